//! What both windows have in common: the title, and the names of keys.

/// The title.
pub const TITLE: &str = "Paprsek";

/// The symbols of the keys that mean something (X11/keysymdef.h). Both windows report a held key once, but an arrow as
/// often as it repeats.
pub mod keysym {
    /// Esc. A window that is closed reports this too.
    pub const ESCAPE: u32 = 0xff1b;
    /// The space bar.
    pub const SPACE: u32 = 0x20;
    /// The left arrow.
    pub const LEFT: u32 = 0xff51;
    /// The right arrow.
    pub const RIGHT: u32 = 0xff53;
    /// The digit 1. The digits between it and 9 have the symbols between theirs.
    pub const DIGIT_1: u32 = 0x31;
    /// The digit 9.
    pub const DIGIT_9: u32 = 0x39;
    /// F.
    pub const F: u32 = 0x66;
    /// S.
    pub const S: u32 = 0x73;
}
