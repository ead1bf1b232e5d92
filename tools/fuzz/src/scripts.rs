//! The stack machine of scripts: any valid script has to leave what its statements mean.
//!
//! A script has no errors: one that is not valid was never compiled. So an input is read as statements, which are both
//! coded, by the rules that `src/scenes/script.rs` states, and carried out, by a walk over their expressions.

use crate::input::Input;
use crate::scenes::script::{Script, VARIABLES};

/// Most operations of a scene that a script has, and most bytes.
const OPERATIONS: usize = 200;
const BYTES: usize = 4000;
/// Most operands of an operation, and depth of an expression.
const OPERANDS: usize = 12;
const DEPTH: usize = 5;
/// The variable that counts the runs of a block.
const COUNT: usize = 3;
// The bytes of instructions.
const ASSIGN: u8 = 16;
const ADD: u8 = 32;
const MUL: u8 = 33;
const SIN: u8 = 34;
const COS: u8 = 35;
const ABS: u8 = 36;
const PICK: u8 = 37;
const REPEAT: u8 = 38;
const AGAIN: u8 = 39;
/// The first operation of scenes.
const FIRST: u8 = 40;
/// How many operations of scenes there may be, up to the first byte of a number.
const OWN: usize = 16;

/// An expression.
enum Term {
    /// A multiple of 1/200.
    Number(i32),
    Variable(u8),
    Sum(Box<[Term; 2]>),
    Product(Box<[Term; 2]>),
    Function(u8, Box<Term>),
}

/// A statement.
enum Statement {
    /// An operation of a scene with its operands.
    Operation(u8, Vec<Term>),
    Assign(u8, Term),
    /// Rows of a width, of which one is left, and an operation that takes it.
    Pick {
        rows: Vec<Vec<i32>>,
        index: u8,
        operation: u8,
    },
    /// A block that is run so often, in 200ths.
    Repeat(i32, Vec<Statement>),
}

/// What the operations that a script comes to have as operands.
type Trace = Vec<(u8, Vec<f32>)>;

pub fn run(bytes: &[u8]) {
    let input = &mut Input::new(bytes);
    let mut statements = Vec::new();
    while !input.is_empty() {
        let statement = statement(input, true);
        statements.push(statement);
    }
    let (mut code, mut numbers, mut trace) = (Vec::new(), [0.0; VARIABLES], Vec::new());
    (numbers[0], numbers[1]) = (input.number(-9.0, 9.0), input.number(-9.0, 9.0));
    let mut script_numbers = [numbers[0], numbers[1]];
    for statement in &statements {
        let (mut more, mut after, mut next) = (Vec::new(), numbers, Vec::new());
        statement.code(&mut more);
        statement.act(&mut after, &mut next);
        if trace.len() + next.len() > OPERATIONS || code.len() + more.len() > BYTES {
            break;
        }
        code.extend(more);
        trace.extend(next);
        numbers = after;
    }
    // A last operation, so that all before it is carried out.
    code.push(FIRST);
    trace.push((FIRST, Vec::new()));
    script_numbers = script_numbers.map(|number| number + 0.0);
    let mut script = Script::new(code.leak(), script_numbers);
    for (operation, operands) in &trace {
        assert_eq!(script.next(), *operation);
        assert!(same(script.stack(), operands), "{:?} for {operands:?}", script.stack());
    }
    assert!(same(&script.numbers[..VARIABLES], &numbers), "{:?} for {numbers:?}", &script.numbers[..VARIABLES]);
}

/// Whether numbers are the same, bit for bit, or both none.
fn same(ours: &[f32], theirs: &[f32]) -> bool {
    let equal = |(a, b): (&f32, &f32)| a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan();
    ours.len() == theirs.len() && ours.iter().zip(theirs).all(equal)
}

fn statement(input: &mut Input, may_repeat: bool) -> Statement {
    let operation = FIRST + input.below(OWN) as u8;
    match input.below(if may_repeat { 4 } else { 3 }) {
        0 => Statement::Operation(operation, (0..input.below(OPERANDS)).map(|_| term(input, DEPTH)).collect()),
        1 => {
            let variable = input.below(VARIABLES);
            // What counts a block's runs may not be changed within it.
            let variable = if variable == COUNT && !may_repeat { COUNT + 1 } else { variable };
            Statement::Assign(variable as u8, term(input, DEPTH))
        }
        2 => {
            let (width, count) = (1 + input.below(4), 1 + input.below(5));
            let rows = (0..count).map(|_| (0..width).map(|_| number(input)).collect()).collect();
            Statement::Pick { rows, index: input.below(25) as u8, operation }
        }
        _ => {
            let runs = input.below(1800) as i32 - 200;
            Statement::Repeat(runs, (0..1 + input.below(4)).map(|_| statement(input, false)).collect())
        }
    }
}

/// A number from -25.6 to 25.595, in 200ths; often of a tenth.
fn number(input: &mut Input) -> i32 {
    let number = input.below(10_240) as i32 - 5120;
    if input.flag() { number / 20 * 20 } else { number }
}

fn term(input: &mut Input, depth: usize) -> Term {
    let kind = if depth == 0 || input.is_empty() { input.below(2) } else { input.below(5) };
    match kind {
        0 => Term::Number(number(input)),
        1 => Term::Variable(input.below(VARIABLES) as u8),
        2 => Term::Sum([term(input, depth - 1), term(input, depth - 1)].into()),
        3 => Term::Product([term(input, depth - 1), term(input, depth - 1)].into()),
        _ => Term::Function(input.one_of(&[SIN, COS, ABS]), term(input, depth - 1).into()),
    }
}

/// A number: one byte for tenths from -4 to 11.9, else two.
fn code_number(number: i32, code: &mut Vec<u8>) {
    if number % 20 == 0 && (-40..120).contains(&(number / 20)) {
        code.push((136 + number / 20) as u8);
    } else {
        let [low, high, ..] = (number + (76 << 8)).to_le_bytes();
        code.extend([high, low]);
    }
}

impl Term {
    fn code(&self, code: &mut Vec<u8>) {
        match self {
            Term::Number(number) => code_number(*number, code),
            Term::Variable(variable) => code.push(*variable),
            Term::Sum(terms) | Term::Product(terms) => {
                terms.iter().for_each(|term| term.code(code));
                code.push(if matches!(self, Term::Sum(_)) { ADD } else { MUL });
            }
            Term::Function(function, term) => {
                term.code(code);
                code.push(*function);
            }
        }
    }

    fn value(&self, variables: &[f32; VARIABLES]) -> f32 {
        match self {
            Term::Number(number) => *number as f32 / 200.0,
            Term::Variable(variable) => variables[usize::from(*variable)],
            Term::Sum(terms) => terms[0].value(variables) + terms[1].value(variables),
            Term::Product(terms) => terms[0].value(variables) * terms[1].value(variables),
            Term::Function(function, term) => match (*function, term.value(variables)) {
                (SIN, value) => f64::from(value).sin() as f32,
                (COS, value) => f64::from(value).cos() as f32,
                (_, value) => value.abs(),
            },
        }
    }
}

impl Statement {
    fn code(&self, code: &mut Vec<u8>) {
        match self {
            Statement::Operation(operation, operands) => {
                operands.iter().for_each(|operand| operand.code(code));
                code.push(*operation);
            }
            Statement::Assign(variable, value) => {
                value.code(code);
                code.push(ASSIGN + variable);
            }
            Statement::Pick { rows, index, operation } => {
                rows.as_slice().concat().iter().for_each(|number| code_number(*number, code));
                code_number(200 * i32::from(*index), code);
                code_number(200 * rows[0].len() as i32, code);
                code.extend([PICK, *operation]);
            }
            Statement::Repeat(runs, block) => {
                code_number(*runs, code);
                code.push(REPEAT);
                block.iter().for_each(|statement| statement.code(code));
                code.push(AGAIN);
            }
        }
    }

    fn act(&self, variables: &mut [f32; VARIABLES], trace: &mut Trace) {
        match self {
            Statement::Operation(operation, operands) => {
                trace.push((*operation, operands.iter().map(|operand| operand.value(variables)).collect()));
            }
            Statement::Assign(variable, value) => variables[usize::from(*variable)] = value.value(variables),
            Statement::Pick { rows, index, operation } => {
                let row = &rows[usize::from(*index) % rows.len()];
                trace.push((*operation, row.iter().map(|number| *number as f32 / 200.0).collect()));
            }
            Statement::Repeat(runs, block) => {
                let runs = *runs as f32 / 200.0;
                variables[COUNT] = 0.0;
                loop {
                    block.iter().for_each(|statement| statement.act(variables, trace));
                    variables[COUNT] += 1.0;
                    if variables[COUNT] >= runs {
                        break;
                    }
                }
            }
        }
    }
}
