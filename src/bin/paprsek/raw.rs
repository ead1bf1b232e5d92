//! What the plain build cannot do without unsafe code. All of that is in this file, and the 64 kB build is without it.

#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::io::{Write, stderr};
use std::process;
#[cfg(target_os = "linux")]
use std::sync::atomic::{AtomicBool, Ordering};

/// Most bytes that may be asked for at once within [`bounded`]: minifb's picture for a window of 16,384 x 16,384 pixels,
/// in a vector that doubles where it grows.
const MOST: usize = 2 << 30;
/// What is said where more is asked for.
pub const TOO_LARGE: &str = "the window is too large";

thread_local! {
    // Without a destructor, and known before the program runs, so it may be asked for wherever memory is.
    static IS_BOUNDED: Cell<bool> = const { Cell::new(false) };
}

/// Makes a call into minifb, which keeps a picture as large as its window, whatever size the display says that is: 17 GB
/// for the largest. Where that is too large the process ends with one line on stderr, before there is such memory.
pub fn bounded<T>(call: impl FnOnce() -> T) -> T {
    IS_BOUNDED.set(true);
    let value = call();
    IS_BOUNDED.set(false);
    value
}

/// The system's memory, with that bound.
struct Memory;

#[global_allocator]
static MEMORY: Memory = Memory;

/// To be called before so many bytes are asked for.
fn check(size: usize) {
    if size > MOST && IS_BOUNDED.replace(false) {
        let _ = stderr().write_all(format!("paprsek: {TOO_LARGE}\n").as_bytes());
        process::exit(1);
    }
}

// SAFETY: every call goes to the system's allocator as it came, or does not return.
unsafe impl GlobalAlloc for Memory {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        check(layout.size());
        // SAFETY: the caller's promise is the one that is asked for.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        check(layout.size());
        // SAFETY: as above.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, place: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        check(size);
        // SAFETY: as above.
        unsafe { System.realloc(place, layout, size) }
    }

    unsafe fn dealloc(&self, place: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(place, layout) }
    }
}

/// Whether stdout was closed when the program started.
#[cfg(target_os = "linux")]
static STDOUT_WAS_CLOSED: AtomicBool = AtomicBool::new(false);

/// Whether stdout was closed when the program started. The standard library opens `/dev/null` over a stream that is
/// closed, before `main`, and nothing tells that from a caller's own `/dev/null`. So it is asked before.
#[cfg(target_os = "linux")]
pub fn stdout_was_closed() -> bool {
    STDOUT_WAS_CLOSED.load(Ordering::Relaxed)
}

#[cfg(target_os = "linux")]
extern "C" fn look_at_stdout() {
    let closed = rustix::io::fcntl_getfd(rustix::stdio::stdout()).is_err();
    STDOUT_WAS_CLOSED.store(closed, Ordering::Relaxed);
}

// SAFETY: the loader calls what is listed here, by C's convention, once, and before `main`. All that this function does
// is a call of the system and a store, neither of which needs anything that the standard library sets up.
#[cfg(target_os = "linux")]
#[used]
#[unsafe(link_section = ".init_array")]
static LOOK_AT_STDOUT: extern "C" fn() = look_at_stdout;
