//! stub, to be replaced
use fearless_simd::prelude::*;
/// 2^x
#[inline(always)]
pub fn exp2<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let x = x.max(S::f32s::splat(simd, -126.0)).min(S::f32s::splat(simd, 127.0));
    let n = (x + 0.5).floor();
    let f = x - n;
    let p = f * 1.540353e-4 + 1.3333558e-3;
    let p = p * f + 9.618129e-3;
    let p = p * f + 5.550411e-2;
    let p = p * f + 2.4022651e-1;
    let p = p * f + 6.931472e-1;
    let p = p * f + 1.0;
    let i: S::i32s = n.to_int();
    let bits: S::i32s = (i + 127) << 23;
    p * bits.bitcast::<S::f32s>()
}
/// log2 x
#[inline(always)]
pub fn log2<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let bits = x.bitcast::<S::i32s>();
    let e = (bits - 0x3f35_04f3) >> 23;
    let m = (bits - (e << 23)).bitcast::<S::f32s>();
    let one = S::f32s::splat(simd, 1.0);
    let s = (m - one) / (m + one);
    let z = s * s;
    let p = z * 0.32059893 + 0.41219859;
    let p = p * z + 0.57707802;
    let p = p * z + 0.96179669;
    let p = p * z + 2.88539008;
    p * s + e.to_float::<S::f32s>()
}
/// x^e
#[inline(always)]
pub fn powf<S: Simd>(simd: S, x: S::f32s, e: S::f32s) -> S::f32s {
    exp2(simd, log2(simd, x) * e)
}
/// sin x
#[inline(always)]
pub fn sin<S: Simd>(_: S, x: S::f32s) -> S::f32s {
    let n = (x * std::f32::consts::FRAC_1_PI + 0.5).floor();
    let r = x - n * 3.140625 - n * 9.676535e-4;
    let i: S::i32s = n.to_int();
    let z = r * r;
    let p = z * 2.6083159809e-6 - 1.981069071e-4;
    let p = p * z + 8.333078585e-3;
    let p = p * z - 1.666665971e-1;
    let p = (p * z + 1.0) * r;
    ((i << 31) ^ p.bitcast::<S::i32s>()).bitcast()
}
