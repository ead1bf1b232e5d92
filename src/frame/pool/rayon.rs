//! Threads that stay: the only file that names rayon.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread::available_parallelism;

/// A fixed number of threads that work together.
pub struct Pool(ThreadPool);

impl Pool {
    /// `threads` threads (0: all cores), the calling one among them where it can be. Fails where they cannot start.
    pub fn new(threads: usize) -> Result<Pool, String> {
        let build = |own: bool| {
            let pool = ThreadPoolBuilder::new().num_threads(threads);
            if own { pool.use_current_thread() } else { pool }.build()
        };
        build(true).or_else(|_| build(false)).map(Pool).map_err(|e| format!("cannot start threads: {e}"))
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.0.current_num_threads()
    }

    /// Does `work` on `most` threads at once, or on as many as there are; the sum of what it gives.
    pub fn sum(&self, most: usize, work: &(dyn Fn() -> u64 + Sync)) -> u64 {
        let sum = AtomicU64::new(0);
        let add = || sum.fetch_add(work(), Ordering::Relaxed);
        self.0.scope(|scope| {
            (1..self.threads().min(most)).for_each(|_| scope.spawn(|_| _ = add()));
            // Not a task: it starts at once.
            add();
        });
        sum.into_inner()
    }
}

/// The cores that this process may use at once.
pub fn cores() -> usize {
    available_parallelism().map_or(1, usize::from)
}
