//! A pool whose threads live for one piece of work: starting one takes some 30 microseconds. rayon would take 6 kB
//! packed.

use super::start::STACK;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::{self, Builder};

/// A fixed number of threads that work together.
pub struct Pool(usize);

impl Pool {
    /// A pool of `threads` threads (0: one per core), of which the calling thread is one. Never fails.
    pub fn new(threads: usize) -> Result<Pool, String> {
        Ok(Pool(if threads > 0 { threads } else { cores() }))
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.0
    }

    /// Runs `work` once on each of at most `most` threads, at the same time, and returns the sum of the results.
    ///
    /// The calling thread always takes part. Where no more threads can start it works with those that did.
    pub fn sum(&self, most: usize, work: &(dyn Fn() -> u64 + Sync)) -> u64 {
        let sum = AtomicU64::new(0);
        // A trait object, as [`super::start`] takes it, so that the program has one instance of starting a thread.
        let add: &(dyn Fn() + Sync) = &|| {
            sum.fetch_add(work(), Ordering::Relaxed);
        };
        thread::scope(|scope| {
            for _ in 1..self.0.min(most) {
                if Builder::new().stack_size(STACK).spawn_scoped(scope, add).is_err() {
                    break;
                }
            }
            add();
        });
        sum.into_inner()
    }
}

/// The number of cores that this process may run on. The standard library's answer minds a container's quota too, for 4
/// kB packed.
#[cfg(target_os = "linux")]
pub fn cores() -> usize {
    use rustix::thread::{CpuSet, sched_getaffinity};
    sched_getaffinity(None).map_or(1, |cores| (0..CpuSet::MAX_CPU).filter(|&core| cores.is_set(core)).count())
}

/// The number of cores that this process may use at once.
#[cfg(not(target_os = "linux"))]
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
