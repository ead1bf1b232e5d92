//! A limit on how long a call into Xlib may take.
//!
//! Xlib waits for its server for ever. So a thread watches the calls, and ends the process when one lasts too long.

use crate::io::complain;
use std::env;
use std::io;
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Time from one check to the next. Checks are counted rather than timed, so that a process that was stopped for a
/// while gives up nothing.
const INTERVAL: Duration = Duration::from_millis(500);
/// Checks that a call to a server of this machine may outlast: less than 5 s.
const CHECKS: usize = 9;
/// Checks that a call over a network may outlast, which has waits of its own: a minute.
const NETWORK_CHECKS: usize = 120;

/// How often calls have begun and ended: odd while one lasts.
static CALLS: AtomicUsize = AtomicUsize::new(0);

/// Starts the thread that watches the calls.
pub fn begin() -> io::Result<()> {
    let display = env::var("DISPLAY").unwrap_or_default();
    let limit = if display.starts_with(':') || display.starts_with("unix:") { CHECKS } else { NETWORK_CHECKS };
    let watch = move || {
        let (mut last, mut checks) = (0, 0);
        while checks < limit {
            thread::sleep(INTERVAL);
            let calls = CALLS.load(Ordering::Relaxed);
            checks = if calls == last && calls % 2 == 1 { checks + 1 } else { 0 };
            last = calls;
        }
        complain(b"the display does not answer");
        process::exit(1);
    };
    thread::Builder::new().spawn(watch).map(drop)
}

/// Makes calls into Xlib, watched.
pub fn during<T>(call: impl FnOnce() -> T) -> T {
    CALLS.fetch_add(1, Ordering::Relaxed);
    let value = call();
    CALLS.fetch_add(1, Ordering::Relaxed);
    value
}
