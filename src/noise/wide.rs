//! Noise for 64 points at any SIMD level: what a level has no kernel of its own for.
//!
//! ```text
//! cells of all points, over lanes
//! for each point: three lookups in the permutation and four in the gradients, each of two neighbouring entries
//! for each vector of points: offsets and weights, the blend of the lower four corners, of the upper four, and of both
//! ```
//!
//! The hashes are looked up one point at a time: gathers would not be faster than these loads of pairs, and byte
//! shuffles of a table of 256 only are from AVX-512 on.

use super::curve::{fade, lerp};
use super::permutation::PERMUTATION;
use crate::simd::block::{BLOCK, load, store, vectors};
use fearless_simd::prelude::*;

/// The gradients in the order of Perlin's `h & 15`: their components, -1, 0 or 1, as signed fields of two bits, x lowest. A
/// component of 1 is 1, 4 or 16 in x, y or z, one of -1 is 3, 12 or 48.
pub const CODES: [u8; 16] =
    [0x05, 0x07, 0x0d, 0x0f, 0x11, 0x13, 0x31, 0x33, 0x14, 0x1c, 0x34, 0x3c, 0x05, 0x1c, 0x07, 0x3c];

/// The gradient of each entry of the permutation as [`CODES`] has it.
static GRADIENTS: [u8; 257] = {
    let mut codes = [0; 257];
    let mut i = 0;
    while i < 257 {
        codes[i] = CODES[PERMUTATION[i] as usize & 15];
        i += 1;
    }
    codes
};

/// Entry `i` modulo 256 in the low byte and the next one in the high byte, by one load.
///
/// In 32 bits, since writing the byte of a register would make each lookup wait for the last.
#[inline(always)]
pub fn at(table: &[u8; 257], i: u32) -> u32 {
    let i = i as usize & 255;
    u16::from_le_bytes([table[i], table[i + 1]]) as u32
}

/// Noise at the first `count` of 64 points times `zoom`.
#[inline(always)]
pub fn noise64<S: Simd>(simd: S, [x, y, z]: [&[f32; BLOCK]; 3], zoom: f32, count: usize, out: &mut [f32; BLOCK]) {
    let vectors = vectors(count, S::f32s::LEN);
    let [mut ix, mut iy, mut iz] = [[0u32; BLOCK]; 3];
    cells(simd, x, zoom, &mut ix);
    cells(simd, y, zoom, &mut iy);
    cells(simd, z, zoom, &mut iz);
    let codes = hashes(&ix, &iy, &iz, vectors * S::f32s::LEN);
    let mut i = 0;
    while i < vectors {
        let (x, y, z): (S::f32s, S::f32s, S::f32s) = (load(simd, x, i), load(simd, y, i), load(simd, z, i));
        let (x, y, z) = (x * zoom, y * zoom, z * zoom);
        let (x, y, z) = (x - x.floor(), y - y.floor(), z - z.floor());
        let (u, v, w) = (fade(x), fade(y), fade(z));
        let (aa, ba): (S::u32s, S::u32s) = (load(simd, &codes[0], i), load(simd, &codes[1], i));
        let (ab, bb): (S::u32s, S::u32s) = (load(simd, &codes[2], i), load(simd, &codes[3], i));
        let bottom = face::<S>([aa, ba, ab, bb], x, y, z, u, v);
        let top = face::<S>([aa >> 8, ba >> 8, ab >> 8, bb >> 8], x, y, z - 1.0, u, v);
        store(lerp(w, bottom, top) + 0.0, out, i);
        i += 1;
    }
}

/// The gradients of each cell's corners as [`GRADIENTS`] has them: of the corner at (0, 0), (1, 0), (0, 1) and (1, 1)
/// in x and y, each with that of the corner above it in z in the next byte.
#[inline(always)]
fn hashes(ix: &[u32; BLOCK], iy: &[u32; BLOCK], iz: &[u32; BLOCK], count: usize) -> [[u32; BLOCK]; 4] {
    let mut codes = [[0u32; BLOCK]; 4];
    for i in 0..count.min(BLOCK) {
        let (iy, iz) = (iy[i], iz[i]);
        let ab = at(&PERMUTATION, ix[i]);
        let (a, b) = (at(&PERMUTATION, ab + iy), at(&PERMUTATION, (ab >> 8) + iy));
        codes[0][i] = at(&GRADIENTS, a + iz);
        codes[1][i] = at(&GRADIENTS, b + iz);
        codes[2][i] = at(&GRADIENTS, (a >> 8) + iz);
        codes[3][i] = at(&GRADIENTS, (b >> 8) + iz);
    }
    codes
}

/// The blend of the four corners of one face of a cell, at the offset (x, y, z) from the first, by the weights `u`
/// along x and `v` along y.
#[inline(always)]
fn face<S: Simd>(
    [aa, ba, ab, bb]: [S::u32s; 4],
    x: S::f32s,
    y: S::f32s,
    z: S::f32s,
    u: S::f32s,
    v: S::f32s,
) -> S::f32s {
    let (x1, y1) = (x - 1.0, y - 1.0);
    let near = lerp(u, gradient::<S>(aa, x, y, z), gradient::<S>(ba, x1, y, z));
    // y = 0 in all lanes, as on a floor that lies on the lattice: the far half has no weight.
    if y.simd_eq(0.0).all_true() {
        return near;
    }
    let far = lerp(u, gradient::<S>(ab, x, y1, z), gradient::<S>(bb, x1, y1, z));
    lerp(v, near, far)
}

/// The dot product of a gradient and an offset. One of the three products is zero, so this is Perlin's sum of two.
#[inline(always)]
fn gradient<S: Simd>(code: S::u32s, x: S::f32s, y: S::f32s, z: S::f32s) -> S::f32s {
    component::<S>(code) * x + (component::<S>(code >> 2) * y + component::<S>(code >> 4) * z)
}

/// The low two bits of each lane, as a number with a sign.
#[inline(always)]
fn component<S: Simd>(codes: S::u32s) -> S::f32s {
    ((codes << 30).bitcast::<S::i32s>() >> 30).to_float()
}

/// The cells of coordinates times `zoom`, modulo 256.
#[inline(always)]
fn cells<S: Simd>(simd: S, x: &[f32; BLOCK], zoom: f32, cells: &mut [u32; BLOCK]) {
    // Where the x86 conversion overflows it gives 0x80000000. Its low byte is right, since floats as large are
    // multiples of 256. Other conversions saturate.
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
