//! The rasterizer: depth maps alone, and whole frames of its bench scenes. `cargo bench --bench raster`.
//!
//! `cargo bench --bench raster -- --test` prints million triangles a second, as other renderers count them: all 9984 of
//! the set times the passes, whether they are seen or not. Light and torch move from frame to frame.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::Level;
use glam::{Affine3A, Vec2, Vec3A};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Cache, Frame, Layer, Picture, Renderer, Stats, Tile, Workers};
use paprsek::raster::{Bias, Body, Light, Projection, RasterLayer, RasterMemory, ShadowViews, World, fit};
use paprsek::scenes;
use paprsek::scenes::bench::shadow_set;
use paprsek::settings::Quality;
use paprsek::view::Camera;
use paprsek::view::View;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;
use testkit::drawn::forget_maps;

/// Triangles of the set.
const TRIANGLES: usize = 9984;
/// Frames of a figure that is printed, and the seconds between them: those of the other renderers.
const FRAMES: usize = 40;
const STEP: f64 = 0.05;
const START: f64 = 2.0;
const SIZE: (usize, usize) = (1280, 720);

/// Only the maps, all of whose tiles are drawn, whether they are looked up or not.
struct DepthOnly(RasterLayer);

impl Layer for DepthOnly {
    fn prepare(&mut self, workers: &Workers, cache: &Cache) {
        self.0.prepare(workers, cache);
        let memory = cache.get::<RasterMemory>();
        memory.lock().maps.iter().for_each(|(_, map)| map.draw_all(workers));
    }

    fn draw(&self, _level: Level, _tile: &mut Tile) -> Stats {
        Stats::default()
    }
}

/// What a light sees.
#[derive(Clone, Copy)]
enum Case {
    Sun,
    Cube,
}

impl Case {
    /// Its name, the edge of a map in texels, the number of maps.
    fn numbers(self) -> (&'static str, usize, usize) {
        match self {
            Case::Sun => ("sun 1024^2", 1024, 1),
            Case::Cube => ("cube 6 x 512^2", 512, 6),
        }
    }

    fn light(self, time: f64) -> Light {
        let (_, size, _) = self.numbers();
        let (light, views) = match self {
            Case::Sun => {
                let towards = shadow_set::sun(time).as_vec3a();
                let views = vec![Projection::parallel(towards, Vec3A::ZERO, 72.0, size as u32)];
                (Light::sun(towards, Vec3A::ONE), views)
            }
            Case::Cube => {
                let position = shadow_set::torch(time).as_vec3a();
                let light = Light::lamp(position, Vec3A::ONE, Vec2::new(0.0, 0.06), f32::INFINITY);
                (light, fit::cube(position, size as u32))
            }
        };
        light.with_shadow(ShadowViews { smooth: false, ..ShadowViews::new(views, Bias::default()) })
    }
}

/// The set under a light, whose maps are all that is drawn: the camera is far off and looks away.
fn depth_only(bodies: &[Body], light: Light) -> Picture {
    let camera = Camera::look_at(Vec3A::splat(1e4), Vec3A::splat(2e4), 0.1, 0.0);
    let world = World { lights: vec![light], ..World::new(bodies.to_vec()) };
    let drawn = RasterLayer::new(world, &View::new(camera, Tile::SIZE, Tile::SIZE), &Quality::FAST.raster);
    Picture { layers: vec![Box::new(DepthOnly(drawn))], transfer: Transfer::Gamma22 }
}

/// The bits of every texel, mixed.
fn sum(renderer: &Renderer) -> u64 {
    let memory = renderer.cache().get::<RasterMemory>();
    let memory = memory.lock();
    let (key, map) = memory.maps.iter().find(|(key, _)| key.slot == 0).expect("a map was drawn");
    let mut sum = 0u64;
    for view in 0..key.views.len() {
        for (x, y) in (0..map.size).flat_map(|y| (0..map.size).map(move |x| (x, y))) {
            sum = sum.wrapping_mul(31).wrapping_add(map.at(view, x, y).to_bits().into());
        }
    }
    sum
}

/// Milliseconds of a frame: the median.
fn median(mut frame: impl FnMut(f64)) -> f64 {
    frame(START);
    let timed = |k: usize| {
        let began = Instant::now();
        frame(START + k as f64 * STEP);
        began.elapsed().as_secs_f64() * 1000.0
    };
    testkit::median((0..FRAMES).map(timed).collect())
}

fn depth(criterion: &mut Criterion) {
    let meshes = shadow_set::meshes();
    assert_eq!(meshes.iter().map(|mesh| mesh.faces.len()).sum::<usize>(), TRIANGLES);
    let bodies: Vec<_> = meshes.into_iter().map(|mesh| Body::new(Arc::new(mesh), Affine3A::IDENTITY)).collect();
    let mut frame = Frame::new(Tile::SIZE, Tile::SIZE);
    for case in [Case::Sun, Case::Cube] {
        let (name, size, count) = case.numbers();
        let mut group = criterion.benchmark_group(format!("depth {name}"));
        group.throughput(Throughput::Elements((TRIANGLES * count) as u64)).sample_size(20);
        let mut expected = None;
        let settings = testkit::levels().into_iter().map(|level| (level, 1)).chain([(testkit::levels()[0], 2)]);
        for ((level_name, level), threads) in settings {
            let mut renderer = Renderer::new(threads).expect("threads can be started").at_level(level);
            let mut draw = |renderer: &mut Renderer, time: f64| {
                forget_maps(renderer);
                black_box(renderer.draw(depth_only(&bodies, case.light(time)), &mut frame));
            };
            draw(&mut renderer, START);
            let found = sum(&renderer);
            assert_eq!(*expected.get_or_insert(found), found, "{name} {level_name} on {threads} threads");
            let ms = median(|time| draw(&mut renderer, time));
            println!(
                "{name:15} {level_name:7} {threads} threads {ms:7.3} ms {:7.2} Mtri/s {:8.1} Mpixel/s",
                (TRIANGLES * count) as f64 / ms * 1e-3,
                (size * size * count) as f64 / ms * 1e-3
            );
            let mut step = 0;
            group.bench_function(format!("{level_name} {threads} threads"), |bencher| {
                bencher.iter(|| {
                    step += 1;
                    draw(&mut renderer, START + step as f64 * STEP);
                });
            });
        }
    }
}

fn frames(criterion: &mut Criterion) {
    let mut renderer = Renderer::new(2).expect("two threads");
    for (name, passes) in [("shadow", 2), ("shadow-cube", 7)] {
        let scene = scenes::named(name).expect("a bench scene");
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements((SIZE.0 * SIZE.1) as u64)).sample_size(20);
        for quality_name in ["fast", "default"] {
            let quality = Quality::named(quality_name).expect("a quality of the command line");
            let mut frame = Frame::new(SIZE.0, SIZE.1);
            let mut draw = |time: f64| {
                forget_maps(&renderer);
                renderer.render(&scene, time, &quality, &mut frame).samples
            };
            // Every pixel but those of the sky has a fragment.
            let share = draw(START) as f64 / (SIZE.0 * SIZE.1) as f64;
            assert!((0.5..2.0).contains(&share), "{name} {quality_name}: {share} fragments a pixel");
            let ms = median(|time| {
                draw(time);
            });
            println!(
                "{name} {quality_name} 2 threads {ms:.3} ms {:.1} fps {:.2} Mtri/s",
                1e3 / ms,
                (TRIANGLES * passes) as f64 / ms * 1e-3
            );
            let mut step = 0;
            group.bench_function(quality_name, |bencher| {
                bencher.iter(|| {
                    step += 1;
                    black_box(draw(START + step as f64 * STEP))
                });
            });
        }
    }
}

criterion_group!(benches, depth, frames);
criterion_main!(benches);
