//! Rays through the voxels of one cloud, a vector of rays at a time.
//!
//! This is the second pass of `[Kajiya84]`. The way of a ray through the cube is cut into equal steps, about as long for
//! every ray, and the density in the middle of a step stands for all of it. By the law of Beer and Lambert a step of
//! length s hides the share `1 - exp(-extinction density s)` of what is behind it, and shows as much of its own light. The
//! error falls with the square of the step. The reference is the same march in `f64` (`tools/testkit/src/voxels.rs`), and
//! in the limit of many steps the transmittance of clouds that have one in closed form.

use super::grain::grain;
use super::voxels::Voxels;
use super::world::{Cloud, CloudLight};
use crate::simd::lanes::{F, Lane, U, V3, float, masked};
use crate::simd::math::{opacity, to_f32};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{DVec3, Vec3A};
use std::f32::consts::LOG2_E;

/// How much detail below a voxel adds to the light, of what it adds to the density.
const SHADE: f32 = 0.68;

/// What rays meet in a cloud, without the colours of its light.
pub struct Passage<S: Simd> {
    /// The share of what is behind the cloud that it hides, good to 1e-5 of itself however small it is.
    pub hidden: F<S>,
    /// The part of `hidden` that is lit by the light from above, which grows linearly with the height in the cube.
    pub upper: F<S>,
    /// The part of `hidden` that is lit by the sun, of 255.
    pub lit: F<S>,
    /// The share of what is behind the cloud that comes through: 1 less `hidden`.
    pub transmittance: F<S>,
    /// Distance from the eye at which the ray ended as too little came through, metres; infinite where none did.
    pub end: F<S>,
}

impl<S: Simd> Passage<S> {
    /// The light that reaches the eye along unit directions `d`, premultiplied; and the transmittance.
    #[inline(always)]
    pub fn shine(self, simd: S, light: &CloudLight, d: V3<S>) -> (V3<S>, F<S>) {
        let [low, high] = light.ambient;
        let c = d.dot1(light.towards).max(0.0);
        let c2 = c * c;
        let phase = c2 * c2 * c2 * light.phase[1] + light.phase[0];
        let color = V3::splat(simd, low) * Lane(self.hidden)
            + V3::splat(simd, high - low) * Lane(self.upper)
            + V3::splat(simd, light.sun * (1.0 / 255.0)) * Lane(self.lit * phase);
        (color, self.transmittance)
    }
}

/// What rays from `eye` along unit directions `d` meet of a cloud, up to `limit` metres from the eye.
///
/// The way through the cube is cut into equal steps, whose length is the nearest to the cube's edge over `steps`. A ray
/// ends where its transmittance falls below `opaque`, or less by up to 6 %. Detail below a voxel is that of the table
/// `fine`, if there is one; there is none where less than 16 times `opaque` comes through. Above an `opaque` of 1 the end of a
/// ray that meets nothing says nothing.
///
/// Directions have to have the length 1: they are not normalised, and the depth is in proportion to it. The cube is
/// closed: a ray along an axis that runs within a face is in the cloud. `limit` may be infinite; where it is 0 or less
/// nothing is met. `steps` is at least 1. What a NaN gives is unspecified.
///
/// ```text
/// start at the point that is closest to the centre, so that far clouds lose no digits
/// entry, exit = the ray against the three slabs of the cube, ended by eye and limit
/// for each step in the box around all that is in the voxels, as long as a lane of the vector has one left:
///     u = the middle of the step, in voxels
///     was the last step's density 0 in every lane, and may nothing be at u in any either?
///         step over as many steps as the empty space around u is wide
///     else
///         depth += density(u) * extinction * length            for lanes that are not through
///         hidden = 1 - exp(-depth)                              and as much as it grows is lit
/// ```
///
/// Lanes are independent: a lane that is through adds an optical depth of 0 as long as others go on, so a ray has the
/// same bits in any company.
#[simd]
pub fn march<S: Simd>(
    simd: S,
    (cloud, fine): (&Cloud, Option<&Voxels>),
    eye: Vec3A,
    d: V3<S>,
    limit: F<S>,
    steps: f32,
    opaque: F<S>,
) -> Passage<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let (q, way) = closest((eye.as_dvec3() - cloud.centre.as_dvec3()) / cloud.size as f64, d);
    let clip = |(entry, exit): (F<S>, F<S>)| (entry.max(-way), exit.min(limit * (1.0 / cloud.size) - way));
    let (first, beyond) = clip(within(simd, q, d, cloud.voxels.bounds()));
    let never = F::<S>::splat(simd, f32::INFINITY);
    if !first.simd_lt(beyond).any_true() {
        return Passage { hidden: zero, upper: zero, lit: zero, transmittance: one, end: never };
    }
    let (entry, exit) = clip(within(simd, q, d, CUBE));
    let (mut hidden, mut height, mut lit) = (zero, zero, zero);
    let steps = steps_along::<S>(exit - entry, steps);
    let length = (exit - entry) / steps;
    let missed = length.simd_le(zero);
    let (entry, unit) = (missed.select(zero, entry), missed.select(one, length));
    let length = missed.select(zero, length);
    let most = to_f32(cloud.voxels.edge() - 1);
    let half = to_f32(cloud.voxels.edge()) * 0.5;
    // In voxels, the middle of the first step and what each adds to it: two operations a step, which wait for the last one.
    let (first_middle, each) = (d * Lane((entry + length * 0.5) * half), d * Lane(length * half));
    let voxel = |q: F<S>, middle: F<S>| q * half + middle + (half - 0.5);
    let start = V3::<S> { x: voxel(q.x, first_middle.x), y: voxel(q.y, first_middle.y), z: voxel(q.z, first_middle.z) };
    // Voxels that one step crosses at most, along any axis, and so the steps per voxel: a little less, lest rounding
    // brings a leap into what it ends before.
    let stride = each.x.abs().max(each.y.abs()).max(each.z.abs());
    let reach = F::<S>::splat(simd, 0.9999) / missed.select(one, stride);
    // Depths are binary logarithms of transmittances: from 0 down. They are compared, and not the transmittances, which take
    // longer to be known.
    let thickness = length * (-cloud.extinction * LOG2_E / Voxels::FULL);
    let mut depth = zero;
    let least = below_log2::<S>(opaque);
    // From the step in which the ray enters the box, up to the one in which it leaves it. What ends a lane is kept apart from
    // its step, so that the next place does not wait for this one's light.
    let number = |place: F<S>| (place - entry) / unit;
    let mut step = number(first).floor().max(zero);
    let mut last = missed.select(zero, number(beyond).min(steps));
    let mut in_cloud = false;
    loop {
        let goes = step.simd_lt(last);
        if !goes.any_true() {
            break;
        }
        let p = start + each * Lane(step);
        let inside = |p: F<S>| p.max(0.0).min(most);
        let u = V3 { x: inside(p.x), y: inside(p.y), z: inside(p.z) };
        if !in_cloud {
            let leap = cloud.voxels.leap(simd, u);
            if !(goes & leap.simd_eq(0)).any_true() {
                step += (float(simd, leap.max(1) - 1) * reach).floor() + 1.0;
                continue;
            }
        }
        let [mut density, mut sunlit] = cloud.voxels.look_up(simd, u);
        in_cloud = (goes & density.simd_gt(zero)).any_true();
        if let Some(fine) = fine {
            // Neither emptiness nor a cloud's inside has any.
            let share = density * (density * (-1.0 / Voxels::FULL) + 1.0);
            let share = masked::<S>(share, depth.simd_ge(least + 4.0));
            if (goes & share.simd_gt(zero)).any_true() {
                let grain = grain(simd, fine, u) * share;
                density = (density + grain).max(zero).min(Voxels::FULL);
                sunlit += sunlit * grain * (SHADE / Voxels::FULL);
            }
        }
        // From the depth so far, and not as what is missing from 1: of a thin cloud that would be rounding alone. Of `goes`
        // compilers would keep a bit a lane, and take longer to make lanes of these again.
        let goes = (last - step).simd_gt(zero);
        depth += masked::<S>(density * thickness, goes);
        let [kept, _] = opacity(simd, depth);
        let hides = kept - hidden;
        hidden = kept;
        height += hides * p.y;
        lit += hides * sunlit;
        // The step in which the ray ends is its last one.
        last = (goes & depth.simd_lt(least)).select(step, last);
        step += one;
    }
    // The middle of the lowest voxels is half a voxel above the cube's bottom.
    let upper = (height + hidden * 0.5) * (0.5 / half);
    let end = depth.simd_lt(least).select((way + entry + (last + 1.0) * unit) * cloud.size, never);
    Passage { hidden, upper, lit: lit * (255.0 / Voxels::FULL), transmittance: -hidden + 1.0, end }
}

/// The binary logarithm of a number, less at most 0.09: its exponent, and its mantissa as it is. Of a power of two it is
/// exact, of 0 it is -127.
#[inline(always)]
pub(super) fn below_log2<S: Simd>(x: F<S>) -> F<S> {
    (x.bitcast::<S::i32s>() - 1.0f32.to_bits() as i32).to_float::<F<S>>() * (1.0 / (1 << 23) as f32)
}

/// The steps that ways through a cube are cut into, halves of its edge long, where `steps` are cut along an edge.
#[inline(always)]
pub(super) fn steps_along<S: Simd>(way: F<S>, steps: f32) -> F<S> {
    (way * (steps * 0.5) + 0.5).floor().max(1.0)
}

/// The points where rays from `q` along unit directions `d` come closest to the centre of the cube, and how far away.
///
/// From there on numbers are small, however far the eye is. As far as that point it takes two goes: in the first the
/// distance and the directions have 12 bits at a time, whose products are exact.
#[inline(always)]
pub(super) fn closest<S: Simd>(q: DVec3, d: V3<S>) -> (V3<S>, F<S>) {
    let short = |x: F<S>| (x.bitcast::<U<S>>() & !0xfff).bitcast::<F<S>>();
    let eye = q.as_vec3a();
    let rest = (q - eye.as_dvec3()).as_vec3a();
    let way = short(-d.dot1(eye));
    let go = |eye: f32, rest: f32, d: F<S>| {
        let first = short(d);
        (first * way + eye) + (d - first) * way + rest
    };
    let near = V3::<S> { x: go(eye.x, rest.x, d.x), y: go(eye.y, rest.y, d.y), z: go(eye.z, rest.z, d.z) };
    let more = -d.dot(near);
    (near + d * Lane(more), way + more)
}

/// The cube that a cloud is in: least and largest coordinates.
pub(super) const CUBE: [Vec3A; 2] = [Vec3A::NEG_ONE, Vec3A::ONE];

/// Where rays from `q` along `d` enter and leave a box.
#[inline(always)]
pub(super) fn within<S: Simd>(simd: S, q: V3<S>, d: V3<S>, [low, high]: [Vec3A; 2]) -> (F<S>, F<S>) {
    let [x0, x1] = slab(simd, q.x, d.x, low.x, high.x);
    let [y0, y1] = slab(simd, q.y, d.y, low.y, high.y);
    let [z0, z1] = slab(simd, q.z, d.z, low.z, high.z);
    (x0.max(y0).max(z0), x1.min(y1).min(z1))
}

/// Where rays enter and leave the space between two numbers along an axis.
#[inline(always)]
fn slab<S: Simd>(simd: S, q: F<S>, d: F<S>, low: f32, high: f32) -> [F<S>; 2] {
    let inverse = F::<S>::splat(simd, 1.0) / d;
    let (a, b) = (inverse * (-q + low), inverse * (-q + high));
    // A ray along the slab is in it or is not; on the very face it would be 0 / 0, or 0 times infinity.
    let along = d.abs().simd_lt(1e-20);
    let never = F::<S>::splat(simd, f32::INFINITY);
    let entry = (q.simd_lt(low) | q.simd_gt(high)).select(never, -never);
    [along.select(entry, a.min(b)), along.select(never, a.max(b))]
}
