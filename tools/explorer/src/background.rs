//! A thread that works on the newest job, and leaves the newest result.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// What the threads share: the newest job, and the newest result.
struct Slot<J, R> {
    job: Option<J>,
    result: Option<R>,
}

/// What both sides hold.
type Shared<J, R> = Arc<(Mutex<Slot<J, R>>, Condvar)>;

/// A thread that works. It ends with the process.
pub struct Background<J, R>(Shared<J, R>);

impl<J: Send + 'static, R: Send + 'static> Background<J, R> {
    /// Starts the thread, which does `work` on one job after another.
    pub fn start(mut work: impl FnMut(J) -> R + Send + 'static) -> Result<Self, String> {
        let shared: Shared<J, R> = Arc::new((Mutex::new(Slot { job: None, result: None }), Condvar::new()));
        let own = shared.clone();
        let run = move || {
            loop {
                let mut slot = lock(&own.0);
                let job = loop {
                    match slot.job.take() {
                        Some(job) => break job,
                        None => slot = own.1.wait(slot).unwrap_or_else(PoisonError::into_inner),
                    }
                };
                drop(slot);
                let result = work(job);
                lock(&own.0).result = Some(result);
            }
        };
        thread::Builder::new().spawn(run).map_err(|error| error.to_string())?;
        Ok(Background(shared))
    }

    /// Asks for a job, in place of one that has been asked for and not begun.
    pub fn ask(&self, job: J) {
        lock(&self.0.0).job = Some(job);
        self.0.1.notify_one();
    }

    /// The newest result, if there is one that has not been taken.
    pub fn take(&self) -> Option<R> {
        lock(&self.0.0).result.take()
    }
}

fn lock<T>(shared: &Mutex<T>) -> MutexGuard<'_, T> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}
