//! A pool whose threads stay from frame to frame. The only file that names rayon.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::available_parallelism;

/// A fixed number of threads that work together.
pub struct Pool(ThreadPool);

impl Pool {
    /// A pool of `threads` threads (0: one per core). The calling thread is one of them unless it belongs to a pool
    /// already.
    ///
    /// Fails where the threads cannot be started.
    pub fn new(threads: usize) -> Result<Pool, String> {
        let build = |own: bool| {
            let pool = ThreadPoolBuilder::new().num_threads(threads);
            if own { pool.use_current_thread() } else { pool }.build()
        };
        build(true).or_else(|_| build(false)).map(Pool).map_err(|e| format!("cannot start threads: {e}"))
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.0.current_num_threads()
    }

    /// Runs `work` once on each of at most `most` threads, at the same time, and returns the sum of the results.
    ///
    /// The calling thread always takes part.
    pub fn sum(&self, most: usize, work: &(dyn Fn() -> u64 + Sync)) -> u64 {
        let sum = AtomicU64::new(0);
        let add = || sum.fetch_add(work(), Ordering::Relaxed);
        self.0.scope(|scope| {
            (1..self.threads().min(most)).for_each(|_| scope.spawn(|_| _ = add()));
            // A call, not a task, which would have to wait for a thread.
            add();
        });
        sum.into_inner()
    }
}

/// The number of cores that this process may use at once.
pub fn cores() -> usize {
    available_parallelism().map_or(1, usize::from)
}
