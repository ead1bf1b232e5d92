//! Sets and models as byte code: a number in a table takes fewer bytes in the 64 kB build than one in code.
//!
//! A script is a row of instructions for a stack machine. A number is pushed, an operation takes its operands from the
//! stack. Arithmetic, loops and variables are carried out here by [`Script::next`]; any other operation is returned to
//! the caller, which reads its operands from [`Script::stack`] and leaves the stack empty. Beside the stack there are
//! [`VARIABLES`] registers that keep their values from operation to operation.
//!
//! [`script!`] compiles a readable form into the bytes, at compile time:
//!
//! ```text
//! repeat(6.0) {                      // COUNT runs from 0 to 5
//!     X = (2.6 + 0.1 * COUNT);       // arithmetic into a variable
//!     at(X, 0.0, -3.4 * COUNT);      // an operation of the scene with its operands
//!     ..marble(DARK, LIGHT, 0.9);    // instructions from a `const fn` or a constant
//!     column(5.4, 0.55);
//! }
//! ```
//!
//! An operation takes the whole stack, so operands may also be pushed before it. Expressions know `+`, `*`,
//! parentheses, `sin`, `cos` and `abs`; there is no subtraction and no division.

use crate::angle;
use crate::texture::{Palette, Pattern, Texture};
use glam::{Mat3A, Vec3A, vec3a};

/// An instruction. From -25.6 to 25.595 it is a number: one byte for tenths from -4 to 11.9, two bytes for other
/// multiples of 1/200. Greater values are [`instruction`]s without an operand.
pub type Word = f32;

/// The number of registers beside the stack.
pub const VARIABLES: usize = 16;
/// The first byte that starts a number of two bytes.
const TWO: u8 = 56;
/// The first byte that is a number of its own.
const ONE: u8 = 96;
// The first bytes of the number 0.
const TWO_ZERO: i32 = 76;
const ONE_ZERO: i32 = 136;
/// Steps of two-byte numbers per unit, and per tenth.
const STEPS: f32 = 200.0;
const TENTH: i32 = 20;

/// The instruction that is encoded as that byte: a variable (pushes its value), an assignment, an operation.
pub const fn instruction(byte: u8) -> Word {
    1000.0 + byte as f32
}

/// A variable: as an operand, its value.
pub const fn variable(number: u8) -> Word {
    instruction(number)
}

/// Takes the value of a variable from the stack.
pub const fn assign(variable: Word) -> Word {
    variable + VARIABLES as f32
}

/// Takes the values of variables from the stack, of the last one first.
pub const fn assign_all<const N: usize>(variables: [Word; N]) -> [Word; N] {
    let (mut words, mut i) = ([0.0; N], 0);
    while i < N {
        words[i] = assign(variables[N - 1 - i]);
        i += 1;
    }
    words
}

/// Names the operations of a machine in a module `op`, as bytes. Lower case, since scripts read like calls.
macro_rules! operations {
    ($($(#[$about:meta])* $name:ident = $byte:expr;)+) => {
        /// The operations of scripts.
        #[allow(non_upper_case_globals)]
        pub(crate) mod op {
            $($(#[$about])* pub const $name: u8 = $byte;)+
        }
    };
}
pub(crate) use operations;

operations! {
    /// The sum of two numbers.
    add = 32;
    /// The product of two numbers.
    mul = 33;
    /// The sine of a number of radians.
    sin = 34;
    /// The cosine of a number of radians.
    cos = 35;
    /// The absolute value of a number.
    abs = 36;
    /// `pick(rows..., index, width)`: of rows of `width` numbers leaves the one at `index`, modulo their count.
    pick = 37;
    /// `repeat(count) { ... }`: runs the block so often; [`COUNT`] is the number of the run, from 0. Blocks do not
    /// nest.
    repeat = 38;
    /// The end of that block. Operations from 40 on belong to the machines of scenes and models.
    again = 39;
}
// Those of expressions as instructions.
pub const ADD: Word = instruction(op::add);
pub const MUL: Word = instruction(op::mul);
pub const SIN: Word = instruction(op::sin);
pub const COS: Word = instruction(op::cos);
pub const ABS: Word = instruction(op::abs);

/// The variable that counts the runs of a block.
pub const COUNT: Word = variable(3);

/// Compiles statements to a `&'static [u8]`; see the module.
///
/// A statement is `operation(operands);` with an operation of the caller's module `op`, `push(operands);`,
/// `VARIABLE = (expression);`, `..array_of_words;` or `repeat(count) { ... }`.
macro_rules! script {
    (@bytes [$($part:expr,)*]) => {{
        const SCRIPT_PARTS: &[&[$crate::scenes::script::Word]] = &[$($part),*];
        const SCRIPT_SIZE: usize = $crate::scenes::script::bytes::<0>(SCRIPT_PARTS).1;
        static SCRIPT_BYTES: [u8; SCRIPT_SIZE] = $crate::scenes::script::bytes(SCRIPT_PARTS).0;
        &SCRIPT_BYTES
    }};
    (@words [$($part:expr,)*]) => { $crate::scenes::script::join(&[$($part),*]) };
    (@ $form:ident [$($parts:tt)*] .. $words:expr; $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [$($parts)* &$words,] $($rest)*)
    };
    (@ $form:ident [$($parts:tt)*] repeat($($count:tt)+) { $($block:tt)* } $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [
            $($parts)* &$crate::scenes::script::words!($($count)+; $crate::scenes::script::op::repeat),
        ] $($block)* again(); $($rest)*)
    };
    (@ $form:ident [$($parts:tt)*] again(); $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [
            $($parts)* &[$crate::scenes::script::instruction($crate::scenes::script::op::again)],
        ] $($rest)*)
    };
    (@ $form:ident [$($parts:tt)*] pick($($operands:tt)+); $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [
            $($parts)* &$crate::scenes::script::words!($($operands)+; $crate::scenes::script::op::pick),
        ] $($rest)*)
    };
    (@ $form:ident [$($parts:tt)*] push($($operands:tt)+); $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [
            $($parts)* &$crate::scenes::script::words!($($operands)+),
        ] $($rest)*)
    };
    (@ $form:ident [$($parts:tt)*] $variable:ident = ($($value:tt)+); $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [
            $($parts)* &$crate::scenes::script::words!($($value)+; = $variable),
        ] $($rest)*)
    };
    (@ $form:ident [$($parts:tt)*] $operation:ident(); $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [
            $($parts)* &[$crate::scenes::script::instruction(op::$operation)],
        ] $($rest)*)
    };
    (@ $form:ident [$($parts:tt)*] $operation:ident($($operands:tt)+); $($rest:tt)*) => {
        $crate::scenes::script::script!(@ $form [
            $($parts)* &$crate::scenes::script::words!($($operands)+; op::$operation),
        ] $($rest)*)
    };
    ($($statements:tt)+) => { $crate::scenes::script::script!(@ bytes [] $($statements)+) };
}
pub(crate) use script;

/// The words of such statements, for other scripts to include: an array whose length the context says.
macro_rules! fragment {
    ($($statements:tt)+) => { $crate::scenes::script::script!(@ words [] $($statements)+) };
}
pub(crate) use fragment;

/// The words of some parts. Panics, at compile time, where there are not `N` of them.
pub const fn join<const N: usize>(parts: &[&[Word]]) -> [Word; N] {
    let (mut words, mut count, mut i) = ([0.0; N], 0, 0);
    while i < parts.len() {
        let mut k = 0;
        while k < parts[i].len() {
            words[count] = parts[i][k];
            count += 1;
            k += 1;
        }
        i += 1;
    }
    assert!(count == N);
    words
}

/// The words that push expressions, followed by an operation or an assignment: `words!(1.0 + X * 2.0; op::at)`.
///
/// It reads from left to right and keeps, besides the words so far, the product and the sum that wait for their right
/// operand: `*` closes a product, `+` closes both, a comma or the end too. At a parenthesis these wait behind `=>`.
macro_rules! words {
    // An operand.
    (@operand $words:tt $mul:tt $add:tt ($($inner:tt)+) $($rest:tt)*) => {
        $crate::scenes::script::words!(@operand $words [] [] $($inner)+ => [] $mul $add $($rest)*)
    };
    (@operand $words:tt $mul:tt $add:tt sin($($inner:tt)+) $($rest:tt)*) => {
        $crate::scenes::script::words!(
            @operand $words [] [] $($inner)+ => [$crate::scenes::script::SIN,] $mul $add $($rest)*)
    };
    (@operand $words:tt $mul:tt $add:tt cos($($inner:tt)+) $($rest:tt)*) => {
        $crate::scenes::script::words!(
            @operand $words [] [] $($inner)+ => [$crate::scenes::script::COS,] $mul $add $($rest)*)
    };
    (@operand $words:tt $mul:tt $add:tt abs($($inner:tt)+) $($rest:tt)*) => {
        $crate::scenes::script::words!(
            @operand $words [] [] $($inner)+ => [$crate::scenes::script::ABS,] $mul $add $($rest)*)
    };
    (@operand [$($words:tt)*] $mul:tt $add:tt $number:literal $($rest:tt)*) => {
        $crate::scenes::script::words!(@operator [$($words)* $number,] $mul $add $($rest)*)
    };
    (@operand [$($words:tt)*] $mul:tt $add:tt $name:ident $($rest:tt)*) => {
        $crate::scenes::script::words!(
            @operator [$($words)* $name as $crate::scenes::script::Word,] $mul $add $($rest)*)
    };
    // What follows an operand.
    (@operator [$($words:tt)*] [$($mul:tt)*] $add:tt * $($rest:tt)+) => {
        $crate::scenes::script::words!(
            @operand [$($words)* $($mul)*] [$crate::scenes::script::MUL,] $add $($rest)+)
    };
    (@operator [$($words:tt)*] [$($mul:tt)*] [$($add:tt)*] + $($rest:tt)+) => {
        $crate::scenes::script::words!(
            @operand [$($words)* $($mul)* $($add)*] [] [$crate::scenes::script::ADD,] $($rest)+)
    };
    (@operator [$($words:tt)*] [$($mul:tt)*] [$($add:tt)*], $($rest:tt)+) => {
        $crate::scenes::script::words!(@operand [$($words)* $($mul)* $($add)*] [] [] $($rest)+)
    };
    (@operator [$($words:tt)*] [$($mul:tt)*] [$($add:tt)*] => [$($function:tt)*] $outer:tt $sum:tt $($rest:tt)*) => {
        $crate::scenes::script::words!(@operator [$($words)* $($mul)* $($add)* $($function)*] $outer $sum $($rest)*)
    };
    // The end.
    (@operator [$($words:tt)*] [$($mul:tt)*] [$($add:tt)*]) => { [$($words)* $($mul)* $($add)*] };
    (@operator [$($words:tt)*] [$($mul:tt)*] [$($add:tt)*]; = $variable:ident) => {
        [$($words)* $($mul)* $($add)* $crate::scenes::script::assign($variable)]
    };
    (@operator [$($words:tt)*] [$($mul:tt)*] [$($add:tt)*]; $operation:path) => {
        [$($words)* $($mul)* $($add)* $crate::scenes::script::instruction($operation)]
    };
    ($($expressions:tt)+) => { $crate::scenes::script::words!(@operand [] [] [] $($expressions)+) };
}
pub(crate) use words;

/// The bytes of an instruction, and how many of them count.
const fn encoded(word: Word) -> ([u8; 2], usize) {
    if word >= instruction(0) {
        return ([(word - instruction(0)) as u8, 0], 1);
    }
    let steps = (word * STEPS + (TWO_ZERO << 8) as f32 + 0.5) as i32;
    let exact = steps - (TWO_ZERO << 8);
    let one = exact / TENTH + ONE_ZERO;
    if exact % TENTH == 0 && one >= ONE as i32 && one < 256 {
        return ([one as u8, 0], 1);
    }
    assert!(steps >> 8 >= TWO as i32 && steps >> 8 < ONE as i32);
    ([(steps >> 8) as u8, steps as u8], 2)
}

/// The bytes of a script's parts, as far as `N` bytes hold them, and how many bytes they take.
pub const fn bytes<const N: usize>(parts: &[&[Word]]) -> ([u8; N], usize) {
    let (mut bytes, mut size, mut i) = ([0; N], 0, 0);
    while i < parts.len() {
        let mut k = 0;
        while k < parts[i].len() {
            let (word, length) = encoded(parts[i][k]);
            let mut byte = 0;
            while byte < length {
                if size < N {
                    bytes[size] = word[byte];
                }
                size += 1;
                byte += 1;
            }
            k += 1;
        }
        i += 1;
    }
    (bytes, size)
}

/// A script being run.
pub struct Script {
    bytes: &'static [u8],
    /// Index of the next byte.
    at: usize,
    /// Where the block that is being repeated begins, and the number of its runs.
    block: (usize, f32),
    /// The variables, then the stack.
    pub numbers: [f32; 256],
    /// The end of the stack in `numbers`.
    top: u8,
}

impl Script {
    /// Starts a script. `variables` are the first two variables; all others are 0.
    #[inline(never)]
    pub fn new(bytes: &'static [u8], variables: [f32; 2]) -> Script {
        let mut numbers = [0.0; 256];
        [numbers[0], numbers[1]] = variables;
        Script { bytes, at: 0, block: (0, 0.0), numbers, top: 0 }
    }

    /// The operands of the operation that [`Script::next`] has returned.
    pub fn stack(&self) -> &[f32] {
        &self.numbers[VARIABLES..self.top as usize]
    }

    /// Runs up to the next operation that is not of this machine, and returns its byte. Panics after the last one.
    #[inline(never)]
    pub fn next(&mut self) -> u8 {
        const COUNT: usize = 3;
        let mut top = VARIABLES as u8;
        loop {
            let word = self.bytes[self.at];
            self.at += 1;
            // The last two numbers, and the place for the result: that of the first operand, unless an arm says
            // otherwise.
            let mut at = top - 2;
            let [a, b] = [at, at + 1].map(|i| self.numbers[i as usize]);
            let number = match word {
                op::add => a + b,
                op::mul => a * b,
                op::sin | op::cos | op::abs => {
                    at += 1;
                    match word {
                        op::sin => angle::sin(b),
                        op::cos => angle::sin_cos(b).1,
                        _ => b.abs(),
                    }
                }
                op::pick => {
                    let width = b as u8;
                    let rows = (at - VARIABLES as u8) / width;
                    let row = a as u8 % rows * width;
                    top = VARIABLES as u8;
                    for _ in 0..width {
                        self.numbers[top as usize] = self.numbers[(top + row) as usize];
                        top += 1;
                    }
                    continue;
                }
                op::again => {
                    self.numbers[COUNT] += 1.0;
                    if self.numbers[COUNT] < self.block.1 {
                        self.at = self.block.0;
                    }
                    continue;
                }
                op::repeat => {
                    self.block = (self.at, b);
                    self.numbers[COUNT] = 0.0;
                    top -= 1;
                    continue;
                }
                16..32 => {
                    self.numbers[word as usize - VARIABLES] = b;
                    top -= 1;
                    continue;
                }
                _ => {
                    at = top;
                    match word {
                        0..16 => self.numbers[word as usize],
                        TWO.. => {
                            let mut steps = (word as i32 - ONE_ZERO) * TENTH;
                            if word < ONE {
                                steps = (word as i32 - TWO_ZERO) * 256 + self.bytes[self.at] as i32;
                                self.at += 1;
                            }
                            steps as f32 / STEPS
                        }
                        _ => {
                            self.top = top;
                            return word;
                        }
                    }
                }
            };
            self.numbers[at as usize] = number;
            top = at + 1;
        }
    }
}

/// Kinds of textures, by the pattern and the palette that they have.
pub mod kind {
    /// The first colour alone.
    pub const PLAIN: u8 = 0;
    /// Cubes of two colours.
    pub const CHECKER: u8 = 1;
    /// Soft noise between two colours.
    pub const CLOUDS: u8 = 2;
    /// Noise with creases between two colours.
    pub const CREASES: u8 = 3;
    /// Folded layers along x, between two colours.
    pub const MARBLE: u8 = 4;
    /// Shades of the second colour, with veins of the first.
    pub const VEINS: u8 = 5;
    /// Rings around y. The last year's wood is as dark as the next one's.
    pub const WOOD: u8 = 6;
    /// Layers of four colours one above the other. Beside the numbers that other kinds have, this one takes the scale
    /// of the noise, the third and the fourth colour, and the height of a layer's middle, hundreds of metres.
    pub const LAYERS: u8 = 7;
}

/// The operands of a scene's `texture`, for most kinds: two linear colours; `scale`, pattern units per metre; and
/// `warp`, how far noise bends the pattern, or for noise itself the number of octaves.
pub const fn pattern(kind: u8, [r, g, b]: [Word; 3], [x, y, z]: [Word; 3], scale: Word, warp: Word) -> [Word; 9] {
    [r, g, b, x, y, z, scale, warp, kind as Word]
}

/// The texture of those operands `n`, turned by `turn` (world to texture) around `at`.
#[inline(never)]
pub fn texture(n: &[f32; 17], turn: &Mat3A, at: Vec3A) -> Texture {
    let color = |i: usize| vec3a(n[i], n[i + 1], n[i + 2]);
    let (a, b, warp, of) = (color(0), color(3), n[7], n[8] as u8);
    let octaves = warp as u32;
    let pattern = match of {
        kind::PLAIN => Pattern::Plain,
        kind::CHECKER => Pattern::Checker,
        kind::CLOUDS => Pattern::Clouds { octaves },
        kind::CREASES => Pattern::Turbulence { octaves },
        kind::WOOD => Pattern::Wood { warp, octaves: 2 },
        kind::LAYERS => Pattern::Marble { warp, scale: n[9], octaves: 5 },
        _ => Pattern::Marble { warp, scale: 0.5 * warp, octaves: 3 },
    };
    let palette = match of {
        kind::VEINS => Palette::Ramp([a, b, b * 0.75, b]),
        kind::WOOD => Palette::Ramp([a, b, a * 0.4 + b * 0.6, a]),
        kind::LAYERS => Palette::Ramp([a, b, color(10), color(13)]),
        _ => Palette::Mix(a, b),
    };
    let mut texture = Texture { pattern, palette, turn: *turn * n[6], origin: at };
    if of == kind::LAYERS {
        // Marble's layers lie across x, these lie across y.
        (texture.turn.x_axis, texture.turn.y_axis) = (texture.turn.y_axis, texture.turn.x_axis);
        texture.origin.y = 100.0 * n[16];
    }
    texture
}
