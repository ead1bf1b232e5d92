//! The logistic domain and the mixer. Mixing there and its learning rule: Mahoney's PAQ7 (2005).

#![allow(unsafe_code)]

use core::arch::x86_64::*;

/// Stretched probabilities lie within plus and minus this; 256 is a factor of e in the odds.
const STRETCH: i32 = 2047;

/// The logistic function and its inverse, tabled.
pub struct Logistic {
    /// Probability in 65536ths, by stretched value plus 4096.
    squash: [u16; 8192],
    /// Stretched value, by probability in 4096ths.
    stretch: [i16; 4096],
}

impl Logistic {
    /// Unusable before [`Self::fill`].
    pub const ZERO: Self = Self { squash: [0; 8192], stretch: [0; 4096] };

    /// Integrates dp = p (1 - p) dx from p = 1/2 on, in Euler's steps, until all of the inverse is known. Their error
    /// does not matter: the curve need not be the logistic exactly, only the same on both sides.
    pub fn fill(&mut self) {
        let mut p = 1u64 << 31;
        let (mut x, mut known) = (0, 2048);
        while known < 4096 {
            let high = (p >> 16) as u16;
            if known <= (high >> 4) as usize {
                self.stretch[known] = x as i16;
                self.stretch[4095 - known] = -(x as i16);
                known += 1;
                continue;
            }
            self.squash[(4096 + x) & 8191] = high;
            self.squash[(4095 - x) & 8191] = !high;
            p += (p * ((1 << 32) - p)) >> 40;
            x += 1;
        }
    }

    /// Probability in 65536ths of a stretched value, 1 to 65535 + 1 exclusive.
    pub fn squash(&self, x: i32) -> i32 {
        self.squash[(x + 4096) as usize & 8191] as i32
    }

    /// Stretched value of a probability in 65536ths.
    pub fn stretch(&self, p: i32) -> i16 {
        self.stretch[(p >> 4) as usize & 4095]
    }
}

/// Sixteen numbers. As weights, 16384 is one.
pub type Vector = [i16; 16];

/// The sum of `x`, each with its weight, clamped to what can be squashed.
pub fn dot(x: &[Vector], w: &[Vector]) -> i32 {
    #[target_feature(enable = "avx2")]
    fn vectors(x: &[Vector], w: &[Vector]) -> i64 {
        let mut sums = _mm256_setzero_si256();
        for (x, w) in x.iter().zip(w) {
            // One after the other: as an array of two they would pass through memory, a fifth of the unpacker's time.
            // SAFETY: reads sixteen numbers where there are sixteen.
            let x = unsafe { _mm256_loadu_si256(x.as_ptr().cast()) };
            // SAFETY: likewise.
            let w = unsafe { _mm256_loadu_si256(w.as_ptr().cast()) };
            sums = _mm256_add_epi32(sums, _mm256_madd_epi16(x, w));
        }
        let sums = _mm_add_epi32(_mm256_castsi256_si128(sums), _mm256_extracti128_si256::<1>(sums));
        _mm_cvtsi128_si64(_mm_add_epi32(sums, _mm_unpackhi_epi64(sums, sums)))
    }
    // SAFETY: whoever starts a model has seen that the processor has AVX2.
    let pair = unsafe { vectors(x, w) };
    ((pair as i32).wrapping_add((pair >> 32) as i32) >> 14).clamp(-STRETCH, STRETCH)
}

/// Moves the weights by `x` times the error, rounded to 65536ths. The error is that of a probability
/// (65536ths), times the rate, within 16 bits.
pub fn train(x: &[Vector], w: &mut [Vector], error: i32) {
    #[target_feature(enable = "avx2")]
    fn vectors(x: &[Vector], w: &mut [Vector], error: i16) {
        for (x, w) in x.iter().zip(w) {
            // SAFETY: reads sixteen numbers where there are sixteen, as does the other.
            let x = unsafe { _mm256_loadu_si256(x.as_ptr().cast()) };
            let twice = _mm256_mulhi_epi16(_mm256_add_epi16(x, x), _mm256_set1_epi16(error));
            let step = _mm256_srai_epi16::<1>(_mm256_add_epi16(twice, _mm256_set1_epi16(1)));
            let new = _mm256_adds_epi16(unsafe { _mm256_loadu_si256(w.as_ptr().cast()) }, step);
            // SAFETY: writes as many.
            unsafe { _mm256_storeu_si256(w.as_mut_ptr().cast(), new) };
        }
    }
    // SAFETY: as above.
    unsafe { vectors(x, w, error as i16) }
}
