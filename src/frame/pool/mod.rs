//! Threads that draw the bands of a frame.
//!
//! rayon's workers wait for the next frame; in the 64 kB build, which has no rayon, threads live for a frame.

#[cfg(feature = "rayon")]
mod rayon;
#[cfg(not(feature = "rayon"))]
mod scoped;

#[cfg(feature = "rayon")]
pub use self::rayon::{Pool, cores};
#[cfg(not(feature = "rayon"))]
pub use scoped::{Pool, cores};
use std::thread::Builder;

/// Stack of a thread, bytes: the standard size. Said here, it is not looked for in the environment.
const STACK: usize = 2 << 20;

/// Starts a thread that nobody waits for; `None` where none can start.
pub fn start(work: &'static (dyn Fn() + Sync)) -> Option<()> {
    Builder::new().stack_size(STACK).spawn(work).ok().map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_are_as_many_as_there_is_work_for() {
        let pool = Pool::new(8).unwrap();
        assert_eq!([0, 1, 2, 8, 99].map(|most| pool.sum(most, &|| 1)), [1, 1, 2, 8, 8]);
    }
}
