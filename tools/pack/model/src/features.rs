//! What may tell the next byte: features of the bytes before it. A context is a set of them.

use crate::parse::{DISP8, IMM8, MODRM, Parser};

/// Number of features: a set of them is a `u32`.
pub const FEATURES: usize = 32;

/// The features, kept up byte by byte. They start as zeros.
///
/// Everywhere: 0 to 5 the last bytes, 30 what the longest match predicts. In code: 6 the field, 7 the bytes of
/// it so far; 8 to 11 of the current instruction opcode, operands byte, hash of all so far, REX or VEX;
/// 12 to 27 the same of the four before; 28 the last displacement in the same addressing mode, 29 the operands
/// byte that followed the same opcode last, 31 the addressing mode. In data: 6 to 27 further bytes,
/// 28 the word so far, 29 and 31 the position modulo 4 and 16.
#[repr(C)]
pub struct Features {
    /// The features themselves.
    pub f: [u32; FEATURES],
    /// Where in an instruction the next byte stands.
    parser: Parser,
    word: u32,
    displacements: [u32; 256],
    operands: [u32; 1024],
}

/// Mixes a number into a hash.
pub fn hash(h: u32, value: u32) -> u32 {
    let h = (h ^ value).wrapping_mul(0x9e37_79b1);
    h ^ h >> 15
}

impl Features {
    /// Before the first byte.
    pub const ZERO: Self =
        Self { f: [0; FEATURES], parser: Parser::START, word: 0, displacements: [0; 256], operands: [0; 1024] };

    /// A small number that says what is to come: in code the field, in data the position modulo 4. Below 32.
    pub fn place(&self, code: bool) -> u32 {
        if code { self.f[6] & 31 } else { self.f[29] & 3 }
    }

    /// Takes one byte. `position` is that of the next byte, which is `code` or is not.
    #[inline(never)]
    pub fn push(&mut self, byte: u8, position: u32, code: bool) {
        let f = &mut self.f;
        let value = byte as u32;
        f.copy_within(0..if code { 5 } else { 27 }, 1);
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
        let place = p.modrm as usize & 0xc7;
        p.step(byte);
        let opcode = p.map << 8 | p.op;
        let d = &mut self.displacements[place];
        if (DISP8..IMM8).contains(&before) {
            *d = *d << 8 | value;
        }
        let o = &mut self.operands[opcode as usize & 1023];
        if before == MODRM {
            *o = value;
        }
        f[10] = hash(f[10], value + 1);
        f[8] = opcode | p.prefix << 16;
        f[9] = p.modrm;
        f[11] = p.rex;
        if p.done {
            f.copy_within(8..24, 12);
            f[8..12].fill(0);
        }
        let p = if p.done { Parser::START } else { *p };
        let field = p.field();
        f[7] = if matches!(field, 5..=7 | 10..=12) { hash(f[7], value + 1) } else { 0 };
        f[6] = field | ((p.relative != 0) as u32) << 4 | p.map << 5;
        f[31] = p.modrm & 0xc7;
        f[28] = self.displacements[f[31] as usize & 255];
        f[29] = self.operands[(p.map << 8 | p.op) as usize & 1023];
    }
}
