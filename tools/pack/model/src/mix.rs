//! The logistic domain and the mixers. Mixing there and its learning rule: Mahoney's PAQ7 (2005).
//!
//! Odds are stretched by the logarithm and squashed by its inverse, both as a float's own bits are: linear between powers of
//! two. That costs no more bytes than exact curves, and takes no tables. Every operation is rounded as IEEE 754 says and in
//! a fixed order, so that packer and unpacker agree to the last bit.

#![cfg_attr(test, allow(unsafe_code))]

use crate::vector::{Floats, Words, floats, put_floats};
use core::arch::x86_64::*;

/// Vectors of inputs.
pub const VECTORS: usize = 7;
/// Sets of weights of each mixer, one of which is chosen for each bit.
const ROWS: usize = 2048;
/// Stretched probabilities lie within plus and minus this. 2^23 is a factor of two in the odds.
const MOST: f32 = 15.5 * (1 << 23) as f32;

/// Stretched values of probabilities, given as [`crate::slot::centred`].
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn stretch(p: __m256i) -> __m256 {
    let half = _mm256_set1_epi32(1 << 16);
    let ones = _mm256_castps_si256(_mm256_cvtepi32_ps(_mm256_add_epi32(half, p)));
    let zeros = _mm256_castps_si256(_mm256_cvtepi32_ps(_mm256_sub_epi32(half, p)));
    _mm256_cvtepi32_ps(_mm256_sub_epi32(ones, zeros))
}

/// Probabilities of ones of stretched values that are not beyond [`MOST`].
#[target_feature(enable = "avx2,fma")]
#[inline]
pub fn squash(x: __m256) -> __m256 {
    let one = _mm256_set1_ps(1.0);
    let zeros_to_ones = _mm256_castsi256_ps(_mm256_sub_epi32(_mm256_castps_si256(one), _mm256_cvtps_epi32(x)));
    _mm256_div_ps(one, _mm256_add_ps(one, zeros_to_ones))
}

/// Up to eight mixers of the same inputs. No vector lies in two lines of the processor's cache.
#[repr(C, align(64))]
pub struct Layer {
    /// What they mix.
    pub inputs: [Floats; VECTORS],
    /// Inputs times weights, summed up to eight numbers for each mixer.
    products: [Floats; 8],
    /// Their results: the sums of those, clamped to what can be squashed.
    pub sums: Floats,
    errors: Floats,
    /// All sets of each.
    pub weights: [[[Floats; VECTORS]; ROWS]; 8],
}

impl Layer {
    /// Before the first bit.
    pub const ZERO: Self = Self {
        inputs: [[0.0; 8]; VECTORS],
        products: [[0.0; 8]; 8],
        sums: [0.0; 8],
        errors: [0.0; 8],
        weights: [[[[0.0; 8]; VECTORS]; ROWS]; 8],
    };

    /// Sums up the first `vectors` of the inputs, for the first `mixers`, each with the set of weights that `rows` says.
    #[target_feature(enable = "avx2,fma")]
    #[inline(never)]
    pub fn mix(&mut self, rows: &Words, mixers: usize, vectors: usize) {
        for ((product, &row), weights) in self.products.iter_mut().zip(rows).zip(&self.weights).take(mixers) {
            let mut sum = _mm256_setzero_ps();
            for (x, w) in self.inputs.iter().zip(&weights[row as usize & (ROWS - 1)]).take(vectors) {
                sum = _mm256_fmadd_ps(floats(x), floats(w), sum);
            }
            put_floats(sum, product);
        }
        // The sums of eight by eight.
        let [a, b, c, d, e, f, g, h] = &self.products;
        let add =
            |a, b, c, d| _mm256_hadd_ps(_mm256_hadd_ps(floats(a), floats(b)), _mm256_hadd_ps(floats(c), floats(d)));
        let (low, high) = (add(a, b, c, d), add(e, f, g, h));
        let sums = _mm256_add_ps(_mm256_permute2f128_ps::<0x20>(low, high), _mm256_permute2f128_ps::<0x31>(low, high));
        let clamped = _mm256_max_ps(_mm256_min_ps(sums, _mm256_set1_ps(MOST)), _mm256_set1_ps(-MOST));
        put_floats(clamped, &mut self.sums);
    }

    /// Moves the same weights by the error of each mixer's probability of the `bit`.
    #[target_feature(enable = "avx2,fma")]
    #[inline(never)]
    pub fn learn(&mut self, rows: &Words, mixers: usize, vectors: usize, bit: u32, rate: f32) {
        let errors = _mm256_sub_ps(_mm256_set1_ps(bit as i32 as f32), squash(floats(&self.sums)));
        put_floats(_mm256_mul_ps(errors, _mm256_set1_ps(rate)), &mut self.errors);
        for ((&error, &row), weights) in self.errors.iter().zip(rows).zip(&mut self.weights).take(mixers) {
            for (x, w) in self.inputs.iter().zip(&mut weights[row as usize & (ROWS - 1)]).take(vectors) {
                put_floats(_mm256_fmadd_ps(floats(x), _mm256_set1_ps(error), floats(w)), w);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::words;

    /// What is linear between powers of two is off by a factor of 1.062 in the odds at most, twice.
    const OFF: f64 = 1.062 * 1.062;

    fn layer() -> Box<Layer> {
        let layout = std::alloc::Layout::new::<Layer>();
        // SAFETY: zeros are a layer, too large for the stack.
        unsafe { Box::from_raw(std::alloc::alloc_zeroed(layout).cast()) }
    }

    #[test]
    fn squashing_undoes_stretching() {
        let mut before = 0.0;
        for p in (-65_535..65_536).step_by(7) {
            let mut squashed = [0.0; 8];
            // SAFETY: tests of the packer need AVX2 and FMA, as packing does.
            unsafe {
                let most = _mm256_set1_ps(MOST);
                let x = _mm256_min_ps(stretch(words(&[p as u32; 8])), most);
                put_floats(squash(_mm256_max_ps(x, _mm256_set1_ps(-MOST))), &mut squashed);
            }
            let (q, p) = (f64::from(squashed[0]), (f64::from(p) + 65_536.0) / 131_072.0);
            let odds = q / (1.0 - q) / (p / (1.0 - p));
            assert!((1.0 / OFF..OFF).contains(&odds) || !(1e-4..0.9999).contains(&p), "{p} {q}");
            assert!(q >= before, "{p} {q}");
            before = q;
        }
    }

    #[test]
    fn mixers_add_up_and_learn() {
        let mut layer = layer();
        let number = |i: usize| ((i * 2_654_435_761) as u32 >> 8) as f32 / (1 << 24) as f32 - 0.5;
        let rows = [0, 5, 2047, 3, 9, 1024, 7, 8];
        for (i, x) in layer.inputs.as_flattened_mut().iter_mut().enumerate() {
            *x = number(i) * (1 << 23) as f32;
        }
        for (i, w) in layer.weights.as_flattened_mut().as_flattened_mut().as_flattened_mut().iter_mut().enumerate() {
            *w = number(i + 9) * 0.2;
        }
        let exact = |layer: &Layer, mixer: usize| -> f64 {
            let weights = &layer.weights[mixer][rows[mixer] as usize];
            let pairs = layer.inputs.as_flattened().iter().zip(weights.as_flattened());
            pairs.map(|(&x, &w)| f64::from(x) * f64::from(w)).sum()
        };
        // SAFETY: as above.
        unsafe { layer.mix(&rows, 6, VECTORS) };
        let before: [f64; 8] = core::array::from_fn(|i| exact(&layer, i));
        for (mixer, (&sum, exact)) in layer.sums.iter().zip(before).enumerate() {
            let exact = if mixer < 6 { exact.clamp((-MOST).into(), MOST.into()) } else { 0.0 };
            assert!((f64::from(sum) - exact).abs() < 16.0, "{mixer}: {sum} {exact}");
        }
        // SAFETY: as above.
        unsafe { layer.learn(&rows, 6, VECTORS, 1, 1e-9) };
        for (mixer, before) in before.into_iter().enumerate() {
            let after = exact(&layer, mixer);
            assert!(if mixer < 6 { after > before } else { after == before }, "{mixer}: {before} {after}");
        }
    }
}
