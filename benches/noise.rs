//! Noises a second on one core, on the grid (i, j, k) 0.05 of 256 x 128 x 128 points.
//!
//! `cargo bench --bench noise`. Every level must give the scalar sum bit for bit.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, Throughput, black_box, criterion_group, criterion_main};
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::Vec3A;
use paprsek::noise::{Scratch, fbm, noise, noise_block, octaves_block};
use paprsek::simd::block::BLOCK;
use std::time::Instant;

const SIZE: [usize; 3] = [256, 128, 128];
const STEP: f32 = 0.05;

/// The grid in blocks along x: `evaluate` is given the coordinates and answers with noises, whose bits are summed.
#[inline(always)]
fn grid<S: Simd>(simd: S, planes: usize, mut evaluate: impl FnMut(&[[f32; BLOCK]; 3], &mut [f32; BLOCK])) -> u32 {
    let mut out = [0.0; BLOCK];
    let mut sum = S::u32s::splat(simd, 0);
    let mut p = [[0.0; BLOCK]; 3];
    let mut row = [[0.0; BLOCK]; SIZE[0] / BLOCK];
    for i in 0..SIZE[0] {
        row[i / BLOCK][i % BLOCK] = i as f32 * STEP;
    }
    for k in 0..planes {
        fill(simd, k as f32 * STEP, &mut p[2]);
        for j in 0..SIZE[1] {
            fill(simd, j as f32 * STEP, &mut p[1]);
            for x in &row {
                p[0] = *x;
                evaluate(&p, &mut out);
                let mut i = 0;
                while i < BLOCK {
                    sum += S::f32s::from_slice(simd, &out[i..i + S::f32s::LEN]).bitcast::<S::u32s>();
                    i += S::f32s::LEN;
                }
            }
        }
    }
    sum.reduce_sum()
}

#[inline(always)]
fn fill<S: Simd>(simd: S, value: f32, out: &mut [f32; BLOCK]) {
    let mut i = 0;
    while i < BLOCK {
        S::f32s::splat(simd, value).store_slice(&mut out[i..i + S::f32s::LEN]);
        i += S::f32s::LEN;
    }
}

fn wide(level: Level, planes: usize, octaves: Option<u32>) -> u32 {
    let mut scratch = Scratch::default();
    dispatch!(level, simd => grid(simd, planes, #[inline(always)] |[x, y, z], out| match octaves {
        None => noise_block(simd, x, y, z, 1.0, BLOCK, &mut scratch, out),
        Some(octaves) => octaves_block(simd, [x, y, z], octaves, false, BLOCK, None, out),
    }))
}

fn scalar(planes: usize, octaves: Option<u32>) -> u32 {
    let mut sum = 0u32;
    for k in 0..planes {
        for j in 0..SIZE[1] {
            for i in 0..SIZE[0] {
                let p = Vec3A::new(i as f32, j as f32, k as f32) * STEP;
                sum = sum.wrapping_add(octaves.map_or_else(|| noise(p), |n| fbm(p, n)).to_bits());
            }
        }
    }
    sum
}

/// Prints the median of seven in million evaluations a second.
fn report(name: &str, points: usize, mut run: impl FnMut() -> u32) {
    let mut seconds = [0.0; 7];
    for second in &mut seconds {
        let start = Instant::now();
        black_box(run());
        *second = start.elapsed().as_secs_f64();
    }
    seconds.sort_by(f64::total_cmp);
    println!("{name:24} {:8.1} Meval/s", points as f64 * 1e-6 / seconds[3]);
}

fn bench(c: &mut Criterion) {
    for (name, planes, octaves) in [("noise", SIZE[2], None), ("fbm4", SIZE[2] / 4, Some(4))] {
        let points = SIZE[0] * SIZE[1] * planes;
        let expected = scalar(planes, octaves);
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Elements(points as u64)).sample_size(10);
        report(&format!("{name} scalar"), points, || scalar(planes, octaves));
        group.bench_function("scalar", |b| b.iter(|| scalar(planes, octaves)));
        for (level_name, level) in testkit::levels() {
            assert_eq!(wide(level, planes, octaves), expected, "{name} {level_name}");
            report(&format!("{name} {level_name}"), points, || wide(level, planes, octaves));
            group.bench_function(level_name, |b| b.iter(|| wide(level, planes, octaves)));
        }
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
