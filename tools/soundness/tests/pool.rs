//! The pool of the 64 kB build on the standard library, small enough to be interpreted: Miri runs it with other schedules
//! and orders of memory for other seeds, and finds what is read before it has been written.

/// As in `src/frame/pool`.
mod start {
    pub const STACK: usize = 2 << 20;
}
#[allow(dead_code, reason = "the number of cores is not asked for")]
#[path = "../../../src/frame/pool/scoped.rs"]
mod scoped;

use scoped::Pool;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Jobs, more than there are threads.
const JOBS: usize = 12;

#[test]
fn what_threads_wrote_is_there_when_the_pool_returns() {
    for threads in 1..=4 {
        let pool = Pool::new(threads).unwrap();
        let (next, done) = (AtomicUsize::new(0), [(); JOBS].map(|()| AtomicUsize::new(0)));
        let sum = pool.sum(3, &|| {
            let mut sum = 0;
            loop {
                let job = next.fetch_add(1, Relaxed);
                let Some(place) = done.get(job) else { return sum };
                place.store(job * job + 1, Relaxed);
                sum += job as u64;
            }
        });
        assert_eq!(sum, (JOBS * (JOBS - 1) / 2) as u64, "{threads} threads");
        for (job, place) in done.iter().enumerate() {
            assert_eq!(place.load(Relaxed), job * job + 1, "job {job} of {threads} threads");
        }
    }
}
