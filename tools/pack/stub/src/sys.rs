//! The kernel, the processor, and memory: all that is unsafe.
#![allow(unsafe_code)]

use crate::Head;
use core::arch::x86_64::__cpuid_count;
use core::arch::{asm, global_asm};
use core::cell::UnsafeCell;
use pack_model::first;
use pack_model::model::Model;

global_asm!(
    include_str!("first.s"),
    contexts = const first::CONTEXTS,
    multiplier = const first::MULTIPLIER,
    table_bits = const first::TABLE_BITS,
    prior = const first::PRIOR,
    end = const first::END,
    base = const BASE,
);

// The second stage. The kernel leaves the stack aligned to 16 bytes, and a call expects it so.
global_asm!(
    ".pushsection .text._second,\"ax\"",
    "mov rdi, rsp",
    "call {entry}",
    ".popsection",
    entry = sym entry,
);

// Its last word.
global_asm!(".pushsection .second_end,\"a\"", ".long {end}", ".popsection", end = const first::END);

extern "C" fn entry(stack: *const usize) -> ! {
    // SAFETY: the code above passes the stack pointer that the kernel set up, which nothing changes.
    crate::main(unsafe { &*stack.cast() })
}

unsafe extern "C" {
    /// Nowhere defined: linking fails if any panic is left.
    safe fn no_panic_may_be_left() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    no_panic_may_be_left()
}

struct Shared(UnsafeCell<Model>);
// SAFETY: there is one thread.
unsafe impl Sync for Shared {}
static MODEL: Shared = Shared(UnsafeCell::new(Model::ZERO));

/// The model, all zeros. To be called once.
pub fn model() -> &'static mut Model {
    // SAFETY: the only caller calls once, in the only thread.
    unsafe { &mut *core::hint::black_box(MODEL.0.get()) }
}

const BASE: usize = 0x400000;

/// The file's length and the address of the payload, words of the first program header that the packer writes.
fn words() -> (usize, usize) {
    // SAFETY: the headers are mapped, as all of the file is.
    unsafe { (*((BASE + 96) as *const usize), *((BASE + 88) as *const usize)) }
}

/// This file as it is mapped, and the checksum at its end.
pub fn image() -> (&'static [u8], u32) {
    let length = words().0 - 4;
    // SAFETY: so many bytes are mapped, and four more.
    unsafe {
        (core::slice::from_raw_parts(BASE as *const u8, length), ((BASE + length) as *const u32).read_unaligned())
    }
}

/// The payload, to be asked for where the checksum is right: the head, and the coded bits.
pub fn payload() -> (&'static Head, Bits) {
    let at = words().1;
    // SAFETY: the packer has written it so, at a multiple of no number, and nothing changes it.
    unsafe { (&*(at as *const Head), Bits((at + size_of::<Head>()) as u32 * 8)) }
}

/// Bits in memory below 512 MB, the lowest of each byte first: the address of the next, in bits.
pub struct Bits(u32);

impl Bits {
    /// Appends it to a number.
    pub fn append_to(&mut self, mut number: u32) -> u32 {
        // SAFETY: no more than 31 are asked for beyond those that were coded, and the checksum has 32.
        unsafe {
            asm!("bt dword ptr [{zero}], {at:e}", "adc {number:e}, {number:e}", zero = in(reg) 0usize, at = in(reg) self.0,
                number = inout(reg) number, options(nostack, readonly));
        }
        self.0 += 1;
        number
    }
}

/// A part of the text, between places of the head.
pub fn part(text: &mut [u8], start: u32, end: u32) -> &mut [u8] {
    // SAFETY: the packer has written places within the text, the earlier one first.
    unsafe { text.get_unchecked_mut(start as usize..end as usize) }
}

/// Does the processor have all of x86-64-v3, and does the system keep its registers?
pub fn has_avx2() -> bool {
    // FMA, MOVBE, OSXSAVE, AVX, F16C: no processor has the first two but those that have the rest of x86-64-v3 too.
    const WANTED: u32 = 1 << 12 | 1 << 22 | 1 << 27 | 1 << 28 | 1 << 29;
    if WANTED & !__cpuid_count(1, 0).ecx != 0 {
        return false;
    }
    // A hypervisor may hide AVX2 alone.
    if __cpuid_count(7, 0).ebx & 1 << 5 == 0 {
        return false;
    }
    let state: u32;
    // SAFETY: OSXSAVE, just seen, says that the instruction exists; it changes these registers only.
    unsafe { asm!("xgetbv", in("ecx") 0, out("eax") state, out("edx") _, options(nomem, nostack)) };
    state & 6 == 6
}

/// The calls below pass what the kernel asks for, and none of them makes it write to memory.
fn call(number: usize, a: usize, b: usize, c: usize) -> isize {
    let result;
    // SAFETY: see above.
    unsafe {
        asm!("syscall", inlateout("rax") number => result, in("rdi") a, in("rsi") b, in("rdx") c, out("rcx") _,
            out("r11") _, options(nostack));
    }
    result
}

fn call_five(number: usize, a: usize, b: usize, c: usize, d: usize, e: usize) -> isize {
    let result;
    // SAFETY: see above.
    unsafe {
        asm!("syscall", inlateout("rax") number => result, in("rdi") a, in("rsi") b, in("rdx") c, in("r10") d,
            in("r8") e, out("rcx") _, out("r11") _, options(nostack));
    }
    result
}

/// One line to stderr, and the end with the status of a shell's "found, but cannot be run".
pub fn fail(line: &[u8]) -> ! {
    call(1, 2, line.as_ptr() as usize, line.len());
    loop {
        call(231, 126, 0, 0);
    }
}

/// Writes all of `bytes`; false if that fails, as it does where `file` is an error.
pub fn write_all(file: isize, mut bytes: &[u8]) -> bool {
    while !bytes.is_empty() {
        let written = call(1, file as usize, bytes.as_ptr() as usize, bytes.len());
        match bytes.get(written as usize..) {
            Some(rest) if written > 0 => bytes = rest,
            _ => return false,
        }
    }
    true
}

/// memfd_create: a file in memory, or a negative error.
pub fn memory_file(flags: usize) -> isize {
    call(319, c"paprsek".as_ptr() as usize, flags, 0)
}

/// The end of the stack as the kernel made it: argc, then the arguments, 0, the environment, 0.
#[repr(transparent)]
pub struct Stack(usize);

impl Stack {
    fn word(&self, index: usize) -> *const usize {
        // SAFETY: the callers stay within what the kernel laid out.
        unsafe { (&raw const self.0).add(index) }
    }

    fn environment(&self) -> *const usize {
        self.word(self.0 + 2)
    }
}

/// Runs a file with these arguments and this environment: execveat with AT_EMPTY_PATH. Comes back if that fails.
pub fn execute(file: isize, stack: &Stack) {
    let (arguments, environment) = (stack.word(1) as usize, stack.environment() as usize);
    call_five(322, file as usize, c"".as_ptr() as usize, arguments, environment, 0x1000);
}
