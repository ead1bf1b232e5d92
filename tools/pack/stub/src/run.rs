//! Runs a program that is in memory.

use crate::sys::{self, Path, Stack};

const EINVAL: isize = -22;
const EEXIST: isize = -17;

/// Variables that may name a directory for a temporary file, and directories if they do not.
const VARIABLES: [&[u8]; 2] = [b"XDG_RUNTIME_DIR=", b"TMPDIR="];
const DIRECTORIES: [&[u8]; 2] = [b"/tmp", b"/var/tmp"];

/// Runs `program` in place of this process: from memory, else from a temporary file.
///
/// The file has lost its name before it runs, so nothing stays behind unless this process is killed in the
/// few milliseconds between. Memory files may be missing (before Linux 3.17), forbidden (`vm.memfd_noexec`,
/// seccomp), and a directory may be mounted `noexec`; then the next place is tried.
pub fn run(program: &[u8], stack: &Stack) -> ! {
    // MFD_CLOEXEC | MFD_EXEC; the latter is unknown before Linux 6.3.
    let mut file = sys::memory_file(0x11);
    if file == EINVAL {
        file = sys::memory_file(0x01);
    }
    if file >= 0 && sys::write_all(file, program) {
        sys::execute(file, stack);
    }
    let named = VARIABLES.iter().filter_map(|name| stack.variable(name));
    for directory in named.chain(DIRECTORIES) {
        run_from(directory, program, stack);
    }
    sys::fail(b"paprsek: neither memory nor a temporary directory may hold a program to run\n", crate::CANNOT)
}

/// Comes back if that is not possible.
fn run_from(directory: &[u8], program: &[u8], stack: &Stack) {
    let mut number = sys::process();
    loop {
        let path = Path::new(directory, number);
        let file = sys::create(&path);
        if file == EEXIST {
            // Another name; the digits are those of the low bits, so a few million are to be had.
            number = number.wrapping_add(0x10001);
            continue;
        }
        if file < 0 {
            return;
        }
        let complete = sys::write_all(file, program);
        // A file open for writing cannot be run.
        sys::close(file);
        let file = sys::open(&path);
        sys::unlink(&path);
        if complete && file >= 0 {
            sys::execute(file, stack);
        }
        return;
    }
}
