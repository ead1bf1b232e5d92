//! The window of the system: minifb's, or in the 64 kB build, which has no minifb, one that speaks X11 itself.

#[cfg(feature = "minifb")]
mod library;
#[cfg(not(feature = "minifb"))]
mod x11;

#[cfg(feature = "minifb")]
pub use library::Window;
#[cfg(not(feature = "minifb"))]
pub use x11::Window;

/// Its title.
const TITLE: &str = "Paprsek";

/// What the keys ask for.
#[derive(Clone, Copy, PartialEq)]
pub enum Press {
    /// Esc, or the window has been closed.
    Leave,
    /// Space.
    Pause,
    /// Left.
    Back,
    /// Right.
    Forward,
}
