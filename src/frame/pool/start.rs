//! How a thread is started.

use std::thread::Builder;

/// Stack of a thread, bytes: the standard size. Because it is said, the standard library does not look for it in the
/// environment. The packed file's library does not ask for it at all (`tools/pack/src/library.rs`).
pub const STACK: usize = 2 << 20;

/// Starts a thread that nobody waits for; `None` where no thread can start.
pub fn start(work: &'static (dyn Fn() + Sync)) -> Option<()> {
    Builder::new().stack_size(STACK).spawn(work).ok().map(drop)
}
