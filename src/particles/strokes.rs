//! Writing made of light: sparks along lines.

use super::batch::Batch;
use super::lens::Lens;
use crate::simd::hash::{STEP, wide};
use crate::simd::lanes::{F, Lane, U, V3, float};
use fearless_simd::prelude::*;
use glam::Vec3A;

/// Lines of sparks at an instant.
#[derive(Clone, Debug)]
pub struct Strokes {
    /// Both ends of each line from the eye, metres.
    pub lines: Vec<[Vec3A; 2]>,
    /// Sparks per line.
    pub each: u32,
    /// How far sparks are scattered around their line: by at most three times this along each axis, metres.
    pub spread: f32,
    /// Radius of a spark, metres.
    pub radius: f32,
    /// Linear light of a spark.
    pub light: Vec3A,
    /// How they are seen.
    pub lens: Lens,
}

impl Strokes {
    /// The number of sparks, seen or not.
    pub fn count(&self) -> u32 {
        self.lines.len() as u32 * self.each
    }

    /// The sparks with the numbers `i`, which follow one another.
    #[inline(always)]
    pub(super) fn batch<S: Simd>(&self, simd: S, i: U<S>) -> Batch<S> {
        let [mut x, mut y, mut z] = [[0.0; 16]; 3];
        for lane in 0..F::<S>::LEN {
            let number = i[0] + lane as u32;
            let Some([from, to]) = self.lines.get((number / self.each) as usize) else { break };
            // Multiples of the golden ratio are spread evenly over a line.
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
        // By the square of the distance in the cube of chance, so that most are near their line.
        let far = off.dot(off) * self.spread;
        let at = V3 { x: load(x), y: load(y), z: load(z) } + off * Lane(far);
        let light = V3::splat(simd, self.light);
        Batch { at, radius: one * self.radius, light, alpha: zero, turn: [one, zero, one], streak: at }
    }
}
