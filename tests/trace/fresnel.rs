//! Fresnel's reflectance against f64, for indices that are nearly equal and others, at every SIMD level.
//!
//! `1 - eta^2 (1 - c^2)` cancels where both indices are nearly the same and the ray grazes the surface. At equal indices
//! and a cosine of 1e-4 the surface was a mirror, though there is none.

use fearless_simd::dispatch;
use paprsek::trace::reference;
use testkit::fresnel::{ROUNDING, cases, wide, worst};
use testkit::levels;

#[test]
fn nearly_equal_indices_reflect_nearly_nothing() {
    // Closed forms. Equal indices: nothing, however the ray grazes. Straight on: ((n - 1) / (n + 1))^2.
    for cosine in [1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5] {
        let (share, through) = reference::fresnel(1.0, cosine).expect("equal indices let everything through");
        assert!(share < 1e-12 && (through / cosine - 1.0).abs() < 1e-6, "{cosine}: {share} and {through}");
    }
    let mut failed = Vec::new();
    for (low, high) in [(1e-7, 1e-5), (1e-5, 1e-3), (1e-3, 1e-1), (0.1, 1.0), (1.0, 3.0)] {
        let [eta, cosine] = cases(1 << 18, low, high, 1e-5);
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
