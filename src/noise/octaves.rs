//! Noise for blocks of points at the SIMD level that is there, and sums of its octaves.
//!
//! A pixel whose picture on a surface covers several cells of an octave should show that octave's mean, not its value
//! at one point, or it shimmers. So each octave may fade with the length `L` of the footprint, in the octave's own
//! cells, by `1 / (1 + 0.4 L^2 + 0.1 L^4)`.
//!
//! The best linear predictor of the mean over a square of side `L` keeps 0.87, 0.59, 0.32, 0.16 and 0.05 at 0.5, 1, 1.5, 2
//! and 3 (`tests/frame/noise.rs`), within 0.02 of `1 / (1 + 0.5 L^2 + 0.2 L^4)`. This keeps up to 0.1 more, as
//! waves of marble and wood follow the noise, and their own damping fades them once more.

use super::wide;
#[cfg(target_arch = "x86_64")]
use super::{avx2, avx512};
use crate::simd::block::{BLOCK, load, store, vectors};
use crate::simd::level::best;
#[cfg(target_arch = "x86_64")]
use fearless_simd::Level;
use fearless_simd::{dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3A;

/// Standard deviation of noise.
const SIGMA: f32 = 0.27;
/// Mean of the absolute value of noise.
const MEAN: f32 = 0.21;
/// Cells of an octave along the footprint from which on it is left out: less than a thirtieth of it would be left.
const LONG: f32 = 4.0;

/// Memory for a block of noise, in which no value survives. It is passed on because it would be cleared for each block.
#[derive(Default)]
pub struct Scratch {
    #[cfg(target_arch = "x86_64")]
    avx2: avx2::Scratch,
}

/// Perlin's improved noise at the first `count` points of a block, whose coordinates are multiplied by `zoom`: the same
/// bits as [`noise`](super::noise) there. What is written behind these is of no meaning.
#[simd]
#[allow(clippy::too_many_arguments)]
pub fn noise_block<S: Simd>(
    simd: S,
    x: &[f32; BLOCK],
    y: &[f32; BLOCK],
    z: &[f32; BLOCK],
    zoom: f32,
    count: usize,
    scratch: &mut Scratch,
    out: &mut [f32; BLOCK],
) {
    match simd.level() {
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(simd) => avx512::noise64(simd, [x, y, z], zoom, count, out),
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(simd) => avx2::noise64(simd, [x, y, z], zoom, count, &mut scratch.avx2, out),
        _ => wide::noise64(simd, [x, y, z], zoom, count, out),
    }
}

/// What octaves of noise are averaged over at each point.
pub struct Footprint<'a> {
    /// Length of the pixel's picture on the surface, lattice units of the first octave.
    pub length: &'a [f32; BLOCK],
    /// The variance that the sum loses by the averaging is added to this.
    pub lost: &'a mut [f32; BLOCK],
}

/// [`fbm`](super::fbm) at the first `count` points of a block, or [`turbulence`](super::turbulence) where noises are
/// `absolute`. What is written behind these is of no meaning.
///
/// Without a footprint these are the same bits. With one each octave fades to its mean, as the module says.
#[simd]
pub fn octaves_block<S: Simd>(
    simd: S,
    [x, y, z]: [&[f32; BLOCK]; 3],
    octaves: u32,
    absolute: bool,
    count: usize,
    mut footprint: Option<Footprint>,
    out: &mut [f32; BLOCK],
) {
    let mean = if absolute { MEAN } else { 0.0 };
    let mut shortest = 0.0;
    if let Some(footprint) = &footprint {
        shortest = least(simd, footprint.length);
    }
    let (mut amplitude, mut zoom) = (0.5, 1.0);
    *out = [0.0; BLOCK];
    let (mut octave, mut scratch) = ([0.0; BLOCK], Scratch::default());
    for _ in 0..octaves {
        if shortest * zoom < LONG {
            noise_block(simd, x, y, z, zoom, count, &mut scratch, &mut octave);
        } else {
            octave = [0.0; BLOCK];
        }
        let mut i = 0;
        while i < vectors(count, S::f32s::LEN) {
            let mut n: S::f32s = load(simd, &octave, i);
            if absolute {
                n = n.abs();
            }
            if let Some(footprint) = &mut footprint {
                n = faded(simd, n, mean, amplitude, zoom, footprint, i);
            }
            store(load::<S, S::f32s>(simd, out, i) + n * amplitude, out, i);
            i += 1;
        }
        amplitude *= 0.5;
        zoom *= 2.0;
    }
}

/// How many of `octaves` [`octaves_block`] evaluates in a block whose shortest footprint has the length `shortest`, lattice
/// units of the first octave: all of them where it is 0.
#[cfg(feature = "full")]
pub fn evaluated(octaves: u32, shortest: f32) -> u32 {
    (0..octaves).take_while(|octave| shortest * 2f32.powi(*octave as i32) < LONG).count() as u32
}

/// The least number of a block.
#[inline(always)]
fn least<S: Simd>(simd: S, x: &[f32; BLOCK]) -> f32 {
    let mut least: S::f32s = load(simd, x, 0);
    let mut i = 1;
    while i < BLOCK / S::f32s::LEN {
        least = least.min(load::<S, S::f32s>(simd, x, i));
        i += 1;
    }
    least.reduce_min()
}

/// Vector `i` of an octave's noise `n` faded to `mean`; what that takes of its variance is added to what is lost.
#[inline(always)]
fn faded<S: Simd>(
    simd: S,
    n: S::f32s,
    mean: f32,
    amplitude: f32,
    zoom: f32,
    footprint: &mut Footprint,
    i: usize,
) -> S::f32s {
    let one = S::f32s::splat(simd, 1.0);
    let length = load::<S, S::f32s>(simd, footprint.length, i) * zoom;
    let square = length * length;
    let keep = one / (square * (square * 0.1 + 0.4) + 1.0);
    let gone = one - keep;
    let variance = gone * (amplitude * amplitude * SIGMA * SIGMA);
    store(load::<S, S::f32s>(simd, footprint.lost, i) + variance, footprint.lost, i);
    n * keep + gone * mean
}

/// [`fbm`](super::fbm) at one point, or [`turbulence`](super::turbulence) where noises are `absolute`: the same bits
/// for at most 8 `octaves`, by way of [`noise_block`], so that the 64 kB build needs no scalar kernel.
///
/// Panics for more than [`BLOCK`] octaves; octaves from the ninth on are 0.
#[inline(never)] // Called in many places, never in a hot loop.
pub fn octaves(p: Vec3A, octaves: usize, absolute: bool) -> f32 {
    // Each octave is one point of the block.
    let [mut x, mut y, mut z, mut n] = [[0.0; BLOCK]; 4];
    let mut zoomed = p;
    for k in 0..8 {
        [x[k], y[k], z[k]] = zoomed.to_array();
        zoomed *= 2.0;
    }
    dispatch!(best(), simd => noise_block(simd, &x, &y, &z, 1.0, octaves, &mut Scratch::default(), &mut n));
    let (mut sum, mut amplitude) = (0.0, 0.5);
    for n in &n[..octaves] {
        sum += amplitude * if absolute { n.abs() } else { *n };
        amplitude *= 0.5;
    }
    sum
}
