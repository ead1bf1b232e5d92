//! What registers hold at a place of a function.

use super::instruction::{Instruction, Kind, Remark};
use super::register::{CALLERS, Family, RSP, VECTORS, name};
use std::collections::BTreeSet;

/// Where a value comes from.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Source<'a> {
    /// The memory of a spilled value, by its distance from where the stack pointer was at the start.
    Slot(i64),
    /// A constant, by the load that brings it.
    Constant(&'a str, &'a str),
}

/// The lower bytes of a register are those of a source. A general register whose source has 4 bytes has zeros above.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Fact<'a> {
    register: Family,
    source: Source<'a>,
    size: u8,
}

/// What is known of the registers.
#[derive(Clone, PartialEq, Default)]
pub struct Known<'a> {
    facts: BTreeSet<Fact<'a>>,
    /// General registers with zeros in their upper half, as a set of bits.
    narrow: u32,
    /// How far the stack pointer has gone since the start.
    pub moved: i64,
}

/// What becomes of an instruction.
#[derive(Debug, PartialEq)]
pub enum Change {
    /// It does nothing.
    Delete,
    /// Operand `n` is this register.
    Operand(usize, String),
}

/// Where the stack pointer is put by more than a sum, the place is a new one.
const REALIGNED: i64 = -(1 << 32);

impl<'a> Known<'a> {
    /// Keeps what another way to the same place knows too. Returns whether that was all.
    pub fn meet(&mut self, other: &Known<'a>) -> bool {
        let before = (self.facts.len(), self.narrow);
        self.facts.retain(|fact| other.facts.contains(fact));
        self.narrow &= other.narrow;
        before == (self.facts.len(), self.narrow)
    }

    /// Forgets all but where the stack pointer is.
    pub fn forget(&mut self) {
        *self = Known { moved: self.moved, ..Known::default() };
    }

    /// Goes past an instruction, and tells what it could be instead.
    pub fn pass(&mut self, instruction: &Instruction<'a>) -> Option<Change> {
        match instruction.kind() {
            Kind::Push => {
                self.moved -= 8;
                self.overwritten(self.moved, 8);
            }
            Kind::Pop => {
                self.moved += 8;
                self.written(instruction);
            }
            Kind::Call => self.lost(CALLERS),
            Kind::Other => self.forget(),
            Kind::Jump | Kind::Return => {}
            Kind::Reading => return self.folded(instruction, instruction.operands.len()),
            Kind::Ordinary => {
                let last = instruction.operands.len().saturating_sub(1);
                if instruction.register(last) == Some((RSP, 8)) {
                    self.stack_pointer(instruction);
                } else if let Some(size) = instruction.moved() {
                    return self.moves(instruction, size);
                } else {
                    let constant = constant(instruction);
                    if let (Some((register, size)), Some(source)) = (instruction.register(last), constant) {
                        return self.load(register, source, size);
                    }
                    let change = self.folded(instruction, last);
                    self.written(instruction);
                    return change;
                }
            }
        }
        None
    }

    /// A move of `size` bytes.
    fn moves(&mut self, instruction: &Instruction<'a>, size: u8) -> Option<Change> {
        let [from, to] = [0, 1].map(|n| instruction.register(n).map(|register| register.0));
        let [load, store] = [0, 1].map(|n| instruction.slot(n).map(|slot| Source::Slot(slot + self.moved)));
        let spilled = |remark: &Remark| !remark.folded && remark.size == size;
        let ours = instruction.remark.as_ref().is_some_and(spilled);
        match (from, to) {
            (Some(from), Some(to)) => {
                let copied: Vec<_> =
                    self.facts.iter().copied().filter(|f| f.register == from && f.size <= size).collect();
                self.written(instruction);
                if from != to && (from < VECTORS) == (to < VECTORS) {
                    self.facts.extend(copied.into_iter().map(|fact| Fact { register: to, ..fact }));
                }
                None
            }
            (None, Some(to)) => {
                let source = load.filter(|_| ours).or_else(|| constant(instruction));
                let Some(source) = source else {
                    self.written(instruction);
                    return None;
                };
                let change = self.load(to, source, size);
                self.narrow |= u32::from(size == 4) << to;
                change
            }
            (Some(from), None) => {
                let source = store?;
                let fact = Fact { register: from, source, size };
                if ours && self.facts.contains(&fact) {
                    return Some(Change::Delete);
                }
                self.written(instruction);
                if ours && (size != 4 || from >= VECTORS || self.narrow >> from & 1 != 0) {
                    self.facts.insert(fact);
                }
                None
            }
            (None, None) => None,
        }
    }

    /// A load of `size` bytes from a source into a register.
    fn load(&mut self, register: Family, source: Source<'a>, size: u8) -> Option<Change> {
        let fact = Fact { register, source, size };
        if self.facts.contains(&fact) {
            return Some(Change::Delete);
        }
        self.lost(1 << register);
        self.facts.insert(fact);
        None
    }

    /// The register that an instruction can read instead of the memory among its first `count` operands.
    fn folded(&self, instruction: &Instruction<'a>, count: usize) -> Option<Change> {
        let remark = instruction.remark.filter(|remark| remark.folded && remark.reload)?;
        let (n, slot) = (0..count).find_map(|n| Some((n, instruction.slot(n)?)))?;
        let vectors = instruction.name.starts_with('v');
        let size = if vectors { remark.size } else { width(instruction.name)? };
        if !reads_alike(instruction.name) {
            return None;
        }
        let source = Source::Slot(slot + self.moved);
        let same = |f: &&Fact| f.source == source && f.size >= size && (f.register >= VECTORS) == vectors;
        let fact = self.facts.iter().find(same)?;
        Some(Change::Operand(n, name(fact.register, size)))
    }

    /// Forgets what the last operand of an instruction held.
    fn written(&mut self, instruction: &Instruction<'a>) {
        let last = instruction.operands.len().saturating_sub(1);
        if let Some((register, size)) = instruction.register(last) {
            self.lost(1 << register);
            self.narrow |= u32::from(size == 4) << register;
        } else if let Some(slot) = instruction.slot(last) {
            let size = instruction.remark.map_or(32, |remark| remark.size.into());
            self.overwritten(slot + self.moved, size);
        }
    }

    /// Forgets a set of registers.
    fn lost(&mut self, registers: u32) {
        self.facts.retain(|fact| registers >> fact.register & 1 == 0);
        self.narrow &= !registers;
    }

    /// Forgets which registers hold some memory of the stack.
    fn overwritten(&mut self, start: i64, size: i64) {
        self.facts.retain(|fact| match fact.source {
            Source::Slot(slot) => slot >= start + size || slot + i64::from(fact.size) <= start,
            Source::Constant(..) => true,
        });
    }

    /// Follows the stack pointer.
    fn stack_pointer(&mut self, instruction: &Instruction<'a>) {
        let by = instruction.operands[0].strip_prefix('$').and_then(|by| by.parse::<i64>().ok());
        match (instruction.name, by) {
            ("addq", Some(by)) => self.moved += by,
            ("subq", Some(by)) => self.moved -= by,
            _ => *self = Known { moved: REALIGNED, ..Known::default() },
        }
    }
}

/// The constant that an instruction loads, where that is all it does.
fn constant<'a>(instruction: &Instruction<'a>) -> Option<Source<'a>> {
    let [from, _] = instruction.operands[..] else { return None };
    let name = match instruction.name {
        "vbroadcastss" | "vpbroadcastd" => "vbroadcastss",
        "vmovss" | "vmovsd" | "vmovaps" => instruction.name,
        _ => return None,
    };
    from.starts_with(".LCPI").then_some(Source::Constant(name, from))
}

/// The bytes that the name of a general instruction says that it works on.
fn width(name: &str) -> Option<u8> {
    match name.as_bytes().last()? {
        b'q' => Some(8),
        b'l' => Some(4),
        b'w' => Some(2),
        b'b' => Some(1),
        _ => None,
    }
}

/// Does an instruction read the same from a register as from memory? Those that move, widen or convert parts may not.
fn reads_alike(name: &str) -> bool {
    let parts =
        ["mov", "vmov", "vpmov", "vins", "vpins", "vext", "vpext", "vbroad", "vpbroad", "vcvt", "vmask", "vpmask"];
    !parts.iter().any(|part| name.starts_with(part))
}
