//! The threads of a renderer, and how work is shared among them.

use super::pool::Pool;
use crate::simd::level;
use fearless_simd::Level;
use std::sync::{Mutex, PoisonError};

/// The threads of a renderer, and the SIMD level that they work at.
pub struct Workers {
    pool: Pool,
    level: Level,
}

impl Workers {
    /// `threads` threads, or one per core if 0, at the best SIMD level of this machine. Fails where they cannot be started.
    pub fn new(threads: usize) -> Result<Workers, String> {
        Ok(Workers { pool: Pool::new(threads)?, level: level::best() })
    }

    /// Changes the SIMD level.
    pub fn set_level(&mut self, level: Level) {
        self.level = level;
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.pool.threads()
    }

    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Does `work` on every job once. Threads take one job after another.
    ///
    /// Jobs may run at once and in any order, so their results must not depend on it.
    pub fn each<T: Send>(&self, jobs: impl Iterator<Item = T> + Send, work: impl Fn(T) + Sync) {
        self.each_with(
            jobs,
            || (),
            |(), job| {
                work(job);
                0
            },
        );
    }

    /// Does `work` on every job once, with a value that each thread makes once for all of its jobs. Gives the sum of the
    /// jobs' results.
    pub(super) fn each_with<T: Send, M>(
        &self,
        jobs: impl Iterator<Item = T> + Send,
        make: impl Fn() -> M + Sync,
        work: impl Fn(&mut M, T) -> u64 + Sync,
    ) -> u64 {
        // No more threads than jobs: one without a job would be started for nothing.
        let most = jobs.size_hint().1.unwrap_or(usize::MAX);
        let jobs = Mutex::new(jobs);
        self.pool.sum(most, &|| {
            let mut own = make();
            let mut sum = 0;
            loop {
                // Bound, so that the lock is free again while the job is done.
                let next = jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
                let Some(job) = next else { return sum };
                sum += work(&mut own, job);
            }
        })
    }
}
