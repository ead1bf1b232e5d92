//! A limit on how long a call into Xlib may take.
//!
//! Xlib waits for its server for ever. So a thread watches the calls, and ends the process when one lasts too long. A
//! display that goes away ends the process in Xlib itself.

use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Time from one check to the next. Checks are counted rather than timed, so that a process that was stopped for a
/// while gives up nothing.
const INTERVAL: Duration = Duration::from_millis(100);
/// Checks that a call may outlast: 5 s.
const CHECKS: usize = 50;

/// How often calls have begun and ended: odd while one lasts.
static CALLS: AtomicUsize = AtomicUsize::new(0);

/// Starts the thread that watches the calls.
pub fn begin() -> Result<(), String> {
    let watch = || {
        let (mut last, mut checks) = (0, 0);
        loop {
            thread::sleep(INTERVAL);
            let calls = CALLS.load(Ordering::Relaxed);
            checks = if calls == last && calls % 2 == 1 { checks + 1 } else { 0 };
            last = calls;
            if checks >= CHECKS {
                eprintln!("explorer: the display does not answer");
                process::exit(1);
            }
        }
    };
    thread::Builder::new().spawn(watch).map(drop).map_err(|error| error.to_string())
}

/// Makes calls into Xlib, watched.
pub fn during<T>(call: impl FnOnce() -> T) -> T {
    CALLS.fetch_add(1, Ordering::Relaxed);
    let value = call();
    CALLS.fetch_add(1, Ordering::Relaxed);
    value
}
