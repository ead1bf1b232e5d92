//! Fresnel's reflectance of a dielectric in f64, and ratios of indices and cosines at which f32 is in trouble.

use super::ULP;
use super::random::Random;
use fearless_simd::{Simd, prelude::*};
use paprsek::simd::lanes::F;
use paprsek::trace::fresnel;

/// A dozen roundings of numbers up to 1.
pub const ROUNDING: f64 = 6e-7;
/// Near the critical angle the reflectance is as steep as a root: what so many units in the last place of the cosine
/// make of it is no error of ours.
pub const DOUBT: f64 = 3.0 * 2.0 * ULP;

/// Reflectance and cosine behind the surface of ratios of indices and cosines.
#[inline(always)]
pub fn lanes<S: Simd>(simd: S, eta: &[f32], cosine: &[f32]) -> Vec<Option<(f32, f32)>> {
    let lanes = F::<S>::LEN;
    let mut found = Vec::new();
    for (eta, cosine) in eta.chunks_exact(lanes).zip(cosine.chunks_exact(lanes)) {
        let (share, through, passes) = fresnel(simd, F::<S>::from_slice(simd, eta), F::<S>::from_slice(simd, cosine));
        let passes = passes.to_bitmask();
        found.extend((0..lanes).map(|lane| (passes >> lane & 1 == 1).then_some((share[lane], through[lane]))));
    }
    found
}

/// The same, and that a share of 1 and a cosine of 0 come with a total reflection.
#[inline(always)]
pub fn wide<S: Simd>(simd: S, eta: &[f32], cosine: &[f32]) -> Vec<Option<(f32, f32)>> {
    let width = F::<S>::LEN;
    for (eta, cosine) in eta.chunks_exact(width).zip(cosine.chunks_exact(width)) {
        let (share, through, passes) = fresnel(simd, F::<S>::from_slice(simd, eta), F::<S>::from_slice(simd, cosine));
        let passes = passes.to_bitmask();
        for lane in (0..width).filter(|lane| passes >> lane & 1 == 0) {
            assert_eq!((share[lane], through[lane].max(0.0)), (1.0, 0.0));
        }
    }
    lanes(simd, eta, cosine)
}

/// The squared cosine behind the surface, and the reflectance: from the same two numbers, without cancellation.
pub fn truth(eta: f64, cosine: f64) -> (f64, f64) {
    let k = (1.0 - eta) * (1.0 + eta) + (eta * cosine).powi(2);
    if k <= 0.0 {
        return (k, 1.0);
    }
    let through = k.sqrt();
    // (a - b) / (a + b) with the difference of squares, which is exact where a and b are close.
    let s = (eta - 1.0) * (eta + 1.0) / (eta * cosine + through).powi(2);
    let p = (eta * through - cosine) / (eta * through + cosine);
    (k, 0.5 * (s * s + p * p))
}

/// The largest error over what is allowed, and the largest error.
pub fn worst(eta: &[f32], cosine: &[f32], found: &[Option<(f32, f32)>]) -> (f64, f64) {
    let mut worst = (0.0f64, 0.0f64);
    for ((&eta, &cosine), found) in eta.iter().zip(cosine).zip(found) {
        let (eta, cosine) = (eta as f64, cosine as f64);
        let share = truth(eta, cosine).1;
        let slack = [1.0 - DOUBT, 1.0 + DOUBT].map(|k| (truth(eta, cosine * k).1 - share).abs());
        let error = (found.map_or(1.0, |found| found.0) as f64 - share).abs();
        worst = (worst.0.max(error / (ROUNDING + slack[0].max(slack[1]))), worst.1.max(error));
    }
    worst
}

/// Pairs of a ratio and a cosine: half of the ratios below 1, half above. Where the ratio is above 1, half of the
/// cosines stand close to the critical angle.
pub fn cases(count: usize, low: f64, high: f64, steepest: f64) -> [Vec<f32>; 2] {
    let mut random = Random(20);
    let (mut etas, mut cosines) = (Vec::new(), Vec::new());
    for k in 0..count {
        let apart = random.log(low, high);
        let eta = (if k % 2 == 0 { 1.0 / (1.0 + apart) } else { 1.0 + apart }) as f32;
        let mut cosine = random.log(steepest, 1.0);
        if k % 4 == 3 {
            let critical = (1.0 - (eta as f64).powi(-2)).max(0.0).sqrt();
            cosine = (critical * (1.0 + random.log(1e-7, 1.0))).clamp(steepest, 1.0);
        }
        etas.push(eta);
        cosines.push(cosine as f32);
    }
    [etas, cosines]
}

/// Unpolarised reflectance of a body of index `n` at an angle of incidence in radians, as Fresnel wrote it: sines and
/// tangents of sums, no cosines of ours.
pub fn by_angles(n: f64, angle: f64) -> f64 {
    if angle == 0.0 {
        return ((n - 1.0) / (n + 1.0)).powi(2);
    }
    if angle.sin() >= n {
        return 1.0;
    }
    let behind = (angle.sin() / n).asin();
    let (minus, plus) = (angle - behind, angle + behind);
    let s = (minus.sin() / plus.sin()).powi(2);
    0.5 * (s + (minus.tan() / plus.tan()).powi(2))
}
