//! Random numbers without a state: a hash of a counter, so that a number depends on nothing that was drawn before it.
//!
//! The hash is one step of O'Neill's generator PCG-RXS-M-XS-32 `[ONeill14]`, which `[JarzynskiOlano20]` found the best
//! of the short ones.

use crate::simd::lanes::U;
use fearless_simd::prelude::*;

/// Factor and summand of the generator's step, and the factor of its output function.
const MULTIPLIER: u32 = 747_796_405;
const INCREMENT: u32 = 2_891_336_453;
const OUTPUT: u32 = 277_803_737;

/// The output of PCG-RXS-M-XS-32 after one step from the state `n`: a bijection of the 32-bit numbers.
pub fn pcg(n: u32) -> u32 {
    let s = n.wrapping_mul(MULTIPLIER).wrapping_add(INCREMENT);
    let w = ((s >> ((s >> 28) + 4)) ^ s).wrapping_mul(OUTPUT);
    (w >> 22) ^ w
}

/// 2^-24, of which every random number of this module between 0 and 1 is a multiple.
pub const STEP: f32 = 1.0 / 16_777_216.0;

/// Random number `k` of thing `i` in stream `seed`: at least 0 and below 1, a multiple of [`STEP`] and so exact.
///
/// `k` is below 8, `i` below 2^21, `seed` below 256; beyond that things share their numbers.
#[inline(never)] // Called in many places, never in a hot loop.
pub fn rnd(seed: u32, i: u32, k: u32) -> f32 {
    let n = (seed << 24).wrapping_add(8 * i).wrapping_add(k);
    (pcg(n) >> 8) as f32 * STEP
}

/// [`rnd`] of each lane's thing `i`, as whole numbers below 2^24: times [`STEP`] they are what [`rnd`] gives.
#[inline(always)]
pub fn wide<S: Simd>(simd: S, seed: u32, i: U<S>, k: u32) -> U<S> {
    let n = (i << 3) + (seed << 24).wrapping_add(k);
    let s = n * U::<S>::splat(simd, MULTIPLIER) + INCREMENT;
    let w = ((s >> ((s >> 28) + 4)) ^ s) * U::<S>::splat(simd, OUTPUT);
    ((w >> 22) ^ w) >> 8
}
