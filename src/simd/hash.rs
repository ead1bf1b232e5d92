//! Random numbers without a state: the same for the same counter, whatever was drawn before.

use crate::simd::lanes::U;
use fearless_simd::prelude::*;

/// The output function of PCG-RXS-M-XS-32 after one step of its generator.
///
/// Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 2020, found it the best of the short ones.
pub fn pcg(n: u32) -> u32 {
    let s = n.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let w = ((s >> ((s >> 28) + 4)) ^ s).wrapping_mul(277_803_737);
    (w >> 22) ^ w
}

/// 2^-24: what is here from 0 to 1 is a multiple of it.
pub const STEP: f32 = 1.0 / 16_777_216.0;

/// Number `k` below 8 of thing `i` in stream `seed`: 0 to 1, without 1; a multiple of [`STEP`], so exact.
#[inline(never)] // Called in many places, never in a hot loop.
pub fn rnd(seed: u32, i: u32, k: u32) -> f32 {
    let n = (seed << 24).wrapping_add(8 * i).wrapping_add(k);
    (pcg(n) >> 8) as f32 * STEP
}

/// Numbers by counters for the particles of a vector: what [`rnd`] has of things `i` in stream `seed` for number `k`, as
/// whole numbers below 2^24.
#[inline(always)]
pub fn wide<S: Simd>(simd: S, seed: u32, i: U<S>, k: u32) -> U<S> {
    let n = (i << 3) + (seed << 24).wrapping_add(k);
    let s = n * U::<S>::splat(simd, 747_796_405) + 2_891_336_453;
    let w = ((s >> ((s >> 28) + 4)) ^ s) * U::<S>::splat(simd, 277_803_737);
    ((w >> 22) ^ w) >> 8
}
