//! The last word where Xlib has it: one line on stderr when the display goes away.
//!
//! Xlib answers a lost display, and a window that another client destroys, with lines of its own and `exit(1)` in the
//! middle of a call. Its handlers can only be replaced by unsafe code. But `exit` still runs the destructors of the
//! calling thread's locals (glibc does; it is the library that Xlib is loaded with), and while a call lasts stderr
//! can be a pipe.

use rustix::io::ioctl_fionbio;
use rustix::stdio::dup2_stderr;
use std::cell::Cell;
use std::fs::File;
use std::io::{self, PipeReader, PipeWriter, Read, Write};
use std::os::fd::{AsFd, BorrowedFd};
use std::process;
use std::sync::OnceLock;

/// Where stderr goes, and where it goes while a call lasts.
struct Stderr {
    real: &'static File,
    call: (PipeReader, PipeWriter),
    in_call: Cell<bool>,
}

impl Stderr {
    fn open() -> io::Result<Stderr> {
        let real = io::stderr().as_fd().try_clone_to_owned()?;
        let call = io::pipe()?;
        // Nobody waits: neither Xlib for room in the pipe nor the last word for text in it.
        ioctl_fionbio(&call.0, true)?;
        ioctl_fionbio(&call.1, true)?;
        Ok(Stderr { real: REAL.get_or_init(|| real.into()), call, in_call: Cell::new(false) })
    }

    fn set(&self, in_call: bool) {
        let moved = if in_call { dup2_stderr(&self.call.1) } else { dup2_stderr(self.real) };
        if moved.is_ok() {
            self.in_call.set(in_call);
        }
    }
}

impl Drop for Stderr {
    fn drop(&mut self) {
        if !self.in_call.get() {
            return;
        }
        let mut said = [0; 4096];
        let said = self.call.0.read(&mut said).ok().and_then(|count| said.get(..count)).unwrap_or_default();
        // "X Error of failed request:  BadDrawable ...": our window is gone, the display is not. So it was closed,
        // if not in the polite way, and closing ends well.
        if [&b"BadDrawable"[..], b"BadWindow"].iter().any(|name| said.windows(name.len()).any(|part| part == *name)) {
            process::exit(0);
        }
        let _ = { self.real }.write_all(b"paprsek: the display went away\n");
    }
}

/// Where stderr goes, once calls can have it go elsewhere.
static REAL: OnceLock<File> = OnceLock::new();

thread_local! {
    /// `None` where there are no descriptors to spare: then Xlib speaks for itself.
    static STDERR: Option<Stderr> = Stderr::open().ok();
}

/// Where stderr goes whatever call lasts: another thread speaks meanwhile.
pub fn stderr() -> BorrowedFd<'static> {
    REAL.get().map_or(rustix::stdio::stderr(), File::as_fd)
}

/// Calls into Xlib. Should it end the process, that is said in one line; what else it prints is not.
pub fn during<T>(call: impl FnOnce() -> T) -> T {
    let set = |in_call| STDERR.with(|stderr| stderr.iter().for_each(|stderr| stderr.set(in_call)));
    set(true);
    let value = call();
    set(false);
    value
}
