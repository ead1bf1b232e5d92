//! The blur of motion and of a lens: means over many instants, and over many points of the lens, in linear light.

use super::{Row, frame, told};
use crate::metrics::Error;
use crate::options::Result;
use paprsek::frame::encode::srgb_decode;
use paprsek::frame::{Frame, FrameSpec, Renderer, Scene};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::view::Eye;
use std::time::Instant;

/// How long a shutter is open, seconds: half of a sixtieth.
const OPEN: f64 = 1.0 / 120.0;
/// Diameter of the lens and distance of what is sharp, metres: 50 mm at f/2.
const LENS: f32 = 0.025;
const SHARP: f32 = 6.0;

/// The mean of several frames' light.
fn mean(frames: &[Frame]) -> Frame {
    let (width, height) = (frames[0].width, frames[0].height);
    let light = |pixel: u32| [16, 8, 0].map(|shift| f64::from(srgb_decode((pixel >> shift & 255) as f32 / 255.0)));
    let sum = |index: usize| {
        frames.iter().map(|frame| light(frame.pixels[index])).fold([0.0; 3], |a, b| [0, 1, 2].map(|k| a[k] + b[k]))
    };
    let linear: Vec<_> = (0..width * height).map(|index| sum(index).map(|c| c / frames.len() as f64)).collect();
    frame(width, height, &linear)
}

fn render(renderer: &mut Renderer, scene: &Scene, time: f64, eye: Eye, size: (usize, usize)) -> Frame {
    let mut frame = Frame::new(size.0, size.1);
    let spec = renderer.spec(time, &Quality::DEFAULT, size);
    let picture = (scene.picture)(&FrameSpec { eye, ..spec });
    renderer.draw(picture, &mut frame);
    frame
}

/// Both blurs in scenes with much of them.
pub fn rows(quick: bool) -> Result<Vec<Row>> {
    let (size, count) = if quick { ((64, 36), 4) } else { ((640, 360), 24) };
    let mut renderer = Renderer::new(0)?;
    let mut rows = Vec::new();
    let motion = [("spheres", 2.0), ("lumen", 14.0), ("clouds", 6.6), ("snowfall", 12.0), ("torches", 10.0)];
    for (name, time) in motion {
        let scene = scenes::named(name).ok_or(format!("there is no scene {name}"))?;
        // Also what a scene makes when it first comes, which is not timed.
        let plain = mean(&[render(&mut renderer, &scene, time, Eye::MIDDLE, size)]);
        let began = Instant::now();
        let instants = (0..count).map(|k| time + OPEN * ((f64::from(k) + 0.5) / f64::from(count) - 0.5));
        let frames: Vec<_> = instants.map(|at| render(&mut renderer, &scene, at, Eye::MIDDLE, size)).collect();
        let each = full(began, size, count);
        rows.push(Row {
            what: "all: motion blur",
            scene: format!("`{name}` at {time} s, shutter open for 1/120 s"),
            reference: format!("the mean of {count} instants, linear light"),
            error: told(&Error::between(&plain, &mean(&frames))),
            cost: format!("{:.0} for 8 instants", 7.0 * each),
            bytes: "150 (instants into one frame)",
        });
    }
    for (name, time) in [("spheres", 2.0), ("shadow", 2.0), ("torches", 10.0)] {
        let scene = scenes::named(name).ok_or(format!("there is no scene {name}"))?;
        // Also what a scene makes when it first comes, which is not timed.
        let plain = mean(&[render(&mut renderer, &scene, time, Eye::MIDDLE, size)]);
        let began = Instant::now();
        // The chord of a round lens at each offset is its weight: offsets are even in the area left of them.
        let offsets = (0..count).map(|k| 0.5 * LENS * chord((f64::from(k) + 0.5) / f64::from(count)) as f32);
        let eyes = offsets.map(|offset| Eye { offset, convergence: SHARP });
        let frames: Vec<_> = eyes.map(|eye| render(&mut renderer, &scene, time, eye, size)).collect();
        let each = full(began, size, count);
        rows.push(Row {
            what: "all: lens blur",
            scene: format!("`{name}` at {time} s, 50 mm at f/2, sharp at {SHARP} m"),
            reference: format!("the mean of {count} points of the lens, across alone, linear light"),
            error: told(&Error::between(&plain, &mean(&frames))),
            cost: format!("{:.0} for 16 points", 15.0 * each),
            bytes: "200 (points of the lens into one frame)",
        });
    }
    Ok(rows)
}

/// Milliseconds of a frame of 1280x720, from `count` frames of this size.
fn full(began: Instant, size: (usize, usize), count: i32) -> f64 {
    1e3 * began.elapsed().as_secs_f64() / f64::from(count) * (1280 * 720) as f64 / (size.0 * size.1) as f64
}

/// Where a chord across a disc of radius 1 stands that leaves this share of its area to the left, -1 to 1.
fn chord(share: f64) -> f64 {
    let (mut low, mut high) = (-1.0f64, 1.0f64);
    for _ in 0..50 {
        let x = 0.5 * (low + high);
        let left = 0.5 + (x * (1.0 - x * x).sqrt() + x.asin()) / std::f64::consts::PI;
        if left < share { low = x } else { high = x }
    }
    0.5 * (low + high)
}
