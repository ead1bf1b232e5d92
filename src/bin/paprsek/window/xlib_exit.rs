//! One line on stderr where Xlib ends the process.
//!
//! Xlib answers a lost display, and a window that another client destroys, with lines of its own and `exit(1)` in the
//! middle of a call. Its handlers can be replaced only by unsafe code. But `exit` still runs the destructors of the
//! calling thread's locals (glibc's does, and glibc is what Xlib is loaded with), and stderr can be a pipe while a call
//! lasts. So the destructor of a thread local reads what Xlib said, and says it in the program's own words.

use crate::io::{complain, keep_stderr};
use rustix::io::ioctl_fionbio;
use rustix::stdio::dup2_stderr;
use std::cell::Cell;
use std::fs::File;
use std::io::{self, PipeReader, PipeWriter, Read};
use std::process;

/// Errors of Xlib's that mean our window is gone while the display is not.
const WINDOW_IS_GONE: [&[u8]; 2] = [b"BadDrawable", b"BadWindow"];
/// Most bytes of Xlib's lines that are looked at, which is all of them.
const SAID: usize = 4096;

/// Where stderr leads: to its own place, and into a pipe while a call lasts.
struct Stderr {
    own: &'static File,
    pipe: (PipeReader, PipeWriter),
    in_call: Cell<bool>,
}

impl Stderr {
    fn open() -> io::Result<Stderr> {
        let pipe = io::pipe()?;
        // Neither end blocks: Xlib must not wait for room in the pipe, nor the destructor for text in it.
        ioctl_fionbio(&pipe.0, true)?;
        ioctl_fionbio(&pipe.1, true)?;
        Ok(Stderr { own: keep_stderr()?, pipe, in_call: Cell::new(false) })
    }

    fn redirect(&self, in_call: bool) {
        let moved = if in_call { dup2_stderr(&self.pipe.1) } else { dup2_stderr(self.own) };
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
        let mut said = [0; SAID];
        let said = self.pipe.0.read(&mut said).ok().and_then(|count| said.get(..count)).unwrap_or_default();
        // "X Error of failed request:  BadDrawable ...": the window was closed, if not in the polite way, and closing
        // it ends the program well.
        let says = |words: &[u8]| said.windows(words.len()).any(|part| part == words);
        if WINDOW_IS_GONE.iter().any(|name| says(name)) {
            process::exit(0);
        }
        complain(b"the display went away");
    }
}

thread_local! {
    /// `None` where there are no file descriptors to spare: then Xlib speaks for itself.
    static STDERR: Option<Stderr> = Stderr::open().ok();
}

/// Makes calls into Xlib. If it ends the process meanwhile, one line says so; whatever else it prints is dropped.
pub fn during<T>(call: impl FnOnce() -> T) -> T {
    let redirect = |in_call| STDERR.with(|stderr| stderr.iter().for_each(|stderr| stderr.redirect(in_call)));
    redirect(true);
    let value = call();
    redirect(false);
    value
}
