//! The threads that make a frame.

use super::pool::Pool;
use fearless_simd::Level;
use std::sync::{Mutex, PoisonError};

/// The threads of a frame, and the SIMD level that it is made at.
pub struct Workers {
    pub(super) pool: Pool,
    pub(super) level: Level,
}

impl Workers {
    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Does `work` on every job once; threads take one after another.
    ///
    /// Two jobs may run at once in either order: what they give must not depend on it.
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

    /// The same with something that each thread makes once, for all of its jobs; the sum of what the jobs give.
    pub(super) fn each_with<T: Send, M>(
        &self,
        jobs: impl Iterator<Item = T> + Send,
        make: impl Fn() -> M + Sync,
        work: impl Fn(&mut M, T) -> u64 + Sync,
    ) -> u64 {
        // A thread without a job would start for nothing.
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
