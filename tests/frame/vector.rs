//! Cross products and unit vectors: the bits of glam's scalar vectors, which round each product alone, and close to f64.

use glam::{Vec3, Vec3A, vec3a};
use paprsek::vector::{cross, unit};
use testkit::random::Random;

/// Vectors of all sizes, pairs of which are parallel but for their last bits as often as not.
fn pairs() -> impl Iterator<Item = (Vec3A, Vec3A)> {
    let mut random = Random(11);
    (0..100_000).map(move |_| {
        let a = random.direction() * random.log(1e-12, 1e12) as f32;
        let near = a + random.direction() * (a.length() * random.log(1e-8, 1e-3) as f32);
        (a, if random.unit() < 0.5 { near } else { random.direction() * random.log(1e-12, 1e12) as f32 })
    })
}

#[test]
fn cross_products_round_each_product_alone() {
    let mut cancelled = 0;
    for (a, b) in pairs() {
        let found = cross(a, b);
        assert_eq!(
            found.to_array().map(f32::to_bits),
            Vec3::from(a).cross(b.into()).to_array().map(f32::to_bits),
            "{a} {b}"
        );
        let (exact, size) = (a.as_dvec3().cross(b.as_dvec3()), a.as_dvec3().length() * b.as_dvec3().length());
        assert!((found.as_dvec3() - exact).length() <= 2e-7 * size, "{a} {b}: {found}, not {exact}");
        cancelled += usize::from(exact.length() < 1e-5 * size);
    }
    assert!(cancelled > 10_000, "{cancelled}");
    assert_eq!(cross(Vec3A::X, Vec3A::Y), Vec3A::Z);
    assert_eq!(cross(Vec3A::Y, Vec3A::Z), Vec3A::X);
    assert_eq!(cross(Vec3A::Z, Vec3A::X), Vec3A::Y);
}

#[test]
fn unit_vectors_have_a_length_of_one() {
    for (a, _) in pairs() {
        let found = unit(a);
        assert_eq!(found.to_array().map(f32::to_bits), Vec3::from(a).normalize().to_array().map(f32::to_bits), "{a}");
        assert!((found.as_dvec3() - a.as_dvec3().normalize()).length() <= 3e-7, "{a}: {found}");
    }
    for bad in [Vec3A::ZERO, vec3a(f32::NAN, 1.0, 0.0), vec3a(f32::INFINITY, 0.0, 0.0)] {
        assert!(!unit(bad).is_finite(), "{bad}");
    }
}
