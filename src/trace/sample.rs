//! What one eye ray saw: what a corner of the grid remembers.
//!
//! A sample is a signature, which is compared, and a row of numbers, which are interpolated. The numbers lie in one array
//! rather than in fields so that whole vectors of them can be summed and mixed at once.

use crate::simd::lanes::F;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Textured hits that a sample can remember. Later ones, the deepest and of least weight, are looked up on the spot.
pub const REMEMBERED: usize = 4;

/// Where the inverse depth of the first hit stands among the numbers of a sample: behind its light.
pub const INV_DEPTH: usize = 3;
/// Numbers of a sample before those of its textured hits: light and inverse depth.
pub const PLAIN: usize = 4;

/// Where the gain stands among the numbers of a textured hit (three numbers).
pub const GAIN: usize = 0;
/// Where the homogeneous hit point stands among them (three numbers).
pub const POINT: usize = 3;
/// Where the inverse depth of the hit stands among them, by which the hit point is multiplied.
pub const HIT_INV_DEPTH: usize = 6;
/// Numbers of a textured hit.
pub const HIT: usize = 7;

/// Numbers of a sample.
pub const NUMBERS: usize = PLAIN + HIT * REMEMBERED;

/// What one eye ray saw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Hash of the whole tree of rays: every object hit, the path that led there, and the state of every light at the hit.
    pub path_signature: u32,
    /// The number of textured hits that are remembered.
    pub count: u32,
    /// The object of each textured hit.
    pub object: [u32; REMEMBERED],
    /// Linear light that depends on no texture (highlights, plain surfaces, background), then the inverse depth of the
    /// first hit: 1 / distance in lengths of the unnormalised eye ray, or 0 where nothing is hit.
    ///
    /// Then for each textured hit: its gain, which is the light that would reach the eye from there off a white surface;
    /// the hit point times its inverse depth; and its inverse depth, 1 / length of the path from the eye in the same unit.
    /// In this homogeneous form a point on a plane is affine in screen space, exactly, also seen in flat mirrors.
    pub numbers: [f32; NUMBERS],
}

impl Default for Sample {
    fn default() -> Sample {
        Sample { path_signature: 0, count: 0, object: [0; REMEMBERED], numbers: [0.0; NUMBERS] }
    }
}

impl Sample {
    /// 1 / distance of the first hit along the view axis, 0 for the background.
    pub fn inv_depth(&self) -> f32 {
        self.numbers[INV_DEPTH]
    }

    /// The object and the numbers of each textured hit.
    #[inline(always)]
    pub fn hits(&self) -> impl Iterator<Item = (u32, &[f32; HIT])> {
        self.object.iter().copied().zip(hits(&self.numbers)).take(self.count as usize)
    }

    /// Makes this the sample in the middle of samples that have one path signature.
    #[inline(always)]
    pub fn set_mean<S: Simd>(&mut self, simd: S, samples: [&Sample; 4]) {
        (self.path_signature, self.count, self.object) =
            (samples[0].path_signature, samples[0].count, samples[0].object);
        mean(simd, samples, &mut self.numbers);
    }

    /// The count of numbers in use.
    pub fn used(&self) -> usize {
        PLAIN + HIT * self.count as usize
    }
}

/// Writes the means of the numbers of samples that have one path signature.
#[simd]
pub fn mean<S: Simd>(simd: S, samples: [&Sample; 4], mean: &mut [f32; NUMBERS]) {
    for i in (0..samples[0].used()).step_by(F::<S>::LEN) {
        let sum = load(simd, &samples[0].numbers, i)
            + load(simd, &samples[1].numbers, i)
            + load(simd, &samples[2].numbers, i)
            + load(simd, &samples[3].numbers, i);
        store::<S>(sum * 0.25, mean, i);
    }
}

/// The vector of numbers that begins at `i`.
#[inline(always)]
pub fn load<S: Simd>(simd: S, numbers: &[f32; NUMBERS], i: usize) -> F<S> {
    F::<S>::from_slice(simd, &numbers[i..i + F::<S>::LEN])
}

/// Writes the vector of numbers that begins at `i`.
#[inline(always)]
pub fn store<S: Simd>(value: F<S>, numbers: &mut [f32; NUMBERS], i: usize) {
    value.store_slice(&mut numbers[i..i + F::<S>::LEN]);
}

/// The numbers of a sample by textured hit; those beyond its count mean nothing.
#[inline(always)]
pub fn hits(numbers: &[f32; NUMBERS]) -> &[[f32; HIT]] {
    numbers[PLAIN..].as_chunks::<HIT>().0
}

/// The point of a textured hit, metres.
#[inline(always)]
pub fn hit_point(hit: &[f32; HIT]) -> [f32; 3] {
    let k = 1.0 / hit[HIT_INV_DEPTH];
    [hit[POINT] * k, hit[POINT + 1] * k, hit[POINT + 2] * k]
}

// Numbers are read and written in full vectors of any width, so their count is a multiple of the widest.
const _: () = assert!(NUMBERS.is_multiple_of(16));
