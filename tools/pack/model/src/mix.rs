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
/// Sets of weights: of those of each mixer, one is chosen for each bit.
const ROWS: usize = 8 << 11;
/// The mixers' weights at first. Others for histories, and for what counts how often it was seen, are no better.
const WEIGHT: f32 = 0.028;
/// Those of their results.
const LAST_WEIGHT: f32 = 0.15 / 8.0;
/// How fast the mixers learn.
const RATE: f32 = 6.4e-10;
/// How fast the last one does.
const LAST_RATE: f32 = 0.225e-10;
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

/// Eight mixers of the same inputs, and one of their results. No vector lies in two lines of the processor's cache.
#[repr(C, align(64))]
pub struct Mixers {
    /// What they mix.
    pub inputs: [Floats; VECTORS],
    /// Inputs times weights, summed up to eight numbers for each mixer.
    products: [Floats; 8],
    /// Their results: the sums of those, clamped to what can be squashed.
    sums: Floats,
    errors: Floats,
    /// The probability of a one, eight times.
    pub result: Floats,
    /// All sets of the first, then of the others.
    pub weights: [Weights; ROWS],
}

/// A set of weights of the inputs, and behind them of the mixers' results. Those of all eight sets in use are added up.
pub type Weights = [Floats; VECTORS + 1];

impl Mixers {
    /// Before [`Self::start`].
    pub const ZERO: Self = Self {
        inputs: [[0.0; 8]; VECTORS],
        products: [[0.0; 8]; 8],
        sums: [0.0; 8],
        errors: [0.0; 8],
        result: [0.0; 8],
        weights: [[[0.0; 8]; VECTORS + 1]; ROWS],
    };

    /// Before the first bit.
    pub fn start(&mut self) {
        for weights in &mut self.weights {
            *weights = [[WEIGHT; 8]; VECTORS + 1];
            weights[VECTORS] = [LAST_WEIGHT; 8];
        }
    }

    /// Mixes the inputs, each mixer with the set of weights that `rows` says, and the results.
    #[target_feature(enable = "avx2,fma")]
    #[inline]
    pub fn mix(&mut self, rows: &Words) {
        let mut last = _mm256_setzero_ps();
        for (product, &row) in self.products.iter_mut().zip(rows) {
            let weights = &self.weights[row as usize & (ROWS - 1)];
            // Not a loop, which would load every input anew for each mixer.
            const { assert!(VECTORS == 7) };
            let add = |sum, i: usize| _mm256_fmadd_ps(floats(&self.inputs[i]), floats(&weights[i]), sum);
            let sum = _mm256_mul_ps(floats(&self.inputs[0]), floats(&weights[0]));
            put_floats(add(add(add(add(add(add(sum, 1), 2), 3), 4), 5), 6), product);
            last = _mm256_add_ps(last, floats(&weights[VECTORS]));
        }
        // The sums of eight by eight.
        let [a, b, c, d, e, f, g, h] = &self.products;
        let add =
            |a, b, c, d| _mm256_hadd_ps(_mm256_hadd_ps(floats(a), floats(b)), _mm256_hadd_ps(floats(c), floats(d)));
        let (low, high) = (add(a, b, c, d), add(e, f, g, h));
        let sums = _mm256_add_ps(_mm256_permute2f128_ps::<0x20>(low, high), _mm256_permute2f128_ps::<0x31>(low, high));
        let sums = clamped(sums);
        put_floats(sums, &mut self.sums);
        let sum = _mm256_mul_ps(sums, last);
        let sum = _mm256_add_ps(sum, _mm256_permute2f128_ps::<1>(sum, sum));
        let sum = _mm256_hadd_ps(sum, sum);
        put_floats(squash(clamped(_mm256_hadd_ps(sum, sum))), &mut self.result);
    }

    /// Moves the same weights by the error of each mixer's probability of the `bit`, those of the results by that of theirs.
    #[target_feature(enable = "avx2,fma")]
    #[inline]
    pub fn learn(&mut self, rows: &Words, bit: u32) {
        let sums = floats(&self.sums);
        let bits = _mm256_set1_ps(bit as i32 as f32);
        let errors = |p, rate| _mm256_mul_ps(_mm256_sub_ps(bits, p), _mm256_set1_ps(rate));
        put_floats(errors(squash(sums), RATE), &mut self.errors);
        let last = _mm256_mul_ps(sums, errors(floats(&self.result), LAST_RATE));
        for (&error, &row) in self.errors.iter().zip(rows) {
            let weights = &mut self.weights[row as usize & (ROWS - 1)];
            for (x, w) in self.inputs.iter().zip(&mut *weights) {
                put_floats(_mm256_fmadd_ps(floats(x), _mm256_set1_ps(error), floats(w)), w);
            }
            let w = &mut weights[VECTORS];
            put_floats(_mm256_add_ps(floats(w), last), w);
        }
    }
}

/// Within [`MOST`].
#[target_feature(enable = "avx2,fma")]
#[inline]
fn clamped(x: __m256) -> __m256 {
    _mm256_max_ps(_mm256_min_ps(x, _mm256_set1_ps(MOST)), _mm256_set1_ps(-MOST))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::words;

    /// What is linear between powers of two is off by a factor of 1.062 in the odds at most, twice.
    const OFF: f64 = 1.062 * 1.062;

    fn mixers() -> Box<Mixers> {
        let layout = std::alloc::Layout::new::<Mixers>();
        // SAFETY: zeros are mixers, too large for the stack.
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
        let mut mixers = mixers();
        let number = |i: usize| ((i * 2_654_435_761) as u32 >> 8) as f32 / (1 << 24) as f32 - 0.5;
        let rows = core::array::from_fn(|i| [0, 5, 2047, 3, 9, 1024, 7, 8][i] + ((i as u32) << 11));
        for (i, x) in mixers.inputs.as_flattened_mut().iter_mut().enumerate() {
            *x = number(i) * (1 << 23) as f32;
        }
        for (i, w) in mixers.weights.as_flattened_mut().as_flattened_mut().iter_mut().enumerate() {
            *w = number(i + 9) * 0.2;
        }
        let dot = |x: &[f32], w: &[f32]| -> f64 { x.iter().zip(w).map(|(&x, &w)| f64::from(x) * f64::from(w)).sum() };
        let exact = |mixers: &Mixers, row: u32| {
            let weights = &mixers.weights[row as usize][..VECTORS];
            dot(mixers.inputs.as_flattened(), weights.as_flattened())
        };
        let last = |mixers: &Mixers, sums: &Floats| -> f64 {
            rows.iter().map(|&row| dot(sums, &mixers.weights[row as usize][VECTORS])).sum()
        };
        // SAFETY: as above.
        unsafe { mixers.mix(&rows) };
        let sums = mixers.sums;
        let (before, last_before) = (rows.map(|row| exact(&mixers, row)), last(&mixers, &sums));
        for (sum, exact) in sums.into_iter().zip(before) {
            let exact = exact.clamp((-MOST).into(), MOST.into());
            assert!((f64::from(sum) - exact).abs() < 16.0, "{sum} {exact}");
        }
        let odds = f64::from(mixers.result[0] / (1.0 - mixers.result[0]));
        let exact_odds = (last_before / f64::from(1 << 23)).exp2();
        assert!((1.0 / OFF..OFF).contains(&(odds / exact_odds)), "{odds} {exact_odds}");
        // SAFETY: as above.
        unsafe { mixers.learn(&rows, 1) };
        for (row, before) in rows.into_iter().zip(before) {
            assert!(exact(&mixers, row) > before, "{row}: {before}");
        }
        assert!(last(&mixers, &sums) > last_before, "{last_before}");
    }
}
