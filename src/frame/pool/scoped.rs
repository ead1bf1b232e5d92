//! Threads that live for a frame: to start one takes some 30 microseconds, and rayon would take 6 kB packed.

use super::STACK;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::{self, Builder};

/// A fixed number of threads that work together.
pub struct Pool(usize);

impl Pool {
    /// `threads` threads (0: all cores), the calling one among them.
    pub fn new(threads: usize) -> Result<Pool, String> {
        Ok(Pool(if threads > 0 { threads } else { cores() }))
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.0
    }

    /// Does `work` on `most` threads at once, or on as many as there are; the sum of what it gives.
    pub fn sum(&self, most: usize, work: &(dyn Fn() -> u64 + Sync)) -> u64 {
        let sum = AtomicU64::new(0);
        // As an object, as [`super::start`] has it, so that there is one way to start a thread.
        let add: &(dyn Fn() + Sync) = &|| {
            sum.fetch_add(work(), Ordering::Relaxed);
        };
        thread::scope(|scope| {
            for _ in 1..self.0.min(most) {
                // Where no more threads can start, those that did do the work.
                if Builder::new().stack_size(STACK).spawn_scoped(scope, add).is_err() {
                    break;
                }
            }
            add();
        });
        sum.into_inner()
    }
}

/// The cores that this process may run on. The standard answer also reads the quota of a container, for 4 kB packed.
#[cfg(target_os = "linux")]
pub fn cores() -> usize {
    rustix::thread::sched_getaffinity(None).map_or(1, |cores| cores.count() as usize)
}

/// The same as the standard library has it.
#[cfg(not(target_os = "linux"))]
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
