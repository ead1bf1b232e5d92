//! What a light gives to points: Lambert's cosine, the fading of lamps, and shadows, looked up or traced.
//!
//! All lights are summed up in one pass over the visible points, each as far as it reaches, instead of one pass over the
//! scene per light. The formulas are checked in f64 by `tests/raster/lights.rs`, `tests/raster/shadow.rs` and
//! `tests/raster/torch.rs`.

use super::context::{ShadeContext, ShadowLookup};
use super::depth_map::MapPoints;
use super::exact_shadow::hides;
use super::light::{Light, Source};
use super::project::Projection;
use super::queue::Places;
use super::shadow_views::{Bias, ShadowViews};
use crate::cuts;
use crate::simd::block::{Block3, vectors};
use crate::simd::lanes::{Bits, F, Lane, M, V3, masked};
use crate::simd::math::to_f32;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec2, Vec3A, Vec4};

/// Texels along a map's border where it is not looked up: a coarser map has the same point farther inside.
const MARGIN: f32 = 2.0;

/// The tangent of the angle of incidence up to which bias by slope grows.
const STEEP: f32 = 4.0;

/// Share of the bias that is left where shadows are traced: enough for the snapping of corners and for rounding.
const TRACED_BIAS: f32 = 1.0 / 32.0;

/// Adds to `out` what a light gives to the first `count` places, without albedo.
#[simd]
#[inline(never)] // Called per light and for snow: one copy.
pub fn shine<S: Simd>(
    simd: S,
    context: &ShadeContext,
    (light, lookup): (&Light, &ShadowLookup),
    [points, lifted, normals]: &Places,
    count: usize,
    out: &mut Block3,
) {
    let mut i = 0;
    while i < vectors(count, F::<S>::LEN) {
        let (p, n) = (V3::load(simd, points, i), V3::load(simd, normals, i));
        let mut gives = light_at(simd, light, lookup, (p, V3::load(simd, lifted, i)), n);
        if let (Source::Sun(_), Some(clouds)) = (light.source, &context.world.cloud_shadow)
            && !cfg!(without = "cloud-shadows")
        {
            gives = gives * Lane(clouds.at(simd, p));
        }
        (V3::load(simd, out, i) + gives).store(out, i);
        i += 1;
    }
}

/// Light at points with unit normals, clouds aside.
#[inline(always)]
pub(super) fn light_at<S: Simd>(
    simd: S,
    light: &Light,
    lookup: &ShadowLookup,
    (point, lifted): (V3<S>, V3<S>),
    normal: V3<S>,
) -> V3<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let (towards, left) = match light.source {
        Source::Sun(direction) => (V3::splat(simd, direction), one),
        Source::Lamp { position, falloff, reach } => {
            let way = V3::splat(simd, position) - point;
            let distance = way.dot(way).sqrt();
            (way * Lane(one / distance), faded(simd, distance, falloff, reach))
        }
    };
    let cosine = normal.dot(towards).max(zero);
    let mut share = cosine * left;
    let wanted = share.simd_gt(zero);
    if let Some(views) = light.shadow_views()
        && wanted.any_true()
    {
        // A loop and no closure: one that is called twice is not inlined, and then no lane operation in it is.
        let lifted = if cuts::COUNTED_TEXELS && !views.smooth { point } else { lifted };
        let (places, mut open) = ([point, lifted], zero);
        let mut k = usize::from(!cuts::TRACED_SHADOWS || !views.traced);
        while k < 2 {
            let points = locate(simd, views, light.source, &Facet { point: places[k], normal, cosine }, wanted);
            let lit = unshadowed(simd, views, lookup, &points);
            open = if cuts::TRACED_SHADOWS { open.max(lit) } else { lit };
            k += 1;
        }
        share *= open;
    }
    V3::splat(simd, light.color) * Lane(share)
}

/// The share of a lamp's light that is left at a distance: see [`Source::Lamp`].
#[inline(always)]
fn faded<S: Simd>(simd: S, distance: F<S>, falloff: Vec2, reach: f32) -> F<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    // 1 over the loss at the end of the reach; 0 if the reach has no end, or the light does not fade towards it.
    let end = 1.0 / (falloff.x * reach + falloff.y * reach * reach);
    let end = if end.is_finite() { end } else { 0.0 };
    let loss = distance * falloff.x + distance * distance * falloff.y;
    // With f(d) = 1 / (1 + loss) this is (f(d) - f(reach)) / (1 - f(reach)).
    let left = one / (loss + 1.0) * (one - loss * end).max(zero);
    masked::<S>(left, distance.simd_le(reach))
}

/// A piece of surface as a light sees it.
pub(super) struct Facet<S: Simd> {
    pub point: V3<S>,
    /// Unit normal.
    pub normal: V3<S>,
    /// Cosine of the angle of incidence.
    pub cosine: F<S>,
}

/// Finds in which view of a light its shadow on a facet is looked up, where there, and at which depth.
///
/// ```text
/// for each view, until every lane has one
///     here   = lanes that are wanted, found no finer view, and look through this face of a cube
///     p      = point moved along the normal by the normal bias
///     x, y   = p projected
///     here  &= x and y lie within the margin         (a cube's faces have none)
///     depth  = depth of p, moved to the light by constant and slope bias
/// ```
///
/// Bias is in texels, which on a cube's faces grow with the depth. Where a sun grazes, more of it would open gaps behind
/// what stands on the ground. There the facet's plane says how deep each row of the window may be `[Isidoro06]`: see
/// [`MapPoints::slope`]. Lamps do without: docs/rejected.md has the figures.
#[inline(always)]
pub(super) fn locate<S: Simd>(
    simd: S,
    shadow: &ShadowViews,
    source: Source,
    facet: &Facet<S>,
    wanted: M<S>,
) -> MapPoints<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let Facet { point, normal, cosine } = *facet;
    let size = shadow.views[0].size[0] as f32;
    let bias = if cuts::BIAS { shadow.bias } else { Bias::SHOW };
    let bias = bias.times(if cuts::TRACED_SHADOWS && shadow.traced { TRACED_BIAS } else { 1.0 });
    let sine = (one - cosine * cosine).max(zero).sqrt();
    let upright = cosine.max(F::<S>::splat(simd, 1e-3));
    let tangent = (sine / upright).min(F::<S>::splat(simd, STEEP));
    let (mut view, mut x, mut y, mut inv_depth) = (zero, zero, zero, zero);
    let mut slope = zero;
    let mut inside = M::<S>::splat(simd, false);
    // For a sun: texels are of one size, there are no faces, and a border is left out. For a lamp: texels grow by the
    // depth, each point has its face, and there is no border.
    let (mut depth, mut face, mut margin) = (one, zero, MARGIN);
    // What bias leaves out of a sun's slope, over the cosine: 0 where it leaves out nothing.
    let grazing = if let Source::Lamp { position, .. } = source {
        (depth, face) = face_of(simd, point.sub1(position));
        margin = f32::NEG_INFINITY;
        zero
    } else {
        (one - upright * STEEP / sine).max(zero) / upright
    };
    let mut k = 0;
    while k < shadow.views.len() {
        let number = F::<S>::splat(simd, to_f32(k));
        let here = wanted & !inside & (if margin > 0.0 { zero } else { face - number }).simd_eq(zero);
        if here.any_true() {
            let Projection { rows, texel, .. } = &shadow.views[k];
            let p = match cuts::BIAS {
                true => point + normal * Lane(sine * (depth * (bias.normal * texel))),
                false => point,
            };
            let w = apply(rows[3], p);
            let inverse = one / w;
            let (px, py) = (apply(rows[0], p) * inverse, apply(rows[1], p) * inverse);
            let here = here & px.min(py).simd_ge(margin) & px.max(py).simd_le(size - margin);
            let bias = tangent * (depth * (bias.slope * texel)) + bias.constant;
            let z = match source {
                Source::Sun(_) => apply(rows[2], p) + bias,
                Source::Lamp { .. } => one / (w - bias).max(F::<S>::splat(simd, 1e-6)),
            };
            let fall = normal.dot1(Vec3A::from_vec4(rows[1]) * -(texel * texel)) * grazing;
            (x, y) = (here.select(px, x), here.select(py, y));
            slope = here.select(fall, slope);
            (inv_depth, view) = (here.select(z, inv_depth), here.select(number, view));
            inside |= here;
            if !(wanted & !inside).any_true() {
                break;
            }
        }
        k += 1;
    }
    MapPoints { view, x, y, inv_depth, slope, inside }
}

/// For directions from the middle of a cube the depth along the axis of the face that they pass, and the number of that
/// face.
#[inline(always)]
fn face_of<S: Simd>(simd: S, q: V3<S>) -> (F<S>, F<S>) {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let (ax, ay, az) = (q.x.abs(), q.y.abs(), q.z.abs());
    let depth = ax.max(ay).max(az);
    let (on_x, on_y) = (ax.simd_ge(depth), ay.simd_ge(depth));
    let axis = on_x.select(q.x, on_y.select(q.y, q.z));
    let pair = on_x.select(zero, on_y.select(F::<S>::splat(simd, 2.0), F::<S>::splat(simd, 4.0)));
    (depth, pair + axis.simd_gt(zero).select(zero, one))
}

/// The share of the light that is not in shadow. Beyond all views that is all of it.
#[inline(always)]
fn unshadowed<S: Simd>(simd: S, shadow: &ShadowViews, lookup: &ShadowLookup, points: &MapPoints<S>) -> F<S> {
    let one = F::<S>::splat(simd, 1.0);
    let lit = match lookup {
        None => one,
        Some(map) if !cuts::TRACED_SHADOWS || !shadow.traced => map.lit(simd, points, shadow.smooth),
        Some(map) => {
            let (zero, end) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, shadow.views[0].size[0] as f32 - 0.01));
            let (x, y) = (points.x.max(zero).min(end), points.y.max(zero).min(end));
            let mut lit = [0.0; 16];
            for lane in Bits(points.inside.to_bitmask()) {
                let of = |numbers: &F<S>| numbers.as_slice()[lane];
                let view = &map.views()[of(&points.view) as usize];
                lit[lane] = if hides(view, of(&x), of(&y), of(&points.inv_depth)) { 0.0 } else { 1.0 };
            }
            F::<S>::from_slice(simd, &lit[..F::<S>::LEN])
        }
    };
    points.inside.select(lit, one)
}

/// A row of a matrix times points.
#[inline(always)]
fn apply<S: Simd>(row: Vec4, p: V3<S>) -> F<S> {
    p.dot1(Vec3A::from_vec4(row)) + row.w
}
