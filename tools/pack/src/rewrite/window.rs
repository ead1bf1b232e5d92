//! What must stay as it is when the instructions of a window change their order.

use super::instruction::{FLAGS, Op, UNITS, Use};

/// Most instructions of a window.
pub const MOST: usize = 24;

/// Where a value comes from: an instruction of the window and its slot, or what a unit held before.
type Source = (usize, u8);
const BEFORE: usize = MOST;

/// A window, as it was.
pub struct Window {
    /// For each instruction a bit for each that must come before it for what they do in memory.
    before: Vec<u32>,
    /// What each reads: slots and where their values come from, sorted.
    sources: Vec<Vec<(u8, Source)>>,
    /// What the units hold at the end.
    last: [Source; UNITS],
    flags_live: bool,
}

impl Window {
    /// The window as it is, in the order of `ops`. Are the flags looked at after it?
    pub fn new(ops: &[Op], flags_live: bool) -> Self {
        let memory = |j: usize| {
            let ordered = |i: usize| {
                let same = |register| ops[i..j].iter().all(|op| op.writes.iter().all(|&(_, unit)| unit != register));
                ops[i].memory.iter().any(|a| ops[j].memory.iter().any(|b| a.precedes(b, same)))
            };
            (0..j).filter(|&i| ordered(i)).fold(0, |bits, i| bits | 1 << i)
        };
        let before = (0..ops.len()).map(memory).collect();
        let mut sources = Vec::new();
        let order: Vec<usize> = (0..ops.len()).collect();
        let last = flow(ops, &order, |_, found| {
            sources.push(found.to_vec());
            true
        });
        Self { before, sources, last: last.expect("nothing stopped it"), flags_live }
    }

    /// Whether `ops`, each of which does what it did, do the same in `order`: each reads the same values, memory is read and
    /// written in order, and registers hold the same at the end.
    pub fn allows(&self, ops: &[Op], order: &[usize]) -> bool {
        let mut done = 0u32;
        let last = flow(ops, order, |k, found| {
            let right = self.before[k] & !done == 0 && self.sources[k] == found;
            done |= 1 << k;
            right
        });
        let counted = if self.flags_live { UNITS } else { FLAGS };
        last.is_some_and(|last| last[..counted] == self.last[..counted])
    }
}

/// Follows values through `ops` in `order`: gives `each` instruction what it reads until that says no. Returns what the
/// units hold at the end.
fn flow(ops: &[Op], order: &[usize], mut each: impl FnMut(usize, &[(u8, Source)]) -> bool) -> Option<[Source; UNITS]> {
    let mut now: [Source; UNITS] = std::array::from_fn(|unit| (BEFORE, unit as u8));
    let mut found = Vec::new();
    for &k in order {
        found.clear();
        found.extend(ops[k].reads.iter().map(|&(slot, unit): &Use| (slot, now[unit as usize])));
        found.sort_unstable();
        if !each(k, &found) {
            return None;
        }
        for &(slot, unit) in &ops[k].writes {
            now[unit as usize] = (k, slot);
        }
    }
    Some(now)
}

#[cfg(test)]
mod tests {
    use super::*;
    use iced_x86::{Decoder, DecoderOptions, InstructionInfoFactory};
    use pack_model::form::Form;

    /// Constants are from here on.
    const CONSTANTS: u64 = 0x40_0000;

    fn ops(code: &[u8]) -> Vec<Op> {
        let mut factory = InstructionInfoFactory::new();
        let decoder = Decoder::with_ip(64, code, 0x1000, DecoderOptions::NONE);
        let op = |i: iced_x86::Instruction| {
            let at = (i.ip() - 0x1000) as usize;
            Op::new(&mut factory, i, &code[at..at + i.len()], Form::Plain, &(CONSTANTS..2 * CONSTANTS))
        };
        decoder.into_iter().map(op).collect()
    }

    /// Whether two instructions may change places, where the flags are looked at after them.
    fn swap(code: &[u8]) -> bool {
        let ops = ops(code);
        assert_eq!(ops.len(), 2, "{code:x?}");
        assert!(Window::new(&ops, true).allows(&ops, &[0, 1]), "{code:x?}");
        Window::new(&ops, true).allows(&ops, &[1, 0])
    }

    #[test]
    fn values_and_memory_stay_what_they_were() {
        // What may, and its like that may not.
        let pairs: [(&[u8], &[u8]); 9] = [
            // mov eax, ebx; mov ecx, edx (eax)
            (b"\x89\xd8\x89\xd1", b"\x89\xd8\x89\xc1"),
            // mov eax, ebx; mov cl, dl; and where the second writes a part of what the first writes
            (b"\x89\xd8\x88\xd1", b"\x89\xd8\x88\xd0"),
            // cmp eax, ebx; mov ecx, edx; and an add, which has flags too
            (b"\x39\xd8\x89\xd1", b"\x39\xd8\x01\xd1"),
            // [rsp+8] = rax; rcx = [rsp+16] ([rsp+12], which overlaps)
            (b"\x48\x89\x44\x24\x08\x48\x8b\x4c\x24\x10", b"\x48\x89\x44\x24\x08\x48\x8b\x4c\x24\x0c"),
            // [rbx] = eax; ecx = [rbx+4] ([rdi+4], which may be the same)
            (b"\x89\x03\x8b\x4b\x04", b"\x89\x03\x8b\x4f\x04"),
            // ecx = [rdi]; edx = [rsi]; of two stores the order can be seen
            (b"\x8b\x0f\x8b\x16", b"\x89\x0f\x89\x56\x04"),
            // [rdi] = eax; ecx = a constant (a variable)
            (b"\x89\x07\x8b\x0c\x25\x00\x00\x40\x00", b"\x89\x07\x8b\x0c\x25\x00\x00\x30\x00"),
            // vaddps ymm0, ymm1, ymm2; vmulps ymm3, ymm1, ymm2 (xmm0, of which the sum is a part)
            (b"\xc5\xf4\x58\xc2\xc5\xf4\x59\xda", b"\xc5\xf4\x58\xc2\xc5\xf0\x59\xd8"),
            // mov rbx, [rax]; mov rcx, [rax+8]; and where rax is what was loaded
            (b"\x48\x8b\x18\x48\x8b\x48\x08", b"\x48\x8b\x00\x48\x8b\x48\x08"),
        ];
        for (may, may_not) in pairs {
            assert!(swap(may), "{may:x?}");
            assert!(!swap(may_not), "{may_not:x?}");
        }
    }

    #[test]
    fn what_is_more_than_its_operands_stays() {
        // Calls, jumps, push and pop, locked and repeated ones, exchanges with memory, system calls.
        let all: [&[u8]; 9] = [
            b"\xe8\0\0\0\0",
            b"\x74\x00",
            b"\x50",
            b"\x58",
            b"\xf0\x01\x03",
            b"\xf3\xa4",
            b"\x87\x03",
            b"\x0f\x05",
            b"\x48\x83\xec\x08",
        ];
        assert!(all.iter().all(|code| ops(code)[0].fixed));
        assert!(!ops(b"\x01\x03")[0].fixed);
    }

    /// mov eax, ebx, which may move in the form that is coded, and not where it is left as the processor has it.
    #[test]
    fn what_is_not_in_the_coded_form_stays() {
        let mut factory = InstructionInfoFactory::new();
        let instruction = Decoder::with_ip(64, b"\x89\xd8", 0x1000, DecoderOptions::NONE).decode();
        let mut is_fixed = |bytes| Op::new(&mut factory, instruction, bytes, Form::Coded, &(0..0)).fixed;
        assert!(!is_fixed(b"\x89\xc3"));
        assert!(is_fixed(b"\x89\xd8"));
    }

    /// vaddps ymm0, ymm1, ymm2 is as good with the last two swapped; vsubps is not, nor is what would be longer.
    #[test]
    fn operands_commute() {
        let mut factory = InstructionInfoFactory::new();
        let mut variants = |code: &[u8]| -> Vec<Vec<u8>> {
            let all = ops(code)[0].variants(&mut factory);
            all.into_iter().map(|op| op.bytes).collect()
        };
        assert_eq!(variants(b"\xc5\xf4\x58\xc2"), [b"\xc5\xec\x58\xc1"]);
        assert!(variants(b"\xc5\xf4\x5c\xc2").is_empty());
        // ymm9 as the last one needs a longer prefix.
        assert!(variants(b"\xc5\xb4\x58\xc2").is_empty());
        // lea rax, [rbx + rcx] and [rsp + rcx], which has no other way.
        assert_eq!(variants(b"\x48\x8d\x04\x0b"), [b"\x48\x8d\x04\x19"]);
        assert!(variants(b"\x48\x8d\x04\x0c").is_empty());
        let before = ops(b"\xc5\xf4\x58\xc2");
        let swapped = before[0].variants(&mut factory);
        assert!(Window::new(&before, true).allows(&swapped, &[0]));
    }
}
