//! Elementary functions over lanes: polynomials without tables and without fused multiply-add, so that every SIMD level
//! gives the same bits.
//!
//! The polynomials are those of Cephes `[Cephes]` and DirectXMath. Errors are against f64, measured by the tests of
//! `color`. Where nothing else is said, an argument out of range and NaN give an unspecified number, which may be any
//! float.

use crate::simd::lanes::V3;
use fearless_simd::{Simd, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3A;
use std::f32::consts::{FRAC_1_PI, FRAC_1_SQRT_2, LOG2_E};

/// 1.5 times 2^23. Beside it a number has no fraction, and its lowest bits are the whole number nearest to it.
pub const WHOLE: f32 = 12_582_912.0;

/// `2^x`, with `x` clamped to -126..127: relative error 2e-7, exact for integers.
#[inline(always)]
pub fn exp2<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    opacity(simd, x)[1]
}

/// `1 - 2^x`, with `x` clamped to -126..127, and `2^x` as [`exp2`] has it: of light that goes through an optical depth of
/// `-x ln 2`, what is kept and what comes through.
///
/// For `x` <= 0 the relative error of either is 2e-7, however near to 0: of a thin cloud's opacity the difference to 1
/// would leave no digit. The polynomial is that of Cephes' `exp2f` on -1/2..1/2.
#[inline(always)]
pub fn opacity<S: Simd>(_simd: S, x: S::f32s) -> [S::f32s; 2] {
    let x = x.max(-126.0).min(127.0);
    let near = x + WHOLE;
    let f = x - (near - WHOLE);
    // Terms in pairs rather than Horner's chain, here and in `log2`: a chain, in which each operation waits for the
    // last one's result, took a third longer.
    let q = f * f;
    let high = (f * 1.339_887_4e-3 + 9.618_437e-3) + q * 1.535_336_2e-4;
    let middle = f * 5.550_332_5e-2 + 2.402_264_8e-1;
    let (linear, rest) = (f * 6.931_472e-1, q * (middle + q * high));
    let power = ((near.bitcast::<S::i32s>() << 23) + 1.0f32.to_bits() as i32).bitcast::<S::f32s>();
    [(-power + 1.0) - (linear + rest) * power, ((linear + 1.0) + rest) * power]
}

/// The binary logarithm of a positive normal `x`: relative error 2e-7 or absolute error 1.5e-7, whichever is more.
///
/// The polynomial is that of Cephes' `logf` on sqrt(1/2)..sqrt(2).
#[inline(always)]
pub fn log2<S: Simd>(_simd: S, x: S::f32s) -> S::f32s {
    const SQRT_HALF: i32 = FRAC_1_SQRT_2.to_bits() as i32;
    const EXPONENT: i32 = 0x7f80_0000;
    let bits = x.bitcast::<S::i32s>();
    // The exponent of x / sqrt(1/2), so that what remains lies around 1 and cancels nothing there.
    let whole = (bits - SQRT_HALF) & (EXPONENT | i32::MIN);
    let f = (bits - whole).bitcast::<S::f32s>() - 1.0;
    let q = f * f;
    let low = (f * -2.499_999_4e-1 + 3.333_333e-1) + q * (f * -1.666_805_8e-1 + 2.000_071_5e-1);
    let high = (f * -1.242_014_1e-1 + 1.424_932_3e-1) + q * (f * -1.151_461e-1 + 1.167_699_87e-1);
    let fourth = q * q;
    let p = low + fourth * (high + fourth * 7.037_683_6e-2);
    let natural = f + q * (p * f - 0.5);
    natural * LOG2_E + (whole >> 23).to_float::<S::f32s>()
}

/// `x^power` for `x` >= 0: relative error 4e-7 + 1e-7 |log2 of the result|.
///
/// An `x` below the least normal number counts as that number, and the result is clamped to 2^-126..2^127.
#[inline(always)]
pub fn powf<S: Simd>(simd: S, x: S::f32s, power: S::f32s) -> S::f32s {
    exp2(simd, log2(simd, x.max(f32::MIN_POSITIVE)) * power)
}

/// A Phong lobe `[Phong75]`: of unit directions `d`, the cosine of the angle to the unit direction `towards`, squared
/// `squarings` times; 0 on the far side.
#[inline(always)]
pub fn lobe<S: Simd>(simd: S, d: V3<S>, towards: Vec3A, squarings: u32) -> S::f32s {
    let mut power = d.dot1(towards).max(S::f32s::splat(simd, 0.0));
    for _ in 0..squarings {
        power *= power;
    }
    power
}

/// The sine of `x` radians for |x| <= 1000: absolute error 2e-7.
///
/// The argument is reduced by pi in two parts, of which the first is so short that its multiples are exact; then
/// follows the odd polynomial of degree 11 of DirectXMath's `XMScalarSin` on -pi/2..pi/2.
#[inline(always)]
pub fn sin<S: Simd>(_simd: S, x: S::f32s) -> S::f32s {
    const PI_HIGH: f32 = 3.140_625;
    const PI_LOW: f32 = 9.676_536e-4;
    let turns = (x * FRAC_1_PI + 0.5).floor();
    let r = (x - turns * PI_HIGH) - turns * PI_LOW;
    let q = r * r;
    let p = q * -2.388_985_9e-8 + 2.752_556_2e-6;
    let p = p * q - 1.984_087_4e-4;
    let p = p * q + 8.333_331e-3;
    let p = p * q - 0.166_666_67;
    let sine = r + r * (q * p);
    // The sine changes its sign with every half turn.
    let sign = turns.to_int::<S::i32s>() << 31;
    (sine.bitcast::<S::i32s>() ^ sign).bitcast()
}

/// `e^(v k)` by component, each exponent as in [`exp2`].
#[simd]
pub fn exp3<S: Simd>(simd: S, v: V3<S>, k: f32) -> V3<S> {
    let k = k * LOG2_E;
    V3 { x: exp2(simd, v.x * k), y: exp2(simd, v.y * k), z: exp2(simd, v.z * k) }
}

/// Smoothstep, `x^2 (3 - 2 x)`: 0 for `x` <= 0, 1 for `x` >= 1, and between them a rise with no slope at either end.
#[inline(always)]
pub fn smooth<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let x = x.max(S::f32s::splat(simd, 0.0)).min(S::f32s::splat(simd, 1.0));
    x * x * (x * -2.0 + 3.0)
}

/// [`smooth`] of one number. NaN gives NaN.
pub fn smooth1(x: f32) -> f32 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// A count or a pixel's number as a float, exact below 2^24.
///
/// Through `i32`, which is one instruction; `u32` takes one that is longer, `u64` several.
#[inline(always)]
pub fn to_f32(n: usize) -> f32 {
    n as i32 as f32
}
