//! What air does to light: scattered once as exactly as steps allow, more often roughly, on a round earth.
//!
//! Two layers that thin out with height, of gas (Rayleigh) and haze (Mie), and a shell of ozone, which makes the blue hour
//! blue. Light that grazes the earth comes red out of the haze, so its shadow and every colour of dusk follow by
//! themselves. Lengths are km. Coefficients as in Bruneton and Neyret, "Precomputed Atmospheric Scattering", 2008, and
//! Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", 2020, at 680, 550 and 440 nm.

use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math::exp3;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3, vec3};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2};

/// Radius of the earth, where the air ends, and where the eye is above the ground.
const EARTH: f32 = 6360.0;
const TOP: f32 = 100.0;
const EYE: f32 = 0.2;
/// Heights over which gas and haze thin out to 1/e.
const THIN: [f32; 2] = [8.0, 1.2];
/// The shell of ozone, from the ground: as much of it as in the tent of Bruneton, 15 km at its densest.
const OZONE: [f32; 2] = [17.5, 32.5];
/// Scattering of gas, absorption of ozone, scattering of haze of a clear day, 1/km at their densest.
const GAS: Vec3 = vec3(5.802e-3, 13.558e-3, 33.1e-3);
const ABSORBED: Vec3 = vec3(0.650e-3, 1.881e-3, 0.085e-3);
const HAZE: f32 = 3.996e-3;
/// What haze takes away over what it scatters, and how much forward it does.
const HAZE_LOSS: f32 = 1.11;
const FORWARD: f32 = 0.76;

/// The state of the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Haze: 1 on a clear day, 0.5 in polar air, 3 and more in a sultry summer.
    pub haze: f32,
    /// Ozone: 1 is 300 Dobson units.
    pub ozone: f32,
    /// Light from all around that is scattered again, over the mean of a few directions of what is scattered once:
    /// 0 leaves it out.
    pub again: f32,
}

/// A distant lamp: the sun or the moon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    /// Unit vector towards it.
    pub direction: Vec3,
    /// Its light outside of the air; the sun's is 1.
    pub strength: f32,
}

/// `e^(y^2) erfc(y)` for y >= 0, relative error 1.4e-4: the fall of Chapman's function from the horizon to the zenith.
#[inline(always)]
fn erfcx<S: Simd>(y: F<S>) -> F<S> {
    let upper = y * (y * 0.305_72 + 0.872_2) + 1.0;
    upper / (y * (y * (y * 0.541_876 + 1.548_175) + 2.003_408) + 1.0)
}

/// Gas, haze and ozone on the way from a height to space, as km of the densest. `up` is the sine of the way's altitude.
///
/// Chapman's function by the expansion of Fitzmaurice, "Simplification of the Chapman function", 1964: within 0.3 %.
/// Ways that would meet the ground go on through air that gets denser, and nothing is left of them: no edge.
#[simd]
fn columns<S: Simd>(simd: S, height: F<S>, density: V3<S>, up: F<S>) -> V3<S> {
    let zero = F::<S>::splat(simd, 0.0);
    let (radius, down) = (height + EARTH, up.simd_lt(zero));
    let level = (F::<S>::splat(simd, 1.0) - up * up).max(zero).sqrt();
    // The lowest point of the way's line.
    let lowest = radius * level;
    let mut densest = density;
    if down.any_true() {
        densest = thinned(simd, (lowest - EARTH).max(-40.0));
    }
    let (mut sums, all, low) = ([zero; 2], [density.x, density.y], [densest.x, densest.y]);
    let mut k = 0;
    while k < 2 {
        let root = FRAC_PI_2.sqrt() * THIN[k].sqrt();
        let fall = erfcx::<S>((radius * (0.5 / THIN[k])).sqrt() * up.abs());
        let rest = all[k] * radius.sqrt() * fall * root;
        // Twice the way from the lowest point, but for what lies behind.
        sums[k] = down.select(low[k] * lowest.sqrt() * (2.0 * root) - rest, rest);
        k += 1;
    }
    let mut ozone = zero;
    let (squared, back) = (lowest * lowest, radius * up);
    let mut k = 0;
    while k < 2 {
        // The length of the way within a ball, whose edge is soft by a km: at a hard one all light that grazes the
        // shell would change at once, and dusk would jerk.
        let edge = EARTH + OZONE[k];
        let q = -squared + edge * edge;
        let half: F<S> = ((q + (q * q + 1.5e8).sqrt()) * 0.5).sqrt();
        ozone = (half - back).max(zero) - (-half - back).max(zero) - ozone;
        k += 1;
    }
    V3 { x: sums[0], y: sums[1], z: ozone.max(zero) }
}

/// Gas and haze at a height, over their densest.
#[simd]
fn thinned<S: Simd>(simd: S, height: F<S>) -> V3<S> {
    exp3(simd, V3 { x: height * (1.0 / THIN[0]), y: height * (1.0 / THIN[1]), z: height }, -1.0)
}

/// The share of light that comes through columns.
#[simd]
fn left<S: Simd>(simd: S, air: &Air, c: V3<S>) -> V3<S> {
    let depth = V3::splat(simd, GAS) * Lane(c.x)
        + V3::splat(simd, Vec3::splat(HAZE * HAZE_LOSS * air.haze)) * Lane(c.y)
        + V3::splat(simd, ABSORBED * air.ozone) * Lane(c.z);
    exp3(simd, depth, -1.0)
}

/// Columns from the eye to space.
#[inline(always)]
fn whole<S: Simd>(simd: S, up: F<S>) -> V3<S> {
    let eye = F::<S>::splat(simd, EYE);
    columns(simd, eye, thinned(simd, eye), up)
}

/// The share of light that comes through from a direction outside of the air, whose y counts.
#[simd]
pub fn through<S: Simd>(simd: S, air: &Air, d: V3<S>) -> V3<S> {
    left(simd, air, whole(simd, d.y))
}

/// The light that air sends from unit directions: what it scatters once, an integral along each over `steps` points (three
/// times as many in the dusk), and `again`, the mean light from all around, as it scatters that.
///
/// Below the horizon it is the horizon's, and darker downwards.
#[simd]
pub fn scattered<S: Simd>(simd: S, air: &Air, lamps: &[Lamp], again: Vec3, steps: u32, d: V3<S>) -> V3<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    // Bent away from the ground smoothly, so that the horizon is no edge.
    let up: F<S> = ((d.y + (d.y * d.y + 1.5e-4).sqrt()) * 0.5).min(1.0);
    let low = d.y - up;
    let ground = exp3(simd, V3 { x: low, y: low, z: low }, 2.0);
    let level: F<S> = ((one - up * up) / (one - d.y * d.y).max(1e-6)).max(zero).sqrt();
    let d: V3<S> = V3 { x: d.x * level, y: up, z: d.z * level };
    let begin = EARTH + EYE;
    let whole = whole(simd, up);
    let back = up * begin;
    let reach = (back * back + (TOP - EYE) * (2.0 * EARTH + TOP + EYE)).sqrt() - back;
    let opaque = V3::splat(simd, Vec3::ONE) - left(simd, air, whole);
    let mut sum = opaque.mulv(V3::splat(simd, again));
    for lamp in lamps {
        if lamp.strength == 0.0 {
            continue;
        }
        let cosine = d.dot1(lamp.direction);
        let gas = (cosine * cosine + 1.0) * (3.0 / 16.0 * FRAC_1_PI);
        // Cornette and Shanks, "Physically reasonable analytic expression for the single-scattering phase
        // function", 1992.
        const G2: f32 = FORWARD * FORWARD;
        let far = cosine * (-2.0 * FORWARD) + (1.0 + G2);
        let haze = gas * (2.0 * (1.0 - G2) / (2.0 + G2)) / (far * far.sqrt());
        // When only what is far and high is lit, points lie less dense near the eye, and there are more of them.
        let low = -lamp.direction.y;
        let even = (low * 10.0 - 0.5).clamp(0.0, 1.0);
        let steps = if low > -0.05 { 3 * steps } else { steps };
        for step in 0..steps {
            let s = (step as f32 + 0.5) / steps as f32;
            // Cubic by day: the ends of the integral vanish, so that midpoints converge fast.
            let (place, slope) = (s * s * (s + even * (1.0 - s)), s * (3.0 * s + even * (2.0 - 3.0 * s)));
            let (way, length) = (reach * place, reach * (slope * lamp.strength / steps as f32));
            let radius = (way * (way + back * 2.0) + begin * begin).sqrt();
            let height = radius - EARTH;
            let here = thinned(simd, height);
            let inward = columns(simd, height, here, (way * cosine + begin * lamp.direction.y) / radius);
            let rest = columns(simd, height, here, ((way + back) / radius).min(one));
            let seen = V3 {
                x: (whole.x - rest.x).max(zero),
                y: (whole.y - rest.y).max(zero),
                z: (whole.z - rest.z).max(zero),
            };
            let left = left(simd, air, inward + seen);
            let thick = here.x * length * gas;
            let hazy = here.y * length * haze * (HAZE * air.haze);
            sum = sum + left.mulv(V3::splat(simd, GAS) * Lane(thick) + V3 { x: hazy, y: hazy, z: hazy });
        }
    }
    sum.mulv(ground)
}
