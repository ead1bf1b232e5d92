//! Noise for 64 points with AVX-512.
//!
//! Hashing is on bytes, whose arithmetic wraps just as Perlin's `& 255` does. A table of 256 bytes fills four
//! registers, and to look up 64 points in it takes two permutations (`vpermi2b`) and a blend.
//!
//! ```text
//! cells of all points -> a register of bytes for each axis
//! six lookups of 64 bytes each -> hashes of the cells' columns; four more -> gradients of their corners
//! for each 16 points: offsets and weights, the blend of the lower four corners, of the upper four, and of both
//! ```
//!
//! Point 16 g + i lives in byte g of the 32-bit lane i. So the bytes of 16 points are those lanes shifted, and neither
//! packing nor unpacking needs a shuffle.

use super::curve::{fade, lerp};
use super::permutation::PERMUTATION;
use crate::simd::block::{BLOCK, load, store, vectors};
use core::arch::x86_64::*;
use fearless_simd::{Avx512, f32x16, i32x16, prelude::*, u8x64, u32x16};

/// The low four bits of each entry of the permutation, and in the high four bits those of the next entry: one lookup
/// gives the gradients of a corner and of the one above it.
static GRADIENT_PAIRS: [u8; 256] = {
    let mut pairs = [0; 256];
    let mut i = 0;
    while i < 256 {
        pairs[i] = PERMUTATION[i] & 15 | PERMUTATION[i + 1] << 4;
        i += 1;
    }
    pairs
};

/// Components of the 16 gradients. Their products with an offset are exact, so a fused multiply-add rounds just once,
/// as Perlin's sum of two does.
static GRADIENTS: [[f32; 16]; 3] = [
    [1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0],
    [1.0, 1.0, -1.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
    [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0, 0.0, 1.0, 0.0, -1.0],
];

type Floats = f32x16<Avx512>;

fearless_simd::kernel!(
    /// `table[index]` for 64 bytes.
    #[inline]
    fn lookup(simd: Avx512, table: [u8x64<Avx512>; 4], index: u8x64<Avx512>) -> u8x64<Avx512> {
        let low = _mm512_permutex2var_epi8(table[0].into(), index.into(), table[1].into());
        let high = _mm512_permutex2var_epi8(table[2].into(), index.into(), table[3].into());
        _mm512_mask_blend_epi8(_mm512_movepi8_mask(index.into()), low, high).simd_into(simd)
    }
);

fearless_simd::kernel!(
    /// `table[index & 15]`.
    #[inline]
    fn component(simd: Avx512, table: f32x16<Avx512>, index: u32x16<Avx512>) -> f32x16<Avx512> {
        _mm512_permutexvar_ps(index.into(), table.into()).simd_into(simd)
    }
);

/// The first 256 bytes of a table in registers.
#[inline(always)]
fn load_table(simd: Avx512, table: &[u8]) -> [u8x64<Avx512>; 4] {
    // No `map`: the closure that it calls lacks the target features where it is not inlined (see [`crate::simd`]).
    [
        u8x64::from_slice(simd, &table[..64]),
        u8x64::from_slice(simd, &table[64..128]),
        u8x64::from_slice(simd, &table[128..192]),
        u8x64::from_slice(simd, &table[192..256]),
    ]
}

/// The cells of the 16 coordinates of group `g` times `zoom`; the low byte is the cell modulo 256.
#[inline(always)]
fn cell(simd: Avx512, x: &[f32; BLOCK], zoom: f32, g: usize) -> u32x16<Avx512> {
    // Where the conversion overflows it gives 0x80000000. Its low byte is right, since floats as large are multiples of
    // 256.
    (load::<_, Floats>(simd, x, g) * zoom).floor().to_int::<i32x16<_>>().bitcast()
}

/// The cells of 64 coordinates times `zoom`, modulo 256, in the order of bytes that the module describes.
#[inline(always)]
fn cells(simd: Avx512, x: &[f32; BLOCK], zoom: f32) -> u8x64<Avx512> {
    let low = (cell(simd, x, zoom, 0) & 0xff) | ((cell(simd, x, zoom, 1) & 0xff) << 8);
    (low | ((cell(simd, x, zoom, 2) & 0xff) << 16) | (cell(simd, x, zoom, 3) << 24)).bitcast()
}

/// The dot product of a gradient and the offset (x, y, z).
#[inline(always)]
fn gradient(simd: Avx512, tables: &[Floats; 3], hash: u32x16<Avx512>, x: Floats, y: Floats, z: Floats) -> Floats {
    let z = component(simd, tables[2], hash) * z;
    component(simd, tables[0], hash).mul_add(x, component(simd, tables[1], hash).mul_add(y, z))
}

/// Noise at the first `count` of 64 points times `zoom`.
#[inline(always)]
pub fn noise64(simd: Avx512, [x, y, z]: [&[f32; BLOCK]; 3], zoom: f32, count: usize, out: &mut [f32; BLOCK]) {
    let table = load_table(simd, &PERMUTATION);
    let (ix, iy, iz) = (cells(simd, x, zoom), cells(simd, y, zoom), cells(simd, z, zoom));
    let a = lookup(simd, table, ix) + iy;
    let b = lookup(simd, table, ix + 1) + iy;
    let (aa, ab) = (lookup(simd, table, a) + iz, lookup(simd, table, a + 1) + iz);
    let (ba, bb) = (lookup(simd, table, b) + iz, lookup(simd, table, b + 1) + iz);

    let pairs = load_table(simd, &GRADIENT_PAIRS);
    let mut aa: u32x16<_> = lookup(simd, pairs, aa).bitcast();
    let mut ba: u32x16<_> = lookup(simd, pairs, ba).bitcast();
    let mut ab: u32x16<_> = lookup(simd, pairs, ab).bitcast();
    let mut bb: u32x16<_> = lookup(simd, pairs, bb).bitcast();
    let tables = [
        f32x16::load_array(simd, GRADIENTS[0]),
        f32x16::load_array(simd, GRADIENTS[1]),
        f32x16::load_array(simd, GRADIENTS[2]),
    ];

    for g in 0..vectors(count, Floats::LEN) {
        let (x, y, z): (Floats, Floats, Floats) = (load(simd, x, g), load(simd, y, g), load(simd, z, g));
        let (x, y, z) = (x * zoom, y * zoom, z * zoom);
        let (x, y, z) = (x - x.floor(), y - y.floor(), z - z.floor());
        let (u, v, w) = (fade(x), fade(y), fade(z));
        let (x1, y1) = (x - 1.0, y - 1.0);
        // y = 0 in all lanes, as on a floor that lies on the lattice: the far half has no weight. A third faster there.
        let flat = y.simd_eq(0.0).all_true();
        let mut bottom = lerp(u, gradient(simd, &tables, aa, x, y, z), gradient(simd, &tables, ba, x1, y, z));
        if !flat {
            let far = lerp(u, gradient(simd, &tables, ab, x, y1, z), gradient(simd, &tables, bb, x1, y1, z));
            bottom = lerp(v, bottom, far);
        }

        let z = z - 1.0;
        (aa, ba, ab, bb) = (aa >> 4, ba >> 4, ab >> 4, bb >> 4);
        let mut top = lerp(u, gradient(simd, &tables, aa, x, y, z), gradient(simd, &tables, ba, x1, y, z));
        if !flat {
            let far = lerp(u, gradient(simd, &tables, ab, x, y1, z), gradient(simd, &tables, bb, x1, y1, z));
            top = lerp(v, top, far);
        }
        (aa, ba, ab, bb) = (aa >> 4, ba >> 4, ab >> 4, bb >> 4);
        store(lerp(w, bottom, top) + 0.0, out, g);
    }
}
