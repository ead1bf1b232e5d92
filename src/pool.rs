//! Threads: the only file that names rayon.

#[cfg(feature = "full")]
use std::sync::atomic::{AtomicU64, Ordering};

/// Stack of a thread, bytes: the standard size. Said here, it is not looked for in the environment.
#[cfg(not(feature = "full"))]
const STACK: usize = 2 << 20;

/// A fixed number of threads that work together.
pub struct Pool {
    #[cfg(feature = "full")]
    threads: rayon::ThreadPool,
    #[cfg(not(feature = "full"))]
    threads: usize,
}

#[cfg(feature = "full")]
impl Pool {
    /// `threads` threads (0: all cores), the calling one among them where it can be. Fails where they cannot start.
    pub fn new(threads: usize) -> Result<Pool, String> {
        let build = |own: bool| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            if own { pool.use_current_thread() } else { pool }.build()
        };
        let threads = build(true).or_else(|_| build(false)).map_err(|e| format!("cannot start threads: {e}"))?;
        Ok(Pool { threads })
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.threads.current_num_threads()
    }

    /// Does `work` on every thread at once; the sum of what it gives.
    pub fn sum(&self, work: impl Fn() -> u64 + Sync) -> u64 {
        let sum = AtomicU64::new(0);
        let add = || sum.fetch_add(work(), Ordering::Relaxed);
        self.threads.scope(|scope| {
            (1..self.threads()).for_each(|_| scope.spawn(|_| _ = add()));
            // Not a task: it starts at once.
            add();
        });
        sum.into_inner()
    }
}

/// Without rayon, 6 kB packed: threads that live for a frame.
#[cfg(not(feature = "full"))]
impl Pool {
    /// `threads` threads (0: all cores), the calling one among them.
    pub fn new(threads: usize) -> Result<Pool, String> {
        Ok(Pool { threads: if threads > 0 { threads } else { cores() } })
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.threads
    }

    /// Does `work` on every thread at once; the sum of what it gives.
    pub fn sum(&self, work: impl Fn() -> u64 + Sync) -> u64 {
        std::thread::scope(|scope| {
            let hands: Vec<_> = (1..self.threads)
                // Where no more threads can start, those that did do the work.
                .map_while(|_| std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, &work).ok())
                .collect();
            work() + hands.into_iter().filter_map(|hand| hand.join().ok()).sum::<u64>()
        })
    }
}

/// The cores that this process may run on. The standard answer also reads the quota of a container, for 4 kB packed.
#[cfg(all(target_os = "linux", not(feature = "full")))]
fn cores() -> usize {
    rustix::thread::sched_getaffinity(None).map_or(1, |cores| cores.count() as usize)
}

#[cfg(all(not(target_os = "linux"), not(feature = "full")))]
fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
