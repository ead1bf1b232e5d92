//! The particles of a vector, one per lane.

use crate::simd::lanes::{F, V3};
use fearless_simd::prelude::*;

/// As many particles as a vector has lanes.
pub struct Batch<S: Simd> {
    /// Place from the emitter's origin, metres. That is the eye for flakes and writing, and the world's origin for
    /// fires.
    pub at: V3<S>,
    /// Radius, metres.
    pub radius: F<S>,
    /// Linear light that is added where the sprite's weight is 1.
    pub light: V3<S>,
    /// Share of the light behind that is taken where the sprite's weight is 1.
    pub alpha: F<S>,
    /// Cosine and sine of the turn on the screen, and the width over the length of what is seen of a tumbling flake.
    pub turn: [F<S>; 3],
    /// Half of the way that it moves while the shutter is open, metres.
    pub streak: V3<S>,
}
