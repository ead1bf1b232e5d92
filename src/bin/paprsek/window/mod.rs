//! The window of the system: minifb's, or in the 64 kB build, which has no minifb, one that speaks X11 itself.

#[cfg(all(feature = "minifb", unix, not(feature = "wayland")))]
mod beforehand;
#[cfg(feature = "minifb")]
mod minifb;
#[cfg(all(feature = "minifb", unix))]
mod patience;
#[cfg(all(unix, not(feature = "wayland")))]
mod protocol;
#[cfg(not(feature = "minifb"))]
mod x11;
#[cfg(all(unix, feature = "minifb"))]
pub mod xlib_exit;

#[cfg(feature = "minifb")]
pub use self::minifb::Window;
#[cfg(not(feature = "minifb"))]
pub use x11::Window;

/// Its title.
const TITLE: &str = "Paprsek";

// What the keys ask for, by the symbols that X has for the keys (X11/keysymdef.h). Held keys repeat where that is right:
// the arrows.

/// Esc, or the window has been closed.
pub const LEAVE: u32 = 0xff1b;
/// Space.
pub const PAUSE: u32 = 0x20;
/// Left.
pub const BACK: u32 = 0xff51;
/// Right.
pub const FORWARD: u32 = 0xff53;
/// 1 and 9; the parts between them lie in a row.
pub const FIRST_PART: u32 = 0x31;
/// The last of them.
pub const LAST_PART: u32 = 0x39;
/// F.
pub const FILL: u32 = 0x66;
/// S.
pub const STILL: u32 = 0x73;
