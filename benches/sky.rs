//! The sky's dome, each pixel evaluated against cells between whose corners it is interpolated, on one core:
//! `cargo bench --bench sky`. Before a cell is timed its picture is held against that of every pixel.

#![allow(missing_docs)] // criterion_group! makes an undocumented function.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::{Mat3A, Vec3A, vec3a};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::settings::{Quality, SkySettings};
use paprsek::sky::air::Air;
use paprsek::sky::dome::{Dome, Sky};
use paprsek::sky::layer::SkyLayer;
use paprsek::view::{Camera, View};
use std::hint::black_box;

const SIZE: (usize, usize) = (640, 360);
/// Altitudes of the sun, degrees: by day, and in the dusk, which takes three times as many points.
const ALTITUDES: [f32; 2] = [30.0, -6.0];
/// Largest angles of a cell, radians; the first is every pixel.
const CELLS: [f32; 4] = [0.0, 0.011, 0.022, 0.044];
/// Codes of 255 that interpolation may be off at the widest cell: near the horizon the light bends most.
const OFF: u8 = 8;

fn picture(altitude: f32, cell: f32) -> Picture {
    let (sin, cos) = altitude.to_radians().sin_cos();
    let sky = Sky {
        sun: vec3a(0.0, sin, -cos),
        moon: Vec3A::NEG_Y,
        moon_to_sun: Vec3A::X,
        lit: 0.0,
        moon_radius: 0.0045,
        turn: Mat3A::IDENTITY,
        air: Air { haze: 1.3, ozone: 1.1, again: 0.7 },
    };
    let settings = SkySettings { cell, ..Quality::DEFAULT.sky };
    let camera = Camera::look_at(Vec3A::ZERO, vec3a(0.0, 0.35, -1.0), 50f32.to_radians(), 0.0);
    let layer = SkyLayer::new(Dome::new(sky, &settings), &View::new(camera, SIZE.0, SIZE.1), &settings);
    Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }
}

fn off(a: &Frame, b: &Frame) -> u8 {
    let bytes = |frame: &Frame| frame.pixels.iter().flat_map(|p| p.to_be_bytes()).collect::<Vec<_>>();
    bytes(a).into_iter().zip(bytes(b)).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

fn dome(criterion: &mut Criterion) {
    for altitude in ALTITUDES {
        let mut truth = Frame::new(SIZE.0, SIZE.1);
        let mut group = criterion.benchmark_group(format!("dome at {altitude} degrees"));
        group.throughput(Throughput::Elements((SIZE.0 * SIZE.1) as u64)).sample_size(10);
        for (level_name, level) in testkit::levels() {
            let mut renderer = Renderer::new(1).expect("the thread that is there").at_level(level);
            for cell in CELLS {
                let mut frame = Frame::new(SIZE.0, SIZE.1);
                renderer.draw(picture(altitude, cell), &mut frame);
                if cell > 0.0 {
                    assert!(off(&frame, &truth) <= OFF, "{cell} {level_name}: {} codes", off(&frame, &truth));
                } else if level_name == testkit::levels()[0].0 {
                    truth = frame.clone();
                } else {
                    assert_eq!(frame, truth, "{level_name}");
                }
                group.bench_function(format!("{level_name} cell {cell}"), |bencher| {
                    bencher.iter(|| black_box(renderer.draw(picture(altitude, cell), &mut frame)));
                });
            }
        }
    }
}

criterion_group!(benches, dome);
criterion_main!(benches);
