//! What the rendering of one tile reads.

use super::guard::Guard;
use super::packet::TraceContext;
use crate::settings::TraceSettings;
use crate::texture::Variation;

/// What the rendering of one tile reads.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// What packets of rays read.
    pub context: TraceContext<'a>,
    /// How the texture of every object changes.
    pub variation: &'a [Variation],
    /// Squares that must be cut.
    pub guard: &'a Guard,
    /// Speed against error.
    pub settings: &'a TraceSettings,
}

impl Job<'_> {
    /// Lattice steps per pixel.
    #[inline(always)]
    pub fn unit(&self) -> usize {
        1 + self.settings.antialias as usize
    }

    /// The whole pixels in a number of lattice steps.
    #[inline(always)]
    pub fn pixels(&self, steps: usize) -> usize {
        steps >> self.settings.antialias as u32
    }
}
