//! Runs a program that is in memory.

use crate::sys::{self, Stack, Text};

const EINVAL: isize = -22;

/// Runs `program` in place of this process: from memory, else from a temporary file.
///
/// The file has lost its name before it runs, so nothing stays behind unless this process is killed in the
/// few milliseconds between. Memory files may be missing (before Linux 3.17) or forbidden (`vm.memfd_noexec`,
/// seccomp), and a directory may be mounted `noexec`; then the next place is tried.
pub fn run(program: &[u8], stack: &Stack) -> ! {
    // MFD_CLOEXEC | MFD_EXEC; the latter is unknown before Linux 6.3.
    let mut file = sys::memory_file(0x11);
    if file == EINVAL {
        file = sys::memory_file(0x01);
    }
    if sys::write_all(file, program) {
        sys::execute(file, stack);
    }
    run_from(stack.variable(b"TMPDIR="), program, stack);
    run_from(Text::from(c"/tmp"), program, stack);
    sys::fail(b"paprsek: neither memory nor a temporary directory may hold a program to run\n")
}

/// Comes back if that is not possible.
#[inline(never)]
fn run_from(directory: Text, program: &[u8], stack: &Stack) {
    let directory = sys::open(directory);
    let mut name = *b".paprsek-........\0";
    let mut number = sys::process();
    for letter in &mut name[9..17] {
        *letter = b'a' + (number & 15) as u8;
        number >>= 4;
    }
    let file = sys::create(directory, &name);
    if file < 0 {
        return;
    }
    let complete = sys::write_all(file, program);
    // A file open for writing cannot be run.
    sys::close(file);
    let file = sys::open_in(directory, &name);
    sys::unlink(directory, &name);
    if complete {
        sys::execute(file, stack);
    }
}
