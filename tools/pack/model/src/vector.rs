//! Eight numbers at a time, to and from memory: what is unsafe about AVX2, which half of the unpacker's time depends on.

#![allow(unsafe_code)]

use core::arch::x86_64::*;

/// Eight floats.
pub type Floats = [f32; 8];
/// Eight integers.
pub type Words = [u32; 8];

/// Reads floats.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn floats(from: &Floats) -> __m256 {
    // SAFETY: reads eight numbers where there are eight.
    unsafe { _mm256_loadu_ps(from.as_ptr()) }
}

/// Writes floats.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn put_floats(x: __m256, to: &mut Floats) {
    // SAFETY: writes eight numbers where there are eight.
    unsafe { _mm256_storeu_ps(to.as_mut_ptr(), x) }
}

/// Reads integers.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn words(from: &Words) -> __m256i {
    // SAFETY: as above.
    unsafe { _mm256_loadu_si256(from.as_ptr().cast()) }
}

/// Writes integers.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn put_words(x: __m256i, to: &mut Words) {
    // SAFETY: as above.
    unsafe { _mm256_storeu_si256(to.as_mut_ptr().cast(), x) }
}

/// Reads the cells that are `at` these places. One by one: processors whose gathering was mended (Intel's up to 2021) take
/// longer for the instruction that does it at once.
///
/// # Safety
/// The places lie within.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub unsafe fn gather(cells: &[u32], at: &Words) -> __m256i {
    // SAFETY: as the caller says.
    let cell = |i: usize| unsafe { *cells.get_unchecked(at[i] as usize) as i32 };
    _mm256_setr_epi32(cell(0), cell(1), cell(2), cell(3), cell(4), cell(5), cell(6), cell(7))
}

/// Writes cells back, the later one where two are the same.
///
/// # Safety
/// The places lie within.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub unsafe fn scatter(x: __m256i, cells: &mut [u32], at: &Words) {
    let (low, high) = (_mm256_castsi256_si128(x), _mm256_extracti128_si256::<1>(x));
    // SAFETY: as the caller says.
    let mut put = |i: usize, x: i32| unsafe { *cells.get_unchecked_mut(at[i] as usize) = x as u32 };
    put(0, _mm_extract_epi32::<0>(low));
    put(1, _mm_extract_epi32::<1>(low));
    put(2, _mm_extract_epi32::<2>(low));
    put(3, _mm_extract_epi32::<3>(low));
    put(4, _mm_extract_epi32::<0>(high));
    put(5, _mm_extract_epi32::<1>(high));
    put(6, _mm_extract_epi32::<2>(high));
    put(7, _mm_extract_epi32::<3>(high));
}
