//! Lights, and what they give to a point: all of them in one pass over the pixels that are seen, each as far as it reaches.

use super::Raster;
use super::project::Projection;
use super::shadow::{DepthMap, Plan};
use super::traced::hides;
use crate::lanes::{Bits, F, Lane, M, V3};
use fearless_simd::prelude::*;
use glam::{Mat4, Vec2, Vec3, Vec4};
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
    pub shadow: Option<Plan>,
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
    /// Light of the sun's image there, where a mirror shows it.
    pub image: Vec3,
}

impl Haze {
    /// Its light in a direction (unit), and that of the sun's image where a mirror shows it.
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, d: V3<S>) -> (V3<S>, V3<S>) {
        let mut powers = [d.dot1(self.glow.0).max(F::<S>::splat(simd, 0.0)); 2];
        for (power, squarings) in powers.iter_mut().zip([3, 9]) {
            for _ in 0..squarings {
                *power *= *power;
            }
        }
        let haze = V3::splat(simd, self.color) + V3::splat(simd, self.glow.1) * Lane(powers[0]);
        (haze, V3::splat(simd, self.image) * Lane(powers[1]))
    }
}

/// Texels along a map's border in which it is not looked up.
const MARGIN: f32 = 2.0;

/// What is left of a bias where shadows are traced: enough for the snapping of corners and for rounding.
const TRACED_BIAS: f32 = 1.0 / 32.0;

/// A light, ready to be looked up.
pub struct Lit {
    /// The light; a shadow without views is none.
    pub light: Light,
    /// What it sees, where that is mapped.
    pub map: Option<Arc<DepthMap>>,
    /// The first of its rasters, where it has any.
    pub first: usize,
    /// Each view's matrix by rows, and metres a texel where it is a parallel projection.
    views: Vec<(Mat4, f32)>,
    /// 1 / (x D + y D^2) of a lamp at the end of its reach; 0 if it has none, or does not fade towards there.
    end: f32,
}

impl Lit {
    /// A light whose rasters, if it gets any, begin with that one.
    pub fn new(mut light: Light, first: usize) -> Lit {
        light.shadow.take_if(|plan| plan.views.is_empty());
        let end = match light.source {
            Source::Lamp { falloff, reach, .. } => 1.0 / (falloff.x * reach + falloff.y * reach * reach),
            Source::Sun(_) => 0.0,
        };
        let end = if end.is_finite() { end } else { 0.0 };
        let view = |view: &Projection| {
            let rows = view.matrix.transpose();
            (rows, 1.0 / rows.x_axis.truncate().length())
        };
        let views = light.shadow.iter().flat_map(|plan| &plan.views).map(view).collect();
        Lit { light, map: None, first, views, end }
    }

    /// May it reach into a ball?
    pub fn reaches(&self, center: Vec3, radius: f32) -> bool {
        match self.light.source {
            Source::Sun(_) => true,
            Source::Lamp { position, reach, .. } => center.distance(position) <= reach + radius,
        }
    }

    /// Its light at points with unit normals, without albedo.
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, rasters: &[Raster], point: V3<S>, normal: V3<S>) -> V3<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let (towards, left) = match self.light.source {
            Source::Sun(direction) => (V3::splat(simd, direction), one),
            Source::Lamp { position, falloff, reach } => {
                let way = V3::splat(simd, position) - point;
                let distance = way.dot(way).sqrt();
                let loss = distance * falloff.x + distance * distance * falloff.y;
                // What is left at the end of the reach is taken off everywhere, and the rest made 1 at the lamp again.
                let left = one / (loss + 1.0) * (one - loss * self.end).max(zero);
                (way * Lane(one / distance), distance.simd_le(reach).select(left, zero))
            }
        };
        let cosine = normal.dot(towards).max(zero);
        let wanted = (cosine * left).simd_gt(zero);
        let mut light = cosine * left;
        if let Some(plan) = &self.light.shadow
            && wanted.any_true()
        {
            light *= self.seen(simd, plan, rasters, point, normal, cosine, wanted);
        }
        V3::splat(simd, self.light.color) * Lane(light)
    }

    /// The share of the light that is not in shadow.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn seen<S: Simd>(
        &self,
        simd: S,
        plan: &Plan,
        rasters: &[Raster],
        point: V3<S>,
        normal: V3<S>,
        cosine: F<S>,
        wanted: M<S>,
    ) -> F<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let size = plan.views[0].size[0] as f32;
        let bias = plan.bias.times(if plan.traced { TRACED_BIAS } else { 1.0 });
        let sine = (one - cosine * cosine).max(zero).sqrt();
        let tangent = (sine / cosine.max(F::<S>::splat(simd, 1e-3))).min(F::<S>::splat(simd, 4.0));
        let (mut view, mut x, mut y, mut near) = (zero, zero, zero, zero);
        let mut inside = M::<S>::splat(simd, false);
        let mut k = 0;
        match self.light.source {
            Source::Sun(_) => {
                // The finest map that the texels around are in.
                while k < self.views.len() {
                    let (rows, texel) = self.views[k];
                    let p = point + normal * Lane(sine * (bias.normal * texel));
                    let (px, py, z) = (apply(rows.x_axis, p), apply(rows.y_axis, p), apply(rows.z_axis, p));
                    let (low, high) = (px.min(py), px.max(py));
                    let here = low.simd_ge(MARGIN) & high.simd_le(size - MARGIN) & !inside;
                    let bias = tangent * (bias.slope * texel) + bias.constant;
                    (x, y) = (here.select(px, x), here.select(py, y));
                    near = here.select(z + bias, near);
                    view = here.select(F::<S>::splat(simd, k as u32 as f32), view);
                    inside |= here;
                    k += 1;
                }
            }
            Source::Lamp { position, .. } => {
                let q = point.sub1(position);
                let (ax, ay, az) = (q.x.abs(), q.y.abs(), q.z.abs());
                let depth = ax.max(ay).max(az);
                let (on_x, on_y) = (ax.simd_ge(depth), ay.simd_ge(depth));
                let axis = on_x.select(q.x, on_y.select(q.y, q.z));
                let pair = on_x.select(zero, on_y.select(F::<S>::splat(simd, 2.0), F::<S>::splat(simd, 4.0)));
                view = pair + axis.simd_gt(zero).select(zero, one);
                // Texels are wider where the face is farther.
                let texel = depth * (2.0 / size);
                let p = point + normal * Lane(sine * texel * bias.normal);
                while k < self.views.len() {
                    let here = view.simd_eq(k as u32 as f32);
                    if (here & wanted).any_true() {
                        let (rows, _) = self.views[k];
                        let w = apply(rows.w_axis, p);
                        let inverse = one / w;
                        x = here.select(apply(rows.x_axis, p) * inverse, x);
                        y = here.select(apply(rows.y_axis, p) * inverse, y);
                        let bias = tangent * texel * bias.slope + bias.constant;
                        near = here.select(one / (w - bias).max(F::<S>::splat(simd, 1e-6)), near);
                    }
                    k += 1;
                }
                inside = M::<S>::splat(simd, true);
            }
        }
        let wanted = wanted & inside;
        let seen = match &self.map {
            Some(map) => map.light(simd, view, x, y, near, plan.smooth, wanted),
            None => {
                let end = F::<S>::splat(simd, size - 0.01);
                let mut numbers = [[0.0; 16]; 4];
                let lanes = F::<S>::LEN;
                for (row, of) in numbers.iter_mut().zip([view, x.max(zero).min(end), y.max(zero).min(end), near]) {
                    of.store_slice(&mut row[..lanes]);
                }
                let mut seen = [0.0; 16];
                for lane in Bits(wanted.to_bitmask()) {
                    let [view, x, y, near] = [0, 1, 2, 3].map(|row: usize| numbers[row][lane]);
                    seen[lane] = if hides(&rasters[self.first + view as usize], x, y, near) { 0.0 } else { 1.0 };
                }
                F::<S>::from_slice(simd, &seen[..lanes])
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
