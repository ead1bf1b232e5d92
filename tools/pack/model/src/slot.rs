//! Probabilities that learn, and the last bits they saw, in 32 bits each: from the top, 17 bits of probability (its highest
//! bit inverted, so that all-zero memory means one half), 7 of count, 8 of history.

#![cfg_attr(test, allow(unsafe_code))]

use core::arch::x86_64::*;

/// The count stops here: a text is short, and what it teaches holds to its end.
const LIMIT: i32 = 127;

/// Number of bits that a slot has seen, as far as it is counted.
pub fn count(slot: u32) -> u32 {
    slot >> 8 & LIMIT as u32
}

/// The same of eight slots.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn counts(slots: __m256i) -> __m256i {
    _mm256_and_si256(_mm256_srli_epi32::<8>(slots), _mm256_set1_epi32(LIMIT))
}

/// The last seven bits below a leading one, fewer at first; 0 before the first bit.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn histories(slots: __m256i) -> __m256i {
    _mm256_and_si256(slots, _mm256_set1_epi32(255))
}

/// Probabilities of ones less one half, in units of 2^-17.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn centred(slots: __m256i) -> __m256i {
    _mm256_srai_epi32::<15>(slots)
}

/// The slots after one more bit: the `n`th moves the probability by 1 / (n + 1/16).
///
/// Divided as floats, which is exact but for the last bit, and the same everywhere.
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn learned(slots: __m256i, bit: u32) -> __m256i {
    let (p, n, h) = (centred(slots), counts(slots), histories(slots));
    let minus_bit = _mm256_set1_epi32((bit as i32).wrapping_neg());
    // The largest probability for a one, the least for a zero.
    let target = _mm256_xor_si256(_mm256_set1_epi32(-1 << 16), minus_bit);
    let steps = _mm256_add_ps(_mm256_cvtepi32_ps(n), _mm256_set1_ps(17.0 / 16.0));
    let step = _mm256_div_ps(_mm256_cvtepi32_ps(_mm256_sub_epi32(target, p)), steps);
    let p = _mm256_add_epi32(p, _mm256_cvttps_epi32(step));
    let n = _mm256_sub_epi32(n, _mm256_cmpgt_epi32(_mm256_set1_epi32(LIMIT), n));
    // The bit that falls out of eight goes on as the leading one.
    let h = _mm256_max_epi32(h, _mm256_set1_epi32(1));
    let h = _mm256_sub_epi32(_mm256_add_epi32(h, h), minus_bit);
    let h = histories(_mm256_or_si256(h, _mm256_and_si256(_mm256_srli_epi32::<1>(h), _mm256_set1_epi32(128))));
    _mm256_or_si256(_mm256_or_si256(_mm256_slli_epi32::<15>(p), _mm256_slli_epi32::<8>(n)), h)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::{put_words, words};

    /// One slot at a time, in integers and one float.
    fn scalar(slot: u32, bit: u32) -> u32 {
        let (p, n, h) = ((slot >> 15) as i32 ^ 0x1_0000, count(slot) as i32, slot & 255);
        let step = ((0x1_ffff & -(bit as i32)) - p) as f32 / (n as f32 + 17.0 / 16.0);
        let (p, n, h) = (p + step as i32, (n + 1).min(LIMIT), h.max(1) << 1 | bit);
        ((p ^ 0x1_0000) as u32) << 15 | (n as u32) << 8 | (h | h >> 1 & 128) & 255
    }

    #[test]
    fn eight_slots_learn_as_one() {
        // An odd step, so that all counts and histories meet many probabilities.
        for first in (0..u32::MAX).step_by(40_503) {
            let slots: [u32; 8] = core::array::from_fn(|i| first.wrapping_add(i as u32 * 0x2345_6789));
            for bit in [0, 1] {
                let mut new = [0; 8];
                // SAFETY: tests of the packer need AVX2, as packing does.
                unsafe { put_words(learned(words(&slots), bit), &mut new) };
                assert_eq!(new, slots.map(|slot| scalar(slot, bit)), "{slots:x?} {bit}");
            }
        }
    }

    /// A slot that has seen few bits is at the frequency of ones, but for its start from one half.
    #[test]
    fn a_slot_tends_to_the_frequency() {
        let mut slot = 0;
        for i in 0..120 {
            slot = scalar(slot, (i % 4 == 0) as u32);
        }
        let p = f64::from((slot >> 15) as i32 ^ 0x1_0000) / 131_072.0;
        assert!((p - 0.25).abs() < 0.01, "{p}");
        assert_eq!(count(slot), 120);
    }
}
