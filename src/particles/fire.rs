//! Flames and sparks: every particle lives, dies and is born again in a rhythm of its own.
//!
//! After the emitter of a fire for a game engine `[Fire08]`, whose particles also follow from their birth alone. Here
//! not even births are stored: what share of its life a particle has lived is the fraction of the time over the length
//! of its life, so at any instant the same number of particles is there, at all ages. A particle is born and dies
//! without light, so nothing pops.

use super::batch::Batch;
use super::lens::Lens;
use crate::cuts;
use crate::simd::hash::{STEP, wide};
use crate::simd::lanes::{F, Lane, U, V3, float};
use crate::simd::math::sin;
use crate::view::View;
use fearless_simd::prelude::*;
use glam::Vec3A;
use std::f32::consts::{FRAC_PI_2, TAU};

/// What a fire is made of. Pairs are the least and what chance adds at most or, where it says so, from birth to death.
#[derive(Clone, Copy, Debug)]
pub struct Flame {
    /// Length of a life, seconds.
    pub life: [f64; 2],
    /// Inner and outer radius of the level ring that particles start from, metres.
    pub ring: [f32; 2],
    /// The share by which that ring narrows during a life.
    pub narrows: f32,
    /// Metres by which flames lean aside per metre of their height, in waves that run upwards.
    pub leans: f32,
    /// The widest angle from straight up at which a particle sets out, radians.
    pub cone: f32,
    /// Speed at birth, metres per second.
    pub speed: [f32; 2],
    /// Speed at death as a share of that at birth.
    pub slows: f32,
    /// The way that hot air lifts it in the first second, metres. It grows with the square of the age.
    pub lift: f32,
    /// Radius from birth to death, metres.
    pub radius: [f32; 2],
    /// Linear light from birth to death. After a share x of the life it is multiplied by `30 x (1 - x)^2`.
    pub light: [Vec3A; 2],
}

/// A fire at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Fire {
    /// What it is made of.
    pub flame: Flame,
    /// The centre of its ring, metres.
    pub place: Vec3A,
    /// Factor of all lengths.
    pub scale: f32,
    /// Seconds.
    pub time: f64,
    /// The stream of random numbers.
    pub seed: u32,
    /// The number of its first particle in that stream.
    pub first: u32,
    /// The number of particles. A fraction is the share of the light that the last one has.
    pub count: f32,
    /// Factor of the light of each: one that stands for several has the light of all.
    pub weight: f32,
    /// Wind that carries its particles along, metres per second. None in the 64 kB build.
    pub wind: Vec3A,
    /// How they are seen.
    pub lens: Lens,
}

/// The least number of particles that is left of a fire, if it has as many: the light of fewer would flicker.
const LEAST: f32 = 128.0;

/// Waves by which flames lean: radians per metre of height, and turns per second.
const WAVES: f32 = 4.0;
const RATE: f64 = 1.1;

impl Fire {
    /// The same fire with fewer and brighter particles, which together have the light of all.
    ///
    /// The share `detail`, above 0, is drawn per pixel of the fire's height on the screen, and less again where the
    /// screen shows only a part of the fire. As that changes, particles come and go one after another.
    pub fn detailed(self, view: &View, detail: f32) -> Fire {
        let Flame { life, speed, slows, lift, .. } = self.flame;
        let life = (life[0] + 0.5 * life[1]) as f32;
        // The height that a middling particle rises in its life.
        let height = ((speed[0] + 0.5 * speed[1]) * (0.5 + 0.5 * slows) + life * lift) * life * self.scale;
        // The distance from its middle, and not along the view axis: a fire beside the view is as large as one in it.
        let away = view.camera().eye.distance(self.place + Vec3A::Y * (0.5 * height));
        let (pixels, half) = (height / (view.pixel() * away), view.screen().0.1);
        let share = (pixels.min(2.0 * half * half / pixels) * detail).max(LEAST / self.count).min(1.0);
        Fire { count: self.count * share, weight: self.weight / share, ..self }
    }

    /// The number of particles, seen or not.
    pub fn count(&self) -> u32 {
        self.count.ceil() as u32
    }

    /// The particles with the numbers `i`.
    #[inline(always)]
    pub(super) fn batch<S: Simd>(&self, simd: S, i: U<S>) -> Batch<S> {
        let Flame { radius, light, .. } = self.flame;
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let [x, life] = self.lived(simd, i + self.first);
        let at = self.at(simd, i + self.first, x, life);
        let left = one - x;
        // The light of the last one.
        let order = (-float(simd, i) + self.count).max(zero).min(one);
        let glow = x * left * left * (30.0 * self.weight) * order;
        let mut place = at * Lane(F::<S>::splat(simd, self.scale)) + V3::splat(simd, self.place);
        if cuts::PARAMETERS {
            place = place + V3::splat(simd, self.wind) * Lane(x * life);
        }
        Batch {
            at: place,
            radius: (x * (radius[1] - radius[0]) + radius[0]) * self.scale,
            light: (V3::splat(simd, light[0]) + V3::splat(simd, light[1] - light[0]) * Lane(x)) * Lane(glow),
            alpha: zero,
            turn: [one, zero, one],
            streak: at,
        }
    }

    /// The share of their lives that particles have lived, and the lengths of those lives in seconds.
    #[inline(always)]
    fn lived<S: Simd>(&self, simd: S, number: U<S>) -> [F<S>; 2] {
        let life = self.flame.life;
        let lanes = F::<S>::LEN;
        let (mut x, mut lives) = ([0.0; 16], [0.0; 16]);
        let (mut long, mut since) = ([0; 16], [0; 16]);
        wide(simd, self.seed, number, 0).store_slice(&mut long[..lanes]);
        wide(simd, self.seed, number, 1).store_slice(&mut since[..lanes]);
        for lane in 0..lanes {
            // In f64: many lives have passed, and only the fraction of one counts.
            let seconds = life[0] + life[1] * (long[lane] as f64 * STEP as f64);
            let lived = self.time / seconds + since[lane] as f64 * STEP as f64;
            (x[lane], lives[lane]) = ((lived - lived.floor()) as f32, seconds as f32);
        }
        [F::<S>::from_slice(simd, &x[..lanes]), F::<S>::from_slice(simd, &lives[..lanes])]
    }

    /// Where particles are after a share `x` of their lives, metres from the fire's place at scale 1.
    ///
    /// A particle sets out somewhere in the ring, in a direction somewhere in the cone, and is slowed evenly; hot air
    /// lifts it, and its flame leans.
    #[inline(always)]
    fn at<S: Simd>(&self, simd: S, number: U<S>, x: F<S>, life: F<S>) -> V3<S> {
        let Flame { ring, narrows, leans, cone, speed, slows, lift, .. } = self.flame;
        const QUARTER: f32 = FRAC_PI_2;
        let one = F::<S>::splat(simd, 1.0);
        let around = chance(simd, self.seed, number, 2) * TAU;
        // By the root, which spreads directions and places evenly over an area.
        let away = chance(simd, self.seed, number, 3).sqrt() * cone;
        let [inner, outer] = ring.map(|radius| radius * radius);
        let from = chance(simd, self.seed, number, 4) * (outer - inner) + inner;
        let from = from.sqrt() * (one - x * narrows);
        let beside = chance(simd, self.seed, number, 5) * TAU;
        let first = chance(simd, self.seed, number, 6) * speed[1] + speed[0];
        let way = life * first * (x + x * x * ((slows - 1.0) * 0.5));
        let level = sin(simd, away) * way;
        let age = x * life;
        let y = way * sin(simd, away + QUARTER) + age * age * lift;
        let mut lean = F::<S>::splat(simd, 0.0);
        if leans > 0.0 {
            // Each fire's waves are its own.
            let turns = self.time * RATE + self.place.x as f64;
            let wave = (turns - turns.floor()) as f32 * TAU;
            lean = sin(simd, y * -WAVES + wave) * y * leans;
        }
        V3 {
            x: level * sin(simd, around + QUARTER) + from * sin(simd, beside + QUARTER) + lean,
            y,
            z: level * sin(simd, around) + from * sin(simd, beside),
        }
    }
}

/// Random number `k` of things `i`, at least 0 and below 1.
#[inline(always)]
fn chance<S: Simd>(simd: S, seed: u32, i: U<S>, k: u32) -> F<S> {
    float(simd, wide(simd, seed, i, k)) * STEP
}
