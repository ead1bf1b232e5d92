//! What may tell the next byte: features of the bytes before it. A context is a set of them.

use crate::parse::{Field, Parser};

/// Number of features: a set of them is a `u32`.
pub const FEATURES: usize = 32;

/// The features, kept up byte by byte.
///
/// Everywhere: 0 to 5 the last bytes, 30 what the longest match predicts. In code: 6 the field, 7 the bytes of
/// it so far; 8 to 11 of the current instruction opcode, operands byte, hash of all so far, REX or VEX;
/// 12 to 27 the same of the four before; 28 the last displacement after the same operands byte, 29 the operands
/// byte that followed the same opcode last, 31 the addressing mode. In data: 6 to 27 further bytes,
/// 28 the word so far, 29 and 31 the position modulo 4 and 16.
pub struct Features {
    /// The features themselves.
    pub f: [u32; FEATURES],
    /// Where in an instruction the next byte stands.
    pub parser: Parser,
    displacements: [u32; 512],
    operands: [u32; 1024],
    word: u32,
}

/// Mixes a number into a hash.
pub fn hash(h: u32, value: u32) -> u32 {
    let h = (h ^ value).wrapping_mul(0x9e37_79b1);
    h ^ h >> 15
}

impl Features {
    /// Before the first byte.
    pub const ZERO: Self = Self {
        f: [0; FEATURES],
        parser: Parser::START,
        displacements: [0; 512],
        operands: [0; 1024],
        word: 0,
    };

    /// A small number that says what is to come: in code the field and how many bytes of it, in data the
    /// position modulo 4. Below 128.
    pub fn place(&self) -> usize {
        if self.f[6] & 0x100 == 0 {
            return self.f[29] as usize & 3;
        }
        self.f[6] as usize & 127
    }

    /// Takes one byte. `position` is that of the next byte, which is `code` or is not.
    pub fn push(&mut self, byte: u8, position: usize, code: bool) {
        let f = &mut self.f;
        let value = byte as u32;
        if !code {
            f.copy_within(0..27, 1);
            f[0] = value;
            self.word = if byte.is_ascii_alphabetic() { hash(self.word, value) } else { 0 };
            f[28] = self.word;
            f[29] = position as u32 & 3;
            f[31] = position as u32 & 15;
            return;
        }
        f.copy_within(0..5, 1);
        f[0] = value;
        let p = &mut self.parser;
        let before = p.field;
        let key = (p.modrm & 0xc7) as usize | (p.rex as usize & 1) << 8;
        p.step(byte);
        let opcode = (p.map as usize & 3) << 8 | p.op as usize;
        if before == Field::Disp {
            let d = &mut self.displacements[key & 511];
            *d = *d << 8 | value;
        }
        if before == Field::ModRm {
            self.operands[opcode & 1023] = value;
        }
        f[7] = if before == p.field && before as u8 >= Field::Disp as u8 { hash(f[7], value + 1) } else { 0 };
        f[10] = hash(f[10], value + 1);
        f[8] = opcode as u32 | (p.prefix as u32) << 16;
        f[9] = p.modrm as u32;
        f[11] = p.rex as u32;
        if p.done {
            f.copy_within(8..24, 12);
            f[8..12].fill(0);
            f[7] = 0;
        }
        let p = if p.done { Parser::START } else { *p };
        let to_come = if p.field == Field::Disp { p.disp } else { p.imm };
        f[6] = 0x180 | (p.relative as u32) << 9 | (p.field as u32) << 3 | to_come as u32 & 7 | (p.map as u32) << 10;
        f[28] = self.displacements[((f[9] & 0xc7) | (f[11] & 1) << 8) as usize & 511];
        f[29] = self.operands[(f[8] & 1023) as usize];
        f[31] = f[9] & 0xc7;
    }
}
