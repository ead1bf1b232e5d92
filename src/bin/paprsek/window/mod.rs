//! The window, and displays that fail.
//!
//! `Window` is minifb's; in the 64 kB build, which has no minifb, one that speaks X11 itself. Both open with a size,
//! show a frame as large as it fits, fill the screen, and give one key after another. The README beside this file says
//! what each does when a display is slow, odd or gone.

#[cfg(all(feature = "minifb", unix, not(feature = "wayland")))]
mod beforehand;
#[cfg(all(feature = "minifb", unix, not(feature = "wayland")))]
mod beside;
mod common;
#[cfg(all(feature = "minifb", unix, not(feature = "wayland")))]
mod ears;
#[cfg(feature = "minifb")]
mod minifb;
#[cfg(all(feature = "minifb", unix))]
mod patience;
#[cfg(all(unix, not(feature = "wayland")))]
mod protocol;
#[cfg(all(unix, not(feature = "wayland")))]
mod put;
#[cfg(not(feature = "minifb"))]
mod x11;
#[cfg(all(unix, feature = "minifb"))]
mod xlib_exit;

#[cfg(feature = "minifb")]
pub use self::minifb::Window;
pub use common::keysym;
#[cfg(all(unix, feature = "minifb"))]
pub use patience::leave_once;
#[cfg(not(feature = "minifb"))]
pub use x11::Window;
