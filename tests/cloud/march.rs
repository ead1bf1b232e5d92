//! One cloud, ray by ray.

use fearless_simd::{Level, dispatch};
use glam::{Vec3A, vec3a};
use paprsek::cloud::grain;
use paprsek::cloud::{CloudKind, Voxels, sunlight};
use proptest::prelude::*;
use testkit::levels;
use testkit::voxels::{
    DAY, FURNACE, aim, ball, cloud, eighths, filled, fine_rays, fine_truth, ray, rays, span, truth, whole_and_eighths,
};

/// Transmittance is a sum of a hundred roundings of numbers up to 1.
const ROUNDING: f64 = 100.0 * 6e-8;
/// The target: relative, at 64 steps.
const RELATIVE: f64 = 1e-4;
/// Places in voxels are good to 1e-5, where a hard edge has a slope of 10 in optical depth.
const PLACES: f64 = 1e-4;

const FOREVER: f32 = f32::INFINITY;

fn grown(kind: &CloudKind, seed: u32, edge: usize) -> Voxels {
    dispatch!(Level::new(), simd => CloudKind::grow(simd, kind, seed, edge))
}

#[test]
fn a_homogeneous_cloud_follows_beer_and_lambert() {
    let rays = [
        (vec3a(0.0, 0.0, 5.0), Vec3A::NEG_Z, 2.0),
        (Vec3A::ZERO, Vec3A::X, 1.0),
        (Vec3A::splat(-3.0), Vec3A::ONE.normalize(), 12f32.sqrt()),
        (vec3a(0.25, 0.5, 0.0), Vec3A::NEG_Y, 1.5),
    ];
    let (mut worst, mut relative) = (0.0f64, 0.0f64);
    for extinction in [0.0, 1e-30, 1e-7, 1e-3, 0.1, 1.0, 2.5, 10.0, 100.0, 1000.0] {
        let cloud = cloud(filled(32, |_| 255), extinction);
        for (eye, d, length) in rays {
            for steps in [1.0, 8.0, 64.0, 100.0, 800.0] {
                let (light, left) = ray(&cloud, &FURNACE, eye, d, FOREVER, steps);
                let exact = (-extinction as f64 * length as f64).exp();
                let error = (left as f64 - exact).abs();
                worst = worst.max(error);
                assert!(error < ROUNDING, "{extinction} along {length} in {steps}: {left} is off by {error:.1e}");
                let sum = (light.x + left - 1.0).abs() as f64;
                assert!(
                    sum < ROUNDING,
                    "{extinction} along {length} in {steps}: light and transmittance are off by {sum:.1e}"
                );
                if steps == 64.0 && extinction <= 2.5 {
                    relative = relative.max(error / exact);
                }
            }
        }
    }
    println!("off by {worst:.1e} at most; relatively, at 64 steps and up to an optical depth of 8.7: {relative:.1e}");
    assert!(relative < RELATIVE);
}

/// Opacity was `1 - transmittance`, step by step: of a cloud that hides 2.5e-8 nothing was left, and of one that hides
/// 1e-6 two digits.
#[test]
fn thin_clouds_hide_what_they_should() {
    // Each step's product and sum may round, and the length of the way.
    const THIN: f64 = 2e-5;
    let (eye, d) = (vec3a(0.25, 0.5, 4.0), vec3a(-0.05, 0.1, -1.0).normalize());
    let (entry, exit) = span(eye.as_dvec3(), d.as_dvec3()).expect("the ray meets the cube");
    let mut worst = 0.0f64;
    for k in 0..=130 {
        let extinction = 10f32.powf(-12.0 + 0.1 * k as f32);
        let cloud = cloud(filled(32, |_| 255), extinction);
        let depth = extinction as f64 * (exit - entry);
        for steps in [8.0, 100.0] {
            for (name, level) in levels() {
                let (light, left) = rays(level, &cloud, &FURNACE, eye, &[d; 16], FOREVER, [steps, 0.0])[0];
                // All light is 1 and comes from everywhere: a cloud is as bright as it is opaque.
                let error = (light.x as f64 / -(-depth).exp_m1() - 1.0).abs();
                assert!(error < THIN, "{name}, depth {depth:.1e} in {steps}: {} is off by {error:.1e} of it", light.x);
                assert!((light.x + left - 1.0).abs() < 1e-6, "{name}, depth {depth:.1e} in {steps}");
                worst = worst.max(error);
            }
        }
    }
    println!("opacity at depths of 2e-12 to 2e1: off by {worst:.1e} of it");
}

#[test]
fn a_ray_ends_where_too_little_comes_through() {
    for extinction in [10.0, 100.0, 1000.0] {
        let cloud = cloud(filled(32, |_| 255), extinction);
        let cut = [100.0, 1.0 / 256.0];
        let (light, left) =
            rays(Level::new(), &cloud, &FURNACE, vec3a(0.0, 0.0, 3.0), &[Vec3A::NEG_Z; 16], 9.0, cut)[0];
        // Not before the share is reached, and a step behind that at the latest.
        let step = (-extinction / 50.0).exp();
        assert!(left < 1.0 / 256.0 && left as f64 > 0.99 * step as f64 / 256.0 - ROUNDING, "{left}");
        assert!((light.x + left - 1.0).abs() < 2e-6);
    }
}

#[test]
fn a_linear_ramp_is_exact_between_centres_of_voxels() {
    // Density 8 i at the i-th of 32 points along an axis: linear between the first centre and the last.
    for axis in 0..3 {
        let cloud = cloud(filled(32, |place| 8 * place[axis] as u8), 1.0);
        let mut eye = vec3a(0.1, 0.2, 0.3);
        eye[axis] = -1.0 + 0.5 / 16.0;
        for voxels in [4.0, 10.0, 31.0] {
            let d = Vec3A::AXES[axis];
            let (_, left) = ray(&cloud, &FURNACE, eye, d, voxels / 16.0, 2.0 * voxels);
            // The mean density of the way is half of that at its end.
            let exact = (-(voxels as f64) / 16.0 * 4.0 * voxels as f64 / 255.0).exp();
            let error = (left as f64 - exact).abs();
            assert!(error < ROUNDING, "{voxels} voxels along axis {axis}: off by {error:.1e}");
        }
    }
}

#[test]
fn a_gaussian_is_met_to_a_ten_thousandth() {
    let (voxels, narrow, extinction) = (64, 6.0, 2.0);
    let cloud = cloud(ball(voxels, narrow), extinction);
    let (mut worst, mut formula) = (0.0f64, 0.0f64);
    for (x, y) in [(0.0, 0.0), (0.1, -0.2), (0.33, 0.21), (-0.4, 0.4)] {
        let eye = vec3a(x, y, 4.0);
        let (_, left) = ray(&cloud, &FURNACE, eye, Vec3A::NEG_Z, FOREVER, 64.0);
        let (_, exact) = truth(&cloud, &FURNACE, eye, Vec3A::NEG_Z, 6400);
        worst = worst.max((left as f64 - exact).abs() / exact);
        // The integral over all z, of which the cube holds all but a thousandth.
        let r2 = (x * x + y * y) as f64;
        let depth = extinction as f64 * (-narrow as f64 * r2).exp() * (std::f64::consts::PI / narrow as f64).sqrt();
        formula = formula.max((left as f64 - (-depth).exp()).abs());
    }
    println!("off by {worst:.1e} relatively, by {formula:.1e} from the formula for unlimited resolution");
    assert!(worst < RELATIVE);
    // Bytes of density are off by 1/510, and so are depths up to 2 sqrt(pi/6).
    assert!(formula < 3e-3, "{formula}");
}

#[test]
fn half_the_step_makes_a_quarter_of_the_error() {
    // Few voxels: their kinks, and not the roundness of the ball, decide the error, with many steps to a voxel.
    let cloud = cloud(ball(8, 5.0), 3.0);
    let mut errors = [0.0; 3];
    for k in 0..500 {
        let (eye, d) = aim(k);
        let exact = truth(&cloud, &FURNACE, eye, d, 3000).1;
        for (error, steps) in errors.iter_mut().zip([32.0, 64.0, 128.0]) {
            *error += (ray(&cloud, &FURNACE, eye, d, FOREVER, steps).1 as f64 - exact).powi(2) / 500.0;
        }
    }
    let errors = errors.map(f64::sqrt);
    println!("errors of 32, 64 and 128 steps: {errors:?}");
    assert!(errors[0] / errors[1] > 3.5 && errors[1] / errors[2] > 3.5, "{errors:?}");
}

#[test]
fn it_is_what_f64_says() {
    let mut voxels = grown(&CloudKind::CUMULUS, 3, 64);
    dispatch!(Level::new(), simd => sunlight::bake(simd, &mut voxels, vec3a(0.6, 0.5, 0.3).normalize(), 20.0));
    let cloud = cloud(voxels, 20.0);
    let mut worst = 0.0f64;
    for k in 0..1000 {
        let (eye, d) = aim(k);
        let (light, left) = ray(&cloud, &DAY, eye, d, FOREVER, 100.0);
        let (exact, exact_left) = truth(&cloud, &DAY, eye, d, 100);
        worst = worst.max((light.as_dvec3() - exact).abs().max_element()).max((left as f64 - exact_left).abs());
    }
    println!("worst error of 1000 rays: {worst:.1e}");
    assert!(worst < PLACES, "{worst}");
}

/// Detail below a voxel is that of the table, and is the same at every level.
#[test]
fn detail_is_what_f64_says() {
    let mut voxels = grown(&CloudKind::CUMULUS.with_rise(0.05), 3, 96);
    dispatch!(Level::new(), simd => sunlight::bake(simd, &mut voxels, vec3a(0.6, 0.5, 0.3).normalize(), 20.0));
    let cloud = cloud(voxels, 20.0);
    let table = grain::table();
    // Its mean is about 0, and it uses its range.
    let detail = table.density().iter().map(|d| f64::from(*d) / 127.5 - 0.8);
    let mean = detail.clone().sum::<f64>() / table.density().len() as f64;
    assert!(mean.abs() < 0.1 && detail.clone().fold(0.0, f64::max) > 0.8, "{mean}");
    let (mut worst, mut changed) = (0.0f64, 0.0f64);
    for k in 0..300 {
        let (eye, d) = aim(k);
        let found = levels().into_iter().map(|(_, level)| {
            fine_rays(level, (&cloud, Some(&table)), &DAY, eye, &[d; 16], FOREVER, [100.0, 0.0])[k % 16]
        });
        let found: Vec<_> = found.collect();
        let (light, left) = found[0];
        assert!(found.iter().all(|other| *other == found[0]), "ray {k}");
        let (exact, exact_left) = fine_truth((&cloud, Some(&table)), &DAY, eye, d, 100);
        worst = worst.max((light.as_dvec3() - exact).abs().max_element()).max((left as f64 - exact_left).abs());
        let plain = ray(&cloud, &DAY, eye, d, FOREVER, 100.0).0;
        changed = changed.max(f64::from((light - plain).abs().max_element()));
    }
    println!("off by {worst:.1e}, {changed:.1e} of it is detail");
    assert!(worst < PLACES && changed > 0.03, "{worst} {changed}");
}

/// Places along a ray were once counted from the eye: transmittances were off by 3e-3 at this distance.
#[test]
fn far_clouds_lose_no_digits() {
    let cloud = cloud(grown(&CloudKind::CUMULUS, 3, 64), 20.0);
    for away in [1e3, 1e5] {
        let mut worst = 0.0f64;
        for k in 0..300 {
            let (near, d) = aim(k);
            let eye = near - d * away;
            let (light, left) = ray(&cloud, &DAY, eye, d, FOREVER, 100.0);
            let (exact, exact_left) = truth(&cloud, &DAY, eye, d, 100);
            worst = worst.max((light.as_dvec3() - exact).abs().max_element()).max((left as f64 - exact_left).abs());
        }
        println!("{away}: off by {worst:.1e} at most");
        assert!(worst < PLACES, "{away}: {worst}");
    }
}

#[test]
fn every_level_gives_the_same_bits() {
    let cloud = cloud(grown(&CloudKind::CONGESTUS, 1, 32), 15.0);
    for k in 0..60 {
        let eye = aim(k).0;
        // Lanes that go apart: some miss, some end early.
        let d = std::array::from_fn(|i| (aim(16 * k + i).1 * 0.7 - eye).normalize());
        for cut in [[100.0, 0.0], [100.0, 1.0 / 256.0], [13.0, 0.1]] {
            let found = levels().into_iter().map(|(name, level)| {
                let rays = rays(level, &cloud, &DAY, eye, &d, 2.5, cut);
                (
                    name,
                    rays.iter()
                        .map(|(light, left)| light.extend(*left).to_array().map(f32::to_bits))
                        .collect::<Vec<_>>(),
                )
            });
            let found: Vec<_> = found.collect();
            for (name, bits) in &found {
                assert_eq!(bits, &found[0].1, "{name} from {eye}");
            }
            // And a lane does not know its neighbours.
            let alone = rays(Level::new(), &cloud, &DAY, eye, &[d[5]; 16], 2.5, cut)[9];
            assert_eq!(alone.0.extend(alone.1).to_array().map(f32::to_bits), found[0].1[5]);
        }
    }
}

#[test]
fn eight_small_cubes_are_one_large_one() {
    let whole = cloud(grown(&CloudKind::CUMULUS, 2, 64), 8.0);
    let parts = eighths(&whole);
    let mut worst = 0.0f32;
    for k in 0..100 {
        let (y, z) = (((k % 10) as f32 - 4.6) / 5.0, ((k / 10) as f32 - 4.4) / 5.0);
        let [one, eight] = whole_and_eighths(&whole, &parts, y, z);
        worst = worst.max((one - eight).abs());
    }
    println!("one cube and eight: {worst:.1e}");
    assert!((worst as f64) < PLACES, "{worst}");
}

#[test]
fn leaps_leave_nothing_out() {
    // A needle of one voxel anywhere, met by rays through it from all sides. Rows of blocks fill a word, or not; their
    // number is a power of two, or not.
    for k in 0..60usize {
        let edge = [32, 4, 20, 100, 128][k % 5];
        let needle = [(k * 7) % edge, (k * 11) % edge, (k * 13) % edge];
        let cloud = cloud(filled(edge, |place| if place == needle { 255 } else { 0 }), 1.6 * edge as f32);
        let target = Vec3A::from(needle.map(|i| (i as f32 + 0.5) * (2.0 / edge as f32) - 1.0));
        for side in 0..20 {
            let a = side as f32;
            let eye = target + vec3a((a * 2.1).sin(), (a * 1.3).cos(), (a * 0.7).sin()).normalize() * 4.0;
            let d = (target - eye).normalize();
            let steps = 3 * edge as u32;
            let (light, left) = ray(&cloud, &DAY, eye, d, FOREVER, steps as f32);
            let (exact, exact_left) = truth(&cloud, &DAY, eye, d, steps);
            assert!(exact_left < 0.9, "the ray meets it");
            let error = (left as f64 - exact_left).abs().max((light.as_dvec3() - exact).abs().max_element());
            assert!(error < PLACES, "{edge} {needle:?} from {eye}: {left} against {exact_left}");
        }
    }
}

/// What empty space is was once measured when voxels were made and never again: a cloud that was written into them later
/// was leapt over, and its pictures were cut to the size of the old one.
#[test]
fn what_is_written_later_is_seen() {
    let needle = |at: usize| filled(32, |place| if place == [at; 3] { 255 } else { 0 });
    let (early, late) = (needle(3), needle(25));
    let mut written = early.clone();
    written.set_density(late.density().to_vec());
    // Density falls from 1 at the voxel's middle to 0 at those of its neighbours, along each axis.
    let bounds = |at: f32| [at - 0.5, at + 1.5].map(|at| Vec3A::splat(at / 16.0 - 1.0));
    assert_eq!((early.bounds(), late.bounds()), (bounds(3.0), bounds(25.0)));
    assert_eq!((written.reach(), written.bounds()), (late.reach(), late.bounds()));
    assert_eq!(late.reach(), late.bounds()[1].length());
    let target = Vec3A::splat(25.5 / 16.0 - 1.0);
    let (eye, d) = (target + Vec3A::Y * 4.0, Vec3A::NEG_Y);
    let [early, late, written] = [early, late, written].map(|voxels| cloud(voxels, 50.0));
    let [early, late, written] = [&early, &late, &written].map(|cloud| ray(cloud, &FURNACE, eye, d, FOREVER, 100.0));
    assert!(early.1 == 1.0 && late.1 < 0.9, "{early:?} {late:?}");
    assert_eq!(written, late);
}

/// A cloud that has none: its box is empty, and rays from anywhere go on as they were.
#[test]
fn emptiness_hides_nothing() {
    let empty = cloud(filled(32, |_| 0), 50.0);
    let [low, high] = empty.voxels.bounds();
    assert!(low.cmpgt(high).all(), "{low} {high}");
    for k in 0..100 {
        let (eye, d) = aim(k);
        assert_eq!(ray(&empty, &DAY, eye, d, FOREVER, 100.0), (Vec3A::ZERO, 1.0));
    }
}

#[test]
fn cameras_in_awkward_places_see_what_they_should() {
    let solid = cloud(filled(32, |_| 255), 1.0);
    let diagonal = Vec3A::ONE.normalize();
    let s = 1.0 - 1e-6;
    let cases = [
        ("behind", vec3a(0.0, 0.0, 2.0), Vec3A::Z, 0.0),
        ("on a face, inwards", Vec3A::Z, Vec3A::NEG_Z, 2.0),
        ("on a face, outwards", Vec3A::Z, Vec3A::Z, 0.0),
        ("on an edge, inwards", vec3a(1.0, 0.0, 1.0), vec3a(-1.0, 0.0, -1.0).normalize(), 8f64.sqrt()),
        ("on an edge, outwards", vec3a(1.0, 0.0, 1.0), vec3a(1.0, 0.0, 1.0).normalize(), 0.0),
        ("on a corner, inwards", Vec3A::ONE, -diagonal, 12f64.sqrt()),
        ("on a corner, outwards", Vec3A::ONE, diagonal, 0.0),
        ("in the middle", Vec3A::ZERO, Vec3A::Y, 1.0),
        ("just inside of an edge, along it", vec3a(2.0, s, s), Vec3A::NEG_X, 2.0),
        ("just past it", vec3a(2.0, 1.0 + 1e-5, 0.0), Vec3A::NEG_X, 0.0),
        ("across a corner, a sliver", vec3a(1.0, 0.999, 0.0), vec3a(-1.0, 1.0, 0.0).normalize(), 0.001 * 2f64.sqrt()),
        ("negative zeros", vec3a(-0.0, -0.0, 3.0), vec3a(-0.0, -0.0, -1.0), 2.0),
        ("denormal slopes", vec3a(0.5, -0.5, 3.0), vec3a(1e-42, -1e-42, -1.0), 2.0),
        ("denormal slopes on a face", vec3a(0.5, -1.0, 3.0), vec3a(1e-42, 1e-42, -1.0), 2.0),
        ("far away", vec3a(0.0, 0.0, 1024.0), Vec3A::NEG_Z, 2.0),
    ];
    for (name, eye, d, length) in cases {
        let (light, left) = ray(&solid, &FURNACE, eye, d, FOREVER, 100.0);
        let error = (left as f64 - (-length).exp()).abs();
        assert!(error < PLACES, "{name}: {left} is off by {error:.1e}");
        assert!((light.x + left - 1.0).abs() < 2e-6, "{name}");
    }
    // What runs in a face or an edge is in the cloud or is not, and nothing else.
    for sides in [[1.0, 0.3], [-1.0, 0.3], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]] {
        let (_, left) = ray(&solid, &FURNACE, vec3a(sides[0], sides[1], 3.0), Vec3A::NEG_Z, FOREVER, 100.0);
        let inside = (left as f64 - (-2f64).exp()).abs() < PLACES;
        assert!(inside || left == 1.0, "{sides:?}: {left}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(3000) })]

    #[test]
    fn nothing_is_lost_whatever_the_ray(
        eye in prop::array::uniform3(prop_oneof![-4f32..4.0, Just(1.0), Just(-1.0), Just(0.0), -1e-30f32..1e-30]),
        d in prop::array::uniform3(prop_oneof![-1f32..1.0, Just(0.0), Just(-0.0), Just(1e-20), Just(-1e-42), Just(1.0)]),
        extinction in prop_oneof![Just(0.0), 0f32..1000.0, 1e-8f32..1e-3],
        limit in prop_oneof![Just(FOREVER), Just(0.0), 0f32..5.0],
    ) {
        let (eye, d) = (Vec3A::from(eye), Vec3A::from(d).normalize_or(Vec3A::Z));
        let solid = cloud(filled(8, |[i, j, l]| (i * 31 + j * 17 + l * 7) as u8), extinction);
        let (light, left) = ray(&solid, &FURNACE, eye, d, limit, 100.0);
        prop_assert!((0.0..=1.0).contains(&left), "transmittance {}", left);
        prop_assert!((light.x + left - 1.0).abs() < 1e-5, "{} and {}", light.x, left);
        if limit == FOREVER && span(eye.as_dvec3(), d.as_dvec3()).is_none_or(|(entry, exit)| exit - entry < 1e-6) {
            // In a face either is right.
            prop_assert!(left > 0.99 || eye.abs().cmpeq(Vec3A::ONE).any(), "it misses, but {} is left", left);
        }
    }
}
