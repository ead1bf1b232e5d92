//! Fresnel's reflectance against f64, for indices that are nearly equal and others, at every SIMD level.
//!
//! `1 - eta^2 (1 - c^2)` cancels where both indices are nearly the same and the ray grazes the surface. At equal indices
//! and a cosine of 1e-4 the surface was a mirror, though there is none.

use fearless_simd::{Simd, dispatch, prelude::*};
use paprsek::simd::lanes::F;
use paprsek::trace::{fresnel, reference};
use testkit::random::Random;
use testkit::{ULP, levels};

/// A dozen roundings of numbers up to 1.
const ROUNDING: f64 = 6e-7;
/// Near the critical angle the reflectance is as steep as a root: what so many units in the last place of the cosine
/// make of it is no error of ours.
const DOUBT: f64 = 3.0 * 2.0 * ULP;

/// Reflectance and cosine behind the surface of ratios of indices and cosines.
#[inline(always)]
fn wide<S: Simd>(simd: S, eta: &[f32], cosine: &[f32]) -> Vec<Option<(f32, f32)>> {
    let lanes = F::<S>::LEN;
    let mut found = Vec::new();
    for (eta, cosine) in eta.chunks_exact(lanes).zip(cosine.chunks_exact(lanes)) {
        let (share, through, passes) = fresnel(simd, F::<S>::from_slice(simd, eta), F::<S>::from_slice(simd, cosine));
        let passes = passes.to_bitmask();
        found.extend((0..lanes).map(|lane| (passes >> lane & 1 == 1).then_some((share[lane], through[lane]))));
        for lane in (0..lanes).filter(|lane| passes >> lane & 1 == 0) {
            assert_eq!((share[lane], through[lane].max(0.0)), (1.0, 0.0));
        }
    }
    found
}

/// The squared cosine behind the surface, and the reflectance: from the same two numbers, without cancellation.
fn truth(eta: f64, cosine: f64) -> (f64, f64) {
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
fn worst(eta: &[f32], cosine: &[f32], found: &[Option<(f32, f32)>]) -> (f64, f64) {
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
fn cases(low: f64, high: f64, steepest: f64) -> [Vec<f32>; 2] {
    let mut random = Random(20);
    let (mut etas, mut cosines) = (Vec::new(), Vec::new());
    for k in 0..1 << 18 {
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

#[test]
fn nearly_equal_indices_reflect_nearly_nothing() {
    // Closed forms. Equal indices: nothing, however the ray grazes. Straight on: ((n - 1) / (n + 1))^2.
    for cosine in [1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5] {
        let (share, through) = reference::fresnel(1.0, cosine).expect("equal indices let everything through");
        assert!(share < 1e-12 && (through / cosine - 1.0).abs() < 1e-6, "{cosine}: {share} and {through}");
    }
    let mut failed = Vec::new();
    for (low, high) in [(1e-7, 1e-5), (1e-5, 1e-3), (1e-3, 1e-1), (0.1, 1.0), (1.0, 3.0)] {
        let [eta, cosine] = cases(low, high, 1e-5);
        let plain: Vec<_> = eta.iter().zip(&cosine).map(|(&eta, &cosine)| reference::fresnel(eta, cosine)).collect();
        let (share, error) = worst(&eta, &cosine, &plain);
        println!("|eta - 1| of {low:.0e} to {high:.0e}: off by {error:.1e}, {share:.2} of what is allowed");
        if share > 1.0 {
            failed.push((low, share, error));
        }
        for (name, level) in levels() {
            let found = dispatch!(level, simd => wide(simd, &eta, &cosine));
            assert!(found == plain, "{name}: the packet is not the reference");
        }
    }
    assert!(failed.is_empty(), "from |eta - 1|, times what is allowed, error: {failed:?}");
}

#[test]
fn edges_of_the_range() {
    for eta in [0.1, 0.5, 0.999, 1.0, 1.001, 1.5, 4.0] {
        assert!(reference::fresnel(eta, 0.0).is_none_or(|found| found.0 == 1.0), "{eta}");
        let straight = ((1.0 - eta as f64) / (1.0 + eta as f64)).powi(2);
        let (share, through) = reference::fresnel(eta, 1.0).expect("straight on there is no total reflection");
        assert!((share as f64 - straight).abs() < ROUNDING && (through - 1.0).abs() < 1e-6, "{eta}: {share}");
        assert_eq!(reference::fresnel(eta, f32::NAN), None);
    }
    assert_eq!(reference::fresnel(f32::NAN, 0.5), None);
}
