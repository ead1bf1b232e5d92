//! Flakes around the eye: a box that they fall through and that goes with it. What leaves it on one side comes back on
//! the other, since places are whole numbers of 2^-32 boxes, which wrap by themselves.
//!
//! So it snows everywhere, at any time, and nothing is stored: a flake is its number. After "Snow for virtual reality"
//! (thesis C), whose fields around the camera these are.

use super::Batch;
use super::sprite::Lens;
use crate::cuts::BENCH;
use crate::simd::hash::{STEP, wide};
use crate::simd::lanes::{F, U, V3, float};
use crate::simd::math;
use fearless_simd::prelude::*;
use glam::{DVec3, Vec2, Vec3};
use std::f32::consts::{LOG2_E, TAU};

/// What flakes there are, and how they move. Pairs are the least, and what chance adds at most.
#[derive(Clone, Copy, Debug)]
pub struct Flakes {
    /// Tells this field's chance from another's.
    pub seed: u32,
    /// How many are in the box.
    pub count: u32,
    /// The box's edges, metres.
    pub extent: Vec3,
    /// Metres from the upright axis through the eye, over the ground, at which the last ones are.
    pub reach: f32,
    /// Share of the light behind that they take, at the axis.
    pub opacity: f32,
    /// Speed of fall, metres a second.
    pub fall: [f64; 2],
    /// How far they sway, metres, and how fast, radians a second.
    pub sway: [f32; 2],
    /// See there.
    pub pace: [f64; 2],
    /// Radius, metres, and which of their random numbers it is by: with that of the fall, 3, larger ones are faster.
    pub radius: [f32; 2],
    /// See there.
    pub by: u32,
    /// How they are seen.
    pub lens: Lens,
}

/// Flakes at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Snow {
    pub(super) flakes: Flakes,
    /// Share of them that is there.
    share: f32,
    /// Where the box's flakes have come to, 2^-32 of its edges.
    carried: [u32; 3],
    fallen: Phase,
    /// 2^-32 turns.
    turned: u32,
    turns: Phase,
    /// What the wind lacks near the ground.
    pub calm: Calm,
    /// Half of the way of the slowest ones while a shutter is open, metres.
    pub streak: Vec3,
}

/// The wind near the ground, where at height h it has a share of `1 - exp(-h / depth)`.
///
/// A flake that falls at speed v and would have come to x has only come to `x - (wind depth / v) exp(-h / depth)`: the sum
/// of what it lacks on its way down.
#[derive(Clone, Copy, Debug)]
pub struct Calm {
    /// Wind above, along x and z, metres a second.
    pub wind: Vec2,
    /// How high the eye is above the ground, metres.
    pub height: f32,
    /// Metres.
    pub depth: f32,
}

/// What a random number below 2^24 is multiplied by to get 2^-32 turns.
#[derive(Clone, Copy, Debug)]
struct Phase {
    whole: u32,
    rest: f32,
}

/// Turns as 2^-32 turns, without whole ones.
fn wrapped(turns: f64) -> u32 {
    ((turns - turns.floor()) * 4_294_967_296.0) as i64 as u32
}

impl Phase {
    /// For turns of a number of 2^24. Exact to some 2^-32 turns, for up to 2^28 turns.
    fn new(turns: f64) -> Phase {
        let turns = turns * 256.0;
        let whole = turns.floor();
        Phase { whole: whole as i64 as u32, rest: (turns - whole) as f32 }
    }

    #[inline(always)]
    fn of<S: Simd>(self, simd: S, n: U<S>) -> U<S> {
        n * U::<S>::splat(simd, self.whole) + (float(simd, n) * self.rest).to_int::<S::i32s>().bitcast::<U<S>>()
    }
}

/// The sine of 2^-32 turns.
#[inline(always)]
fn sine<S: Simd>(simd: S, turns: U<S>) -> F<S> {
    math::sin(simd, float(simd, turns) * (TAU / WHOLE))
}

impl Snow {
    /// Flakes at `time` seconds around `eye`, after the wind has carried them by `wind` metres, both as exact as time is.
    /// `share` of them are there.
    pub fn new(flakes: &Flakes, time: f64, eye: DVec3, wind: DVec3, share: f32) -> Snow {
        let carried = (wind - DVec3::Y * (flakes.fall[0] * time) - eye) / flakes.extent.as_dvec3();
        let pace = time / std::f64::consts::TAU;
        Snow {
            flakes: *flakes,
            // So that all are there at 1.
            share: share * (1.0 + FADE),
            carried: carried.to_array().map(wrapped),
            fallen: Phase::new(flakes.fall[1] * time / flakes.extent.y as f64),
            turned: wrapped(flakes.pace[0] * pace),
            turns: Phase::new(flakes.pace[1] * pace),
            calm: Calm { wind: Vec2::ZERO, height: 0.0, depth: 1.0 },
            streak: Vec3::ZERO,
        }
    }

    /// Flakes that there are, seen or not.
    pub fn count(&self) -> u32 {
        (self.share.min(1.0) * self.flakes.count as f32) as u32
    }

    /// Flakes number `i`.
    #[inline(always)]
    pub fn batch<S: Simd>(&self, simd: S, i: U<S>) -> Batch<S> {
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
            let lacks = math::exp2(simd, height) * calm.depth / (faster + flakes.fall[0] as f32);
            (x, z) = (x - lacks * calm.wind.x, z - lacks * calm.wind.y);
        }
        let x = place(simd, wide(simd, seed, i, 0), carried[0], x, flakes.extent.x);
        let z = place(simd, wide(simd, seed, i, 2), carried[2], z, flakes.extent.z);
        let at = V3 { x, y, z };
        let radius = float(simd, wide(simd, seed, i, flakes.by)) * (flakes.radius[1] * STEP) + flakes.radius[0];
        let away = one - (at.x * at.x + at.z * at.z) * (1.0 / (flakes.reach * flakes.reach));
        let mut alpha = away * flakes.opacity;
        // The last ones are about to come or go.
        let order = float(simd, i) * (-1.0 / (FADE * flakes.count as f32));
        alpha *= (order + self.share * (1.0 / FADE)).max(zero).min(one);
        let turn = [cos, sin, sin.abs() * 0.6 + 0.4];
        let mut streak = V3::splat(simd, self.streak);
        if BENCH {
            streak.y *= faster * (1.0 / flakes.fall[0] as f32) + 1.0;
        }
        Batch { at, radius, light: V3::splat(simd, Vec3::ZERO), alpha: alpha.max(zero), turn, streak }
    }
}

/// Share of the flakes that come or go at a time.
const FADE: f32 = 0.02;

/// Boxes or turns that numbers of 32 bits have as one.
const WHOLE: f32 = 4_294_967_296.0;

/// Where what has number `n` is along an edge of `extent` metres, `beside` metres from where it was carried: metres from
/// the box's middle.
#[inline(always)]
fn place<S: Simd>(simd: S, n: U<S>, carried: u32, beside: F<S>, extent: f32) -> F<S> {
    let beside = (beside * (WHOLE / extent)).to_int::<S::i32s>().bitcast::<U<S>>();
    float(simd, (n << 8) + carried + beside) * (extent / WHOLE)
}
