//! Sparks along lines: writing made of light.

use super::Batch;
use super::sprite::Lens;
use crate::simd::hash::{STEP, wide};
use crate::simd::lanes::{F, Lane, U, V3, float};
use fearless_simd::prelude::*;
use glam::Vec3;

/// Lines at an instant.
#[derive(Clone, Debug)]
pub struct Strokes {
    /// From where to where, metres.
    pub lines: Vec<[Vec3; 2]>,
    /// Sparks on each.
    pub each: u32,
    /// How far off they are at most, along each axis, metres.
    pub spread: f32,
    /// Their radius, metres.
    pub radius: f32,
    /// The light of each.
    pub light: Vec3,
    /// How they are seen.
    pub lens: Lens,
}

impl Strokes {
    /// Sparks that there are, seen or not.
    pub fn count(&self) -> u32 {
        self.lines.len() as u32 * self.each
    }

    /// Sparks number `i`.
    #[inline(always)]
    pub fn batch<S: Simd>(&self, simd: S, i: U<S>) -> Batch<S> {
        let [mut x, mut y, mut z] = [[0.0; 16]; 3];
        for lane in 0..F::<S>::LEN {
            let number = i[0] + lane as u32;
            let Some([from, to]) = self.lines.get((number / self.each) as usize) else { break };
            // Multiples of the golden ratio lie evenly.
            let along = (number.wrapping_mul(0x9e37_79b9) >> 8) as f32 * STEP;
            [x[lane], y[lane], z[lane]] = from.lerp(*to, along).to_array();
        }
        let load = |of: [f32; 16]| F::<S>::from_slice(simd, &of[..F::<S>::LEN]);
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let off = V3 {
            x: float(simd, wide(simd, 0, i, 0)) * (2.0 * STEP) - one,
            y: float(simd, wide(simd, 0, i, 1)) * (2.0 * STEP) - one,
            z: float(simd, wide(simd, 0, i, 2)) * (2.0 * STEP) - one,
        };
        // Most are near.
        let far = off.dot(off) * self.spread;
        let at = V3 { x: load(x), y: load(y), z: load(z) } + off * Lane(far);
        let light = V3::splat(simd, self.light);
        Batch { at, radius: one * self.radius, light, alpha: zero, turn: [one, zero, one], streak: at }
    }
}
