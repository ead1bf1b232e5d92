//! The pool of the 64 kB build (`src/frame/pool/scoped.rs`) under many schedules, in `tests/`. Here is what the pool takes
//! from the standard library, under a scheduler that chooses who goes on wherever threads meet: a test names this crate
//! `std` and has the pool's file as a module.

/// Atomics of the scheduler.
pub mod sync {
    pub use shuttle::sync::atomic;
}

/// Threads of the scheduler.
pub mod thread {
    use shuttle::rand::{Rng, thread_rng};
    use shuttle::thread::{Scope, ScopedJoinHandle};
    use std::cell::Cell;
    use std::io;
    use std::num::NonZero;

    pub use shuttle::thread::scope;

    thread_local! {
        /// Whether starting a thread fails half of the time, as it does where a process may have no more of them. The
        /// scheduler's threads are all in one of the system's.
        static FAILS: Cell<bool> = const { Cell::new(false) };
    }

    /// From now on starting a thread fails half of the time.
    pub fn fail_half() {
        FAILS.set(true);
    }

    /// Starts threads of a scope.
    #[derive(Default)]
    pub struct Builder(());

    impl Builder {
        /// One without settings.
        pub fn new() -> Builder {
            Builder(())
        }

        /// The same: the scheduler has stacks of its own.
        pub fn stack_size(self, _bytes: usize) -> Builder {
            self
        }

        /// Starts a thread that ends before its scope does.
        pub fn spawn_scoped<'scope, 'env, T: Send + 'scope>(
            self,
            scope: &'scope Scope<'scope, 'env>,
            work: impl FnOnce() -> T + Send + 'scope,
        ) -> io::Result<ScopedJoinHandle<'scope, T>> {
            if FAILS.get() && thread_rng().gen_bool(0.5) {
                return Err(io::Error::from(io::ErrorKind::WouldBlock));
            }
            Ok(scope.spawn(work))
        }
    }

    /// Cores of the machine.
    pub fn available_parallelism() -> io::Result<NonZero<usize>> {
        std::thread::available_parallelism()
    }
}
