//! Threads that live for a frame: to start one takes some 30 microseconds, and rayon would take 6 kB packed.

use std::thread::{self, Builder};

/// Stack of a thread, bytes: the standard size. Said here, it is not looked for in the environment.
const STACK: usize = 2 << 20;

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

    /// Does `work` on every thread at once; the sum of what it gives.
    pub fn sum(&self, work: &(dyn Fn() -> u64 + Sync)) -> u64 {
        thread::scope(|scope| {
            let hands: Vec<_> = (1..self.0)
                // Where no more threads can start, those that did do the work.
                .map_while(|_| Builder::new().stack_size(STACK).spawn_scoped(scope, work).ok())
                .collect();
            work() + hands.into_iter().filter_map(|hand| hand.join().ok()).sum::<u64>()
        })
    }
}

/// The cores that this process may run on. The standard answer also reads the quota of a container, for 4 kB packed.
#[cfg(target_os = "linux")]
fn cores() -> usize {
    rustix::thread::sched_getaffinity(None).map_or(1, |cores| cores.count() as usize)
}

#[cfg(not(target_os = "linux"))]
fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}
