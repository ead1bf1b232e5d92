//! How particles are seen: limits of their size on the screen, and an aperture.

/// How particles are seen.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// The least and the greatest radius of a sprite, pixels. What is smaller is drawn at the least radius and weaker,
    /// so that its light stays; what is larger is drawn at the greatest.
    pub radius: [f32; 2],
    /// Distances along the view axis between which particles come into sight, metres.
    pub near: [f32; 2],
    /// Radius of the aperture, metres. What is nearer than the focus is blurred.
    pub aperture: f32,
    /// Distance of the focus along the view axis, metres.
    pub focus: f32,
    /// Whether sprites are turned, and drawn as snow crystals where they are large enough.
    pub crystals: bool,
    /// Whether sprites are drawn out along their way while the shutter is open. The 64 kB build has no such sprites.
    pub streaks: bool,
}

impl Lens {
    /// Everything is sharp, of its own size, and in sight from the eye on.
    pub const SHARP: Lens =
        Lens { radius: [0.0, f32::MAX], near: [-1.0, 0.0], aperture: 0.0, focus: 1.0, crystals: false, streaks: false };
}
