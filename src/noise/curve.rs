//! Perlin's weights and the interpolation, over lanes.

use fearless_simd::prelude::*;

/// [`fade`](super::reference::fade) over lanes.
#[inline(always)]
pub fn fade<S: Simd, F: SimdFloat<S, Element = f32>>(t: F) -> F {
    let d = t - 0.5;
    let q = d * d;
    d * (q * (q * 6.0 - 5.0) + 1.875) + 0.5
}

/// Linear interpolation over lanes: `a` at `t` = 0, `b` at `t` = 1.
#[inline(always)]
pub fn lerp<S: Simd, F: SimdFloat<S, Element = f32>>(t: F, a: F, b: F) -> F {
    a + t * (b - a)
}
