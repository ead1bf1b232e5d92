//! The kernel, the processor, and memory: all that is unsafe.
#![allow(unsafe_code)]

use core::arch::x86_64::{__cpuid, __cpuid_count};
use core::arch::{asm, global_asm};
use core::cell::UnsafeCell;
use pack_model::model::Model;

// The kernel leaves the stack aligned to 16 bytes, and a call expects it so.
global_asm!(
    ".pushsection .text._start,\"ax\"",
    ".globl _start",
    "_start:",
    "mov rdi, rsp",
    "call {entry}",
    ".popsection",
    entry = sym entry,
);

extern "C" fn entry(stack: *const usize) -> ! {
    // SAFETY: `_start` passes the stack pointer that the kernel set up, which nothing changes.
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
    // MADV_HUGEPAGE: with pages of 2 MB a fifth of the time goes; where it is refused, nothing is lost.
    call(28, MODEL.0.get() as usize, size_of::<Model>(), 14);
    // SAFETY: the only caller calls once, in the only thread.
    unsafe { &mut *MODEL.0.get() }
}

const BASE: usize = 0x400000;

/// This file as it is mapped: the first segment, whose length stands in the first program header.
pub fn image() -> &'static [u8] {
    // SAFETY: the packer has the file mapped from BASE on, as many bytes as the word at 64 + 32 says.
    unsafe { core::slice::from_raw_parts(BASE as *const u8, *((BASE + 96) as *const usize)) }
}

/// Where in the image the payload starts.
pub fn payload_offset() -> usize {
    let address: usize;
    // SAFETY: loads a constant that the linker script defines.
    unsafe { asm!("mov {:e}, offset payload", out(reg) address, options(pure, nomem, nostack, preserves_flags)) };
    address - BASE
}

/// Does the processor have all of x86-64-v3, and does the system keep its registers?
pub fn has_avx2() -> bool {
    // FMA, MOVBE, OSXSAVE, AVX, F16C; BMI1, AVX2, BMI2; LZCNT.
    const WANTED: [u32; 3] = [1 << 12 | 1 << 22 | 1 << 27 | 1 << 28 | 1 << 29, 1 << 3 | 1 << 5 | 1 << 8, 1 << 5];
    let found = [__cpuid(1).ecx, if __cpuid(0).eax < 7 { 0 } else { __cpuid_count(7, 0).ebx }, __cpuid(0x8000_0001).ecx];
    if (0..3).any(|i| found[i] & WANTED[i] != WANTED[i]) {
        return false;
    }
    let state: u32;
    // SAFETY: OSXSAVE, just seen, says that the instruction exists; it changes these registers only.
    unsafe { asm!("xgetbv", in("ecx") 0, out("eax") state, out("edx") _, options(nomem, nostack)) };
    state & 6 == 6
}

fn call(number: usize, a: usize, b: usize, c: usize) -> isize {
    let result;
    // SAFETY: the callers below pass what the call in question asks for, and no call among them writes memory.
    unsafe {
        asm!("syscall", inlateout("rax") number => result, in("rdi") a, in("rsi") b, in("rdx") c, out("rcx") _,
            out("r11") _, options(nostack));
    }
    result
}

/// One line to stderr, and the end.
pub fn fail(line: &[u8], status: i32) -> ! {
    write_all(2, line);
    loop {
        call(231, status as usize, 0, 0);
    }
}

/// Writes all of `bytes`; false if that fails.
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

/// getpid.
pub fn process() -> u32 {
    call(39, 0, 0, 0) as u32
}

/// Creates a file that only its owner may read, write and run; an error if there is one of this name.
pub fn create(path: &Path) -> isize {
    // O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC
    call(2, path.0.as_ptr() as usize, 0o2_000_301, 0o700)
}

/// Opens a file for reading.
pub fn open(path: &Path) -> isize {
    call(2, path.0.as_ptr() as usize, 0o2_000_000, 0)
}

/// Removes a file's name.
pub fn unlink(path: &Path) {
    call(87, path.0.as_ptr() as usize, 0, 0);
}

/// Closes a file.
pub fn close(file: isize) {
    call(3, file as usize, 0, 0);
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

    /// The value of the variable whose name, with the equals sign, is given.
    pub fn variable(&self, name: &[u8]) -> Option<&[u8]> {
        let mut at = self.environment();
        loop {
            // SAFETY: the kernel ends each string with a zero byte and their list with a zero; reading stops there.
            unsafe {
                if *at == 0 {
                    return None;
                }
                let text = *at as *const u8;
                if name.iter().enumerate().all(|(i, &byte)| *text.add(i) == byte) {
                    let value = text.add(name.len());
                    let length = (0..256).take_while(|&i| *value.add(i) != 0).count();
                    return Some(core::slice::from_raw_parts(value, length));
                }
                at = at.add(1);
            }
        }
    }
}

/// Runs a file with these arguments and this environment: execveat with AT_EMPTY_PATH, which needs no /proc.
/// Comes back if that fails.
pub fn execute(file: isize, stack: &Stack) {
    // SAFETY: reads the lists that the kernel itself made.
    unsafe {
        asm!("syscall", inlateout("rax") 322_usize => _, in("rdi") file, in("rsi") c"".as_ptr(), in("rdx") stack.word(1),
            in("r10") stack.environment(), in("r8") 0x1000, out("rcx") _, out("r11") _, options(nostack));
    }
}

/// A path, zero-terminated.
pub struct Path([u8; 512]);

impl Path {
    /// A hidden file of this number in a directory. A name too long is cut, and then cannot be created.
    pub fn new(directory: &[u8], mut number: u32) -> Self {
        let mut path = Path([0; 512]);
        let mut end = 0;
        for part in [directory, b"/.paprsek-"] {
            for &byte in part {
                path.0[end & 255] = byte;
                end += 1;
            }
        }
        while number != 0 {
            path.0[end & 511] = b'a' + (number & 15) as u8;
            number >>= 4;
            end += 1;
        }
        path
    }
}

// What the compiler calls for loops over bytes. The string instructions are small, and fast enough.
global_asm!(
    ".globl memcpy, memmove, memset",
    "memmove: mov rax, rdi; mov rcx, rdx; cmp rdi, rsi; jbe 2f",
    "lea rdi, [rdi + rcx - 1]; lea rsi, [rsi + rcx - 1]; std; rep movsb; cld; ret",
    "memcpy: mov rax, rdi; mov rcx, rdx",
    "2: rep movsb; ret",
    "memset: mov r8, rdi; mov eax, esi; mov rcx, rdx; rep stosb; mov rax, r8; ret",
);
