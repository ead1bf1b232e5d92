//! Clouds as pictures that are kept, against rays cast in every frame: speed, error and the largest change from frame to
//! frame, by the bound in pixels; and frames a second and loading time against the number of clouds, as in a thesis of
//! 2010. Writes `imposters.md` and `imposters-*.svg`.
//!
//! `cargo run --release --example imposters -- [--quick] [--frames N] [--out DIR]`: N 600, of which other scenes have fewer,
//! DIR `docs/report`.

mod count;
#[path = "../shadows/plot.rs"]
mod plot;

use lexopt::{Arg, Parser, ValueExt};
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::{CloudSettings, Quality};
use plot::{Axis, Curve};
use std::error::Error;
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

const SIZE: (usize, usize) = (1280, 720);
const THREADS: usize = 2;
/// Pixels; 0 casts rays.
const BOUNDS: [f32; 6] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0];

/// A flight with a bound: a number for each frame.
struct Flight {
    frame: Frame,
    last: Frame,
    ms: Vec<f64>,
    /// Against rays, decibels.
    psnr: Vec<f64>,
    /// Of the frame before: root of the mean square, and what one pixel in a thousand exceeds; codes of 255.
    changes: Vec<(f64, u32)>,
}

impl Flight {
    fn new() -> Flight {
        let black = || Frame::new(SIZE.0, SIZE.1);
        Flight { frame: black(), last: black(), ms: Vec::new(), psnr: Vec::new(), changes: Vec::new() }
    }
}

/// Mean square of the differences, and the difference of a channel that one pixel in a thousand exceeds; codes of 255.
fn difference(a: &Frame, b: &Frame) -> (f64, u32) {
    let (mut square, mut counts) = (0u64, [0usize; 256]);
    for (a, b) in a.pixels.iter().zip(&b.pixels) {
        let off = [0, 8, 16].map(|shift| (a >> shift & 255).abs_diff(b >> shift & 255));
        square += off.iter().map(|d| u64::from(d * d)).sum::<u64>();
        counts[off[0].max(off[1]).max(off[2]) as usize] += 1;
    }
    let mut more = 0;
    let most = (0..256).rev().find(|code| {
        more += counts[*code];
        more * 1000 > a.pixels.len()
    });
    (square as f64 / (3 * a.pixels.len()) as f64, most.unwrap_or(0) as u32)
}

/// Frames of a scene from `start` on, each with all bounds in turn.
fn fly(scene: &Scene, quality: Quality, start: f64, step: f64, frames: usize) -> Result<Vec<Flight>, Box<dyn Error>> {
    let mut renderer = Renderer::new(THREADS)?;
    let mut flights: Vec<_> = BOUNDS.iter().map(|_| Flight::new()).collect();
    for number in 0..frames {
        let mut truth = None;
        for (flight, bound) in flights.iter_mut().zip(BOUNDS) {
            std::mem::swap(&mut flight.frame, &mut flight.last);
            let quality = Quality { cloud: CloudSettings { imposter: bound, ..quality.cloud }, ..quality };
            let began = Instant::now();
            renderer.render(scene, start + step * number as f64, &quality, &mut flight.frame);
            flight.ms.push(began.elapsed().as_secs_f64() * 1e3);
            let truth = truth.get_or_insert_with(|| flight.frame.clone());
            let (square, _) = difference(&flight.frame, truth);
            flight.psnr.push(10.0 * (255.0 * 255.0 / square.max(1e-6)).log10());
            if number > 0 {
                let (square, most) = difference(&flight.frame, &flight.last);
                flight.changes.push((square.sqrt(), most));
            }
        }
    }
    Ok(flights)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn most(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, f64::max)
}

/// The table of a flight and of a slow one, and a curve: frames a second against error.
fn report(
    text: &mut String,
    scene: &Scene,
    quality: (&str, Quality),
    start: f64,
    frames: [usize; 2],
) -> Result<Curve, Box<dyn Error>> {
    let flights = fly(scene, quality.1, start, 1.0 / 60.0, frames[0])?;
    let slow = fly(scene, quality.1, start, 1.0 / 600.0, frames[1])?;
    let mut curve = Curve { name: format!("{}, {}", scene.name, quality.0), points: Vec::new() };
    writeln!(text, "\n## `{}` at `{}`\n", scene.name, quality.0)?;
    writeln!(text, "{} frames at 60 a second; slow: {} at a tenth of the speed.\n", frames[0], frames[1])?;
    writeln!(
        text,
        "| bound, pixels | fps, mean | of direct | ms, median | ms, slowest hundredth | ms, worst | first frame, ms | PSNR, mean | worst | change, worst rms | 99.9 % of pixels | slow: change, worst rms | 99.9 % of pixels |"
    )?;
    writeln!(text, "|---|{}", "--:|".repeat(12))?;
    let direct = mean(&flights[0].ms[1..]);
    for ((flight, slow), bound) in flights.iter().zip(&slow).zip(BOUNDS) {
        let mut ms = flight.ms[1..].to_vec();
        ms.sort_by(f64::total_cmp);
        let name = if bound > 0.0 { bound.to_string() } else { "direct".into() };
        let psnr = if bound > 0.0 {
            let worst = flight.psnr.iter().copied().fold(f64::MAX, f64::min);
            format!("{:.1} | {worst:.1}", mean(&flight.psnr))
        } else {
            " | ".into()
        };
        let change = |flight: &Flight| {
            let rms = most(flight.changes.iter().map(|change| change.0));
            format!("{rms:.2} | {}", most(flight.changes.iter().map(|change| f64::from(change.1))))
        };
        writeln!(
            text,
            "| {name} | {:.1} | {:.2} | {:.1} | {:.1} | {:.1} | {:.1} | {psnr} | {} | {} |",
            1e3 / mean(&ms),
            direct / mean(&ms),
            ms[ms.len() / 2],
            ms[ms.len() * 99 / 100],
            ms[ms.len() - 1],
            flight.ms[0],
            change(flight),
            change(slow)
        )?;
        if bound > 0.0 {
            curve.points.push((mean(&flight.psnr), direct / mean(&ms), name));
        }
    }
    Ok(curve)
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut quick, mut frames, mut out) = (false, 600usize, PathBuf::from("docs/report"));
    let mut parser = Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Arg::Long("quick") => (quick, frames) = (true, 30),
            Arg::Long("frames") => frames = parser.value()?.parse()?,
            Arg::Long("out") => out = parser.value()?.into(),
            other => return Err(other.unexpected().into()),
        }
    }
    std::fs::create_dir_all(&out)?;
    let mut text = String::from(
        "# CloudLayer as pictures\n\nWritten by `cargo run --release --example imposters`; not edited by hand.\n\n",
    );
    let level = Renderer::new(THREADS)?.simd();
    writeln!(
        text,
        "{}x{}, {THREADS} threads, {level}. Direct: rays are cast in every frame. With a bound, pictures stand for clouds while the eye moves by so little that nothing in them is off by more, and are kept from frame to frame; all bounds take turns in every frame, so what compares is the ratio to direct. PSNR is to the direct frame. The change is that from one frame to the next, codes of 255.",
        SIZE.0, SIZE.1
    )?;
    let sets = [
        ("sky-of-clouds", "fast", Quality::FAST, 2.0, [frames, frames.div_ceil(6)]),
        ("sky-of-clouds", "default", Quality::DEFAULT, 2.0, [frames.div_ceil(4), frames.div_ceil(12)]),
        ("clouds", "default", Quality::DEFAULT, 20.0, [frames.div_ceil(6), frames.div_ceil(12)]),
    ];
    let mut curves = Vec::new();
    for (scene, name, quality, start, frames) in sets {
        let scene = scenes::named(scene).ok_or("no such scene")?;
        curves.push(report(&mut text, &scene, (name, quality), start, frames)?);
        println!("{text}");
    }
    let axes = [Axis { name: "mean PSNR to rays, dB" }, Axis { name: "frames a second, of direct" }];
    plot::draw(&out.join("imposters-bound.svg"), &["speed against error, by the bound"], &[curves], axes)?;
    writeln!(text, "\n![by bound](imposters-bound.svg)")?;
    count::report(&mut text, &out, quick)?;
    std::fs::write(out.join("imposters.md"), &text)?;
    println!("{text}");
    Ok(())
}
