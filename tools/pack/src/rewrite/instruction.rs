//! What an instruction reads and writes, and other instructions that do the same.

use iced_x86::{Code, Encoder, FlowControl, Instruction, InstructionInfoFactory, Mnemonic, OpAccess, OpKind, Register};
use pack_model::form::{Form, convert};
use std::ops::Range;

/// Units of state: 16 general registers, 16 vectors, six flags.
pub const UNITS: usize = FLAGS + 6;
const VECTORS: usize = 16;
/// The first flag.
pub const FLAGS: usize = 32;
/// The general register that points to the stack.
const STACK: u8 = 4;

/// Slots, by which values enter and leave an instruction: explicit operands by their number, then these, then what is
/// implied, by its unit. Operands that commute share one.
const BASE: u8 = 10;
const INDEX: u8 = 11;
const IMPLIED: u8 = 100;

/// A value on its way: a slot of an instruction, and the unit that it is read from or written to.
pub type Use = (u8, u8);

/// Where an access to memory starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// A general register, to which the displacement is added.
    Register(u8),
    /// Nothing: the displacement is the address.
    Absolute,
    /// Two registers, or a segment.
    Unknown,
}

/// An access to memory.
#[derive(Clone, Debug)]
pub struct Access {
    base: Base,
    /// First byte and number of bytes; of 0 nothing is known.
    start: i64,
    size: i64,
    write: bool,
    /// It reads what nothing ever writes.
    constant: bool,
}

impl Access {
    /// Whether this and a later access must stay in order; `same` says of a register that both have the same in it.
    ///
    /// Threads see loads and stores as the processor orders them, so stores stay in order but within the own stack frame.
    pub fn precedes(&self, later: &Access, same: impl Fn(u8) -> bool) -> bool {
        if !self.write && !later.write || self.constant || later.constant {
            return false;
        }
        let known = self.size != 0 && later.size != 0;
        let apart = known && (self.start + self.size <= later.start || later.start + later.size <= self.start);
        match (self.base, later.base) {
            (Base::Register(STACK), Base::Register(STACK)) => !apart,
            _ if self.write && later.write => true,
            (Base::Register(a), Base::Register(b)) if a == b => !(apart && same(a)),
            (Base::Absolute, Base::Absolute) => !apart,
            (Base::Absolute, Base::Register(STACK)) | (Base::Register(STACK), Base::Absolute) => false,
            _ => true,
        }
    }
}

/// An instruction at work.
#[derive(Clone)]
pub struct Op {
    instruction: Instruction,
    /// In the form that is coded.
    pub bytes: Vec<u8>,
    form: Form,
    /// What it reads, by slots.
    pub reads: Vec<Use>,
    /// What it writes.
    pub writes: Vec<Use>,
    /// What it does in memory.
    pub memory: Vec<Access>,
    /// It stays where it is, and so does all else on either side of it.
    pub fixed: bool,
    /// It may be jumped to.
    pub starts_block: bool,
    /// Nobody looks at the flags after it.
    pub ends_flags: bool,
}

impl Op {
    /// An instruction with its bytes, which have this form. What is at the addresses `constants` is never written.
    pub fn new(
        factory: &mut InstructionInfoFactory,
        instruction: Instruction,
        bytes: &[u8],
        form: Form,
        constants: &Range<u64>,
    ) -> Self {
        let known = factory.info(&instruction).used_registers().iter().all(|used| {
            let register = used.register();
            unit(register).is_some() || register.is_segment_register() || register == Register::RIP
        });
        let memory = factory.info(&instruction).used_memory().iter().filter_map(|used| {
            let (read, write) = access(used.access());
            let segment = matches!(used.segment(), Register::FS | Register::GS);
            let base = match unit(used.base()) {
                _ if segment || used.index() != Register::None => Base::Unknown,
                Some(register) => Base::Register(register),
                None => Base::Absolute,
            };
            let constant = base == Base::Absolute && constants.contains(&used.displacement());
            let (start, size) = (used.displacement() as i64, used.memory_size().size() as i64);
            (read || write).then_some(Access { base, start, size, write, constant })
        });
        let (memory, flow) = (memory.collect(), instruction.flow_control());
        let mut op = Self {
            instruction,
            bytes: bytes.to_vec(),
            form,
            reads: Vec::new(),
            writes: Vec::new(),
            memory,
            fixed: false,
            starts_block: false,
            ends_flags: matches!(flow, FlowControl::Return | FlowControl::Call | FlowControl::IndirectCall),
        };
        // The coded form of what the parser takes for other instructions, or does not come to, holds there alone.
        let moves = form == Form::Plain || op.encode(instruction).is_some_and(|bytes| bytes == op.bytes);
        op.use_floats();
        op.find_uses(factory);
        op.fixed = !known || !moves || is_special(&instruction) || op.writes.iter().any(|&(_, unit)| unit == STACK);
        op
    }

    /// Bytes that are no instruction.
    pub fn filler(bytes: &[u8]) -> Self {
        let (reads, writes, memory) = Default::default();
        let (bytes, instruction) = (bytes.to_vec(), Instruction::default());
        Self {
            instruction,
            bytes,
            form: Form::Plain,
            reads,
            writes,
            memory,
            fixed: true,
            starts_block: false,
            ends_flags: false,
        }
    }

    /// Where it was.
    pub fn address(&self) -> u64 {
        self.instruction.ip()
    }

    /// Keeps an instruction where it is that finds its memory from there.
    pub fn stay_if_relative(&mut self) {
        self.fixed |= self.instruction.is_ip_rel_memory_operand();
    }

    /// Finds what is read and written. Writing to a part of a register leaves the rest, so that counts as reading too.
    fn find_uses(&mut self, factory: &mut InstructionInfoFactory) {
        let i = &self.instruction;
        let information = factory.info(i);
        let (reads, writes) = (&mut self.reads, &mut self.writes);
        reads.clear();
        writes.clear();
        let accesses = |register: Register, how| {
            let (read, write) = access(how);
            (read || write && (register.is_gpr8() || register.is_gpr16()), write)
        };
        for k in 0..i.op_count() {
            match i.op_kind(k) {
                OpKind::Register => {
                    let Some(unit) = unit(i.op_register(k)) else { continue };
                    let (read, write) = accesses(i.op_register(k), information.op_access(k));
                    if read {
                        reads.push((if k == 2 && commutes(i) { 1 } else { k as u8 }, unit));
                    }
                    if write {
                        writes.push((k as u8, unit));
                    }
                }
                OpKind::Memory => {
                    let index = if i.memory_index_scale() == 1 { BASE } else { INDEX };
                    reads.extend(unit(i.memory_base()).map(|unit| (BASE, unit)));
                    reads.extend(unit(i.memory_index()).map(|unit| (index, unit)));
                }
                _ => {}
            }
        }
        for used in information.used_registers() {
            let Some(unit) = unit(used.register()) else { continue };
            let (read, write) = accesses(used.register(), used.access());
            if read && reads.iter().all(|r| r.1 != unit) {
                reads.push((IMPLIED + unit, unit));
            }
            if write && writes.iter().all(|w| w.1 != unit) {
                writes.push((IMPLIED + unit, unit));
            }
        }
        for flag in 0..6 {
            let unit = FLAGS as u8 + flag;
            if i.rflags_read() >> flag & 1 != 0 {
                reads.push((IMPLIED + unit, unit));
            }
            if i.rflags_modified() >> flag & 1 != 0 {
                writes.push((IMPLIED + unit, unit));
            }
        }
    }

    /// Has the instruction's like on floats do its work: fewer instructions are easier to foretell.
    fn use_floats(&mut self) {
        let alike = ALIKE.iter().filter(|(code, _)| *code == self.instruction.code());
        let mut found = alike.filter_map(|&(_, code)| {
            let mut instruction = self.instruction;
            instruction.set_code(code);
            Some((instruction, self.encoded(instruction)?))
        });
        if let Some((instruction, bytes)) = found.next() {
            (self.instruction, self.bytes) = (instruction, bytes);
        }
    }

    /// Instructions that do the same, in as many bytes.
    pub fn variants(&self, factory: &mut InstructionInfoFactory) -> Vec<Self> {
        let variants = variants(&self.instruction).into_iter().filter_map(|instruction| {
            let mut op = Self { instruction, bytes: self.encoded(instruction)?, ..self.clone() };
            op.find_uses(factory);
            Some(op)
        });
        variants.collect()
    }

    /// The bytes of another instruction here, if they are as many, and if what is here was encoded by the same rules.
    fn encoded(&self, instruction: Instruction) -> Option<Vec<u8>> {
        let as_it_is = self.encode(self.instruction)?;
        if as_it_is == self.bytes { self.encode(instruction) } else { None }
    }

    fn encode(&self, instruction: Instruction) -> Option<Vec<u8>> {
        let mut encoder = Encoder::new(64);
        let length = encoder.encode(&instruction, instruction.ip()).ok()?;
        let place = encoder.get_constant_offsets();
        let mut bytes = encoder.take_buffer();
        if length != self.bytes.len() {
            return None;
        }
        if self.form == Form::Coded {
            bytes.extend([0; 4]);
            convert(&mut bytes, 0, Form::Coded);
            bytes.truncate(length);
        }
        if instruction.is_ip_rel_memory_operand() {
            let at = place.displacement_offset();
            bytes[at..at + 4].copy_from_slice(&self.bytes[at..at + 4]);
        }
        Some(bytes)
    }
}

/// The unit that a register is a part of.
fn unit(register: Register) -> Option<u8> {
    let full = register.full_register();
    let number = full.number();
    if full.is_gpr64() {
        Some(number as u8)
    } else if full.is_zmm() && number < 16 {
        Some((VECTORS + number) as u8)
    } else {
        None
    }
}

/// Whether something is read, and whether it is written.
fn access(access: OpAccess) -> (bool, bool) {
    match access {
        OpAccess::Read | OpAccess::CondRead => (true, false),
        OpAccess::Write => (false, true),
        OpAccess::CondWrite | OpAccess::ReadWrite | OpAccess::ReadCondWrite => (true, true),
        _ => (false, false),
    }
}

/// Whether it does more than its operands and flags say, or has an order with other threads.
fn is_special(i: &Instruction) -> bool {
    use Mnemonic::*;
    let in_memory = (0..i.op_count()).any(|k| i.op_kind(k) == OpKind::Memory);
    // What is no instruction has a flow of its own.
    i.flow_control() != FlowControl::Next
        || i.has_lock_prefix()
        || i.has_rep_prefix()
        || i.has_repne_prefix()
        || in_memory && i.mnemonic() == Xchg
        || matches!(i.mnemonic(), Syscall | Cpuid | Rdtsc | Xgetbv | Mfence | Lfence | Sfence | Pause | Endbr64 | Nop)
        || matches!(i.mnemonic(), Cld | Std | Ldmxcsr | Stmxcsr | Vldmxcsr | Vstmxcsr | Vzeroupper | Vzeroall)
        // A mask says what they touch.
        || matches!(i.mnemonic(), Vmaskmovps | Vmaskmovpd | Vpmaskmovd | Vpmaskmovq)
}

/// Whether the second and the third operand may change places. Of scalars the upper part of the result is another one
/// then, at which no one looks; of two NaNs it is the other one that goes on.
fn commutes(i: &Instruction) -> bool {
    use Mnemonic::*;
    let both = i.op_count() == 3 && i.op_kind(2) == OpKind::Register;
    let floats = matches!(i.mnemonic(), Vaddss | Vmulss | Vaddsd | Vmulsd | Vaddps | Vmulps | Vaddpd | Vmulpd);
    let bits = matches!(i.mnemonic(), Vandps | Vorps | Vxorps | Vandpd | Vorpd | Vxorpd | Vpand | Vpor | Vpxor);
    let sums = matches!(i.mnemonic(), Vpaddb | Vpaddw | Vpaddd | Vpaddq | Vpmullw | Vpmulld | Vpmuludq | Vpmaddwd);
    let most = matches!(i.mnemonic(), Vpmaxub | Vpmaxud | Vpmaxsw | Vpmaxsd | Vpminub | Vpminud | Vpminsw | Vpminsd);
    both && (floats || bits || sums || most || matches!(i.mnemonic(), Vpcmpeqb | Vpcmpeqd))
}

/// Instructions that do the same; some cannot be encoded.
fn variants(i: &Instruction) -> Vec<Instruction> {
    let mut all = Vec::new();
    if commutes(i) && i.op_register(1) != i.op_register(2) {
        let mut swapped = *i;
        swapped.set_op_register(1, i.op_register(2));
        swapped.set_op_register(2, i.op_register(1));
        all.push(swapped);
    }
    let (base, index) = (i.memory_base(), i.memory_index());
    // With the stack's pointer or none as its base, the segment would be another one, or the meaning.
    if i.memory_index_scale() == 1 && base.is_gpr64() && index.is_gpr64() && base != Register::RSP {
        let mut swapped = *i;
        swapped.set_memory_base(index);
        swapped.set_memory_index(base);
        all.push(swapped);
    }
    all
}

/// Instructions on whole numbers, or on doubles, and those on floats that do the same to bits.
const ALIKE: &[(Code, Code)] = &[
    (Code::VEX_Vmovdqa_xmm_xmmm128, Code::VEX_Vmovaps_xmm_xmmm128),
    (Code::VEX_Vmovdqa_ymm_ymmm256, Code::VEX_Vmovaps_ymm_ymmm256),
    (Code::VEX_Vmovdqa_xmmm128_xmm, Code::VEX_Vmovaps_xmmm128_xmm),
    (Code::VEX_Vmovdqa_ymmm256_ymm, Code::VEX_Vmovaps_ymmm256_ymm),
    (Code::VEX_Vmovdqu_xmm_xmmm128, Code::VEX_Vmovups_xmm_xmmm128),
    (Code::VEX_Vmovdqu_ymm_ymmm256, Code::VEX_Vmovups_ymm_ymmm256),
    (Code::VEX_Vmovdqu_xmmm128_xmm, Code::VEX_Vmovups_xmmm128_xmm),
    (Code::VEX_Vmovdqu_ymmm256_ymm, Code::VEX_Vmovups_ymmm256_ymm),
    (Code::VEX_Vmovapd_xmm_xmmm128, Code::VEX_Vmovaps_xmm_xmmm128),
    (Code::VEX_Vmovapd_ymm_ymmm256, Code::VEX_Vmovaps_ymm_ymmm256),
    (Code::VEX_Vmovapd_xmmm128_xmm, Code::VEX_Vmovaps_xmmm128_xmm),
    (Code::VEX_Vmovapd_ymmm256_ymm, Code::VEX_Vmovaps_ymmm256_ymm),
    (Code::VEX_Vmovupd_xmm_xmmm128, Code::VEX_Vmovups_xmm_xmmm128),
    (Code::VEX_Vmovupd_ymm_ymmm256, Code::VEX_Vmovups_ymm_ymmm256),
    (Code::VEX_Vmovupd_xmmm128_xmm, Code::VEX_Vmovups_xmmm128_xmm),
    (Code::VEX_Vmovupd_ymmm256_ymm, Code::VEX_Vmovups_ymmm256_ymm),
    (Code::VEX_Vpxor_xmm_xmm_xmmm128, Code::VEX_Vxorps_xmm_xmm_xmmm128),
    (Code::VEX_Vpxor_ymm_ymm_ymmm256, Code::VEX_Vxorps_ymm_ymm_ymmm256),
    (Code::VEX_Vpand_xmm_xmm_xmmm128, Code::VEX_Vandps_xmm_xmm_xmmm128),
    (Code::VEX_Vpand_ymm_ymm_ymmm256, Code::VEX_Vandps_ymm_ymm_ymmm256),
    (Code::VEX_Vpor_xmm_xmm_xmmm128, Code::VEX_Vorps_xmm_xmm_xmmm128),
    (Code::VEX_Vpor_ymm_ymm_ymmm256, Code::VEX_Vorps_ymm_ymm_ymmm256),
    (Code::VEX_Vpandn_xmm_xmm_xmmm128, Code::VEX_Vandnps_xmm_xmm_xmmm128),
    (Code::VEX_Vpandn_ymm_ymm_ymmm256, Code::VEX_Vandnps_ymm_ymm_ymmm256),
    (Code::VEX_Vandpd_xmm_xmm_xmmm128, Code::VEX_Vandps_xmm_xmm_xmmm128),
    (Code::VEX_Vxorpd_xmm_xmm_xmmm128, Code::VEX_Vxorps_xmm_xmm_xmmm128),
    (Code::VEX_Vpbroadcastd_xmm_xmmm32, Code::VEX_Vbroadcastss_xmm_xmm),
    (Code::VEX_Vpbroadcastd_ymm_xmmm32, Code::VEX_Vbroadcastss_ymm_xmm),
    (Code::VEX_Vpbroadcastd_xmm_xmmm32, Code::VEX_Vbroadcastss_xmm_m32),
    (Code::VEX_Vpbroadcastd_ymm_xmmm32, Code::VEX_Vbroadcastss_ymm_m32),
    (Code::VEX_Vpbroadcastq_ymm_xmmm64, Code::VEX_Vbroadcastsd_ymm_xmm),
    (Code::VEX_Vpbroadcastq_ymm_xmmm64, Code::VEX_Vbroadcastsd_ymm_m64),
    (Code::VEX_Vinserti128_ymm_ymm_xmmm128_imm8, Code::VEX_Vinsertf128_ymm_ymm_xmmm128_imm8),
    (Code::VEX_Vextracti128_xmmm128_ymm_imm8, Code::VEX_Vextractf128_xmmm128_ymm_imm8),
    (Code::VEX_Vbroadcasti128_ymm_m128, Code::VEX_Vbroadcastf128_ymm_m128),
    (Code::VEX_Vpunpckldq_xmm_xmm_xmmm128, Code::VEX_Vunpcklps_xmm_xmm_xmmm128),
    (Code::VEX_Vmovd_xmm_rm32, Code::VEX_Vmovss_xmm_m32),
    (Code::VEX_Vmovd_rm32_xmm, Code::VEX_Vmovss_m32_xmm),
    (Code::VEX_Vmovq_xmm_xmmm64, Code::VEX_Vmovsd_xmm_m64),
    (Code::VEX_Vmovq_xmmm64_xmm, Code::VEX_Vmovsd_m64_xmm),
    (Code::VEX_Vmovlps_m64_xmm, Code::VEX_Vmovsd_m64_xmm),
];
