//! A function's instructions, and the ways through them.

use super::Tables;
use super::instruction::{Instruction, Kind};
use super::known::{Change, Known};
use std::collections::BTreeMap;

/// A function in pieces that are entered at their first instruction and left after their last one.
pub struct Function<'a> {
    blocks: Vec<Block<'a>>,
    /// Block by label.
    labels: BTreeMap<&'a str, usize>,
    tables: &'a Tables<'a>,
    /// Is all that is spilled found by the stack pointer?
    plain: bool,
}

#[derive(Default)]
struct Block<'a> {
    /// Lines, and the instructions there; none where the source has assembly of its own.
    instructions: Vec<(usize, Option<Instruction<'a>>)>,
}

impl<'a> Function<'a> {
    /// The function of these lines, given the assembly's tables of jumps.
    pub fn read(lines: &[&'a str], tables: &'a Tables<'a>) -> Self {
        let mut function = Function { blocks: vec![Block::default()], labels: BTreeMap::new(), tables, plain: true };
        let mut foreign = false;
        for (number, line) in lines.iter().enumerate() {
            if line.starts_with(".LBB") {
                let label = line.split(':').next().unwrap_or_default();
                function.labels.insert(label, function.blocks.len());
                function.blocks.push(Block::default());
            }
            foreign |= line.contains("#APP");
            let instruction = Instruction::read(line);
            let ends = instruction.as_ref().is_some_and(|i| matches!(i.kind(), Kind::Jump | Kind::Return));
            if let Some(instruction) = instruction {
                let found = (0..instruction.operands.len()).any(|n| instruction.slot(n).is_some());
                function.plain &= instruction.remark.is_none() || found;
                let instruction = if foreign { None } else { Some(instruction) };
                function.blocks.last_mut().expect("one at least").instructions.push((number, instruction));
            }
            foreign &= !line.contains("#NO_APP");
            if ends {
                function.blocks.push(Block::default());
            }
        }
        function
    }

    /// The lines that change, and what to: nothing where they go. None of them where the stack pointer cannot be followed, or
    /// something is spilled that it does not find.
    pub fn changes(&self) -> Vec<(usize, String)> {
        let Some(known) = self.plain.then(|| self.known()).flatten() else { return Vec::new() };
        let mut changes = Vec::new();
        for (block, known) in self.blocks.iter().zip(known) {
            let Some(mut known) = known else { continue };
            for (line, instruction) in &block.instructions {
                let Some(instruction) = instruction else {
                    known.forget();
                    continue;
                };
                match known.pass(instruction) {
                    Some(Change::Delete) => changes.push((*line, String::new())),
                    Some(Change::Operand(n, register)) => {
                        let mut operands = instruction.operands.clone();
                        operands[n] = &register;
                        changes.push((*line, format!("\t{}\t{}", instruction.name, operands.join(", "))));
                    }
                    None => {}
                }
            }
        }
        changes
    }

    /// What is known where each block begins that can be reached.
    ///
    /// ```text
    /// from the first block on, until nothing changes
    ///     go through a block
    ///     each block that follows knows no more than this one does at its end
    /// ```
    fn known(&self) -> Option<Vec<Option<Known<'a>>>> {
        let mut starts: Vec<Option<Known>> = vec![None; self.blocks.len()];
        starts[0] = Some(Known::default());
        let mut todo = vec![0];
        while let Some(number) = todo.pop() {
            let mut known = starts[number].clone().expect("what is to be done has been reached");
            for (_, instruction) in &self.blocks[number].instructions {
                match instruction {
                    Some(instruction) => _ = known.pass(instruction),
                    None => known.forget(),
                }
            }
            for next in self.next(number) {
                let same = match &mut starts[next] {
                    Some(start) if start.moved != known.moved => return None,
                    Some(start) => start.meet(&known),
                    start => {
                        *start = Some(known.clone());
                        false
                    }
                };
                if !same {
                    todo.push(next);
                }
            }
        }
        Some(starts)
    }

    /// The blocks that may follow one.
    fn next(&self, number: usize) -> Vec<usize> {
        let mut next = Vec::new();
        let mut goes_on = number + 1 < self.blocks.len();
        if let Some((_, Some(last))) = self.blocks[number].instructions.last() {
            match last.kind() {
                Kind::Jump => {
                    let to = last.operands[0];
                    let table = to.strip_prefix('*').and_then(|to| to.split('(').next());
                    let entries = table.and_then(|table| self.tables.get(table));
                    next.extend(entries.into_iter().flatten().chain([&to]).filter_map(|to| self.labels.get(to)));
                    goes_on &= last.name != "jmp" && last.name != "jmpq";
                }
                Kind::Return => goes_on = false,
                _ => goes_on &= last.name != "ud2",
            }
        }
        next.extend(goes_on.then_some(number + 1));
        next
    }
}
