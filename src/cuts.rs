//! What the 64 kB build leaves out.

/// Are the bench scenes there? What they alone ask for, the intro does without: in the rasterizer a background, light
/// without film, and lookups of depth maps in which each texel counts alike; pictures that stand for clouds.
pub const BENCH: bool = cfg!(feature = "full");
