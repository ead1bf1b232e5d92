//! Runs a program that is in memory.

use crate::sys::{self, Stack};

const EINVAL: isize = -22;

/// Runs `program` in place of this process, from a file in memory, which stays nowhere.
///
/// That needs Linux 3.19, and no rule against it (`vm.memfd_noexec`, seccomp): a way by a temporary file took 0.4 kB.
pub fn run(program: &[u8], stack: &Stack) -> ! {
    // MFD_CLOEXEC | MFD_EXEC; the latter is unknown before Linux 6.3.
    let mut file = sys::memory_file(0x11);
    if file == EINVAL {
        file = sys::memory_file(0x01);
    }
    if sys::write_all(file, program) {
        sys::execute(file, stack);
    }
    sys::fail(b"paprsek: no program may run in memory here\n")
}
