//! What a point sees of the lights, and what a ray sees of the background.

use super::bounds::{Bounds, Extent, Shaft, Start};
use super::ray::{RayPacket, Search, nearest};
use super::shape::FAR;
use super::world::{Background, Emitter, Light, World};
use crate::angle;
use crate::cuts;
use crate::simd::lanes::{F, Lane, M, U, V3};
use crate::simd::math;
use fearless_simd::prelude::*;
use glam::Vec3A;

/// The way from points to a light.
#[derive(Clone, Copy)]
pub struct Aim<S: Simd> {
    /// Unit direction to the light's centre.
    pub direction: V3<S>,
    /// Distance of the centre, metres; [`FAR`] for a directional light.
    pub reach: F<S>,
}

/// The way from points to a light's centre.
#[inline(always)]
pub fn aim<S: Simd>(simd: S, light: &Light, point: V3<S>) -> Aim<S> {
    match light.emitter {
        Emitter::Point(position) => {
            let q = V3::splat(simd, position) - point;
            let reach = q.dot(q).sqrt();
            Aim { direction: q * Lane(F::<S>::splat(simd, 1.0) / reach), reach }
        }
        Emitter::Directional(direction) => {
            Aim { direction: V3::splat(simd, direction), reach: F::<S>::splat(simd, FAR) }
        }
    }
}

/// The share of a light that each lane sees: 0 or 1 for a point, the share of `samples` points for a light with a radius;
/// through balls of glass any numbers of each colour, also above 1.
///
/// Shadow rays leave the points `point` on the bodies `from`, which are what `start` says. Lanes that are not `wanted` have unspecified results.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn visibility<S: Simd>(
    simd: S,
    world: &World,
    bounds: &Bounds,
    samples: u32,
    light: &Light,
    start: Start,
    point: V3<S>,
    aim: Aim<S>,
    from: U<S>,
    wanted: M<S>,
) -> V3<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let soft = cuts::SOFT_LIGHTS && light.radius > 0.0;
    let samples = if soft { samples } else { 1 };
    let directional = matches!(light.emitter, Emitter::Directional(_));
    let scale = if directional { one } else { aim.reach };
    let (mut direction, mut distance) = (aim.direction, aim.reach);
    let (mut u, mut v) = (aim.direction, aim.direction);
    if soft {
        // The luminous ball's disc as the point sees it: two axes across the direction to it.
        let y_up = aim.direction.y.abs().simd_lt(F::<S>::splat(simd, 0.9));
        let helper = V3 { x: y_up.select(zero, one), y: y_up.select(one, zero), z: zero };
        u = cross(helper, aim.direction);
        u = u * Lane(F::<S>::splat(simd, light.radius) / u.dot(u).sqrt());
        v = cross(aim.direction, u);
    }
    let mut seen = V3::splat(simd, Vec3A::ZERO);
    for k in 0..samples {
        if soft {
            let (a, b) = disc_point(k, samples);
            direction =
                aim.direction * Lane(scale) + u * Lane(F::<S>::splat(simd, a)) + v * Lane(F::<S>::splat(simd, b));
            let length = direction.dot(direction).sqrt();
            distance = if directional { aim.reach } else { length };
            direction = direction * Lane(one / length);
        }
        // A lit point of a convex body is never in that body's own shadow.
        let ray = RayPacket { origin: point, direction, from, inward: M::<S>::splat(simd, false) };
        let shaft = match light.emitter {
            Emitter::Point(position) if !soft => Shaft::to(simd, start, position),
            Emitter::Directional(towards) if !soft => Shaft::new(simd, start, Extent::point(towards)),
            _ => Shaft::new(simd, start, Extent::new(simd, direction, wanted)),
        };
        let (_, share, tint) =
            nearest(simd, world, bounds, &bounds.casters, Some(&shaft), &ray, wanted, distance, Search::Shadow);
        seen = seen + tint * Lane(share);
    }
    seen * Lane(one * (1.0 / samples as f32))
}

/// Point `k` of `n` that are spread evenly over the unit disc along Vogel's spiral `[Vogel79]`.
fn disc_point(k: u32, n: u32) -> (f32, f32) {
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    let radius = ((k as f32 + 0.5) / n as f32).sqrt();
    let (sin, cos) = angle::sin_cos(k as f32 * GOLDEN_ANGLE);
    (radius * cos, radius * sin)
}

/// The background's light in a unit direction.
#[inline(always)]
pub fn background<S: Simd>(simd: S, background: &Background, direction: V3<S>) -> V3<S> {
    let Background { horizon, zenith, glow } = *background;
    let height = direction.y.max(F::<S>::splat(simd, 0.0));
    V3::splat(simd, horizon)
        + V3::splat(simd, zenith - horizon) * Lane(height)
        + V3::splat(simd, glow.color) * Lane(math::lobe(simd, direction, glow.direction, glow.squarings))
}

/// Cross product.
#[inline(always)]
fn cross<S: Simd>(a: V3<S>, b: V3<S>) -> V3<S> {
    V3 { x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x }
}
