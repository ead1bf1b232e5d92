//! Encoding rows of 1280 pixels on one core, in nanoseconds a pixel.
//!
//! `cargo bench --bench color`. Every level must give the same pixels.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, Throughput, black_box, criterion_group, criterion_main};
use fearless_simd::{Level, dispatch};
use paprsek::frame::encode::{Transfer, encode};
use std::time::Instant;

const PIXELS: usize = 1280;
const ROWS: u32 = 720;

fn frame(level: Level, transfer: Transfer, [r, g, b]: [&[f32]; 3], out: &mut [u32]) -> u32 {
    let mut sum = 0u32;
    for y in 0..ROWS {
        dispatch!(level, simd => encode(simd, transfer, 0, y, r, g, b, out));
        sum = sum.wrapping_mul(31).wrapping_add(out[y as usize]);
    }
    sum
}

fn bench(c: &mut Criterion) {
    // Three rows of their own: the compiler would share the work of equal channels.
    let channels = [1.0, 0.7, 1.3].map(|s| (0..PIXELS).map(|i| s * i as f32 / PIXELS as f32).collect::<Vec<f32>>());
    let light = channels.each_ref().map(|c| &c[..]);
    let mut out = vec![0; PIXELS];
    for (name, transfer) in [("gamma22", Transfer::Gamma22), ("srgb", Transfer::Srgb)] {
        let mut group = c.benchmark_group(name);
        group.throughput(Throughput::Elements(PIXELS as u64 * ROWS as u64)).sample_size(10);
        let mut expected = None;
        for (level_name, level) in testkit::levels() {
            let sum = frame(level, transfer, light, &mut out);
            assert_eq!(*expected.get_or_insert(sum), sum, "{name} {level_name}");
            let best = (0..7).map(|_| {
                let start = Instant::now();
                black_box(frame(level, transfer, black_box(light), &mut out));
                start.elapsed().as_secs_f64()
            });
            let nanoseconds = best.fold(f64::MAX, f64::min) * 1e9 / (PIXELS as f64 * ROWS as f64);
            println!("{name} {level_name:8} {nanoseconds:6.3} ns/pixel");
            group.bench_function(level_name, |b| b.iter(|| frame(level, transfer, black_box(light), &mut out)));
        }
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
