//! What may tell the next byte: features of the bytes before it. A context is a set of them.

use crate::model::MOST;
use crate::parse::{DISP8, DISP32_LAST, IMM8, IMM32_LAST, MODE, Parser};

/// Number of features: a set of them is a `u32`.
pub const FEATURES: usize = 32;

/// The features, kept up byte by byte. They start as zeros.
///
/// Everywhere: 0 to 5 the last bytes, 30 what the longest match predicts. In code: 6 the field, 7 the bytes of
/// it so far; 8 to 11 of the current instruction opcode, operands byte, hash of all so far, REX or VEX;
/// 12 to 15 the same of the one before; 16 and 17 opcode and operands byte of the one before that; 19 the last two
/// opcodes, 27 the last four; 20 the register that the last operands byte names in its middle; 21 the highest bits of
/// registers; 22 bytes until the next place that is jumped to, at most 16; 23 what the bytes to come of a displacement
/// or distance were when the same addressing mode had one last; 31 the addressing mode. In data: 6 to 27 further
/// bytes, 28 the word so far, 29 and 31 the position modulo 4 and 16.
#[repr(C)]
#[derive(Clone)]
pub struct Features {
    /// The features themselves.
    pub f: [u32; FEATURES],
    /// Address of the text's first byte, counted as its instructions are.
    pub origin: u32,
    /// Where in an instruction the next byte stands.
    parser: Parser,
    word: u32,
    /// The last bytes as a little-endian number.
    number: u32,
    numbers: [u32; 256],
}

/// Which positions are jumped to, from before.
pub type Targets = [bool; MOST];

/// Mixes a number into a hash.
pub fn hash(h: u32, value: u32) -> u32 {
    let h = (h ^ value).wrapping_mul(0x9e37_79b1);
    h ^ h >> 15
}

impl Features {
    /// Before the first byte.
    pub const ZERO: Self =
        Self { f: [0; FEATURES], origin: 0, parser: Parser::START, word: 0, number: 0, numbers: [0; 256] };

    /// A small number that says what is to come: in code the field, in data the position modulo 4. Below 32.
    pub fn place(&self, code: bool) -> u32 {
        if code { self.f[6] & 31 } else { self.f[29] & 3 }
    }

    /// Takes one byte. `position` is that of the next byte, which is `code` or is not.
    #[inline(never)]
    pub fn push(&mut self, byte: u8, position: u32, code: bool, targets: &mut Targets) {
        let f = &mut self.f;
        let value = byte as u32;
        // A loop, since `copy_within` would be the only call of a function for moving memory, which took 35 bytes.
        for i in (0..if code { 5 } else { 27 }).rev() {
            f[i + 1] = f[i];
        }
        f[0] = value;
        if !code {
            self.word = if byte >= b'A' { hash(self.word, value) } else { 0 };
            f[28] = self.word;
            f[29] = position & 3;
            f[31] = position & 15;
            return;
        }
        let p = &mut self.parser;
        let before = p.field();
        p.step(byte);
        let address = position.wrapping_add(self.origin);
        self.number = self.number >> 8 | value << 24;
        if before == DISP8 || before == IMM8 {
            self.number = byte as i8 as u32;
        }
        let jump = p.relative >= IMM8 && matches!(before, IMM8 | IMM32_LAST);
        if jump {
            if before == IMM8 {
                self.number = self.number.wrapping_add(address);
            }
            targets[self.number.wrapping_sub(self.origin) as usize & (MOST - 1)] = true;
        }
        if jump || matches!(before, DISP8 | DISP32_LAST) {
            self.numbers[p.addressing()] = self.number;
        }
        let opcode = p.map << 8 | p.op;
        f[10] = hash(f[10], value + 1);
        f[8] = opcode | p.prefix << 16;
        f[9] = p.modrm;
        f[11] = p.rex;
        if p.done {
            f[20] = p.modrm & 7 | p.high << 1 & 8;
            f[27] = f[27] << 8 | p.op;
            f[19] = f[27] & 0xffff;
            f.copy_within(12..14, 16);
            f.copy_within(8..12, 12);
            f[8..12].fill(0);
        }
        let p = if p.done { Parser::START } else { *p };
        let field = p.field();
        f[31] = p.modrm & MODE;
        if matches!(field, 5..=7 | 10..=12) {
            f[7] = hash(f[7], value + 1);
            f[23] >>= 8;
        } else {
            f[7] = 0;
            f[23] = self.numbers[p.addressing()];
            if p.relative == IMM8 {
                f[23] = f[23].wrapping_sub(address.wrapping_add(1)) & 255;
            }
        }
        f[6] = field | ((p.relative != 0) as u32) << 4 | p.map << 5;
        f[21] = p.high;
        f[22] = (0..16).find(|i| targets[(position + i) as usize & (MOST - 1)]).unwrap_or(16);
    }
}
