//! What the air of a round earth does to light: what it scatters towards the eye, and what it lets through.
//!
//! The air is two layers that thin out with height, of gas (Rayleigh) and haze (Mie), and a shell of ozone, which makes
//! the blue hour blue. Light that has been scattered once is summed along each direction; light that has been scattered
//! more often is approximated by the mean of a few directions. Light that grazes the earth comes red out of the haze,
//! so the earth's shadow and every colour of dusk follow by themselves.
//!
//! The coefficients are those of `[Bruneton08]` and `[Hillaire20]` at 680, 550 and 440 nm. Optical depths are Chapman's
//! function `[Chapman31]` in closed form `[Fitzmaurice64]`, so the sum has no inner loop. A column is the optical depth
//! of one of the three along a way, counted in km of its densest place. Lengths are km. The tests sum the same light in
//! f64 by brute force.

use super::place::Place;
use super::time::{sane, turned};
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math::exp3;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3A, vec3a};
use std::f32::consts::{FRAC_1_PI, FRAC_PI_2};

/// Radius of the earth, km.
const EARTH: f32 = 6360.0;
/// Height at which the air ends, km.
const TOP: f32 = 100.0;
/// Height of the eye, km, and its distance from the earth's centre.
const EYE: f32 = 0.2;
const BEGIN: f32 = EARTH + EYE;
/// Heights over which gas and haze thin out to 1/e, km.
const THIN: [f32; 2] = [8.0, 1.2];
/// Heights between which ozone is, km. `[Bruneton08]` has as much of it in a tent: 15 km at its densest.
const OZONE: [f32; 2] = [17.5, 32.5];
/// What gas scatters, 1/km at its densest.
const GAS: Vec3A = vec3a(5.802e-3, 13.558e-3, 33.1e-3);
/// What ozone absorbs, 1/km at its densest.
const ABSORBED: Vec3A = vec3a(0.650e-3, 1.881e-3, 0.085e-3);
/// What the haze of a clear day scatters, 1/km at its densest.
const HAZE: f32 = 3.996e-3;
/// What haze takes from light over what it scatters.
const HAZE_LOSS: f32 = 1.11;
/// Mean cosine of the angle by which haze turns light.
const FORWARD: f32 = 0.76;

/// The state of the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// Amount of haze: 1 on a clear day, 0.5 in polar air, 3 and more in a sultry summer.
    pub haze: f32,
    /// Amount of ozone: 1 is 300 Dobson units.
    pub ozone: f32,
    /// Light from all around that is scattered again, over the mean of a few directions of light that is scattered
    /// once. 0 leaves it out.
    pub again: f32,
}

impl Air {
    /// The air of a time of year, by days since J2000: hazy and thin in ozone in late summer, clear in late winter.
    pub fn of_season(days: f64, place: &Place) -> Air {
        // 24 July, day 205 of a year, is the warmest north of the equator.
        let summer = turned((sane(days) - 205.0) * (360.0 / 365.25)).1;
        let warmth = (summer * turned(sane(place.latitude).to_degrees()).0) as f32;
        Air { haze: 1.3 + 0.7 * warmth, ozone: 1.15 - 0.15 * warmth, again: 0.7 }
    }
}

/// The sun or the moon as a source of light: so far away that its light is parallel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DistantLight {
    /// Unit vector towards it.
    pub direction: Vec3A,
    /// Its light outside of the air; the sun's is 1. At 0 it is left out.
    pub strength: f32,
}

/// `e^(y^2) erfc(y)` for `y` >= 0, relative error 1.4e-4: how Chapman's function falls from the horizon to the zenith.
#[inline(always)]
fn erfcx<S: Simd>(y: F<S>) -> F<S> {
    let upper = y * (y * 0.305_72 + 0.872_2) + 1.0;
    upper / (y * (y * (y * 0.541_876 + 1.548_175) + 2.003_408) + 1.0)
}

/// Columns of gas, haze and ozone on the way to space from a height, km, where gas and haze have a `density` over their
/// densest. `up` is the sine of the way's altitude.
///
/// Gas and haze by Chapman's function, in the expansion of `[Fitzmaurice64]`: within 0.3 %. A way that would meet the
/// ground goes on through air that gets ever denser, which lets nothing through, so there is no edge.
#[simd]
fn columns<S: Simd>(simd: S, height: F<S>, density: V3<S>, up: F<S>) -> V3<S> {
    let zero = F::<S>::splat(simd, 0.0);
    let (radius, down) = (height + EARTH, up.simd_lt(zero));
    let level = (F::<S>::splat(simd, 1.0) - up * up).max(zero).sqrt();
    // The distance of the way's line from the earth's centre, where it is lowest.
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
        // Downwards: twice the way from the lowest point, without what lies behind the start.
        sums[k] = down.select(low[k] * lowest.sqrt() * (2.0 * root) - rest, rest);
        k += 1;
    }
    let mut ozone = zero;
    let (squared, back) = (lowest * lowest, radius * up);
    let mut k = 0;
    while k < 2 {
        // The length of the way within a ball whose edge is soft by a km. At a hard edge all light that grazes the
        // shell would change at once, and dusk would jerk.
        let edge = EARTH + OZONE[k];
        let q = -squared + edge * edge;
        let half: F<S> = ((q + (q * q + 1.5e8).sqrt()) * 0.5).sqrt();
        ozone = (half - back).max(zero) - (-half - back).max(zero) - ozone;
        k += 1;
    }
    V3 { x: sums[0], y: sums[1], z: ozone.max(zero) }
}

/// Gas and haze at a height, km, over their densest.
#[simd]
fn thinned<S: Simd>(simd: S, height: F<S>) -> V3<S> {
    exp3(simd, V3 { x: height * (1.0 / THIN[0]), y: height * (1.0 / THIN[1]), z: height }, -1.0)
}

/// The share of light that columns let through, by colour.
#[simd]
fn left<S: Simd>(simd: S, air: &Air, c: V3<S>) -> V3<S> {
    let depth = V3::splat(simd, GAS) * Lane(c.x)
        + V3::splat(simd, Vec3A::splat(HAZE * HAZE_LOSS * air.haze)) * Lane(c.y)
        + V3::splat(simd, ABSORBED * air.ozone) * Lane(c.z);
    exp3(simd, depth, -1.0)
}

/// Columns from the eye to space, by the sine of the altitude.
#[inline(always)]
fn whole<S: Simd>(simd: S, up: F<S>) -> V3<S> {
    let eye = F::<S>::splat(simd, EYE);
    columns(simd, eye, thinned(simd, eye), up)
}

/// The share of light from outside of the air that reaches the eye, by colour. Of the unit directions only y counts,
/// which is not normalised.
#[simd]
pub fn through<S: Simd>(simd: S, air: &Air, d: V3<S>) -> V3<S> {
    left(simd, air, whole(simd, d.y))
}

/// An eye ray through the air.
struct Path<S: Simd> {
    /// Its unit direction, bent away from the ground.
    direction: V3<S>,
    /// The factor by which its light is darker, 1 above the horizon and less below it.
    ground: V3<S>,
    /// Columns along all of it.
    whole: V3<S>,
    /// Its length up to the end of the air, km.
    reach: F<S>,
    /// How far behind the eye its line is nearest to the earth's centre, km.
    back: F<S>,
}

impl<S: Simd> Path<S> {
    /// The path of rays with the unit direction `d`.
    #[inline(always)]
    fn new(simd: S, d: V3<S>) -> Path<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        // Bent smoothly, so that the horizon is no edge.
        let up: F<S> = ((d.y + (d.y * d.y + 1.5e-4).sqrt()) * 0.5).min(1.0);
        let low = d.y - up;
        let ground = exp3(simd, V3 { x: low, y: low, z: low }, 2.0);
        let level: F<S> = ((one - up * up) / (one - d.y * d.y).max(1e-6)).max(zero).sqrt();
        let back = up * BEGIN;
        let reach = (back * back + (TOP - EYE) * (2.0 * EARTH + TOP + EYE)).sqrt() - back;
        let direction = V3 { x: d.x * level, y: up, z: d.z * level };
        Path { direction, ground, whole: whole(simd, up), reach, back }
    }
}

/// How gas and haze spread light, by the cosine of the angle that it is turned by: the share per steradian.
#[inline(always)]
fn phases<S: Simd>(cosine: F<S>) -> (F<S>, F<S>) {
    const G2: f32 = FORWARD * FORWARD;
    let gas = (cosine * cosine + 1.0) * (3.0 / 16.0 * FRAC_1_PI);
    // `[CornetteShanks92]`, which shares a factor with Rayleigh's law.
    let far = cosine * (-2.0 * FORWARD) + (1.0 + G2);
    (gas, gas * (2.0 * (1.0 - G2) / (2.0 + G2)) / (far * far.sqrt()))
}

/// How the points of an integral lie along a path.
#[derive(Clone, Copy)]
struct Points {
    count: u32,
    /// From 0, where they are dense at both ends, to 1, where they are dense near the eye alone.
    even: f32,
}

impl Points {
    /// The points for a light at the sine `altitude`, of which there are `steps` by day.
    fn new(altitude: f32, steps: u32) -> Points {
        // When only what is far and high is lit, points lie less dense near the eye, and there are more of them.
        let low = -altitude;
        Points { count: if low > -0.05 { 3 * steps } else { steps }, even: (low * 10.0 - 0.5).clamp(0.0, 1.0) }
    }

    /// Point `number`, as a share of the path, and the share that it stands for times the number of points.
    #[inline(always)]
    fn at(self, number: u32) -> (f32, f32) {
        let s = (number as f32 + 0.5) / self.count as f32;
        // Cubic by day: the ends of the integral vanish, so that midpoints converge fast.
        (s * s * (s + self.even * (1.0 - s)), s * (3.0 * s + self.even * (2.0 - 3.0 * s)))
    }
}

/// The light that air sends from unit directions, over the sun's outside of the air.
///
/// It is what the air scatters once, summed over `steps` points along each direction, three times as many in the dusk;
/// and `again`, the mean light from all around, as far as the air scatters that. Below the horizon it is the horizon's
/// light, darker downwards.
///
/// ```text
/// path from the eye to the end of the air
/// sum = what the path makes opaque * again
/// for each light, for each point on the path:
///     sum += light that is left at the point, and then at the eye * gas and haze there * their phase functions
/// ```
#[simd]
pub fn scattered<S: Simd>(simd: S, air: &Air, lights: &[DistantLight], again: Vec3A, steps: u32, d: V3<S>) -> V3<S> {
    let path = Path::new(simd, d);
    let opaque = V3::splat(simd, Vec3A::ONE) - left(simd, air, path.whole);
    let mut sum = opaque.mulv(V3::splat(simd, again));
    for light in lights {
        if light.strength == 0.0 {
            continue;
        }
        let cosine = path.direction.dot1(light.direction);
        let phases = phases::<S>(cosine);
        let points = Points::new(light.direction.y, steps);
        for number in 0..points.count {
            let (place, slope) = points.at(number);
            let length = path.reach * (slope * light.strength / points.count as f32);
            sum = sum + sent(simd, air, &path, light.direction.y, cosine, phases, path.reach * place, length);
        }
    }
    sum.mulv(path.ground)
}

/// The light of one point, `way` km along a path, that stands for `length` km: scattered once towards the eye.
#[inline(always)]
#[allow(clippy::too_many_arguments)] // A step of the loop above.
fn sent<S: Simd>(
    simd: S,
    air: &Air,
    path: &Path<S>,
    altitude: f32,
    cosine: F<S>,
    (gas, haze): (F<S>, F<S>),
    way: F<S>,
    length: F<S>,
) -> V3<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let radius = (way * (way + path.back * 2.0) + BEGIN * BEGIN).sqrt();
    let height = radius - EARTH;
    let here = thinned(simd, height);
    let inward = columns(simd, height, here, (way * cosine + BEGIN * altitude) / radius);
    // From the eye to the point: all of the path without the rest of it.
    let rest = columns(simd, height, here, ((way + path.back) / radius).min(one));
    let seen = V3 {
        x: (path.whole.x - rest.x).max(zero),
        y: (path.whole.y - rest.y).max(zero),
        z: (path.whole.z - rest.z).max(zero),
    };
    let left = left(simd, air, inward + seen);
    let thick = here.x * length * gas;
    let hazy = here.y * length * haze * (HAZE * air.haze);
    left.mulv(V3::splat(simd, GAS) * Lane(thick) + V3 { x: hazy, y: hazy, z: hazy })
}
