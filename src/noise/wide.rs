//! Noise for 64 points at once, the same bits as the scalar truth at every SIMD level.

use super::PERMUTATION;
use crate::simd::block::{BLOCK, load, store};
#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Avx2, Level, f32x8, u32x8};
use fearless_simd::{Simd, prelude::*};
use fearless_simd_macros::simd;

/// The gradient of each hash: components of -1, 0 or 1 as signed fields of two bits, x lowest.
static GRADIENTS: [u8; 257] = {
    // x, y and z of 1 are 1, 4 and 16, of -1 3, 12 and 48; in the order of Perlin's `h & 15`.
    const CODES: [u8; 16] =
        [0x05, 0x07, 0x0d, 0x0f, 0x11, 0x13, 0x31, 0x33, 0x14, 0x1c, 0x34, 0x3c, 0x05, 0x1c, 0x07, 0x3c];
    let mut codes = [0; 257];
    let mut i = 0;
    while i < 257 {
        codes[i] = CODES[PERMUTATION[i] as usize & 15];
        i += 1;
    }
    codes
};

/// Entry `i` modulo 256 and, in the high byte, the next one: one load. In 32 bits, since bytes in registers would make each
/// lookup wait for the last.
#[inline(always)]
fn at(table: &[u8; 257], i: u32) -> u32 {
    let i = i as usize & 255;
    u16::from_le_bytes([table[i], table[i + 1]]) as u32
}

/// [`super::fade`], wide.
#[inline(always)]
pub(super) fn fade<S: Simd, F: SimdFloat<S, Element = f32>>(t: F) -> F {
    let d = t - 0.5;
    let q = d * d;
    d * (q * (q * 6.0 - 5.0) + 1.875) + 0.5
}

/// [`super::lerp`], wide.
#[inline(always)]
pub(super) fn lerp<S: Simd, F: SimdFloat<S, Element = f32>>(t: F, a: F, b: F) -> F {
    a + t * (b - a)
}

/// Perlin's improved noise at 64 points times `zoom`: the bits of [`super::noise`] there.
#[simd]
pub fn noise_block<S: Simd>(
    simd: S,
    x: &[f32; BLOCK],
    y: &[f32; BLOCK],
    z: &[f32; BLOCK],
    zoom: f32,
    out: &mut [f32; BLOCK],
) {
    match simd.level() {
        #[cfg(target_arch = "x86_64")]
        Level::Avx512(simd) => super::avx512::noise64(simd, x, y, z, zoom, out),
        #[cfg(target_arch = "x86_64")]
        Level::Avx2(avx2) => noise64(
            avx2,
            [x, y, z],
            zoom,
            out,
            #[inline(always)]
            |codes| component_avx2(avx2, codes),
        ),
        _ => noise64(
            simd,
            [x, y, z],
            zoom,
            out,
            #[inline(always)]
            |codes| ((codes << 30).bitcast::<S::i32s>() >> 30).to_float(),
        ),
    }
}

#[cfg(target_arch = "x86_64")]
fearless_simd::kernel!(
    /// The low two bits of each lane, signed, as a float.
    #[inline]
    fn component_avx2(simd: Avx2, codes: u32x8<Avx2>) -> f32x8<Avx2> {
        let values = _mm256_setr_ps(0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0);
        _mm256_permutevar_ps(values, codes.into()).simd_into(simd)
    }
);

/// Noise for 64 points: cells and hashes one point at a time, all else wide.
///
/// `component` gives the float of the signed field in the low two bits of each lane. Gathers would not be faster than
/// loads of pairs, and byte shuffles of a table of 256 only are from AVX-512 on.
#[inline(always)]
fn noise64<S: Simd>(
    simd: S,
    [x, y, z]: [&[f32; BLOCK]; 3],
    zoom: f32,
    out: &mut [f32; BLOCK],
    component: impl Fn(S::u32s) -> S::f32s,
) {
    let [mut ix, mut iy, mut iz] = [[0u32; BLOCK]; 3];
    cells(simd, x, zoom, &mut ix);
    cells(simd, y, zoom, &mut iy);
    cells(simd, z, zoom, &mut iz);
    let mut codes = [[0u32; BLOCK]; 4];
    for i in 0..BLOCK {
        let (iy, iz) = (iy[i], iz[i]);
        let ab = at(&PERMUTATION, ix[i]);
        let (a, b) = (at(&PERMUTATION, ab + iy), at(&PERMUTATION, (ab >> 8) + iy));
        codes[0][i] = at(&GRADIENTS, a + iz);
        codes[1][i] = at(&GRADIENTS, b + iz);
        codes[2][i] = at(&GRADIENTS, (a >> 8) + iz);
        codes[3][i] = at(&GRADIENTS, (b >> 8) + iz);
    }

    let mut i = 0;
    while i < BLOCK / S::f32s::LEN {
        let (x, y, z): (S::f32s, S::f32s, S::f32s) = (load(simd, x, i), load(simd, y, i), load(simd, z, i));
        let (x, y, z) = (x * zoom, y * zoom, z * zoom);
        let (x, y, z) = (x - x.floor(), y - y.floor(), z - z.floor());
        let (u, v, w) = (fade(x), fade(y), fade(z));
        let (aa, ba): (S::u32s, S::u32s) = (load(simd, &codes[0], i), load(simd, &codes[1], i));
        let (ab, bb): (S::u32s, S::u32s) = (load(simd, &codes[2], i), load(simd, &codes[3], i));
        let bottom = face([aa, ba, ab, bb], x, y, z, u, v, &component);
        let top = face([aa >> 8, ba >> 8, ab >> 8, bb >> 8], x, y, z - 1.0, u, v, &component);
        store(lerp(w, bottom, top) + 0.0, out, i);
        i += 1;
    }
}

/// Noise of the four corners of one face of a cell, at the offset (x, y, z) from the first.
#[inline(always)]
fn face<S: Simd, F: SimdFloat<S, Element = f32>, C: SimdInt<S>>(
    [aa, ba, ab, bb]: [C; 4],
    x: F,
    y: F,
    z: F,
    u: F,
    v: F,
    component: &impl Fn(C) -> F,
) -> F {
    let (x1, y1) = (x - 1.0, y - 1.0);
    let near = lerp(u, gradient(aa, x, y, z, component), gradient(ba, x1, y, z, component));
    // A floor on the lattice, y = 0 throughout: the far half has no weight.
    if y.simd_eq(0.0).all_true() {
        return near;
    }
    let far = lerp(u, gradient(ab, x, y1, z, component), gradient(bb, x1, y1, z, component));
    lerp(v, near, far)
}

/// The product of a gradient and an offset: one of the three products is zero, so this is Perlin's sum of two.
#[inline(always)]
fn gradient<S: Simd, F: SimdFloat<S, Element = f32>, C: SimdInt<S>>(
    code: C,
    x: F,
    y: F,
    z: F,
    component: &impl Fn(C) -> F,
) -> F {
    component(code) * x + (component(code >> 2) * y + component(code >> 4) * z)
}

/// The cells of coordinates times `zoom`, modulo 256.
#[inline(always)]
fn cells<S: Simd>(simd: S, x: &[f32; BLOCK], zoom: f32, cells: &mut [u32; BLOCK]) {
    // The x86 conversion gives 0x80000000 where it overflows: the right byte, since such floats are multiples of 256.
    // Others saturate.
    let saturates = !cfg!(target_arch = "x86_64") || simd.level().is_fallback();
    let mut i = 0;
    while i < BLOCK / S::f32s::LEN {
        let mut cell: S::f32s = load(simd, x, i);
        cell = (cell * zoom).floor();
        if saturates {
            cell -= (cell * (1.0 / 256.0)).floor() * 256.0;
        }
        store(cell.to_int::<S::i32s>().bitcast::<S::u32s>() & 255, cells, i);
        i += 1;
    }
}

/// What fades octaves of noise over the footprint of a pixel.
pub struct Fade<'a> {
    /// How long the footprint is, lattice units.
    pub footprint: &'a [f32; BLOCK],
    /// The variance that the fading took is added to this.
    pub lost: &'a mut [f32; BLOCK],
}

/// [`super::fbm`] at 64 points, or [`super::turbulence`] if noises are `absolute`: the same bits, unless they are faded.
///
/// Each octave fades by its best linear predictor, fitted to `1 / (1 + 0.3 L^2)` (L: octave's cells along the footprint;
/// within 0.04 of measured).
#[simd]
pub fn octaves_block<S: Simd>(
    simd: S,
    [x, y, z]: [&[f32; BLOCK]; 3],
    octaves: u32,
    absolute: bool,
    mut fade: Option<Fade>,
    out: &mut [f32; BLOCK],
) {
    /// Standard deviation of noise.
    const SIGMA: f32 = 0.27;
    /// Mean of |noise|.
    const MEAN: f32 = 0.21;
    let one = S::f32s::splat(simd, 1.0);
    let mean = if absolute { MEAN } else { 0.0 };
    let mut least = 0.0;
    if let Some(fade) = &fade {
        let mut lengths: S::f32s = load(simd, fade.footprint, 0);
        let mut i = 1;
        while i < BLOCK / S::f32s::LEN {
            lengths = lengths.min(load::<S, S::f32s>(simd, fade.footprint, i));
            i += 1;
        }
        least = lengths.reduce_min();
    }
    let (mut amplitude, mut zoom) = (0.5, 1.0);
    *out = [0.0; BLOCK];
    for _ in 0..octaves {
        let mut octave = [0.0; BLOCK];
        // Beyond ten cells less than a thirtieth is left of an octave.
        if least * zoom < 10.0 {
            noise_block(simd, x, y, z, zoom, &mut octave);
        }
        let mut i = 0;
        while i < BLOCK / S::f32s::LEN {
            let mut n: S::f32s = load(simd, &octave, i);
            if absolute {
                n = n.abs();
            }
            if let Some(fade) = &mut fade {
                let length = load::<S, S::f32s>(simd, fade.footprint, i) * zoom;
                let keep = one / (length * length * 0.3 + 1.0);
                let gone = one - keep;
                n = n * keep + gone * mean;
                let variance = gone * (amplitude * amplitude * SIGMA * SIGMA);
                store(load::<S, S::f32s>(simd, fade.lost, i) + variance, fade.lost, i);
            }
            store(load::<S, S::f32s>(simd, out, i) + n * amplitude, out, i);
            i += 1;
        }
        amplitude *= 0.5;
        zoom *= 2.0;
    }
}
