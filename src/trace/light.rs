//! What a point sees of the lights, and the sky.

use super::packet::{Context, NOWHERE, Ray, nearest};
use super::shape::FAR;
use super::world::{Light, Source, World};
use crate::cuts::BENCH;
use crate::simd::lanes::{F, Lane, M, U, V3};
use crate::simd::math;
use fearless_simd::prelude::*;

/// Unit direction and distance to a light's centre.
#[inline(always)]
pub fn toward<S: Simd>(simd: S, light: &Light, point: V3<S>) -> (V3<S>, F<S>) {
    match light.source {
        Source::Point(position) => {
            let q = V3::splat(simd, position) - point;
            let distance = q.dot(q).sqrt();
            (q * Lane(F::<S>::splat(simd, 1.0) / distance), distance)
        }
        Source::Directional(direction) => (V3::splat(simd, direction), F::<S>::splat(simd, FAR)),
    }
}

/// The share of a light that each lane sees: 0 or 1 for a point, the share of its sample points for one with a size.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn visibility<S: Simd>(
    simd: S,
    context: &Context,
    samples: u32,
    light: &Light,
    point: V3<S>,
    to_light: V3<S>,
    reach: F<S>,
    from: U<S>,
    wanted: M<S>,
) -> F<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    // What the show has of lumen has hard shadows.
    let soft = BENCH && light.radius > 0.0;
    let samples = if soft { samples } else { 1 };
    let directional = matches!(light.source, Source::Directional(_));
    let scale = if directional { one } else { reach };
    let (mut aim, mut distance) = (to_light, reach);
    let (mut u, mut v) = (to_light, to_light);
    if soft {
        // The luminous ball's disc, seen from the point: two axes across the direction to it.
        let y_up = to_light.y.abs().simd_lt(F::<S>::splat(simd, 0.9));
        let helper = V3 { x: y_up.select(zero, one), y: y_up.select(one, zero), z: zero };
        u = cross(helper, to_light);
        u = u * Lane(F::<S>::splat(simd, light.radius) / u.dot(u).sqrt());
        v = cross(to_light, u);
    }
    let mut seen = zero;
    for k in 0..samples {
        if soft {
            let (a, b) = disc_point(k, samples);
            aim = to_light * Lane(scale) + u * Lane(F::<S>::splat(simd, a)) + v * Lane(F::<S>::splat(simd, b));
            let length = aim.dot(aim).sqrt();
            distance = if directional { reach } else { length };
            aim = aim * Lane(one / length);
        }
        // A lit point of a convex body is never in that body's own shadow.
        let ray = Ray { origin: point, direction: aim, from, inward: M::<S>::splat(simd, false) };
        let (object, _) = nearest(simd, context.world, context.all, &ray, wanted, distance, true);
        seen += (wanted & object.simd_eq(U::<S>::splat(simd, NOWHERE))).select(one, zero);
    }
    seen * (1.0 / samples as f32)
}

/// Point `k` of `n` spread evenly over the unit disc, by Vogel's spiral.
fn disc_point(k: u32, n: u32) -> (f32, f32) {
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    let radius = ((k as f32 + 0.5) / n as f32).sqrt();
    let (sin, cos) = (k as f32 * GOLDEN_ANGLE).sin_cos();
    (radius * cos, radius * sin)
}

/// The sky in a direction.
#[inline(always)]
pub fn sky<S: Simd>(simd: S, world: &World, d: V3<S>) -> V3<S> {
    let zero = F::<S>::splat(simd, 0.0);
    let sky = &world.sky;
    let base = V3::splat(simd, sky.horizon) + V3::splat(simd, sky.zenith - sky.horizon) * Lane(d.y.max(zero));
    let (towards, color, exponent) = sky.glow;
    if exponent == 0.0 {
        return base;
    }
    let glow = math::powf(simd, d.dot1(towards).max(F::<S>::splat(simd, 1e-6)), exponent);
    base + V3::splat(simd, color) * Lane(glow)
}

/// Cross product.
#[inline(always)]
fn cross<S: Simd>(a: V3<S>, b: V3<S>) -> V3<S> {
    V3 { x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x }
}
