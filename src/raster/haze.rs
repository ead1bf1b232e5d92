//! Haze in front of what is far, and the sky at the horizon that glossy surfaces mirror.

use crate::simd::lanes::{Lane, V3};
use crate::simd::math;
use fearless_simd::prelude::*;
use glam::Vec3A;

/// Air that hides what is far: light fades exponentially with the distance, into a colour that depends on the direction.
#[derive(Clone, Copy, Debug)]
pub struct Haze {
    /// Colour of the haze, linear light.
    pub color: Vec3A,
    /// Extinction per metre: `exp(-density d)` of the light is left after d metres.
    pub density: f32,
    /// A direction (unit), and light that is added to the colour around it, by the eighth power of the cosine.
    pub glow: (Vec3A, Vec3A),
    /// The direction of sun or moon projected to the horizon (unit), and the light of their image in a mirror there, by
    /// the 512th power of the cosine.
    pub image: (Vec3A, Vec3A),
}

impl Haze {
    /// Haze of one colour in all directions. A `density` of 0 is clear air.
    pub const fn even(color: Vec3A, density: f32) -> Haze {
        Haze { color, density, glow: (Vec3A::Y, Vec3A::ZERO), image: (Vec3A::Y, Vec3A::ZERO) }
    }

    /// The colour of the haze in a direction (unit).
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, d: V3<S>) -> V3<S> {
        V3::splat(simd, self.color) + V3::splat(simd, self.glow.1) * Lane(math::lobe(simd, d, self.glow.0, 3))
    }

    /// Light of the image of sun or moon in a direction (unit).
    #[inline(always)]
    pub fn image_at<S: Simd>(&self, simd: S, d: V3<S>) -> V3<S> {
        V3::splat(simd, self.image.1) * Lane(math::lobe(simd, d, self.image.0, 9))
    }
}

/// Clear air before a black sky.
impl Default for Haze {
    fn default() -> Haze {
        Haze::even(Vec3A::ZERO, 0.0)
    }
}
