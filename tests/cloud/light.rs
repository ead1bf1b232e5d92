//! What grows, and what the sun lights of it.

use fearless_simd::{Level, dispatch};
use glam::vec3a;
use paprsek::cloud::{CloudKind, sunlight};
use paprsek::scenes::bench::cumulus_set::{shape, sun};
use testkit::levels;
use testkit::voxels::{cumulus, depth, lit};

const KINDS: [CloudKind; 2] = [CloudKind::CUMULUS, CloudKind::CONGESTUS];
/// Every so many voxels are looked at: no divisor of 64.
const STRIDE: usize = 37;
const VOXELS: usize = 64 * 64 * 64;

#[test]
fn the_bench_scenes_have_the_voxels_specified() {
    for k in 0..4 {
        let voxels = shape(k as usize);
        let (mut off, mut dark) = (0, 0);
        for at in (0..VOXELS).step_by(STRIDE) {
            let density = cumulus(k, [at % 64, at / 64 % 64, at / 4096]);
            let error = (voxels.density()[at] as f64 - density).abs();
            // Half a code of rounding, and 2e-6 of distance in f32 over 0.12.
            assert!(error < 0.51, "shape {k}, voxel {at}: {} for {density}", voxels.density()[at]);
            off += (voxels.density()[at] > 0) as u32;
        }
        for at in (0..VOXELS).step_by(23 * STRIDE) {
            let light = 255.0 * lit(depth(&voxels, at, sun().as_dvec3(), 30.0, [60, 1]));
            let error = (voxels.light(at) as f64 - light).abs();
            assert!(error < 0.51, "shape {k}, voxel {at}: light {} for {light}", voxels.light(at));
            dark += (light < 200.0) as u32;
        }
        assert!(off > 500 && dark > 20, "{off} voxels are cloud, and {dark} dark");
    }
}

#[test]
fn the_sweep_s_light_is_that_of_a_ray_a_voxel() {
    // Light spreads by bilinear lookups from layer to layer, so it is a little smoother than by rays.
    const RMS: f64 = 0.04;
    for (number, kind) in KINDS.iter().enumerate() {
        let mut voxels = dispatch!(Level::new(), simd => CloudKind::grow(simd, kind, 0, 64));
        let full = voxels.density().iter().filter(|density| **density > 0).count();
        assert!((8_000..180_000).contains(&full), "{full} voxels of {kind:?}");
        for towards in [vec3a(0.6, 0.55, 0.45), vec3a(-0.3, 0.9, 0.1), vec3a(0.2, 0.05, -0.97), vec3a(0.0, 1.0, 0.0)] {
            let towards = towards.normalize();
            dispatch!(Level::new(), simd => sunlight::bake(simd, &mut voxels, towards, 20.0));
            let (mut sum, mut worst, mut count) = (0.0, 0.0f64, 0.0);
            // Points whose light a lookup may ask for: those with some density, and their neighbours. Nothing is in the faces
            // of the cube, so that no row runs into the next.
            let asked = |at: &usize| {
                let near = |k: usize| (at + k % 3 + k / 3 % 3 * 64 + k / 9 * 4096).wrapping_sub(1 + 64 + 4096);
                (0..27).any(|k| voxels.density().get(near(k)).is_some_and(|density| *density > 0))
            };
            for at in (0..VOXELS).step_by(STRIDE).filter(asked).step_by(4) {
                let error =
                    voxels.light(at) as f64 / 255.0 - lit(depth(&voxels, at, towards.as_dvec3(), 20.0, [4 * 111, 4]));
                (sum, worst, count) = (sum + error * error, worst.max(error.abs()), count + 1.0);
            }
            let rms = (sum / count).sqrt();
            println!("kind {number} lit from {towards:.2}: rms {rms:.4}, worst {worst:.3} of {count} voxels");
            assert!(rms < RMS, "rms {rms}");
        }
    }
}

#[test]
fn a_slab_s_light_is_exact() {
    // Layers of one density across the sun's way: nothing varies sideways, so sweep and ray are the same.
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let mut voxels = testkit::voxels::filled(64, |place| (place[axis] * 4) as u8);
            let mut towards = glam::Vec3A::ZERO;
            towards[axis] = sign;
            dispatch!(Level::new(), simd => sunlight::bake(simd, &mut voxels, towards, 20.0));
            for i in 0..64 {
                let at = 32 * (1 + 64 + 4096) + i * [1, 64, 4096][axis] - 32 * [1, 64, 4096][axis];
                let between = if sign > 0.0 { i + 1..64 } else { 0..i };
                let sum = between.map(|k| 4.0 * k as f64).sum::<f64>() + 2.0 * i as f64;
                let exact = 255.0 * lit(20.0 * sum / 255.0 * 2.0 / 64.0);
                let error = (voxels.light(at) as f64 - exact).abs();
                assert!(error < 0.51, "axis {axis}, {sign}, voxel {i}: {} for {exact}", voxels.light(at));
            }
        }
    }
}

#[test]
fn every_level_grows_and_lights_the_same_bytes() {
    for (kind, seed) in KINDS.iter().zip(0..) {
        let mut first = None;
        for (name, level) in levels() {
            let mut voxels = dispatch!(level, simd => CloudKind::grow(simd, kind, seed, 32));
            dispatch!(level, simd => sunlight::bake(simd, &mut voxels, vec3a(0.4, 0.3, -0.7).normalize(), 20.0));
            let found: Vec<_> =
                voxels.density().iter().zip(0..).map(|(&density, at)| (density, voxels.light(at))).collect();
            assert!(*first.get_or_insert_with(|| found.clone()) == found, "{kind:?} at {name}");
        }
    }
}
