//! What the plain build cannot do without unsafe code. All of that is in this file, and the 64 kB build is without it.

#![allow(unsafe_code)]

#[cfg(target_os = "linux")]
use std::sync::atomic::{AtomicBool, Ordering};

#[cfg(all(unix, not(target_os = "macos"), feature = "x11", not(feature = "wayland")))]
pub use size::too_large;
#[cfg(all(unix, not(target_os = "macos"), feature = "x11"))]
pub use size::{LARGEST, bound};

/// The bound to the size that minifb hears of.
#[cfg(all(unix, not(target_os = "macos"), feature = "x11"))]
mod size {
    use raw_window_handle::{HasDisplayHandle, HasWindowHandle, RawDisplayHandle, RawWindowHandle};
    use std::ffi::c_int;
    use std::sync::OnceLock;
    use std::sync::atomic::{AtomicU32, Ordering};
    use x11_dl::xlib::{ConfigureNotify, Display, Window, XEvent, Xlib, xEvent};

    /// Largest side of a window that minifb hears of, pixels: that of the largest frame.
    pub const LARGEST: u16 = 16_384;

    /// What Xlib makes an event of, from the bytes that the server has sent.
    type Convert = unsafe extern "C" fn(*mut Display, *mut XEvent, *mut xEvent) -> c_int;

    /// How minifb's window is bounded.
    struct Bound {
        window: Window,
        /// The side that minifb is told of in the place of a larger one where the window is too large.
        instead: u16,
        /// Xlib's own conversion.
        convert: Convert,
    }

    static BOUND: OnceLock<Bound> = OnceLock::new();
    /// Width and height of the window while it is too large for minifb, 16 bits each, and else 0.
    static TOO_LARGE: AtomicU32 = AtomicU32::new(0);

    /// Width and height of the window in pixels while one of them is above [`LARGEST`]. minifb does not know then.
    #[cfg(not(feature = "wayland"))]
    pub fn too_large() -> Option<(usize, usize)> {
        let size = TOO_LARGE.load(Ordering::Relaxed) as usize;
        (size > 0).then_some((size & 0xffff, size >> 16))
    }

    /// Bounds what minifb hears of its window's size, which it keeps a picture of: 17 GB for the largest. Where a side is
    /// above [`LARGEST`], minifb hears of a window of at most `instead` per side. Only the first window is bounded, and
    /// none where the window is not an X server's.
    ///
    /// Another client may resize the window between any question of ours and minifb's, and any client may send minifb an
    /// event that names a size. So the bound is where Xlib makes events of what has come, which is a hook of its own for
    /// its extensions.
    pub fn bound(window: &(impl HasDisplayHandle + HasWindowHandle), instead: u16) {
        let handles = (window.display_handle().map(|handle| handle.as_raw()), window.window_handle());
        let (Ok(RawDisplayHandle::Xlib(display)), Ok(handle)) = handles else { return };
        let (Some(display), RawWindowHandle::Xlib(handle)) = (display.display, handle.as_raw()) else { return };
        let (display, window) = (display.cast::<Display>().as_ptr(), handle.window);
        // minifb has opened the same library.
        let Ok(xlib) = Xlib::open() else { return };
        // SAFETY: the display is open as long as the window, which is borrowed here. The hook is a function that stays,
        // and is called as Xlib's own is: with a display, room for an event, and the 32 bytes that make it.
        let Some(convert) = (unsafe { (xlib.XESetWireToEvent)(display, ConfigureNotify, Some(convert)) }) else {
            return;
        };
        let bound = BOUND.get_or_init(|| Bound { window, instead, convert });
        // What has come while the window was opened has been converted already. The last word counts.
        let mut last = None;
        let mut event = XEvent { pad: [0; 24] };
        // SAFETY: as above; the event is written, and read back as the type that was asked for.
        while unsafe { (xlib.XCheckTypedWindowEvent)(display, window, ConfigureNotify, &mut event) } != 0 {
            last = Some(event);
        }
        if let Some(mut event) = last {
            bound.apply(&mut event);
            // SAFETY: as above; Xlib copies the event.
            unsafe { (xlib.XPutBackEvent)(display, &mut event) };
        }
    }

    /// Xlib's conversion of a window's new size, bounded.
    unsafe extern "C" fn convert(display: *mut Display, event: *mut XEvent, wire: *mut xEvent) -> c_int {
        // It has been set before the next event can come.
        let Some(bound) = BOUND.get() else { return 0 };
        // SAFETY: Xlib's own function gets what Xlib has called this one with.
        let is_wanted = unsafe { (bound.convert)(display, event, wire) };
        // SAFETY: the event is Xlib's to write, and has just been written.
        bound.apply(unsafe { &mut *event });
        is_wanted
    }

    impl Bound {
        /// Notes the size that an event of the right type names, and bounds it.
        fn apply(&self, event: &mut XEvent) {
            // SAFETY: the event is a `ConfigureNotify`, and every bit pattern is a number.
            let configure = unsafe { &mut event.configure };
            if configure.window != self.window {
                return;
            }
            // 16 bits each, as the server has sent them.
            let [width, height] = [configure.width, configure.height].map(|side| side as u16);
            let is_too_large = width.max(height) > LARGEST;
            let size = if is_too_large { u32::from(width) | u32::from(height) << 16 } else { 0 };
            TOO_LARGE.store(size, Ordering::Relaxed);
            if is_too_large {
                (configure.width, configure.height) = (width.min(self.instead).into(), height.min(self.instead).into());
            }
        }
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
