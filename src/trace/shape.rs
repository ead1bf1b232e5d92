//! Convex bodies: where a line enters and leaves them, and their normals.
//!
//! Every shape is convex, so a ray that leaves a body outwards cannot meet that body again, and one that goes inwards
//! meets only its far side. The test against hitting oneself therefore compares identities and needs no epsilon; a
//! constant epsilon fails on 3 to 36 % of secondary rays, depending on the scale of the scene.
//!
//! The same arithmetic in scalar code is in [`super::reference`]; `tests/trace/shapes.rs` holds both against exact numbers.

use crate::cuts;
use crate::simd::lanes::{F, Lane, M, V3, masked};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Mat3A, Vec3A};

/// A convex body's shape and place. Lengths are metres and above 0; what is called unit or a rotation has to be one.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// A ball.
    Sphere {
        /// Centre.
        center: Vec3A,
        /// Radius.
        radius: f32,
    },
    /// The half-space below a plane: `normal . p <= offset`.
    Plane {
        /// Unit normal, outwards.
        normal: Vec3A,
        /// Distance from the origin along the normal.
        offset: f32,
    },
    /// A ball so large that f32 cannot hold its centre, a planet for example. It is given by a point of its surface near
    /// the eye.
    #[cfg(feature = "full")]
    Globe {
        /// A point of the surface.
        touch: Vec3A,
        /// Unit normal there, outwards.
        normal: Vec3A,
        /// Radius.
        radius: f32,
    },
    /// A box of any orientation.
    Block {
        /// Centre.
        center: Vec3A,
        /// Half of each edge.
        half: Vec3A,
        /// Rotation from world to box.
        turn: Mat3A,
    },
    /// A capped cylinder.
    Cylinder {
        /// Centre.
        center: Vec3A,
        /// Unit axis.
        axis: Vec3A,
        /// Half of its length.
        half: f32,
        /// Radius.
        radius: f32,
    },
}

/// How exact the distances have to be at which a line enters and leaves a ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ball {
    /// To a few ulps of themselves.
    Exact,
    /// To a few ulps of the distance to the centre: enough to tell which body is nearest, at half the cost.
    Rough,
}

/// The distance beyond which a ray has left the scene.
pub const FAR: f32 = 1e30;

impl Shape {
    /// Centre and radius of a ball around the body. The radius is infinite for planes and globes.
    pub fn bound(&self) -> (Vec3A, f32) {
        match *self {
            Shape::Sphere { center, radius } => (center, radius),
            Shape::Block { center, half, .. } => (center, half.length()),
            Shape::Cylinder { center, half, radius, .. } => (center, (half * half + radius * radius).sqrt()),
            Shape::Plane { .. } => (Vec3A::ZERO, f32::INFINITY),
            #[cfg(feature = "full")]
            Shape::Globe { .. } => (Vec3A::ZERO, f32::INFINITY),
        }
    }

    /// The interval `t0 <= t1` in which the line `o + t d` with `|d| = 1` is inside the body, and whether there is one.
    ///
    /// Where the mask is false the interval means nothing. A line that only touches a round body has none. Planes and
    /// globes are half-spaces and a ball, so an interval may reach to minus or plus [`FAR`].
    ///
    /// A direction of another length gives no error, but wrong distances, and balls and cylinders are missed. Intervals
    /// are closed, so a line through a corner of a block meets it in a point; of one that runs within a face, rounding
    /// and the signs of zeros decide. What a NaN or an infinity gives is unspecified.
    ///
    /// The ball is tested in the projected form `[Haines19]`: the distance from the centre to the line's nearest point does
    /// not cancel as `b^2 - 4ac` does far away.
    #[inline(always)]
    pub fn span<S: Simd>(&self, simd: S, o: V3<S>, d: V3<S>, ball: Ball) -> (F<S>, F<S>, M<S>) {
        let zero = F::<S>::splat(simd, 0.0);
        match *self {
            Shape::Sphere { center, radius } => {
                let (q, b, apart) = past(o, d, center);
                let disc = F::<S>::splat(simd, radius * radius) - apart;
                let (t0, t1) = match ball {
                    Ball::Exact => roots::<S>(b, disc.max(zero), q.dot(q) - radius * radius),
                    Ball::Rough => {
                        let s = disc.max(zero).sqrt();
                        (b - s, b + s)
                    }
                };
                (t0, t1, disc.simd_gt(zero))
            }
            Shape::Plane { normal, offset } => {
                let speed = d.dot1(normal);
                let height = o.dot1(normal) - offset;
                let t = -height / speed;
                let (enters, leaves) = (speed.simd_lt(zero), speed.simd_gt(zero));
                // Parallel to the plane a ray is inside all along or never.
                let far = F::<S>::splat(simd, FAR);
                (enters.select(t, -far), leaves.select(t, far), enters | leaves | height.simd_le(zero))
            }
            #[cfg(feature = "full")]
            Shape::Globe { touch, normal, radius } => {
                // With q = o - touch and the centre at touch - R n: |o - c|^2 - R^2 = |q|^2 + 2 R q.n, and R^2 - |m|^2
                // = R^2 (n.d)^2 - 2 R m.n - |m|^2, m the part of q across d: no term larger than the answer.
                let q = o.sub1(touch);
                let along = q.dot(d);
                let slope = d.dot1(normal);
                let m = q - d * Lane(along);
                let across = m.dot1(normal);
                let disc = slope * slope * radius - across * 2.0 - m.dot(m) * (1.0 / radius);
                let product = q.dot(q) + q.dot1(normal) * (2.0 * radius);
                let (t0, t1) = roots::<S>(-(along + slope * radius), disc.max(zero) * radius, product);
                (t0, t1, disc.simd_gt(zero))
            }
            Shape::Block { center, half, turn } => {
                let (o, d) = (turned(turn, o.sub1(center)), turned(turn, d));
                let (x0, x1) = slab(simd, o.x, d.x, half.x);
                let (y0, y1) = slab(simd, o.y, d.y, half.y);
                let (z0, z1) = slab(simd, o.z, d.z, half.z);
                let (t0, t1) = (x0.max(y0).max(z0), x1.min(y1).min(z1));
                (t0, t1, t0.simd_le(t1))
            }
            Shape::Cylinder { center, axis, half, radius } => {
                let q = o.sub1(center);
                let ((qa, q), (da, d)) = (split(simd, q, axis), split(simd, d, axis));
                let (c0, c1) = slab(simd, qa, da, half);
                // Along the axis the round side is never crossed: then all of the line is inside it or none.
                let a = d.dot(d).max(F::<S>::splat(simd, 1e-12));
                let b = -q.dot(d) / a;
                let m = q + d * Lane(b);
                let disc = F::<S>::splat(simd, radius * radius) - m.dot(m);
                let s = (disc.max(zero) / a).sqrt();
                let (t0, t1) = (c0.max(b - s), c1.min(b + s));
                (t0, t1, disc.simd_gt(zero) & t0.simd_le(t1))
            }
        }
    }

    /// Unit outward normal at a point of the surface. On an edge of a block or cylinder it is that of one of the faces.
    #[simd]
    pub fn normal<S: Simd>(&self, simd: S, p: V3<S>) -> V3<S> {
        match *self {
            Shape::Sphere { center, .. } => unit(simd, p.sub1(center)),
            Shape::Plane { normal, .. } => V3::splat(simd, normal),
            #[cfg(feature = "full")]
            Shape::Globe { touch, normal, radius } => {
                let k = F::<S>::splat(simd, 1.0 / radius);
                unit(simd, p.sub1(touch) * Lane(k) + V3::splat(simd, normal))
            }
            Shape::Block { center, half, turn } => {
                let q = turned(turn, p.sub1(center));
                let (x, y, z) = (q.x * (1.0 / half.x), q.y * (1.0 / half.y), q.z * (1.0 / half.z));
                let one = F::<S>::splat(simd, 1.0);
                let on_x = x.abs().simd_ge(y.abs()) & x.abs().simd_ge(z.abs());
                let on_y = !on_x & y.abs().simd_ge(z.abs());
                let on_z = !on_x & !on_y;
                let local = V3 {
                    x: masked::<S>(one.copysign(x), on_x),
                    y: masked::<S>(one.copysign(y), on_y),
                    z: masked::<S>(one.copysign(z), on_z),
                };
                turned(turn.transpose(), local)
            }
            Shape::Cylinder { center, axis, half, radius } => {
                let (h, round) = split(simd, p.sub1(center), axis);
                let cap = (h.abs() * (1.0 / half)).simd_ge(round.dot(round).sqrt() * (1.0 / radius));
                let up = F::<S>::splat(simd, 1.0).copysign(h);
                V3::select(cap, V3::splat(simd, axis) * Lane(up), unit(simd, round))
            }
        }
    }
}

/// The roots `b - sqrt(disc)` and `b + sqrt(disc)`, given their product.
#[inline(always)]
fn roots<S: Simd>(b: F<S>, disc: F<S>, product: F<S>) -> (F<S>, F<S>) {
    // The root of larger magnitude does not cancel; the other follows from their product.
    let far = b + disc.sqrt().copysign(b);
    let near = product / far;
    (far.min(near), far.max(near))
}

/// How a line passes a point: the vector from the point to the line's origin, the distance along the line at which it is
/// nearest, and the square of the distance between them there.
#[inline(always)]
fn past<S: Simd>(o: V3<S>, d: V3<S>, center: Vec3A) -> (V3<S>, F<S>, F<S>) {
    let q = o.sub1(center);
    let b = -q.dot(d);
    let m = q + d * Lane(b);
    (q, b, m.dot(m))
}

/// The unit vector of every lane.
///
/// The normal of a ball is not divided by the radius instead: the error of a hit point would come back, 13 times as large,
/// in the length of each direction that is reflected inside a ball.
#[inline(always)]
fn unit<S: Simd>(simd: S, v: V3<S>) -> V3<S> {
    v * Lane(F::<S>::splat(simd, 1.0) / v.dot(v).sqrt())
}

/// The interval in which a line is between `-half` and `half` on one axis. Directions too small to divide by are nudged
/// away from 0, so that 0 times infinity never forms.
#[inline(always)]
fn slab<S: Simd>(simd: S, o: F<S>, d: F<S>, half: f32) -> (F<S>, F<S>) {
    let d = d.abs().max(F::<S>::splat(simd, 1e-20)).copysign(d);
    let (a, b) = ((-o - half) / d, (-o + half) / d);
    (a.min(b), a.max(b))
}

/// The part of the vector of every lane along a unit axis, and the vector across it that is left.
#[inline(always)]
fn split<S: Simd>(simd: S, v: V3<S>, axis: Vec3A) -> (F<S>, V3<S>) {
    if !cuts::ASKEW {
        return (v.y, V3 { y: F::<S>::splat(simd, 0.0), ..v });
    }
    let along = v.dot1(axis);
    (along, v - V3::splat(simd, axis) * Lane(along))
}

/// The vector of every lane, through one matrix.
#[inline(always)]
fn turned<S: Simd>(m: Mat3A, v: V3<S>) -> V3<S> {
    if !cuts::ASKEW {
        return v;
    }
    V3 { x: v.dot1(m.row(0)), y: v.dot1(m.row(1)), z: v.dot1(m.row(2)) }
}
