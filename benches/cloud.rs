//! Clouds on one core: `cargo bench --bench cloud`. How long one of 64^3 voxels takes to grow and to be lit, and how many
//! steps a second rays make through it. What each level makes is held against the first before it is timed.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::{Simd, dispatch, prelude::*};
use glam::{Vec3A, vec3a};
use paprsek::cloud::march::march;
use paprsek::cloud::{Cloud, CloudKind, CloudLight, Voxels, sunlight};
use paprsek::simd::lanes::{F, Lane, V3};
use std::hint::black_box;
use std::sync::Arc;
use testkit::voxels::span;

/// Points along an edge.
const EDGE: usize = 64;
/// Rays along each side of the picture, and steps along an edge of the cube.
const SIDE: usize = 128;
const STEPS: usize = 100;
const EYE: Vec3A = vec3a(0.0, 0.0, 3.0);
/// Distance from the eye at which the picture is 2 wide and high.
const AWAY: f32 = 2.5;
const EXTINCTION: f32 = 20.0;
const SUN: Vec3A = vec3a(0.67, 0.57, 0.47);
const LOOK: CloudLight = CloudLight {
    ambient: [vec3a(0.2, 0.3, 0.4), vec3a(0.4, 0.4, 0.5)],
    towards: SUN,
    sun: Vec3A::ONE,
    phase: [0.8, 0.5],
};

/// Kinds by name.
const KINDS: [(&str, CloudKind); 2] = [("cumulus", CloudKind::CUMULUS), ("congestus", CloudKind::CONGESTUS)];

fn grow(criterion: &mut Criterion) {
    for (kind_name, kind) in KINDS {
        let mut group = criterion.benchmark_group(kind_name);
        group.throughput(Throughput::Elements((EDGE * EDGE * EDGE) as u64)).sample_size(10);
        let mut first = None;
        for (level_name, level) in testkit::levels() {
            let grow = || dispatch!(level, simd => CloudKind::grow(simd, &kind, 0, EDGE));
            let light = |voxels: &mut Voxels| dispatch!(level, simd => sunlight::bake(simd, voxels, SUN, EXTINCTION));
            let mut voxels = grow();
            light(&mut voxels);
            let made: Vec<_> =
                voxels.density().iter().zip(0..).map(|(&density, at)| (density, voxels.light(at))).collect();
            assert!(*first.get_or_insert_with(|| made.clone()) == made, "{kind_name} at {level_name}");
            group.bench_function(format!("{level_name} grow"), |bencher| bencher.iter(|| black_box(grow())));
            group.bench_function(format!("{level_name} light"), |bencher| {
                bencher.iter(|| light(black_box(&mut voxels)))
            });
        }
    }
}

/// Where rays pass through the picture, along either axis.
fn places() -> [f32; SIDE] {
    std::array::from_fn(|i| (i as f32 + 0.5) * (2.0 / SIDE as f32) - 1.0)
}

/// Steps that all rays take where nothing ends them.
fn steps() -> u64 {
    let way = |x: f32, y: f32| span(EYE.as_dvec3(), vec3a(x, y, -AWAY).as_dvec3().normalize());
    let ways = places().into_iter().flat_map(|y| places().map(|x| way(x, y))).flatten();
    ways.map(|(entry, exit)| ((exit - entry) * 0.5 * STEPS as f64).round() as u64).sum()
}

/// The sum of light of rays side by side.
fn sum<S: Simd>(simd: S, cloud: &Cloud, opaque: f32) -> f32 {
    let along = places();
    let mut sum = 0.0;
    for y in along {
        for x in along.chunks(F::<S>::LEN) {
            let d =
                V3::<S> { x: F::<S>::from_slice(simd, x), y: F::<S>::splat(simd, y), z: F::<S>::splat(simd, -AWAY) };
            let length = d.dot(d).sqrt();
            let d = d * Lane(F::<S>::splat(simd, 1.0) / length);
            let limit = F::<S>::splat(simd, f32::INFINITY);
            let met = march(simd, (cloud, None), EYE, d, limit, STEPS as f32, F::<S>::splat(simd, opaque));
            let (light, left) = met.shine(simd, &LOOK, d);
            // One by one, so that every level adds in the same order.
            for i in 0..F::<S>::LEN {
                sum += light.x[i] + left[i];
            }
        }
    }
    sum
}

fn rays(criterion: &mut Criterion) {
    let level = testkit::levels()[0].1;
    let mut grown = dispatch!(level, simd => CloudKind::grow(simd, &CloudKind::CUMULUS, 0, EDGE));
    dispatch!(level, simd => sunlight::bake(simd, &mut grown, SUN, EXTINCTION));
    let full = Voxels::new(EDGE, vec![255; EDGE * EDGE * EDGE]);
    // Every step looked up; and as in pictures, where leaps and opaque clouds spare most of them.
    let cases = [("full", full, 1.0, 0.0), ("cumulus", grown, EXTINCTION, 1.0 / 256.0)];
    for (name, voxels, extinction, opaque) in cases {
        let cloud = Cloud { voxels: Arc::new(voxels), centre: Vec3A::ZERO, size: 1.0, extinction };
        let mut group = criterion.benchmark_group(format!("steps of rays, {name}"));
        group.throughput(Throughput::Elements(steps())).sample_size(20);
        let mut first = None;
        for (level_name, level) in testkit::levels() {
            let sum = || dispatch!(level, simd => sum(simd, &cloud, opaque));
            assert_eq!(*first.get_or_insert_with(sum), sum(), "{level_name}");
            group.bench_function(level_name, |bencher| bencher.iter(|| black_box(sum())));
        }
    }
}

criterion_group!(benches, grow, rays);
criterion_main!(benches);
