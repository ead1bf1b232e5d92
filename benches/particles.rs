//! Particles: motion alone, sprites into tiles, and whole frames of the bench scenes. `cargo bench --bench particles`.
//!
//! `cargo bench --bench particles -- --test` prints a million of each a second. What each level makes is held against the
//! first before it is timed.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::Level;
use paprsek::frame::{Frame, Layer, Renderer, Tile};
use paprsek::particles::{Emitter, ParticleLayer};
use paprsek::scenes;
use paprsek::scenes::bench::particles::{FLAKES, fires, snowfall};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use paprsek::view::View;
use std::hint::black_box;
use std::time::Instant;

/// Frames of a figure that is printed, and the seconds between them: those of the other renderers.
const FRAMES: usize = 20;
const STEP: f64 = 0.05;
const START: f64 = 2.0;
const SIZE: (usize, usize) = (1280, 720);

/// What moves: its name, and how many there are.
const KINDS: [(&str, usize); 2] = [("flakes", FLAKES.count as usize), ("flames", 10_000)];

/// The particles of a bench scene.
fn particles(renderer: &Renderer, kind: usize, time: f64) -> ParticleLayer {
    let (width, height) = SIZE;
    if kind == 0 {
        return snowfall(&renderer.spec(time, &Quality::FAST, SIZE), &FLAKES).without_solids();
    }
    let camera = Camera::look_at(glam::vec3a(4.0, 2.2, 5.8), glam::vec3a(0.0, 1.8, 0.0), 50f32.to_radians(), 0.0);
    let fires = fires(time).into_iter().map(Emitter::Fire).collect();
    ParticleLayer::new(fires, &View::new(camera, width, height), &Quality::EXACT.particles).without_solids()
}

/// Milliseconds: the median.
fn median(mut frame: impl FnMut(f64)) -> f64 {
    frame(START);
    let timed = |k: usize| {
        let began = Instant::now();
        frame(START + k as f64 * STEP);
        began.elapsed().as_secs_f64() * 1000.0
    };
    testkit::median((0..FRAMES).map(timed).collect())
}

/// Draws prepared particles into all tiles of the picture.
fn draw(particles: &ParticleLayer, level: Level, tiles: &mut [Tile]) {
    for tile in tiles {
        tile.clear();
        particles.draw(level, tile);
    }
}

/// The bits of every pixel's light, mixed.
fn sum(tiles: &[Tile]) -> u64 {
    let planes = tiles.iter().flat_map(|tile| [&tile.red, &tile.green, &tile.blue]);
    planes
        .flat_map(|plane| plane.iter())
        .fold(0, |sum, light| sum.wrapping_mul(31).wrapping_add(light.to_bits().into()))
}

fn motion(criterion: &mut Criterion) {
    for (kind, (name, count)) in KINDS.into_iter().enumerate() {
        let mut group = criterion.benchmark_group(format!("motion of {name}"));
        group.throughput(Throughput::Elements(count as u64)).sample_size(20);
        let mut expected = None;
        let settings = testkit::levels().into_iter().map(|level| (level, 1)).chain([(testkit::levels()[0], 2)]);
        for ((level_name, level), threads) in settings {
            let renderer = Renderer::new(threads).expect("threads can be started").at_level(level);
            let prepare = |time: f64| {
                let mut particles = particles(&renderer, kind, time);
                particles.prepare(renderer.workers(), renderer.cache());
                particles.drawn()
            };
            let drawn = prepare(START);
            assert!((count / 20..=count).contains(&drawn), "{name}: {drawn} of {count} are seen");
            assert_eq!(*expected.get_or_insert(drawn), drawn, "{name} {level_name} on {threads} threads");
            let ms = median(|time| {
                black_box(prepare(time));
            });
            println!(
                "{name} {level_name:7} {threads} threads {ms:7.3} ms {:7.1} million a second, of which {drawn} of {count} are seen",
                count as f64 / ms * 1e-3
            );
            let mut step = 0;
            group.bench_function(format!("{level_name} {threads} threads"), |bencher| {
                bencher.iter(|| {
                    step += 1;
                    black_box(prepare(START + step as f64 * STEP))
                });
            });
        }
    }
}

fn sprites(criterion: &mut Criterion) {
    let columns = SIZE.0.div_ceil(Tile::SIZE);
    let place = |n: usize| Tile::at(n % columns, n / columns, SIZE.0, SIZE.1);
    let mut tiles: Vec<_> = (0..columns * SIZE.1.div_ceil(Tile::SIZE)).map(place).collect();
    for (kind, (name, _)) in KINDS.into_iter().enumerate() {
        let mut group = criterion.benchmark_group(format!("sprites of {name}"));
        let mut expected = None;
        for (level_name, level) in testkit::levels() {
            let renderer = Renderer::new(1).expect("threads can be started").at_level(level);
            let mut particles = particles(&renderer, kind, START);
            particles.prepare(renderer.workers(), renderer.cache());
            draw(&particles, level, &mut tiles);
            assert_eq!(*expected.get_or_insert_with(|| sum(&tiles)), sum(&tiles), "{name} at {level_name}");
            let ms = median(|_| draw(&particles, level, &mut tiles));
            let drawn = particles.drawn();
            println!("sprites of {name} {level_name:7} {ms:7.3} ms {:7.2} million a second", drawn as f64 / ms * 1e-3);
            group.throughput(Throughput::Elements(drawn as u64)).sample_size(20);
            group.bench_function(level_name, |bencher| bencher.iter(|| draw(&particles, level, black_box(&mut tiles))));
        }
        assert!(expected.is_some_and(|sum| sum != 0), "{name}: nothing was drawn");
    }
}

fn frames(criterion: &mut Criterion) {
    for name in ["snow", "fire"] {
        let scene = scenes::named(name).expect("a bench scene");
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements((SIZE.0 * SIZE.1) as u64)).sample_size(20);
        let mut frame = Frame::new(SIZE.0, SIZE.1);
        let mut expected = None;
        for threads in [1, 2] {
            let mut renderer = Renderer::new(threads).expect("threads can be started");
            let mut draw = |time: f64| {
                renderer.render(&scene, time, &Quality::FAST, &mut frame);
                // Behind particles a row has one colour.
                frame.pixels.chunks_exact(SIZE.0).flat_map(|row| row.windows(2)).filter(|two| two[0] != two[1]).count()
            };
            let edges = draw(START);
            assert!(edges > 10_000, "{name}: {edges} pixels are unlike their neighbours");
            assert_eq!(*expected.get_or_insert(edges), edges, "{name} on {threads} threads");
            let ms = median(|time| {
                draw(time);
            });
            println!("{name} fast {threads} threads {ms:.3} ms {:.1} fps", 1e3 / ms);
            let mut step = 0;
            group.bench_function(format!("{threads} threads"), |bencher| {
                bencher.iter(|| {
                    step += 1;
                    black_box(draw(START + step as f64 * STEP))
                });
            });
        }
    }
}

criterion_group!(benches, motion, sprites, frames);
criterion_main!(benches);
