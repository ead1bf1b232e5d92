//! Where in an x86-64 instruction the next byte stands, as it is coded ([`crate::form`]). Lengths after the opcode maps of
//! Intel's manual, volume 2, appendix A; 64-bit mode only, VEX included, EVEX not.

/// A prefix, or the opcode of an instruction without VEX.
pub const OP: u32 = 0;
/// Operands.
pub const MODRM: u32 = 1;
/// Base, index and scale.
pub const SIB: u32 = 2;
/// A displacement of one byte.
pub const DISP8: u32 = 3;
/// The first of four bytes of a displacement; the others follow in numbers too.
pub const DISP32: u32 = 4;
/// The last of them.
pub const DISP32_LAST: u32 = 7;
/// An immediate, or a jump's distance, of one byte.
pub const IMM8: u32 = 8;
/// The first of four bytes of an immediate or of a distance.
pub const IMM32: u32 = 9;
/// The last of them.
pub const IMM32_LAST: u32 = 12;
/// The first of the two bytes that the last of VEX and the opcode are coded as.
pub const VEX: u32 = 14;
/// The second of them, or the opcode after an escape byte.
pub const OP_MORE: u32 = 15;

/// The last byte of VEX and the opcode are coded as one word, rotated to the left by so many bits.
pub const TURN: u32 = 5;
/// What stands for VEX, of two or three bytes, as a prefix.
const VEX_PREFIX: u8 = 0xc5;
/// The bits of a coded operands byte that are the addressing mode.
pub const MODE: u32 = 0xf8;
/// The mode of what is relative to the end of the instruction.
const RELATIVE: u32 = 5 << 3;

/// Bytes of these fields to come: a queue in groups of four bits, the next one lowest.
const FOUR_OF_DISP: u64 = 0x7654;
const FOUR_OF_IMM: u64 = 0xcba9;
/// The second of the three bytes of a VEX prefix (13), its last and the opcode.
const AFTER_C4: u64 = 0xfed;

/// State of the parser between two bytes. It starts as zeros.
#[derive(Clone, Copy)]
pub struct Parser {
    /// Fields to come, as far as they are known.
    queue: u64,
    /// Opcode map: 0 one byte, 1 `0F`, 2 `0F 38`, 3 `0F 3A`.
    pub map: u32,
    /// The opcode, once known.
    pub op: u32,
    /// Operands byte as it is coded, 0 until known.
    pub modrm: u32,
    /// REX, or the last byte of VEX; before that is known, what is coded first of it.
    pub rex: u32,
    /// Highest bits of registers: R 4, X 2, B 1. 8: VEX has three bytes.
    pub high: u32,
    /// The last legacy prefix: `66`, `F2`, `F3`, a segment; `C5` for VEX. Above its eight bits, width and kind of numbers: W of
    /// REX, or L and the prefix that VEX stands for.
    pub prefix: u32,
    /// The field whose bytes, four or one, are relative to the end of the instruction, or 0.
    pub relative: u32,
    /// The last byte ended an instruction, which the other fields still describe.
    pub done: bool,
}

/// One bit for each opcode of maps 0 and 1: does it have operands?
const HAS_MODRM: [u32; 16] = [
    0x0f0f_0f0f,
    0x0f0f_0f0f,
    0,
    0x0000_0a08,
    0x0000_ffff,
    0,
    0xff0f_00c3,
    0xc0c0_0000,
    0xffff_b41f,
    0xff00_ffff,
    0xffff_ffff,
    0xff7f_ffff,
    0xffff_0000,
    0xffff_f8f8,
    0xffff_00ff,
    0xffff_ffff,
];
/// Does it have an immediate of one byte?
const HAS_IMM8: [u32; 16] = [
    0x1010_1010,
    0x1010_1010,
    0,
    0xffff_0c00,
    0x0000_0009,
    0x00ff_0100,
    0x0000_2043,
    0x0000_08ff,
    0,
    0,
    0,
    0x000f_0000,
    0,
    0x0400_1010,
    0x0000_0074,
    0,
];
/// Does it have an immediate or a distance of four bytes? Of map 1 only jumps have, 80 to 8F.
const HAS_IMM32: [u32; 8] =
    [0x2020_2020, 0x2020_2020, 0, 0x0000_0300, 0x0000_0002, 0xff00_0200, 0x0000_0080, 0x0000_0300];

fn has<const N: usize>(table: &[u32; N], index: u32) -> bool {
    table[(index >> 5) as usize % N] >> (index & 31) & 1 != 0
}

impl Parser {
    /// At the start of an instruction.
    pub const START: Self =
        Self { queue: 0, map: 0, op: 0, modrm: 0, rex: 0, high: 0, prefix: 0, relative: 0, done: false };

    /// What comes next.
    pub fn field(&self) -> u32 {
        (self.queue & 15) as u32
    }

    /// Bytes to come after the four of the current field. Two are counted as four.
    pub fn after_four(&self) -> u32 {
        (self.queue as u32 >> 19).min(4)
    }

    /// How the operand in memory is addressed: the mode, and whether its base is one of the upper registers. Below 256.
    pub fn addressing(&self) -> usize {
        (self.modrm & MODE | self.high & 1) as usize
    }

    /// Takes one byte.
    pub fn step(&mut self, byte: u8) {
        if self.done {
            *self = Self::START;
        }
        let byte = byte as u32;
        let field = self.field();
        self.queue >>= 4;
        match field {
            OP | OP_MORE => {
                if self.map == 0 {
                    match byte {
                        0x40..=0x4f => {
                            (self.rex, self.high) = (byte, byte & 7);
                            self.prefix |= (byte & 8) << 8;
                        }
                        // The segments that mean something, and 2E, which long NOPs have. F1 is rare.
                        0x2e | 0x64..=0x67 | 0xf0..=0xf3 => self.prefix = byte,
                        0xc4 => self.queue = AFTER_C4,
                        0xc5 => (self.map, self.queue) = (1, AFTER_C4 >> 4),
                        0x0f => (self.map, self.queue) = (1, OP_MORE as u64),
                        _ => self.opcode(byte),
                    }
                    // No opcode yet; that is never the end.
                    if self.op != byte {
                        return;
                    }
                } else if self.map == 1 && !self.has_vex() && byte & 0xfd == 0x38 {
                    (self.map, self.queue) = (2 + (byte >> 1 & 1), OP_MORE as u64);
                } else {
                    let mut opcode = byte as u8;
                    if self.has_vex() {
                        let vex;
                        [vex, opcode] = u16::from_be_bytes([self.rex as u8, opcode]).rotate_right(TURN).to_be_bytes();
                        self.rex = vex as u32;
                        self.prefix = (self.rex & 7) << 8 | VEX_PREFIX as u32;
                        if self.high == 0 {
                            self.high = !self.rex >> 5 & 4;
                        }
                    }
                    self.opcode(opcode as u32);
                }
            }
            MODRM => {
                self.modrm = byte;
                // TEST, alone of its group, has an immediate.
                if self.map == 0 && self.op & 0xfe == 0xf6 && byte & 6 == 0 {
                    self.queue = if self.op == 0xf6 { IMM8 as u64 } else { self.wide() };
                }
                if byte & MODE == RELATIVE {
                    self.relative = DISP32;
                }
                if byte & MODE == RELATIVE || byte >> 6 == 2 {
                    self.queue = self.queue << 16 | FOUR_OF_DISP;
                }
                if byte >> 6 == 1 {
                    self.queue = self.queue << 4 | DISP8 as u64;
                }
                if byte < 0xc0 && byte >> 3 & 7 == 4 {
                    self.queue = self.queue << 4 | SIB as u64;
                }
            }
            SIB if byte & 7 == 5 && self.modrm < 0x40 => self.queue = self.queue << 16 | FOUR_OF_DISP,
            13 => (self.map, self.high) = (byte & 3, !byte >> 5 & 7 | 8),
            VEX => (self.rex, self.prefix) = (byte, byte << 8 | VEX_PREFIX as u32),
            _ => {}
        }
        self.done = self.queue == 0;
    }

    fn has_vex(&self) -> bool {
        self.prefix as u8 == VEX_PREFIX
    }

    /// An operand as wide as the operands, which the prefix `66` makes two bytes.
    fn wide(&self) -> u64 {
        if self.prefix as u8 == 0x66 { FOUR_OF_IMM >> 8 } else { FOUR_OF_IMM }
    }

    /// Takes the opcode proper.
    fn opcode(&mut self, byte: u32) {
        self.op = byte;
        let index = byte | self.map << 8;
        if self.map == 3 || self.map < 2 && has(&HAS_IMM8, index) {
            self.queue = IMM8 as u64;
            if index & 0xf0 == 0x70 || index == 0xeb {
                self.relative = IMM8;
            }
        }
        let jump = index & 0x1f0 == 0x180;
        if jump || self.map == 0 && has(&HAS_IMM32, index) {
            self.queue = self.wide();
            if jump || index & 0xfe == 0xe8 {
                self.relative = IMM32;
                self.queue = FOUR_OF_IMM;
            }
            if index & 0xf8 == 0xb8 && self.rex & 8 != 0 {
                self.queue |= FOUR_OF_IMM << 16;
            }
        }
        if self.map > 1 || has(&HAS_MODRM, index) {
            self.queue = self.queue << 4 | MODRM as u64;
        }
    }
}
