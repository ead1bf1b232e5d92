//! Blocks of points: the unit in which kernels take numbers from memory.

use fearless_simd::prelude::*;

/// Points of a block: the bytes of one AVX-512 register.
pub const BLOCK: usize = 64;

/// Vector `i` of a block.
///
/// Arrays of a constant length, because the optimizer, asked for size, calls a function for each range of a slice.
#[inline(always)]
pub fn load<S: Simd, V: SimdBase<S>>(simd: S, x: &[V::Element; BLOCK], i: usize) -> V {
    match V::LEN {
        4 => V::from_slice(simd, &x.as_chunks::<4>().0[i]),
        8 => V::from_slice(simd, &x.as_chunks::<8>().0[i]),
        _ => V::from_slice(simd, &x.as_chunks::<16>().0[i]),
    }
}

/// Writes vector `i` of a block.
#[inline(always)]
pub fn store<S: Simd, V: SimdBase<S>>(value: V, out: &mut [V::Element; BLOCK], i: usize) {
    match V::LEN {
        4 => value.store_slice(&mut out.as_chunks_mut::<4>().0[i]),
        8 => value.store_slice(&mut out.as_chunks_mut::<8>().0[i]),
        _ => value.store_slice(&mut out.as_chunks_mut::<16>().0[i]),
    }
}
