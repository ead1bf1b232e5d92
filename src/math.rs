//! stub
use fearless_simd::prelude::*;
#[inline(always)]
pub fn powf<S: Simd>(simd: S, x: S::f32s, e: S::f32s) -> S::f32s { S::f32s::from_fn(simd, |i| x[i].powf(e[i])) }
#[inline(always)]
pub fn sin<S: Simd>(simd: S, x: S::f32s) -> S::f32s { S::f32s::from_fn(simd, |i| x[i].sin()) }
