//! Frames of the ray tracer against the number of bodies, on one core: `cargo bench --bench trace`. Balls hang in a cube
//! over a floor, smaller where they are more, so that about as much of the picture shows them.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{Vec3A, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::settings::Quality;
use paprsek::simd::hash::pcg;
use paprsek::trace::{Background, Light, Material, Object, Shape, TraceLayer, World};
use paprsek::view::{Camera, View};

const SIZE: (usize, usize) = (640, 360);
const COUNTS: [u32; 5] = [10, 30, 100, 1000, 10_000];
/// Share of the cube's front that the balls would cover if none hid another.
const COVER: f32 = 0.6;

fn world(count: u32) -> World {
    let radius = 2.0 * (COVER / count as f32 / std::f32::consts::PI).sqrt();
    let random = |n: u32| pcg(n) as f32 / u32::MAX as f32 * 2.0 - 1.0;
    let ball = |n: u32| {
        let center = vec3a(random(3 * n), 1.0 + random(3 * n + 1), random(3 * n + 2));
        let material = Material::plain(vec3a(0.7, 0.4, 0.3)).polished(0.25, 0.5, 48.0);
        Object::new(Shape::Sphere { center: center + Vec3A::Y * radius, radius }, material)
    };
    let floor = Shape::Plane { normal: Vec3A::Y, offset: 0.0 };
    let floor = Object::new(floor, Material::plain(Vec3A::splat(0.5)).polished(0.15, 0.2, 32.0)).without_shadow();
    World {
        lights: vec![
            Light::point(vec3a(4.0, 6.0, 3.0), Vec3A::ONE),
            Light::point(vec3a(-5.0, 4.0, 2.0), Vec3A::splat(0.4)),
        ],
        ambient: Vec3A::splat(0.08),
        background: Background::gradient(vec3a(0.75, 0.8, 0.9), vec3a(0.2, 0.35, 0.6)),
        max_level: 4,
        ..World::new((0..count).map(ball).chain([floor]).collect())
    }
}

fn bodies(criterion: &mut Criterion) {
    let view = View::new(Camera::look_at(vec3a(0.0, 2.2, 5.0), Vec3A::Y, 0.8, 0.0), SIZE.0, SIZE.1);
    for (quality_name, quality) in [("fast", Quality::FAST), ("exact", Quality::EXACT)] {
        let mut group = criterion.benchmark_group(format!("bodies, {quality_name}"));
        group.sample_size(10);
        for (level_name, level) in testkit::levels() {
            let mut renderer = Renderer::new(1).expect("the thread that is there").at_level(level);
            let mut frame = Frame::new(SIZE.0, SIZE.1);
            for count in COUNTS {
                group.bench_function(format!("{level_name} {count}"), |bencher| {
                    bencher.iter(|| {
                        let layer = TraceLayer::new(world(count), &view, &quality.trace);
                        renderer.draw(Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }, &mut frame)
                    })
                });
            }
        }
    }
}

criterion_group!(benches, bodies);
criterion_main!(benches);
