//! Clouds as pictures that are kept, against rays cast in every frame: speed, error and the largest change from frame to
//! frame, by the bound in pixels; and frames per second and loading time against the number of clouds, as in `[Clouds10]`.
//! Writes `imposters.md` and `imposters-*.svg`.

mod count;

use crate::options::{Common, Result};
use crate::plot::{self, Axis, Curve};
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::{CloudSettings, Quality};
use std::fmt::Write;
use std::time::Instant;
use testkit::median;
use testkit::metrics::{Difference, gaps};

const SIZE: (usize, usize) = (1280, 720);
const THREADS: usize = 2;
/// Bounds of the error of a kept picture, pixels; 0 casts rays.
const BOUNDS: [f32; 6] = [0.0, 0.25, 0.5, 1.0, 2.0, 4.0];

/// The PSNR of equal pictures is infinite: in means they count as this, decibels.
const EQUAL: f64 = 100.0;

/// A flight with one bound, with one number per frame.
struct Flight {
    frame: Frame,
    last: Frame,
    ms: Vec<f64>,
    /// PSNR against rays, decibels.
    psnr: Vec<f64>,
    /// The change from the frame before: root mean square, and the change that one pixel in a thousand exceeds; codes of 255.
    changes: Vec<(f64, u8)>,
}

impl Flight {
    fn new() -> Flight {
        let black = || Frame::new(SIZE.0, SIZE.1);
        Flight { frame: black(), last: black(), ms: Vec::new(), psnr: Vec::new(), changes: Vec::new() }
    }
}

/// The difference of a channel, in codes of 255, that one pixel in a thousand exceeds.
fn thousandth(a: &Frame, b: &Frame) -> u8 {
    let mut gaps = gaps(a, b);
    gaps.sort_unstable();
    gaps[gaps.len() - 1 - gaps.len() / 1000]
}

/// Draws frames of a scene from `start` on, seconds, each with all bounds in turn.
fn fly(scene: &Scene, quality: Quality, start: f64, step: f64, frames: usize) -> Result<Vec<Flight>> {
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
            flight.psnr.push(Difference::between(&flight.frame, truth).psnr().min(EQUAL));
            if number > 0 {
                let rms = Difference::between(&flight.frame, &flight.last).rmse();
                flight.changes.push((rms, thousandth(&flight.frame, &flight.last)));
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

/// Appends the table of a flight and of a slow one, and returns the curve of frames per second against error.
fn report(text: &mut String, scene: &Scene, quality: (&str, Quality), start: f64, frames: [usize; 2]) -> Result<Curve> {
    let flights = fly(scene, quality.1, start, 1.0 / 60.0, frames[0])?;
    let slow = fly(scene, quality.1, start, 1.0 / 600.0, frames[1])?;
    let mut curve = Curve { name: format!("{}, {}", scene.name, quality.0), points: Vec::new() };
    writeln!(text, "\n## `{}` at `{}`\n", scene.name, quality.0)?;
    writeln!(text, "{} frames at 60 per second; slow: {} frames at a tenth of the speed.\n", frames[0], frames[1])?;
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
            median(ms.clone()),
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

/// What the flights take.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// Number of frames of the longest flight; the others take a part of it [default: 600, quick 30].
    #[arg(long, value_name = "N")]
    pub frames: Option<usize>,
}

/// Flies, and writes the tables and their curves.
pub fn run(Options { common, frames }: &Options) -> Result {
    let (quick, out) = (common.quick, &common.out);
    let count = frames.unwrap_or(if quick { 30 } else { 600 });
    std::fs::create_dir_all(out)?;
    let command = common.command("imposters") + &frames.map(|frames| format!(" --frames {frames}")).unwrap_or_default();
    let mut text = format!("# Clouds as pictures\n\nWritten by `{command}`; not edited by hand.\n\n");
    let level = Renderer::new(THREADS)?.simd();
    writeln!(
        text,
        "{}x{}, {THREADS} threads, {level}. Direct: rays are cast in every frame. With a bound, pictures stand for clouds and are kept from frame to frame, as long as the eye has moved by so little that nothing in them is off by more than the bound. All bounds take turns in every frame, so compare the ratios to direct. PSNR is against the direct frame. The change is that from one frame to the next, in codes of 255.",
        SIZE.0, SIZE.1
    )?;
    let sets = [
        ("sky-of-clouds", "fast", Quality::FAST, 2.0, [count, count.div_ceil(6)]),
        ("sky-of-clouds", "default", Quality::DEFAULT, 2.0, [count.div_ceil(4), count.div_ceil(12)]),
        ("clouds", "default", Quality::DEFAULT, 20.0, [count.div_ceil(6), count.div_ceil(12)]),
    ];
    let mut curves = Vec::new();
    for (scene, name, quality, start, frames) in sets {
        let scene = scenes::named(scene).ok_or("no such scene")?;
        curves.push(report(&mut text, &scene, (name, quality), start, frames)?);
        println!("{text}");
    }
    let axes = [Axis { name: "mean PSNR to rays, dB" }, Axis { name: "frames per second, relative to direct" }];
    plot::draw(&out.join("imposters-bound.svg"), &["speed against error, by the bound"], &[curves], axes)?;
    writeln!(text, "\n![by bound](imposters-bound.svg)")?;
    count::report(&mut text, out, quick)?;
    std::fs::write(out.join("imposters.md"), &text)?;
    println!("{text}");
    Ok(())
}
