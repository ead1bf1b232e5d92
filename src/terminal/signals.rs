//! Signals that end the process, of which the terminal is to be put back first.

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;
use std::io;
use std::thread;

/// Calls `first` when such a signal comes, and then ends by it, so that whoever waits for the process learns of it.
/// `first` may not wait for ever: nothing but SIGKILL ends the process while it does.
pub fn before_the_end<T>(first: impl FnOnce() -> T + Send + 'static) -> io::Result<()> {
    // The signals are caught by the thread, so that they are as usual where there is none.
    let wait = || {
        let Ok(mut signals) = Signals::new([SIGHUP, SIGINT, SIGTERM]) else { return };
        if let Some(signal) = signals.forever().next() {
            let _kept = first();
            let _ = emulate_default_handler(signal);
        }
    };
    thread::Builder::new().spawn(wait).map(drop)
}
