//! Signals that end the process, of which the terminal is to be put back first.

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag::register_usize;
use signal_hook::low_level::emulate_default_handler;
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

/// How long a signal may wait to be seen.
const LOOK: Duration = Duration::from_millis(20);

/// Calls `first` when such a signal comes, and then ends by it, so that whoever waits for the process learns of it.
/// `first` may not wait for ever: nothing but SIGKILL ends the process while it does.
pub fn before_the_end<T>(first: impl FnOnce() -> T + Send + 'static) -> io::Result<()> {
    let caught = Arc::new(AtomicUsize::new(0));
    let seen = Arc::clone(&caught);
    let wait = move || {
        let signal = loop {
            match seen.load(Ordering::Relaxed) {
                0 => thread::sleep(LOOK),
                signal => break signal,
            }
        };
        let _kept = first();
        let _ = emulate_default_handler(signal as i32);
    };
    // The thread first: without it a signal is to end the process as usual.
    thread::Builder::new().spawn(wait)?;
    for signal in [SIGHUP, SIGINT, SIGTERM] {
        register_usize(signal, Arc::clone(&caught), signal as usize)?;
    }
    Ok(())
}
