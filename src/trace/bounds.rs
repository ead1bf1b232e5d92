//! Which bodies a packet of rays may meet: boxes around bodies, many per vector, against the shaft of the packet.
//!
//! A test of a packet against a body is dear, above all against a block, and most packets come near few bodies. So the
//! packet's rays are taken together, as in shaft culling `[Haines94]`: all origins lie in one box, all directions in
//! another, so that at a distance t along the rays all points lie in `origins + t directions`, by interval arithmetic
//! `[Boulos06]`. Along each axis that box overlaps the box of a body from some distance on, up to some distance; both are
//! linear in the body's sides, so that a vector of bodies takes six multiplications. What is left is one bit per body.
//!
//! No body that a ray meets is ever left out: boxes and directions are taken a little larger than they are
//! ([`SLACK`]), so that roundings in [`Shape::span`](super::shape::Shape::span) do not matter. So culling changes what a
//! frame costs, and none of its bytes.

use super::ray::NOWHERE;
use super::shape::{FAR, Shape};
use super::world::World;
use crate::simd::block::{BLOCK, Block3, load};
use crate::simd::lanes::{F, M, V3};
use fearless_simd::prelude::*;
use glam::Vec3;

/// By how much boxes (as a share of their size and their distance from the origin) and directions are taken larger than
/// they are. Roundings are a hundredth of it.
const SLACK: f32 = 1e-5;

/// Bodies of a word.
pub const WORD: usize = BLOCK;

/// Boxes around as many bodies as a word has bits: least and largest coordinates.
struct Boxes {
    low: Block3,
    high: Block3,
}

/// Boxes around the bodies of a world.
pub struct Bounds {
    boxes: Vec<Boxes>,
    /// A bit for every body, 64 to a word.
    pub all: Vec<u64>,
    /// The bits of bodies that cast shadows.
    pub casters: Vec<u64>,
}

impl Bounds {
    /// The boxes around the bodies of a world.
    pub fn new(world: &World) -> Bounds {
        let mut bounds = Bounds { boxes: Vec::new(), all: Vec::new(), casters: Vec::new() };
        for bodies in world.objects.chunks(WORD) {
            let mut boxes = Boxes { low: [[0.0; BLOCK]; 3], high: [[0.0; BLOCK]; 3] };
            let mut casters = 0;
            for (bit, body) in bodies.iter().enumerate() {
                let (low, high) = around(&body.shape);
                for axis in 0..3 {
                    boxes.low[axis][bit] = low[axis];
                    boxes.high[axis][bit] = high[axis];
                }
                casters |= (body.casts_shadow as u64) << bit;
            }
            bounds.boxes.push(boxes);
            bounds.all.push(u64::MAX >> (WORD - bodies.len()));
            bounds.casters.push(casters);
        }
        bounds
    }
}

/// The box around a body, a little larger: least and largest coordinates. It has no end where the body has none.
fn around(shape: &Shape) -> (Vec3, Vec3) {
    let (center, half) = match *shape {
        Shape::Sphere { center, radius } => (center, Vec3::splat(radius)),
        Shape::Block { center, half, turn } => {
            let turn = turn.transpose();
            let reach = |axis: usize| turn.row(axis).abs().dot(half);
            (center, Vec3::new(reach(0), reach(1), reach(2)))
        }
        Shape::Cylinder { center, axis, half, radius } => {
            let across = (Vec3::ONE - axis * axis).max(Vec3::ZERO);
            (center, axis.abs() * half + Vec3::new(across.x.sqrt(), across.y.sqrt(), across.z.sqrt()) * radius)
        }
        // A level plane ends at its own height.
        Shape::Plane { normal, offset } => {
            let mut high = Vec3::INFINITY;
            if normal == Vec3::Y {
                high.y = offset + offset.abs() * SLACK;
            }
            return (Vec3::NEG_INFINITY, high);
        }
        #[cfg(feature = "full")]
        Shape::Globe { .. } => return (Vec3::NEG_INFINITY, Vec3::INFINITY),
    };
    let half = half + (half.max_element() + center.abs().max_element()) * SLACK;
    (center - half, center + half)
}

/// A box: least and largest coordinates.
#[derive(Clone, Copy)]
pub struct Extent {
    low: Vec3,
    high: Vec3,
}

impl Extent {
    /// A point.
    pub const fn point(at: Vec3) -> Extent {
        Extent { low: at, high: at }
    }

    /// The box around the `active` lanes.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S, v: V3<S>, active: M<S>) -> Extent {
        let (least, most) = (F::<S>::splat(simd, f32::INFINITY), F::<S>::splat(simd, f32::NEG_INFINITY));
        let low: V3<S> =
            V3 { x: active.select(v.x, least), y: active.select(v.y, least), z: active.select(v.z, least) };
        let high: V3<S> = V3 { x: active.select(v.x, most), y: active.select(v.y, most), z: active.select(v.z, most) };
        Extent {
            low: Vec3::new(low.x.reduce_min(), low.y.reduce_min(), low.z.reduce_min()),
            high: Vec3::new(high.x.reduce_max(), high.y.reduce_max(), high.z.reduce_max()),
        }
    }
}

/// Where the rays of a packet begin.
#[derive(Clone, Copy)]
pub struct Start {
    /// The box around their origins.
    pub origins: Extent,
    /// The body that none of them can meet, because all of them leave it outwards; or [`NOWHERE`].
    pub leaves: u32,
}

impl Start {
    /// The same where some rays may go `inward`, into the body that they leave.
    #[inline(always)]
    pub fn without<S: Simd>(self, _simd: S, inward: M<S>) -> Start {
        Start { leaves: if inward.any_true() { NOWHERE } else { self.leaves }, ..self }
    }
}

/// One of the six conditions under which the box of all rays at a distance overlaps that of a body:
/// `(side - edge) * inverse` is a bound of that distance.
#[derive(Clone, Copy)]
struct Condition {
    edge: f32,
    inverse: f32,
    /// Positive infinity if it is a lower bound, negative infinity if it is an upper one.
    lower: f32,
}

/// All places where the rays of a packet may be.
pub struct Shaft {
    /// For each axis the condition on the low side of a box, and on the high one.
    conditions: [[Condition; 2]; 3],
    reach: f32,
    leaves: u32,
}

impl Shaft {
    /// The shaft of rays whose unit directions lie in a box.
    #[inline(always)]
    pub fn new(start: Start, directions: Extent) -> Shaft {
        Shaft::between(start, directions.low - SLACK, directions.high + SLACK, FAR)
    }

    /// The shaft of rays that end at one point.
    #[inline(always)]
    pub fn to(start: Start, target: Vec3) -> Shaft {
        // With its own length for the unit, each of them is there at 1.
        let origins = start.origins;
        let (low, high) = (target - origins.low, target - origins.high);
        let slack = SLACK * low.abs().max(high.abs()).max_element();
        Shaft::between(start, low - slack, high + slack, 1.0)
    }

    /// At the distance t the rays are between `origins.low + low t` and `origins.high + high t`.
    #[inline(always)]
    fn between(start: Start, low: Vec3, high: Vec3, reach: f32) -> Shaft {
        let Start { origins, leaves } = start;
        let mut conditions = [[Condition { edge: 0.0, inverse: 0.0, lower: 0.0 }; 2]; 3];
        let mut axis = 0;
        while axis < 3 {
            conditions[axis] =
                [condition(origins.high[axis], high[axis], 1.0), condition(origins.low[axis], low[axis], -1.0)];
            axis += 1;
        }
        Shaft { conditions, reach, leaves }
    }

    /// The bits of the bodies of a word that a ray may meet; bits beyond the last body mean nothing.
    #[inline(always)]
    pub fn meets<S: Simd>(&self, simd: S, bounds: &Bounds, word: usize) -> u64 {
        let Boxes { low, high } = &bounds.boxes[word];
        let count = WORD - bounds.all[word].leading_zeros() as usize;
        let mut bits = 0;
        let mut i = 0;
        while i * F::<S>::LEN < count {
            let mut from = F::<S>::splat(simd, 0.0);
            let mut to = F::<S>::splat(simd, self.reach);
            let mut axis = 0;
            while axis < 3 {
                let [on_low, on_high] = self.conditions[axis];
                narrow(simd, on_low, load(simd, &low[axis], i), &mut from, &mut to);
                narrow(simd, on_high, load(simd, &high[axis], i), &mut from, &mut to);
                axis += 1;
            }
            bits |= from.simd_le(to).to_bitmask() << (i * F::<S>::LEN);
            i += 1;
        }
        if self.leaves as usize / WORD == word {
            bits &= !(1 << (self.leaves as usize % WORD));
        }
        bits
    }
}

/// The condition that `speed * t` comes from `edge` to a side of a box, from below for a `sign` of 1, from above for -1.
#[inline(always)]
fn condition(edge: f32, speed: f32, sign: f32) -> Condition {
    // Never 0, so that 0 times infinity never forms.
    let speed = speed.abs().max(1e-20).copysign(speed);
    Condition { edge, inverse: 1.0 / speed, lower: f32::INFINITY.copysign(speed * sign) }
}

/// Narrows the distances `from` to `to` at which boxes overlap by a condition on one of their sides.
#[inline(always)]
fn narrow<S: Simd>(simd: S, condition: Condition, side: F<S>, from: &mut F<S>, to: &mut F<S>) {
    let Condition { edge, inverse, lower } = condition;
    let bound = (side - F::<S>::splat(simd, edge)) * inverse;
    *from = from.max(bound.min(F::<S>::splat(simd, lower)));
    *to = to.min(bound.max(F::<S>::splat(simd, lower)));
}
