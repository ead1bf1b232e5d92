//! Where in an x86-64 instruction the next byte stands. Lengths after the opcode maps of Intel's manual,
//! volume 2, appendix A; 64-bit mode only, VEX included, EVEX not.

/// What the next byte is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[repr(u8)]
pub enum Field {
    /// A prefix or an opcode.
    Op,
    /// The second of the three bytes of a VEX prefix: register bits and opcode map.
    Vex3,
    /// The last byte of a VEX prefix.
    Vex,
    /// Operands.
    ModRm,
    /// Base, index and scale.
    Sib,
    /// A byte of a displacement.
    Disp,
    /// A byte of an immediate or of a jump's distance.
    Imm,
}

/// State of the parser between two bytes.
#[derive(Clone, Copy)]
pub struct Parser {
    /// What comes next.
    pub field: Field,
    /// Opcode map: 0 one byte, 1 `0F`, 2 `0F 38`, 3 `0F 3A`.
    pub map: u8,
    /// The opcode, once known.
    pub op: u8,
    /// Operands byte, 0 until known.
    pub modrm: u8,
    /// REX, or the last byte of VEX.
    pub rex: u8,
    /// The last legacy prefix: `66`, `F2`, `F3`, a segment; `C5` for VEX.
    pub prefix: u8,
    /// Bytes of displacement to come.
    pub disp: u8,
    /// Bytes of immediate to come.
    pub imm: u8,
    /// The number being read is relative to the end of the instruction.
    pub relative: bool,
    /// The last byte ended an instruction, which the other fields still describe.
    pub done: bool,
    sib: bool,
}

/// One bit an opcode, eight opcodes of a row's half a byte: does it have operands (maps 0 and 1)?
const MODRM: [u32; 16] = [0x0f0f_0f0f, 0x0f0f_0f0f, 0, 0x0000_0a08, 0x0000_ffff, 0, 0xff0f_00c3, 0xc0c0_0000, 0xffff_b41f, 0xff00_ffff, 0xffff_ffff, 0xff7f_ffff, 0xffff_0000, 0xffff_f8f8, 0xffff_00ff, 0xffff_ffff];
/// Does it have an immediate of one byte?
const IMM8: [u32; 16] = [0x1010_1010, 0x1010_1010, 0, 0xffff_0c00, 0x0000_0009, 0x00ff_0100, 0x0000_2043, 0x0000_08ff, 0, 0, 0, 0x000f_0000, 0, 0x0400_1010, 0x0000_0074, 0];
/// Does it have an immediate or a distance of four bytes?
const IMM32: [u32; 16] = [0x2020_2020, 0x2020_2020, 0, 0x0000_0300, 0x0000_0002, 0xff00_0200, 0x0000_0080, 0x0000_0300, 0, 0, 0, 0, 0x0000_ffff, 0, 0, 0];

fn has(table: &[u32; 16], index: usize) -> bool {
    table[(index >> 5) & 15] >> (index & 31) & 1 != 0
}

impl Parser {
    /// At the start of an instruction.
    pub const START: Parser = Parser {
        field: Field::Op,
        map: 0,
        op: 0,
        modrm: 0,
        rex: 0,
        prefix: 0,
        disp: 0,
        imm: 0,
        relative: false,
        done: false,
        sib: false,
    };

    /// Takes one byte.
    pub fn step(&mut self, byte: u8) {
        if self.done {
            *self = Self::START;
        }
        match self.field {
            Field::Op => {
                if self.map == 0 {
                    match byte {
                        0x40..=0x4f => {
                            self.rex = byte;
                            return;
                        }
                        0x26 | 0x2e | 0x36 | 0x3e | 0x64..=0x67 | 0xf0 | 0xf2 | 0xf3 => {
                            self.prefix = byte;
                            return;
                        }
                        0xc4 => {
                            self.field = Field::Vex3;
                            return;
                        }
                        0xc5 => {
                            self.map = 1;
                            self.field = Field::Vex;
                            return;
                        }
                        0x0f => {
                            self.map = 1;
                            return;
                        }
                        _ => {}
                    }
                } else if self.map == 1 && self.prefix != 0xc5 && byte & 0xfd == 0x38 {
                    self.map = 2 + (byte >> 1 & 1);
                    return;
                }
                if self.opcode(byte) {
                    self.field = Field::ModRm;
                    return;
                }
            }
            Field::Vex3 => {
                self.map = byte & 3;
                self.field = Field::Vex;
                return;
            }
            Field::Vex => {
                self.rex = byte;
                self.prefix = 0xc5;
                self.field = Field::Op;
                return;
            }
            Field::ModRm => {
                self.modrm = byte;
                let (mode, rm) = (byte >> 6, byte & 7);
                if self.map == 0 && self.op & 0xfe == 0xf6 && byte & 0x30 == 0 {
                    self.imm = if self.op == 0xf6 { 1 } else { self.wide() };
                }
                if mode != 3 {
                    self.sib = rm == 4;
                    self.disp = [0, 1, 4, 0][mode as usize & 3];
                    if mode == 0 && rm == 5 {
                        self.disp = 4;
                        self.relative = true;
                    }
                }
            }
            Field::Sib => {
                self.sib = false;
                if byte & 7 == 5 && self.modrm < 0x40 {
                    self.disp = 4;
                }
            }
            Field::Disp => {
                self.disp -= 1;
                if self.disp == 0 {
                    self.relative = false;
                }
            }
            Field::Imm => self.imm -= 1,
        }
        self.field = if self.sib {
            Field::Sib
        } else if self.disp != 0 {
            Field::Disp
        } else if self.imm != 0 {
            Field::Imm
        } else {
            self.done = true;
            Field::Op
        };
    }

    /// Bytes of an operand as wide as the operands, which the prefix `66` makes two.
    fn wide(&self) -> u8 {
        if self.prefix == 0x66 { 2 } else { 4 }
    }

    /// Takes the opcode proper. True when operands follow.
    fn opcode(&mut self, byte: u8) -> bool {
        self.op = byte;
        if self.map == 3 {
            self.imm = 1;
        }
        if self.map > 1 {
            return true;
        }
        let index = byte as usize + 256 * self.map as usize;
        self.imm = has(&IMM8, index) as u8;
        if has(&IMM32, index) {
            let jump = index & 0xfe == 0xe8 || index & 0x1f0 == 0x180;
            self.relative = jump;
            self.imm = if jump { 4 } else { self.wide() };
            if byte & 0xf8 == 0xb8 && self.rex & 8 != 0 {
                self.imm = 8;
            }
        }
        has(&MODRM, index)
    }
}
