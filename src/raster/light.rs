//! Lights: suns and lamps, and how far they reach.

use super::project::Projection;
use super::shadow_views::ShadowViews;
use crate::simd::lanes::{F, V3};
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3A};

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// From a direction (unit), the same everywhere.
    Sun(Vec3A),
    /// From a point.
    Lamp {
        /// Place of the lamp, metres.
        position: Vec3A,
        /// How its light fades: `1 / (1 + x d + y d^2)` of it is left after d metres, where `falloff` is (x, y).
        falloff: Vec2,
        /// Distance beyond which nothing is left, metres; infinite for no end. Light that fades at all reaches 0 there
        /// continuously: what the formula leaves at the reach is subtracted everywhere, and the rest is scaled so that
        /// nothing is lost at the lamp.
        reach: f32,
    },
}

/// A light.
#[derive(Clone, Debug)]
pub struct Light {
    /// Where it comes from.
    pub source: Source,
    /// Light that a white surface facing it sends back before any fading, linear.
    pub color: Vec3A,
    /// The views for its shadows, if it casts any.
    pub shadow: Option<ShadowViews>,
}

impl Light {
    /// A sun in the direction `towards` (unit), without shadows. It is not normalised: a longer one is a brighter sun.
    #[inline(always)]
    pub fn sun(towards: Vec3A, color: Vec3A) -> Light {
        Light { source: Source::Sun(towards), color, shadow: None }
    }

    /// A lamp at `position` that fades as [`Source::Lamp`] says, without shadows. `falloff` of (0, 1) and an infinite
    /// `reach` are near to the inverse square law. What lies at the very place of the lamp gets no light.
    #[inline(always)]
    pub fn lamp(position: Vec3A, color: Vec3A, falloff: Vec2, reach: f32) -> Light {
        Light { source: Source::Lamp { position, falloff, reach }, color, shadow: None }
    }

    /// The same light with shadows.
    #[inline(always)]
    pub fn with_shadow(self, shadow: ShadowViews) -> Light {
        Light { shadow: Some(shadow), ..self }
    }

    /// The views for its shadows; `None` also where there are none in the list.
    pub fn shadow_views(&self) -> Option<&ShadowViews> {
        self.shadow.as_ref().filter(|shadow| !shadow.views.is_empty())
    }

    /// Whether it may reach into a sphere.
    pub fn reaches(&self, center: Vec3A, radius: f32) -> bool {
        match self.source {
            Source::Sun(_) => true,
            Source::Lamp { position, reach, .. } => center.distance(position) <= reach + radius,
        }
    }

    /// Whether it may reach what a raster shows. A hundredth of the reach is allowed for, lest a rounded point needs a
    /// map that was left out.
    pub fn counts(&self, raster: &Projection) -> bool {
        match self.source {
            Source::Sun(_) => true,
            Source::Lamp { position, reach, .. } => !raster.misses(position, 1.01 * reach),
        }
    }

    /// Whether it may reach into one of the boxes between corresponding lanes of `low` and `high`.
    #[inline(always)]
    pub fn meets<S: Simd>(&self, simd: S, low: V3<S>, high: V3<S>) -> bool {
        match self.source {
            Source::Sun(_) => true,
            Source::Lamp { position, reach, .. } => {
                let (below, above) = (V3::splat(simd, position) - high, low.sub1(position));
                let zero = F::<S>::splat(simd, 0.0);
                let (x, y, z) =
                    (below.x.max(above.x).max(zero), below.y.max(above.y).max(zero), below.z.max(above.z).max(zero));
                (x * x + y * y + z * z).sqrt().simd_le(reach).any_true()
            }
        }
    }
}
