//! Lights, and what they give to a point: all of them in one pass over the pixels that are seen, each as far as it reaches.

use super::Raster;
use super::exact_shadow::hides;
use super::project::Projection;
use super::shadow::{DepthMap, ShadowViews};
use crate::cuts::BENCH;
use crate::simd::lanes::{Bits, F, Lane, M, V3};
use fearless_simd::prelude::*;
use glam::{Vec2, Vec3, Vec4};
use std::sync::Arc;

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// From that direction (unit), everywhere alike.
    Sun(Vec3),
    /// From a point. At a distance of D metres `1 / (1 + x D + y D^2)` is left, where `falloff` is (x, y).
    Lamp {
        /// Where it is, metres.
        position: Vec3,
        /// How fast its light fades.
        falloff: Vec2,
        /// Metres beyond which there is nothing left of it; infinite for no end. It fades out evenly towards there, if it
        /// fades at all.
        reach: f32,
    },
}

/// A light.
#[derive(Clone, Debug)]
pub struct Light {
    /// Where it comes from.
    pub source: Source,
    /// Light on a surface that faces it, linear.
    pub color: Vec3,
    /// What it sees, if it casts shadows.
    pub shadow: Option<ShadowViews>,
}

/// The haze before what is far.
#[derive(Clone, Copy, Debug)]
pub struct Haze {
    /// Its light, linear.
    pub color: Vec3,
    /// Share that it takes a metre.
    pub density: f32,
    /// A direction (unit) in which it shines by that much more, with the eighth power of the cosine.
    pub glow: (Vec3, Vec3),
    /// The direction of sun or moon, level, and the light of their image there, where a mirror shows it.
    pub image: (Vec3, Vec3),
}

impl Haze {
    /// The same in all directions.
    pub const fn even(color: Vec3, density: f32) -> Haze {
        Haze { color, density, glow: (Vec3::Y, Vec3::ZERO), image: (Vec3::Y, Vec3::ZERO) }
    }

    /// Its light in a direction (unit).
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, d: V3<S>) -> V3<S> {
        V3::splat(simd, self.color) + lobe(simd, d, self.glow, 3)
    }

    /// Light of the image of sun or moon in a direction (unit).
    #[inline(always)]
    pub fn image_at<S: Simd>(&self, simd: S, d: V3<S>) -> V3<S> {
        lobe(simd, d, self.image, 9)
    }
}

/// Light around a direction, with the power of two of the cosine that so many squarings give.
#[inline(always)]
fn lobe<S: Simd>(simd: S, d: V3<S>, (towards, light): (Vec3, Vec3), squarings: u32) -> V3<S> {
    let mut power = d.dot1(towards).max(F::<S>::splat(simd, 0.0));
    for _ in 0..squarings {
        power *= power;
    }
    V3::splat(simd, light) * Lane(power)
}

/// Texels along a map's border in which it is not looked up.
const MARGIN: f32 = 2.0;

/// What is left of a bias where shadows are traced: enough for the snapping of corners and for rounding.
const TRACED_BIAS: f32 = 1.0 / 32.0;

/// What a light sees.
pub struct ShadowLookup {
    /// Where that is mapped.
    pub map: Option<Arc<DepthMap>>,
    /// The first of its rasters, where it has any.
    pub first: usize,
}

impl Light {
    /// What it is to see, if it casts shadows.
    pub fn plan(&self) -> Option<&ShadowViews> {
        self.shadow.as_ref().filter(|plan| !plan.views.is_empty())
    }

    /// May it reach into a ball?
    pub fn reaches(&self, center: Vec3, radius: f32) -> bool {
        match self.source {
            Source::Sun(_) => true,
            Source::Lamp { position, reach, .. } => center.distance(position) <= reach + radius,
        }
    }

    /// May it reach what a raster shows? With a little to spare, lest a rounded point asks for a map that was left out.
    pub fn counts(&self, raster: &Projection) -> bool {
        match self.source {
            Source::Sun(_) => true,
            Source::Lamp { position, reach, .. } => !raster.misses(position, 1.01 * reach),
        }
    }

    /// May it reach into one of the boxes between `low` and `high`?
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

    /// Its light at points with unit normals, without albedo.
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, sight: &ShadowLookup, rasters: &[Raster], point: V3<S>, normal: V3<S>) -> V3<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let (towards, left) = match self.source {
            Source::Sun(direction) => (V3::splat(simd, direction), one),
            Source::Lamp { position, falloff, reach } => {
                // 1 over the loss at the end of the reach; 0 if it has none, or does not fade towards there.
                let end = 1.0 / (falloff.x * reach + falloff.y * reach * reach);
                let end = if end.is_finite() { end } else { 0.0 };
                let way = V3::splat(simd, position) - point;
                let distance = way.dot(way).sqrt();
                let loss = distance * falloff.x + distance * distance * falloff.y;
                // What is left at the end of the reach is taken off everywhere, and the rest made 1 at the lamp again.
                let left = one / (loss + 1.0) * (one - loss * end).max(zero);
                (way * Lane(one / distance), distance.simd_le(reach).select(left, zero))
            }
        };
        let cosine = normal.dot(towards).max(zero);
        let mut light = cosine * left;
        let wanted = light.simd_gt(zero);
        if let Some(plan) = self.plan()
            && wanted.any_true()
        {
            light *= self.seen(simd, plan, sight, rasters, point, normal, cosine, wanted);
        }
        V3::splat(simd, self.color) * Lane(light)
    }

    /// The share of the light that is not in shadow.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn seen<S: Simd>(
        &self,
        simd: S,
        plan: &ShadowViews,
        sight: &ShadowLookup,
        rasters: &[Raster],
        point: V3<S>,
        normal: V3<S>,
        cosine: F<S>,
        wanted: M<S>,
    ) -> F<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let size = plan.views[0].size[0] as f32;
        let bias = plan.bias.times(if BENCH && plan.traced { TRACED_BIAS } else { 1.0 });
        let sine = (one - cosine * cosine).max(zero).sqrt();
        let tangent = (sine / cosine.max(F::<S>::splat(simd, 1e-3))).min(F::<S>::splat(simd, 4.0));
        let (mut view, mut x, mut y, mut near) = (zero, zero, zero, zero);
        let mut inside = M::<S>::splat(simd, false);
        // The depth by which texels grow, the face of a cube that a point is seen through, and the border of a map that
        // no point lies in.
        let (mut depth, mut face, mut margin) = (one, zero, MARGIN);
        if let Source::Lamp { position, .. } = self.source {
            let q = point.sub1(position);
            let (ax, ay, az) = (q.x.abs(), q.y.abs(), q.z.abs());
            depth = ax.max(ay).max(az);
            let (on_x, on_y) = (ax.simd_ge(depth), ay.simd_ge(depth));
            let axis = on_x.select(q.x, on_y.select(q.y, q.z));
            let pair = on_x.select(zero, on_y.select(F::<S>::splat(simd, 2.0), F::<S>::splat(simd, 4.0)));
            face = pair + axis.simd_gt(zero).select(zero, one);
            margin = f32::NEG_INFINITY;
        }
        let mut k = 0;
        while k < plan.views.len() {
            let number = F::<S>::splat(simd, k as u32 as f32);
            // The finest of several maps that the texels around are in.
            let here = wanted & !inside & (if margin > 0.0 { zero } else { face - number }).simd_eq(zero);
            if here.any_true() {
                let Projection { rows, texel, .. } = &plan.views[k];
                let p = point + normal * Lane(sine * (depth * (bias.normal * texel)));
                let w = apply(rows[3], p);
                let inverse = one / w;
                let (px, py) = (apply(rows[0], p) * inverse, apply(rows[1], p) * inverse);
                let here = here & px.min(py).simd_ge(margin) & px.max(py).simd_le(size - margin);
                let bias = tangent * (depth * (bias.slope * texel)) + bias.constant;
                let z = match self.source {
                    Source::Sun(_) => apply(rows[2], p) + bias,
                    Source::Lamp { .. } => one / (w - bias).max(F::<S>::splat(simd, 1e-6)),
                };
                (x, y) = (here.select(px, x), here.select(py, y));
                (near, view) = (here.select(z, near), here.select(number, view));
                inside |= here;
            }
            k += 1;
        }
        let seen = match &sight.map {
            Some(map) => map.light(simd, view, x, y, near, plan.smooth, inside),
            None if !BENCH => one,
            None => {
                let end = F::<S>::splat(simd, size - 0.01);
                let (x, y) = (x.max(zero).min(end), y.max(zero).min(end));
                let mut seen = [0.0; 16];
                for lane in Bits(inside.to_bitmask()) {
                    let of = |numbers: &F<S>| numbers.as_slice()[lane];
                    let raster = &rasters[sight.first + of(&view) as usize];
                    seen[lane] = if hides(raster, of(&x), of(&y), of(&near)) { 0.0 } else { 1.0 };
                }
                F::<S>::from_slice(simd, &seen[..F::<S>::LEN])
            }
        };
        inside.select(seen, one)
    }
}

/// A row of a matrix times a point.
#[inline(always)]
fn apply<S: Simd>(row: Vec4, p: V3<S>) -> F<S> {
    p.dot1(row.truncate()) + row.w
}
