//! Flakes and drops around the eye, which fall for ever and everywhere.
//!
//! Fields of flakes that go with the camera are those of snow for virtual reality `[Snow07]`. Flakes fall through a box
//! around the eye; what leaves the box on one side comes back on the other. A place in the box is a whole number of
//! 2^-32 of its edges, so it wraps by itself, and what time is multiplied by is split into a whole number and a
//! fraction: after 10^9 s a flake is where exact arithmetic has it, within some nanometres. Nothing is stored: a flake
//! is its number.

use super::batch::Batch;
use super::lens::Lens;
use crate::cuts;
use crate::simd::hash::{STEP, wide};
use crate::simd::lanes::{F, U, V3, float};
use crate::simd::math::{exp2, sin};
use fearless_simd::prelude::*;
use glam::{DVec3, Vec2, Vec3A};
use std::f32::consts::{LOG2_E, TAU};

/// A field of flakes, and how they move. Pairs are the least and what chance adds at most.
#[derive(Clone, Copy, Debug)]
pub struct Flakes {
    /// The stream of random numbers.
    pub seed: u32,
    /// The number of flakes in the box.
    pub count: u32,
    /// Edges of the box, metres.
    pub extent: Vec3A,
    /// Radius of the upright cylinder around the eye beyond which no flakes are drawn, metres.
    pub reach: f32,
    /// Share of the light behind that a flake takes at the axis of the cylinder. It falls to 0 at its surface.
    pub opacity: f32,
    /// Speed of fall, metres per second.
    pub fall: [f64; 2],
    /// Radius of the circle that a flake sways on, metres.
    pub sway: [f32; 2],
    /// How fast it goes around that circle, radians per second.
    pub pace: [f64; 2],
    /// Radius, metres.
    pub radius: [f32; 2],
    /// The number of the chance that the radius depends on. With 3, which is that of the fall, larger flakes are
    /// faster; with 7 it has its own.
    pub by: u32,
    /// How they are seen.
    pub lens: Lens,
}

/// Flakes at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Snow {
    /// The field.
    pub(super) flakes: Flakes,
    /// The share of the flakes that is there, and more, so that the last ones are fully there at 1.
    share: f32,
    /// How far the slowest flakes have been carried, 2^-32 of the box's edges.
    carried: [u32; 3],
    /// How much further faster flakes have fallen.
    fallen: Phase,
    /// How far the slowest have gone around their circle, 2^-32 turns; and how much further others have.
    turned: u32,
    turns: Phase,
    /// The calm near the ground; none by default.
    pub calm: Calm,
    /// Half of the way of the slowest flakes while the shutter is open, metres.
    pub streak: Vec3A,
}

/// The wind near the ground: at height h it has the share `1 - exp(-h / depth)` of the wind above.
///
/// A flake that falls at speed v and would have come to x in the wind above has only come to
/// `x - (wind depth / v) exp(-h / depth)`, which is the integral of what it lacked on its way down.
#[derive(Clone, Copy, Debug)]
pub struct Calm {
    /// Wind above, along x and z, metres per second.
    pub wind: Vec2,
    /// Height of the eye above the ground, metres.
    pub height: f32,
    /// Depth of the calm layer, metres.
    pub depth: f32,
}

/// A factor for random numbers below 2^24 whose product, in 2^-32 turns, may be many turns.
#[derive(Clone, Copy, Debug)]
struct Phase {
    whole: u32,
    rest: f32,
}

/// The fraction of turns, in 2^-32 turns.
fn wrapped(turns: f64) -> u32 {
    ((turns - turns.floor()) * 4_294_967_296.0) as i64 as u32
}

impl Phase {
    /// The factor that makes `turns` turns of the number 2^24. Exact to some 2^-32 turns, for up to 2^28 turns.
    fn new(turns: f64) -> Phase {
        let turns = turns * 256.0;
        let whole = turns.floor();
        Phase { whole: whole as i64 as u32, rest: (turns - whole) as f32 }
    }

    /// The product with `n`, 2^-32 turns without whole ones.
    #[inline(always)]
    fn of<S: Simd>(self, simd: S, n: U<S>) -> U<S> {
        n * U::<S>::splat(simd, self.whole) + (float(simd, n) * self.rest).to_int::<S::i32s>().bitcast::<U<S>>()
    }
}

/// The sine of 2^-32 turns.
#[inline(always)]
fn sine<S: Simd>(simd: S, turns: U<S>) -> F<S> {
    sin(simd, float(simd, turns) * (TAU / WHOLE))
}

/// The share of the flakes that comes or goes at a time.
const FADE: f32 = 0.02;

/// 2^32, which stands for one edge of the box or one turn.
const WHOLE: f32 = 4_294_967_296.0;

impl Snow {
    /// The share `share` of a field's flakes, at `time` seconds around `eye`, in metres, after the wind has carried
    /// them by `wind` metres.
    pub fn new(flakes: &Flakes, time: f64, eye: DVec3, wind: DVec3, share: f32) -> Snow {
        let carried = (wind - DVec3::Y * (flakes.fall[0] * time) - eye) / flakes.extent.as_dvec3();
        let pace = time / std::f64::consts::TAU;
        Snow {
            flakes: *flakes,
            share: share * (1.0 + FADE),
            carried: carried.to_array().map(wrapped),
            fallen: Phase::new(flakes.fall[1] * time / flakes.extent.y as f64),
            turned: wrapped(flakes.pace[0] * pace),
            turns: Phase::new(flakes.pace[1] * pace),
            calm: Calm { wind: Vec2::ZERO, height: 0.0, depth: 1.0 },
            streak: Vec3A::ZERO,
        }
    }

    /// The number of flakes, seen or not.
    pub fn count(&self) -> u32 {
        (self.share.min(1.0) * self.flakes.count as f32) as u32
    }

    /// The flakes with the numbers `i`.
    #[inline(always)]
    pub(super) fn batch<S: Simd>(&self, simd: S, i: U<S>) -> Batch<S> {
        let Snow { flakes, carried, calm, .. } = self;
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let seed = flakes.seed;
        let turns = (wide(simd, seed, i, 5) << 8) + self.turns.of(simd, wide(simd, seed, i, 6)) + self.turned;
        let (sin, cos) = (sine(simd, turns), sine(simd, turns + (1 << 30)));
        let sway = float(simd, wide(simd, seed, i, 4)) * (flakes.sway[1] * STEP) + flakes.sway[0];
        let speed = wide(simd, seed, i, 3);
        let y = (wide(simd, seed, i, 1) << 8) - self.fallen.of(simd, speed) + carried[1];
        let y = float(simd, y) * (flakes.extent.y / WHOLE);
        let faster = float(simd, speed) * (flakes.fall[1] as f32 * STEP);
        let [mut x, mut z] = [sway * sin, sway * cos];
        if calm.wind != Vec2::ZERO {
            let height = (y + calm.height).max(zero) * (-LOG2_E / calm.depth);
            let lacks = exp2(simd, height) * calm.depth / (faster + flakes.fall[0] as f32);
            (x, z) = (x - lacks * calm.wind.x, z - lacks * calm.wind.y);
        }
        let x = place(simd, wide(simd, seed, i, 0), carried[0], x, flakes.extent.x);
        let z = place(simd, wide(simd, seed, i, 2), carried[2], z, flakes.extent.z);
        let at = V3 { x, y, z };
        let radius = float(simd, wide(simd, seed, i, flakes.by)) * (flakes.radius[1] * STEP) + flakes.radius[0];
        let away = one - (at.x * at.x + at.z * at.z) * (1.0 / (flakes.reach * flakes.reach));
        let mut alpha = away * flakes.opacity;
        // The last flakes are about to come or go.
        let order = float(simd, i) * (-1.0 / (FADE * flakes.count as f32));
        alpha *= (order + self.share * (1.0 / FADE)).max(zero).min(one);
        let turn = [cos, sin, sin.abs() * 0.6 + 0.4];
        let mut streak = V3::splat(simd, self.streak);
        if cuts::STREAKS {
            streak.y *= faster * (1.0 / flakes.fall[0] as f32) + 1.0;
        }
        Batch { at, radius, light: V3::splat(simd, Vec3A::ZERO), alpha: alpha.max(zero), turn, streak }
    }
}

/// Where flakes with the random numbers `n` are along an edge of `extent` metres, `beside` metres from where they were
/// carried to: metres from the middle of the box.
#[inline(always)]
fn place<S: Simd>(simd: S, n: U<S>, carried: u32, beside: F<S>, extent: f32) -> F<S> {
    let beside = (beside * (WHOLE / extent)).to_int::<S::i32s>().bitcast::<U<S>>();
    float(simd, (n << 8) + carried + beside) * (extent / WHOLE)
}
