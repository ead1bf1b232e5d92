//! A limit on how long a call into Xlib may take.
//!
//! Xlib waits for its server for ever. So a thread watches the calls, and ends the process when one lasts too long.

use crate::io::complain;
use std::env;
use std::io;
use std::process;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// Time from one check to the next. Checks are counted rather than timed, so that a process that was stopped for a
/// while gives up nothing.
const INTERVAL: Duration = Duration::from_millis(100);
/// Checks that a call may outlast once Esc has been heard: less than half a second.
const LEAVING_CHECKS: usize = 3;
/// Checks that a call to a server of this machine may outlast: less than 5 s.
const CHECKS: usize = 48;
/// Checks that a call over a network may outlast, which has waits of its own: a minute.
const NETWORK_CHECKS: usize = 600;

/// How often calls have begun and ended: odd while one lasts.
static CALLS: AtomicUsize = AtomicUsize::new(0);
/// Whether Esc has been heard, by whomever.
static LEAVING: AtomicBool = AtomicBool::new(false);
/// Whether the process may end: what was asked for has been saved.
static MAY_END: OnceLock<Box<dyn Fn() -> bool + Send + Sync>> = OnceLock::new();

/// Starts the thread that watches the calls.
pub fn begin() -> io::Result<()> {
    let display = env::var("DISPLAY").unwrap_or_default();
    let limit = if display.starts_with(':') || display.starts_with("unix:") { CHECKS } else { NETWORK_CHECKS };
    let watch = move || {
        let (mut last, mut checks) = (0, 0);
        loop {
            thread::sleep(INTERVAL);
            let calls = CALLS.load(Ordering::Relaxed);
            checks = if calls == last && calls % 2 == 1 { checks + 1 } else { 0 };
            last = calls;
            if LEAVING.load(Ordering::Relaxed) {
                if checks >= LEAVING_CHECKS && MAY_END.get().is_none_or(|may_end| may_end()) {
                    process::exit(0);
                }
            } else if checks >= limit {
                complain(b"the display does not answer");
                process::exit(1);
            }
        }
    };
    thread::Builder::new().spawn(watch).map(drop)
}

/// Ends the process well if the call of this moment, or a later one, lasts.
#[cfg(not(feature = "wayland"))]
pub fn leave() {
    LEAVING.store(true, Ordering::Relaxed);
}

/// Whether Esc has been heard so.
#[cfg(not(feature = "wayland"))]
pub fn is_leaving() -> bool {
    LEAVING.load(Ordering::Relaxed)
}

/// Has the process wait for this, where Esc ends it in the middle of a call.
pub fn leave_once(may_end: impl Fn() -> bool + Send + Sync + 'static) {
    let _ = MAY_END.set(Box::new(may_end));
}

/// Makes calls into Xlib, watched.
pub fn during<T>(call: impl FnOnce() -> T) -> T {
    CALLS.fetch_add(1, Ordering::Relaxed);
    let value = call();
    CALLS.fetch_add(1, Ordering::Relaxed);
    value
}
