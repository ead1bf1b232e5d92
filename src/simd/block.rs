//! Blocks of points: the unit in which kernels take numbers from memory.
//!
//! A kernel that takes many points takes a block of each of their coordinates, and goes through it a vector at a time:
//! `BLOCK / V::LEN` vectors of 4, 8 or 16 lanes, by the SIMD level.

use fearless_simd::prelude::*;

/// Points of a block, which are also the pixels of a tile's row.
///
/// As bytes they fill one AVX-512 register, which is what noise at that level makes use of.
pub const BLOCK: usize = 64;

/// x, y and z (or red, green and blue) of the points of a block.
pub type Block3 = [[f32; BLOCK]; 3];

/// The vectors of a number of `lanes` that the first `count` points of a block lie in: at most those of a block.
#[inline(always)]
pub fn vectors(count: usize, lanes: usize) -> usize {
    count.min(BLOCK).div_ceil(lanes)
}

/// Vector `i` of a block. Panics where `i` is not below `BLOCK / V::LEN`.
#[inline(always)]
pub fn load<S: Simd, V: SimdBase<S>>(simd: S, x: &[V::Element; BLOCK], i: usize) -> V {
    match V::LEN {
        4 => V::from_slice(simd, &x.as_chunks::<4>().0[i]),
        8 => V::from_slice(simd, &x.as_chunks::<8>().0[i]),
        _ => V::from_slice(simd, &x.as_chunks::<16>().0[i]),
    }
}

/// Writes vector `i` of a block. Panics where `i` is not below `BLOCK / V::LEN`.
#[inline(always)]
pub fn store<S: Simd, V: SimdBase<S>>(value: V, out: &mut [V::Element; BLOCK], i: usize) {
    match V::LEN {
        4 => value.store_slice(&mut out.as_chunks_mut::<4>().0[i]),
        8 => value.store_slice(&mut out.as_chunks_mut::<8>().0[i]),
        _ => value.store_slice(&mut out.as_chunks_mut::<16>().0[i]),
    }
}
