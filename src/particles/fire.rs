//! Flames, sparks and smoke: each particle lives, ends and begins again in its own time, so that as many are there at any
//! instant and none needs to be emitted. After the emitter of a fire for a game engine (thesis D).

use super::Batch;
use super::sprite::Lens;
use crate::cuts;
use crate::simd::hash::{STEP, wide};
use crate::simd::lanes::{F, Lane, U, V3, float};
use crate::simd::math;
use crate::view::View;
use fearless_simd::prelude::*;
use glam::Vec3;
use std::f32::consts::{FRAC_PI_2, TAU};

/// What a fire is made of. Pairs are the least and what chance adds at most, or, where it is said so, from birth to death.
#[derive(Clone, Copy, Debug)]
pub struct Flame {
    /// Seconds that a particle lives.
    pub life: [f64; 2],
    /// Inner and outer radius of the level ring that it starts from, metres.
    pub ring: [f32; 2],
    /// By what share that ring narrows as they live.
    pub narrows: f32,
    /// Metres that flames lean aside for each metre of their height, in waves that run upwards.
    pub leans: f32,
    /// The widest angle from straight up to where it sets out, radians.
    pub cone: f32,
    /// Its first speed, metres a second.
    pub speed: [f32; 2],
    /// Its last speed, as a share of the first.
    pub slows: f32,
    /// Metres that it has been lifted after a second, growing with the square.
    pub lift: f32,
    /// Its radius from birth to death, metres.
    pub radius: [f32; 2],
    /// Its light from birth to death, times `30 x (1 - x)^2` after a share x of its life.
    pub light: [Vec3; 2],
    /// Share of the light behind that it takes, times the same.
    pub alpha: f32,
}

/// A fire at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Fire {
    /// What it is made of.
    pub flame: Flame,
    /// Where, metres.
    pub place: Vec3,
    /// Its size, and that of its parts.
    pub scale: f32,
    /// Seconds.
    pub time: f64,
    /// Tells its chance from another's.
    pub seed: u32,
    /// The number of its first particle.
    pub first: u32,
    /// How many particles there are.
    pub count: f32,
    /// How bright each is: what is drawn for several has the light of all.
    pub weight: f32,
    /// Wind that carries its particles along, metres per second. None in the 64 kB build.
    pub wind: Vec3,
    /// How they are seen.
    pub lens: Lens,
}

impl Fire {
    /// The same fire with fewer and brighter particles, which together have the light of all: a share of `detail` for each
    /// pixel of its height, and less again where the screen shows only a part of it. As that changes they come and go one
    /// after another.
    ///
    /// For a `detail` above 0. What smoke takes of the light behind is then only nearly that of all.
    pub fn detailed(self, view: &View, detail: f32) -> Fire {
        let Flame { life, speed, slows, lift, .. } = self.flame;
        let life = (life[0] + 0.5 * life[1]) as f32;
        // How high a middling particle rises in its life.
        let height = ((speed[0] + 0.5 * speed[1]) * (0.5 + 0.5 * slows) + life * lift) * life * self.scale;
        // To the middle, and along no axis: a fire beside the view is as large as before it.
        let away = view.camera().eye.distance(self.place + Vec3::Y * (0.5 * height));
        let (pixels, half) = (height / (view.pixel() * away), view.screen().0.1);
        let share = (pixels.min(2.0 * half * half / pixels) * detail).max(LEAST / self.count).min(1.0);
        Fire { count: self.count * share, weight: self.weight / share, ..self }
    }

    /// Particles that there are, seen or not.
    pub fn count(&self) -> u32 {
        self.count.ceil() as u32
    }

    /// Particles number `i`.
    #[inline(always)]
    pub fn batch<S: Simd>(&self, simd: S, i: U<S>) -> Batch<S> {
        let Flame { life, ring, narrows, leans, cone, speed, slows, lift, radius, light, alpha } = self.flame;
        // Each fire's waves are its own.
        let turns = self.time * 1.1 + self.place.x as f64;
        let wave = (turns - turns.floor()) as f32 * TAU;
        let zero = F::<S>::splat(simd, 0.0);
        let one = F::<S>::splat(simd, 1.0);
        let number = i + self.first;
        let (mut x, mut lives) = ([0.0; 16], [0.0; 16]);
        let (mut long, mut since) = ([0; 16], [0; 16]);
        wide(simd, self.seed, number, 0).store_slice(&mut long[..F::<S>::LEN]);
        wide(simd, self.seed, number, 1).store_slice(&mut since[..F::<S>::LEN]);
        for lane in 0..F::<S>::LEN {
            // In f64, since many lives have passed.
            let seconds = life[0] + life[1] * (long[lane] as f64 * STEP as f64);
            let lived = self.time / seconds + since[lane] as f64 * STEP as f64;
            (x[lane], lives[lane]) = ((lived - lived.floor()) as f32, seconds as f32);
        }
        let (x, life) = (F::<S>::from_slice(simd, &x[..F::<S>::LEN]), F::<S>::from_slice(simd, &lives[..F::<S>::LEN]));
        let around = chance(simd, self.seed, number, 2) * TAU;
        let away = chance(simd, self.seed, number, 3).sqrt() * cone;
        let [inner, outer] = ring.map(|radius| radius * radius);
        let from = chance(simd, self.seed, number, 4) * (outer - inner) + inner;
        let from = from.sqrt() * (one - x * narrows);
        let beside = chance(simd, self.seed, number, 5) * TAU;
        let first = chance(simd, self.seed, number, 6) * speed[1] + speed[0];
        let way = life * first * (x + x * x * ((slows - 1.0) * 0.5));
        let level = math::sin(simd, away) * way;
        let age = x * life;
        let quarter = FRAC_PI_2;
        let y = way * math::sin(simd, away + quarter) + age * age * lift;
        let mut lean = zero;
        if leans > 0.0 {
            lean = math::sin(simd, y * -WAVES + wave) * y * leans;
        }
        let at = V3 {
            x: level * math::sin(simd, around + quarter) + from * math::sin(simd, beside + quarter) + lean,
            y,
            z: level * math::sin(simd, around) + from * math::sin(simd, beside),
        };
        let left = one - x;
        let order = (-float(simd, i) + self.count).max(zero).min(one);
        let glow = x * left * left * (30.0 * self.weight) * order;
        let mut at = at * Lane(F::<S>::splat(simd, self.scale)) + V3::splat(simd, self.place);
        if cuts::PARAMETERS {
            at = at + V3::splat(simd, self.wind) * Lane(age);
        }
        Batch {
            at,
            radius: (x * (radius[1] - radius[0]) + radius[0]) * self.scale,
            light: (V3::splat(simd, light[0]) + V3::splat(simd, light[1] - light[0]) * Lane(x)) * Lane(glow),
            alpha: (glow * alpha).min(one),
            turn: [one, zero, one],
            streak: at,
        }
    }
}

/// Particles that a fire has at least, if it has as many: the light of fewer would flicker.
const LEAST: f32 = 128.0;

/// Radians of those waves for each metre.
const WAVES: f32 = 4.0;

/// A number from 0 to 1.
#[inline(always)]
fn chance<S: Simd>(simd: S, seed: u32, i: U<S>, k: u32) -> F<S> {
    float(simd, wide(simd, seed, i, k)) * STEP
}
