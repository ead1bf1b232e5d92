//! The pool of the 64 kB build: work is done by as many threads as there should be, each job once, and nothing goes on
//! after it. All schedules of a few threads, and random ones of more.

// What the pool calls the standard library.
extern crate soundness as std;

/// As in `src/frame/pool`.
mod start {
    pub const STACK: usize = 2 << 20;
}
#[allow(dead_code, reason = "the number of cores is not asked for")]
#[path = "../../../src/frame/pool/scoped.rs"]
mod scoped;

use core::sync::atomic::Ordering::{Relaxed, SeqCst};
use scoped::Pool;
use shuttle::scheduler::DfsScheduler;
use shuttle::sync::atomic::AtomicUsize;
use shuttle::{Config, Runner};

/// Threads of a pool do `JOBS` jobs as a frame has them done: each takes the next number until there is none.
fn work<const JOBS: usize>(threads: usize, most: usize, may_fail: bool) {
    let pool = Pool::new(threads).expect("a pool");
    let (next, calls, inside) = (AtomicUsize::new(0), AtomicUsize::new(0), AtomicUsize::new(0));
    let done: [AtomicUsize; JOBS] = core::array::from_fn(|_| AtomicUsize::new(0));
    let sum = pool.sum(most, &|| {
        calls.fetch_add(1, SeqCst);
        inside.fetch_add(1, SeqCst);
        let mut sum = 0;
        loop {
            let job = next.fetch_add(1, Relaxed);
            let Some(times) = done.get(job) else { break };
            times.fetch_add(1, Relaxed);
            sum += 1 << (4 * job);
        }
        inside.fetch_sub(1, SeqCst);
        sum
    });
    // A hexadecimal digit per job.
    assert_eq!(sum, 0x1111_1111 >> (4 * (8 - JOBS)), "every job is in the sum once");
    assert!(done.iter().all(|times| times.load(Relaxed) == 1), "every job is done once");
    assert_eq!(inside.load(SeqCst), 0, "nobody works on");
    let (calls, full) = (calls.load(SeqCst), threads.min(most).max(1));
    assert!(calls == full || may_fail && (1..full).contains(&calls), "{calls} of {full} threads");
}

#[test]
fn every_schedule_of_two_threads() {
    let runner = Runner::new(DfsScheduler::new(None, false), Config::default());
    let tried = runner.run(|| {
        let taken = AtomicUsize::new(0);
        // 1 of whoever comes first, 2 of the other.
        assert_eq!(Pool::new(2).expect("a pool").sum(9, &|| 1 + taken.fetch_add(1, Relaxed) as u64), 3);
    });
    // It ends by itself: there are no more.
    assert!(tried > 20, "{tried} schedules");
}

#[test]
fn random_schedules_of_up_to_five_threads() {
    for (threads, most) in [(1, 5), (3, 0), (3, 3), (5, 9), (5, 4)] {
        shuttle::check_random(move || work::<6>(threads, most, false), 400);
    }
}

#[test]
fn where_threads_cannot_start_the_others_do_the_work() {
    soundness::thread::fail_half();
    shuttle::check_random(|| work::<6>(5, 5, true), 1000);
}
