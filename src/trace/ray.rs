//! Rays in packets of one per lane, and the nearest body that each of them meets.
//!
//! Every ray is tried against every body that [`super::bounds`] leaves. The scalar code that this must equal is
//! [`super::reference`].

use super::bounds::{Bounds, Extent, Shaft, Start, WORD};
use super::shape::{Ball, Shape};
use super::world::{Material, NOWHERE, World};
use crate::cuts;
use crate::simd::lanes::{Bits, F, M, U, V3};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3A;

/// One ray per lane, and the body whose surface it leaves.
#[derive(Clone, Copy)]
pub struct RayPacket<S: Simd> {
    /// Start, metres.
    pub origin: V3<S>,
    /// Unit direction.
    pub direction: V3<S>,
    /// Index of the body that the ray leaves, or [`NOWHERE`].
    pub from: U<S>,
    /// Whether the ray goes into that body.
    pub inward: M<S>,
}

/// What a search for the nearest body is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Search {
    /// The first surface along the ray.
    Nearest,
    /// The bodies that cast shadows between the ray's origin and `reach`, until all active lanes are dark. Instead of a
    /// distance the result has the light that they let through, in multiples of what there is without them, colours aside;
    /// these are what glass leaves of each.
    Shadow,
}

/// For every lane the nearest of the bodies whose bits are set in `list`, or [`NOWHERE`], and its distance but for a few
/// ulps. Of several at the same distance it is the first by bit.
///
/// Only surfaces at distances above 0 and below `reach` count, both ends excluded. A ray that only touches a round body
/// misses it. Lanes that are not `active`, and rays with a NaN, have unspecified results. If there is a shaft, all active
/// rays lie in it up to their `reach`.
#[simd]
#[allow(clippy::too_many_arguments)]
pub fn nearest<S: Simd>(
    simd: S,
    world: &World,
    bounds: &Bounds,
    list: &[u64],
    shaft: Option<&Shaft>,
    ray: &RayPacket<S>,
    active: M<S>,
    reach: F<S>,
    search: Search,
) -> (U<S>, F<S>, V3<S>) {
    if cuts::MANY_BODIES
        && let Some(shaft) = shaft
        && list.len() > MANY
        && scattered(simd, bounds, shaft, active)
    {
        return apart(simd, world, bounds, list, shaft, ray, active, reach, search);
    }
    let shadow = search == Search::Shadow;
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let (mut best, mut object) = (if shadow { one } else { reach }, U::<S>::splat(simd, NOWHERE));
    let mut tint = V3::splat(simd, Vec3A::ONE);
    let leaves = shaft.map_or(NOWHERE, |shaft| shaft.leaves);
    let rows = if cuts::MANY_BODIES { list.len().div_ceil(WORD) } else { 1 };
    let mut row = 0;
    'rows: while row < rows {
        for word in Bits(bounds.words(simd, shaft, row)) {
            let word = row * WORD + word;
            let mut bodies = list[word];
            if let Some(shaft) = shaft
                && bodies != 0
            {
                bodies &= bounds.bodies(simd, shaft, word);
            }
            for bit in Bits(bodies) {
                let index = bounds.index(word * WORD + bit) as u32;
                if index == leaves {
                    continue;
                }
                let body = &world.objects[index as usize];
                let (t0, t1, hit) = body.shape.span(simd, ray.origin, ray.direction, Ball::Rough);
                if !(hit & active).any_true() {
                    continue;
                }
                let id = U::<S>::splat(simd, index);
                let other = !ray.from.simd_eq(id);
                if shadow {
                    let meets = hit & other & t1.simd_gt(zero) & t0.simd_lt(reach);
                    let mut through = zero;
                    if let Shape::Sphere { radius, .. } = body.shape
                        && body.material.is_glass()
                    {
                        through = gathered::<S>(t0, t1, radius);
                        let passes = V3::splat(simd, passes(&body.material));
                        tint = V3::select(meets, tint.mulv(passes), tint);
                    }
                    best = meets.select(best * through, best);
                    if !(active & best.simd_gt(zero)).any_true() {
                        break 'rows;
                    }
                } else {
                    // Outwards the body that the ray leaves does not count; inwards only its far side does.
                    let t = (t0.simd_gt(zero) & other).select(t0, t1);
                    let meets = hit & t.simd_gt(zero) & t.simd_lt(best) & (other | ray.inward);
                    best = meets.select(t, best);
                    object = meets.select(id, object);
                }
            }
        }
        row += 1;
    }
    (object, best, tint)
}

/// The light that a ball of glass gathers behind it, for points whose lines to the light are inside the ball from `t0` to
/// `t1`: in multiples of the light without the ball, less what glass absorbs and mirrors.
///
/// With r the distance of such a line from the centre and z that of the point along it, both in radii, it is
/// `(1 + q) / (1 + q r^2)^2`, where `q = K / z^2`: light is gathered around the line through the centre, close by the more,
/// and over the shadow the mean is 1. Written without a division by z. docs/report/not-modelled.md holds it against photons.
#[inline(always)]
fn gathered<S: Simd>(t0: F<S>, t1: F<S>, radius: f32) -> F<S> {
    let (sum, chord) = (t0 + t1, t1 - t0);
    let square = sum * sum;
    let all = square + radius * radius * (4.0 * GATHERS);
    let spread = all - chord * chord * GATHERS;
    (all / spread) * (square / spread)
}

/// How much a ball of glass gathers light: K of [`gathered`], for an index of 1.5.
pub(super) const GATHERS: f32 = 128.0;

/// The share of each colour that gets through a ball of glass: what both surfaces let through of it, and what they do not
/// mirror, which for an index of 1.5 is 0.84 over the whole of the ball.
#[inline(always)]
pub(super) fn passes(material: &Material) -> Vec3A {
    material.filter * material.filter * 0.84375
}

/// Words of bodies beyond which the rays of a packet are taken one by one: they lead to all sides, as off balls that are
/// smaller than a pixel, so that together they come near everything.
const MANY: usize = 8;

/// Whether the rays of a packet are better taken one by one.
#[simd]
fn scattered<S: Simd>(simd: S, bounds: &Bounds, shaft: &Shaft, active: M<S>) -> bool {
    let mut words = 0;
    for row in 0..bounds.all.len().div_ceil(WORD) {
        words += bounds.words(simd, Some(shaft), row).count_ones() as usize;
    }
    // More words, dearer searches for single rays.
    words > MANY + bounds.all.len() / 16 && active.to_bitmask().count_ones() > 1
}

/// [`nearest`] for one ray after another, each with a shaft of its own.
#[simd]
#[allow(clippy::too_many_arguments)]
fn apart<S: Simd>(
    simd: S,
    world: &World,
    bounds: &Bounds,
    list: &[u64],
    shaft: &Shaft,
    ray: &RayPacket<S>,
    active: M<S>,
    reach: F<S>,
    search: Search,
) -> (U<S>, F<S>, V3<S>) {
    let (mut object, mut best) = (U::<S>::splat(simd, NOWHERE), reach);
    let mut tint = V3::splat(simd, Vec3A::ONE);
    for lane in Bits(active.to_bitmask()) {
        let one = M::<S>::from_bitmask(simd, 1 << lane);
        let start = Start { origins: Extent::new(simd, ray.origin, one), leaves: shaft.leaves };
        let alone = Shaft::new(simd, start, Extent::new(simd, ray.direction, one)).within(reach[lane]);
        let (found, t, left) = nearest(simd, world, bounds, list, Some(&alone), ray, one, reach, search);
        (object, best, tint) = (one.select(found, object), one.select(t, best), V3::select(one, left, tint));
    }
    (object, best, tint)
}
