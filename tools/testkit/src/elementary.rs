//! The elementary functions over lanes, held against f64.

use fearless_simd::{Simd, dispatch, prelude::*};
use paprsek::simd::math;

/// One function of [`math`] over many arguments at every level, which must agree bit by bit.
pub fn apply_all(function: Function, arguments: &[f32]) -> Vec<f32> {
    let mut first: Option<Vec<f32>> = None;
    for (name, level) in super::levels() {
        let out = dispatch!(level, simd => apply(simd, function, arguments));
        let same = first.get_or_insert_with(|| out.clone()).iter().zip(&out).all(|(a, b)| a.to_bits() == b.to_bits());
        assert!(same, "{function:?} {name}");
    }
    first.unwrap()
}

/// A function of [`math`].
#[derive(Clone, Copy, Debug)]
pub enum Function {
    /// `2^x`.
    Exp2,
    /// `1 - 2^x`.
    Opacity,
    /// Binary logarithm.
    Log2,
    /// This power of x.
    Powf(f32),
    /// Sine.
    Sin,
}

/// A function of whole vectors of arguments.
#[inline(always)]
pub fn apply<S: Simd>(simd: S, function: Function, arguments: &[f32]) -> Vec<f32> {
    let mut out = arguments.to_vec();
    for chunk in out.chunks_exact_mut(S::f32s::LEN) {
        let x = S::f32s::from_slice(simd, chunk);
        let y = match function {
            Function::Exp2 => math::exp2(simd, x),
            Function::Opacity => math::opacity(simd, x)[0],
            Function::Log2 => math::log2(simd, x),
            Function::Powf(power) => math::powf(simd, x, S::f32s::splat(simd, power)),
            Function::Sin => math::sin(simd, x),
        };
        y.store_slice(chunk);
    }
    out
}

/// The largest error, each divided by what is allowed of `truth(x)`.
pub fn worst(function: Function, x: &[f32], truth: impl Fn(f64) -> f64, allowed: impl Fn(f64) -> f64) -> f64 {
    let values = apply_all(function, x);
    x.iter()
        .zip(values)
        .map(|(&x, v)| (v as f64 - truth(x as f64)).abs() / allowed(truth(x as f64)))
        .fold(0.0, f64::max)
}

/// A million arguments from `a` to `b`.
pub fn range(a: f64, b: f64) -> Vec<f32> {
    const N: usize = 1 << 20;
    (0..N).map(|i| (a + (b - a) * i as f64 / (N - 1) as f64) as f32).collect()
}
