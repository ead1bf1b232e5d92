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

/// Eight 16-bit weights, 16384 being one, in two words: a form that safe code can load and store as one vector.
pub type Weights = [i64; 2];

/// Eight times the same weight.
pub const fn all(weight: i16) -> Weights {
    [weight as i64 * 0x0001_0001_0001_0001; 2]
}

#[target_feature(enable = "sse2")]
fn vector(&[a, b, c, d, e, f, g, h]: &[i16; 8]) -> __m128i {
    _mm_set_epi16(h, g, f, e, d, c, b, a)
}

/// The sum of `inputs`, each with its weight, clamped to what can be squashed.
pub fn dot(inputs: &[[i16; 8]], weights: &[Weights]) -> i32 {
    #[target_feature(enable = "sse2")]
    fn vectors(inputs: &[[i16; 8]], weights: &[Weights]) -> i64 {
        let mut sums = _mm_setzero_si128();
        for (x, w) in inputs.iter().zip(weights) {
            sums = _mm_add_epi32(sums, _mm_madd_epi16(vector(x), _mm_set_epi64x(w[1], w[0])));
        }
        _mm_cvtsi128_si64(_mm_add_epi32(sums, _mm_unpackhi_epi64(sums, sums)))
    }
    // SAFETY: every x86-64 processor has SSE2.
    let pair = unsafe { vectors(inputs, weights) };
    ((pair as i32).wrapping_add((pair >> 32) as i32) >> 14).clamp(-STRETCH, STRETCH)
}

/// Moves the weights by `inputs` times the error, rounded to 65536ths. The error is that of a probability
/// (65536ths), times the rate, within 16 bits.
pub fn train(inputs: &[[i16; 8]], weights: &mut [Weights], error: i32) {
    #[target_feature(enable = "sse2")]
    fn vectors(inputs: &[[i16; 8]], weights: &mut [Weights], error: i16) {
        for (x, w) in inputs.iter().zip(weights) {
            let x = vector(x);
            let twice = _mm_mulhi_epi16(_mm_add_epi16(x, x), _mm_set1_epi16(error));
            let step = _mm_srai_epi16::<1>(_mm_add_epi16(twice, _mm_set1_epi16(1)));
            let new = _mm_adds_epi16(_mm_set_epi64x(w[1], w[0]), step);
            *w = [_mm_cvtsi128_si64(new), _mm_cvtsi128_si64(_mm_unpackhi_epi64(new, new))];
        }
    }
    // SAFETY: every x86-64 processor has SSE2.
    unsafe { vectors(inputs, weights, error as i16) }
}
