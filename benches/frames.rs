//! One frame of every scene at every quality that is played: `cargo bench --bench frames`.
//!
//! Before a scene is timed its pictures are judged: the fast one must be what `exact` shows, to 40 dB.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::hint::black_box;

#[path = "../examples/common/maps.rs"]
mod maps;

const SIZE: (usize, usize) = (640, 360);
/// The least likeness of a fast picture to the exact one, decibels.
const PSNR: f64 = 40.0;

/// Likeness of two frames over 8-bit RGB, decibels.
fn psnr(a: &Frame, b: &Frame) -> f64 {
    let channels = |p: u32| [p >> 16 & 255, p >> 8 & 255, p & 255];
    let squares = a
        .pixels
        .iter()
        .zip(&b.pixels)
        .flat_map(|(p, q)| channels(*p).into_iter().zip(channels(*q)).map(|(x, y)| (x as f64 - y as f64).powi(2)));
    let mean = squares.sum::<f64>() / (3 * a.pixels.len()) as f64;
    10.0 * (255.0 * 255.0 / mean.max(1e-9)).log10()
}

fn frames(criterion: &mut Criterion) {
    let mut renderer = Renderer::new(2).expect("two threads");
    let mut draw = |scene: &Scene, quality: &Quality| {
        let mut frame = Frame::new(SIZE.0, SIZE.1);
        maps::forget(&renderer);
        renderer.render(scene, 2.0, quality, &mut frame);
        frame
    };
    // The show's parts are scenes of their own.
    for scene in scenes::all().iter().filter(|scene| scene.name != scenes::INTRO.name) {
        let (fast, exact) = (draw(scene, &Quality::FAST), draw(scene, &Quality::EXACT));
        assert!(psnr(&fast, &exact) >= PSNR, "{}: {:.1} dB", scene.name, psnr(&fast, &exact));
        assert!(fast.pixels.iter().any(|p| *p != fast.pixels[0]), "{}: one colour", scene.name);
        let mut group = criterion.benchmark_group(scene.name);
        group.throughput(Throughput::Elements((SIZE.0 * SIZE.1) as u64)).sample_size(20);
        for name in ["fast", "default", "exact"] {
            let quality = Quality::named(name).expect("a quality of the command line");
            group.bench_function(name, |bencher| bencher.iter(|| black_box(draw(scene, &quality))));
        }
    }
}

criterion_group!(benches, frames);
criterion_main!(benches);
