//! A line of assembly as an instruction: its name, its operands, and the compiler's remark on memory of spilled values.

use super::register::{Family, named};

/// An instruction in AT&T's syntax: what is written to comes last.
pub struct Instruction<'a> {
    /// Its name, with the size where it has one: `movq`.
    pub name: &'a str,
    /// What it works on.
    pub operands: Vec<&'a str>,
    /// What the compiler says of the stack: `8-byte Folded Reload`.
    pub remark: Option<Remark>,
}

/// An access to the memory of a spilled value.
#[derive(Clone, Copy)]
pub struct Remark {
    /// Bytes.
    pub size: u8,
    /// Is it part of an instruction that does more than that?
    pub folded: bool,
    /// Is it read, and not written?
    pub reload: bool,
}

/// What an instruction does to registers.
#[derive(PartialEq)]
pub enum Kind {
    /// It writes to its last operand and to nothing else.
    Ordinary,
    /// It compares.
    Reading,
    Jump,
    Return,
    Call,
    Push,
    Pop,
    /// It may write to anything.
    Other,
}

impl<'a> Instruction<'a> {
    /// The instruction of a line, if it is one.
    pub fn read(line: &'a str) -> Option<Self> {
        let (code, comment) = line.split_once('#').unwrap_or((line, ""));
        let code = code.strip_prefix('\t')?.trim_end();
        if !code.starts_with(|c: char| c.is_ascii_lowercase()) {
            return None;
        }
        let (name, operands) = code.split_once('\t').unwrap_or((code, ""));
        Some(Instruction { name, operands: split(operands), remark: remark(comment) })
    }

    pub fn kind(&self) -> Kind {
        let is = |names: &[&str]| names.contains(&self.name);
        let sized = |names: &[&str]| {
            let name = self.name.strip_suffix(['q', 'l', 'w', 'b']).unwrap_or_default();
            names.contains(&name)
        };
        if self.operands.iter().any(|operand| operand.contains("%es:")) {
            Kind::Other
        } else if self.name.starts_with('j') {
            Kind::Jump
        } else if self.name.starts_with("call") {
            Kind::Call
        } else if is(&["retq"]) {
            Kind::Return
        } else if is(&["pushq"]) {
            Kind::Push
        } else if is(&["popq"]) {
            Kind::Pop
        } else if is(&["vtestps", "vtestpd", "vptest"]) || self.name.contains("comis") || sized(&["cmp", "test", "bt"])
        {
            Kind::Reading
        } else if self.name.starts_with('v')
            && !["vzero", "vgather", "vpgather", "vpcmpistr", "vpcmpestr"].iter().any(|p| self.name.starts_with(p))
            || self.name.starts_with("cmov")
            || self.name.starts_with("set")
            || is(&[
                "movabsq", "movzbl", "movzwl", "movsbl", "movswl", "movsbq", "movswq", "movslq", "movzbw", "movsbw",
            ])
            || sized(&[
                "mov", "lea", "add", "sub", "and", "or", "xor", "adc", "sbb", "inc", "dec", "neg", "not", "shl", "shr",
                "sar", "rol", "ror", "shld", "shrd", "bswap", "bts", "btr", "btc", "tzcnt", "lzcnt", "popcnt", "blsr",
                "blsi", "blsmsk", "andn", "shlx", "shrx", "sarx", "rorx", "bextr", "bzhi", "pdep", "pext",
            ])
            || sized(&["imul"]) && self.operands.len() > 1
        {
            Kind::Ordinary
        } else {
            Kind::Other
        }
    }

    /// The register that operand `n` is, and how many of its bytes.
    pub fn register(&self, n: usize) -> Option<(Family, u8)> {
        named(self.operands.get(n)?.strip_prefix('%')?)
    }

    /// The distance from the stack pointer to the memory that operand `n` is.
    pub fn slot(&self, n: usize) -> Option<i64> {
        let distance = self.operands.get(n)?.strip_suffix("(%rsp)")?;
        if distance.is_empty() { Some(0) } else { distance.parse().ok() }
    }

    /// Bytes that a load, a store or a move from register to register moves, where it is one: all that it does is to
    /// move these.
    pub fn moved(&self) -> Option<u8> {
        let [_, _] = self.operands[..] else { return None };
        let register = self.register(0).or(self.register(1))?;
        match self.name {
            "movq" => Some(8),
            "movl" | "vmovss" => Some(4),
            "vmovsd" => Some(8),
            "vmovaps" | "vmovups" | "vmovapd" | "vmovupd" | "vmovdqa" | "vmovdqu" => Some(register.1),
            _ => None,
        }
    }
}

/// Operands, which commas part outside of brackets.
fn split(text: &str) -> Vec<&str> {
    let mut operands = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ',' if depth == 0 => {
                operands.push(text[start..at].trim());
                start = at + 1;
            }
            _ => {}
        }
    }
    if !text.is_empty() {
        operands.push(text[start..].trim());
    }
    operands
}

/// The remark `8-byte Folded Reload` of a comment.
fn remark(comment: &str) -> Option<Remark> {
    let (size, what) = comment.trim().split_once("-byte ")?;
    let (folded, what) = what.strip_prefix("Folded ").map_or((false, what), |what| (true, what));
    if what != "Reload" && what != "Spill" {
        return None;
    }
    Some(Remark { size: size.parse().ok()?, folded, reload: what == "Reload" })
}
