//! Ends calls into Xlib that take too long, and the process with them: Xlib waits for its server for ever.

use std::env;
use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd;
use std::process;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// From look to look. Looks are counted and not time, so that a process that was stopped for long gives up nothing.
const LOOK: Duration = Duration::from_millis(500);
/// Looks that a call may last: less than 5 s; a minute over a network, whose waits are its own.
const LOOKS: usize = 9;
const FAR_LOOKS: usize = 120;

/// How often calls have begun and ended: odd while one lasts.
static CALLS: AtomicUsize = AtomicUsize::new(0);

/// Begins to look after the calls.
pub fn begin() -> io::Result<()> {
    // While a call lasts stderr is elsewhere.
    let mut stderr: File = io::stderr().as_fd().try_clone_to_owned()?.into();
    let display = env::var("DISPLAY").unwrap_or_default();
    let most = if display.starts_with(':') || display.starts_with("unix:") { LOOKS } else { FAR_LOOKS };
    let look = move || {
        let (mut last, mut looks) = (0, 0);
        while looks < most {
            thread::sleep(LOOK);
            let calls = CALLS.load(Ordering::Relaxed);
            looks = if calls == last && calls % 2 == 1 { looks + 1 } else { 0 };
            last = calls;
        }
        let _ = stderr.write_all(b"paprsek: the display does not answer\n");
        process::exit(1);
    };
    thread::Builder::new().spawn(look).map(drop)
}

/// A call into Xlib.
pub fn during<T>(call: impl FnOnce() -> T) -> T {
    CALLS.fetch_add(1, Ordering::Relaxed);
    let value = call();
    CALLS.fetch_add(1, Ordering::Relaxed);
    value
}
