//! Signals that end the process, before which the terminal has to be put back.
//!
//! Little is allowed in a signal handler, and nothing that takes a lock or waits. So the handler only notes the signal,
//! and a thread that polls the note does the work.

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag::register_usize;
use signal_hook::low_level::emulate_default_handler;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// How long a signal may wait until it is noticed.
const INTERVAL: Duration = Duration::from_millis(20);

/// Calls `first` when a signal is to end the process, and then lets it, so that whoever waits for the process learns of
/// the signal. `first` must not wait for ever: nothing but SIGKILL ends the process meanwhile. What it returns is kept
/// to the end.
pub fn before_the_end<T>(first: impl FnOnce() -> T + Send + 'static) -> io::Result<()> {
    let caught = Arc::new(AtomicUsize::new(0));
    let seen = Arc::clone(&caught);
    let wait = move || {
        let signal = loop {
            match seen.load(Ordering::Relaxed) {
                0 => thread::sleep(INTERVAL),
                signal => break signal,
            }
        };
        let _kept = first();
        let _ = emulate_default_handler(signal as i32);
    };
    // The thread comes first: without it a signal is to end the process as usual.
    thread::Builder::new().spawn(wait)?;
    for signal in [SIGHUP, SIGINT, SIGTERM] {
        register_usize(signal, Arc::clone(&caught), signal as usize)?;
    }
    Ok(())
}
