//! Speed against error with other renderers beside: qualities and plain supersampling, the time to 40 dB, and pictures at
//! equal time.
//!
//! The others run elsewhere: `--peers` names what `versus.py speed` printed of them, a line such as
//! `spheres fast: 59.4 fps, peer 11.0, ratio 5.39` per scene.

use crate::metrics::Error;
use crate::options::{Common, Result};
use crate::picture::rgb;
use crate::plot::{self, Axis, Curve};
use crate::{machine, stills, worst};
use image::RgbImage;
use image::imageops::{self, FilterType};
use paprsek::frame::{Frame, Renderer, Scene};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;
use testkit::drawn::forget_maps;
use testkit::median;

/// What the fronts take.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    pub common: Common,
    /// What `versus.py speed` printed of other renderers.
    #[arg(long, value_name = "FILE", default_value = "docs/report/peers.txt")]
    pub peers: PathBuf,
}

/// How much is measured.
struct Effort {
    size: (usize, usize),
    rounds: usize,
    scenes: &'static [&'static str],
}

const FULL: Effort = Effort {
    size: (1280, 720),
    rounds: 5,
    scenes: &["spheres", "spheres-glass", "shadow", "shadow-cube", "cumulus", "snow", "fire"],
};
const QUICK: Effort = Effort { size: (160, 90), rounds: 1, scenes: &["spheres", "shadow"] };
const THREADS: usize = 2;
/// Qualities after this one only take samples, and are timed once: they take seconds.
const PLAIN: usize = 2;
/// The instant at which the others are measured, seconds.
const TIME: f64 = 2.0;
/// What counts as near enough, dB.
const NEAR: f64 = 40.0;

/// A quality, its time and its error.
struct Point {
    name: &'static str,
    /// Median over the rounds.
    ms: f64,
    error: Error,
}

/// The qualities, and `exact` with a grid of samples: what plain supersampling gives for its time.
fn qualities() -> Vec<(&'static str, Quality)> {
    let grid = |side| {
        let mut quality = Quality::EXACT;
        (quality.trace.grid, quality.raster.grid, quality.cloud.grid, quality.sky.grid) = (side, side, side, side);
        quality
    };
    vec![
        ("fast", Quality::FAST),
        ("default", Quality::DEFAULT),
        ("exact", Quality::EXACT),
        ("4 samples", grid(2)),
        ("9 samples", grid(3)),
        ("16 samples", grid(4)),
    ]
}

/// Measures, and writes `fronts.md` with its pictures.
pub fn run(options: &Options) -> Result {
    let Effort { size, rounds, scenes } = if options.common.quick { QUICK } else { FULL };
    let out = &options.common.out;
    fs::create_dir_all(out)?;
    let peers = peers(&fs::read_to_string(&options.peers).unwrap_or_default());
    let mut renderer = Renderer::new(THREADS)?;
    let (width, height) = size;
    let mut text = format!(
        "# Fronts of speed against error\n\nWritten by `{}`; not edited by hand.\n\n\
         {}; {width}x{height}, {THREADS} threads, SIMD level {}; each scene at {TIME} s, medians of {rounds} rounds, in which \
         the qualities take turns, and one of supersampling. Error is against `reference` (64 samples per pixel). `exact` takes one sample per pixel \
         and no shortcut; \"n samples\" is `exact` with a grid of n, which is what plain supersampling costs. The **peer** is \
         the renderer that a user would otherwise pick, by `{}`: it draws what `exact` draws, to 50 dB or more, and so has \
         its error.\n",
        options.common.command("fronts"),
        machine::machine(),
        renderer.simd(),
        options.peers.display(),
    );
    for name in scenes {
        let scene = scenes::named(name).ok_or(format!("there is no scene {name}"))?;
        let (points, truth) = measure(&mut renderer, &scene, size, rounds);
        let peer = peers.get(*name).map(|fps| 1000.0 / fps);
        let label = |error: &Error| if error.square > 0.0 { format!("{:.1}", error.psnr()) } else { "equal".into() };
        write!(text, "\n## {name}\n\n![{name}](front-{name}.svg)\n\n| | ms | PSNR, dB | SSIM | FLIP | 99 % | bad |\n")?;
        text += "|---|--:|--:|--:|--:|--:|--:|\n";
        let row = |name: &str, ms: f64, e: &Error| {
            let (ssim, flip, flip99, bad) = (e.ssim, e.flip, e.flip99, 100.0 * e.bad);
            format!("| {name} | {ms:.1} | {} | {ssim:.4} | {flip:.4} | {flip99:.3} | {bad:.2} % |\n", label(e))
        };
        for point in &points {
            text += &row(point.name, point.ms, &point.error);
        }
        let exact = &points[2];
        if let Some(ms) = peer {
            text += &row("peer", ms, &exact.error);
        }
        let near = |points: &[Point]| {
            let near = points.iter().filter(|point| point.error.psnr() >= NEAR);
            near.min_by(|a, b| a.ms.total_cmp(&b.ms))
                .map_or("more than was tried".into(), |point| format!("{:.1} ms (`{}`)", point.ms, point.name))
        };
        let (ours, plain) = (near(&points[..2]), near(&points[2..]));
        writeln!(text, "\nTo {NEAR} dB: with shortcuts {ours}, by plain supersampling {plain}.")?;
        let (equal, samples) = equal_time(&mut renderer, &scene, size, points[1].ms / exact.ms);
        let error = Error::between(&equal, &truth);
        let mut default = Frame::new(width, height);
        renderer.render(&scene, TIME, &Quality::DEFAULT, &mut default);
        for (kind, frame) in [("default", &default), ("plain", &equal)] {
            stills::save(&worst::sheet(frame, &truth), &out.join(format!("equal-{name}-{kind}.png")))?;
        }
        writeln!(
            text,
            "\nIn the time of `default`, plain sampling has {samples:.2} samples per pixel and {:.1} dB; `default` has {} dB. \
             Each beside the truth, with the difference {} times amplified and FLIP; `default` first:\n\n\
             ![default](equal-{name}-default.png)\n\n![plain](equal-{name}-plain.png)",
            error.psnr(),
            label(&points[1].error),
            worst::GAIN,
        )?;
        draw(&out.join(format!("front-{name}.svg")), &points, peer)?;
        eprintln!("{name}: measured");
    }
    fs::write(out.join("fronts.md"), &text)?;
    println!("{}", out.join("fronts.md").display());
    Ok(())
}

/// Frames per second of the peer by scene, the median of the lines that name it.
fn peers(text: &str) -> BTreeMap<String, f64> {
    let mut found: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    for line in text.lines() {
        let fps = line.split_once(", peer ").and_then(|(_, rest)| rest.split(',').next()?.trim().parse().ok());
        if let (Some(scene), Some(fps)) = (line.split(' ').next(), fps) {
            found.entry(scene.into()).or_default().push(fps);
        }
    }
    found.into_iter().map(|(scene, fps)| (scene, median(fps))).collect()
}

/// Every quality's time and error, and the truth.
fn measure(renderer: &mut Renderer, scene: &Scene, size: (usize, usize), rounds: usize) -> (Vec<Point>, Frame) {
    let mut truth = Frame::new(size.0, size.1);
    renderer.render(scene, TIME, &Quality::REFERENCE, &mut truth);
    let mut frame = Frame::new(size.0, size.1);
    let qualities = qualities();
    let mut times = vec![Vec::new(); qualities.len()];
    // The first round warms up.
    for round in 0..=rounds {
        for (number, ((_, quality), times)) in qualities.iter().zip(&mut times).enumerate() {
            if number > PLAIN && round > 1 {
                continue;
            }
            forget_maps(renderer);
            let began = Instant::now();
            renderer.render(scene, TIME, quality, &mut frame);
            if round > 0 {
                times.push(1e3 * began.elapsed().as_secs_f64());
            }
        }
    }
    let mut point = |((name, quality), times): ((&'static str, Quality), Vec<f64>)| {
        renderer.render(scene, TIME, &quality, &mut frame);
        Point { name, ms: median(times), error: Error::between(&frame, &truth) }
    };
    (qualities.into_iter().zip(times).map(&mut point).collect(), truth)
}

/// What plain sampling makes of a share of the time of `exact`: as many samples, spread evenly over the picture. Also
/// returns the samples per pixel.
fn equal_time(renderer: &mut Renderer, scene: &Scene, (width, height): (usize, usize), share: f64) -> (Frame, f64) {
    let scaled = |side: usize| ((side as f64 * share.sqrt()).round() as usize).max(1);
    let mut frame = Frame::new(scaled(width), scaled(height));
    renderer.render(scene, TIME, &Quality::EXACT, &mut frame);
    let samples = frame.pixels.len() as f64 / (width * height) as f64;
    let resized: RgbImage = imageops::resize(&rgb(&frame), width as u32, height as u32, FilterType::Triangle);
    let mut full = Frame::new(width, height);
    for (to, from) in full.pixels.iter_mut().zip(resized.pixels()) {
        *to = from.0.iter().fold(0, |code, channel| code << 8 | u32::from(*channel));
    }
    (full, samples)
}

/// The curve of RMSE against milliseconds.
fn draw(path: &std::path::Path, points: &[Point], peer: Option<f64>) -> Result {
    let at = |point: &Point| (point.ms, point.error.rmse(), point.name.to_string());
    let mut curves = vec![
        Curve { name: "shortcuts".into(), points: points[..2].iter().map(at).collect() },
        Curve { name: "plain supersampling".into(), points: points[2..].iter().map(at).collect() },
    ];
    if let Some(ms) = peer {
        curves.push(Curve { name: "peer".into(), points: vec![(ms, points[2].error.rmse(), "peer".into())] });
    }
    plot::draw(
        path,
        &["RMSE against time"],
        &[curves],
        [Axis { name: "milliseconds per frame" }, Axis { name: "RMSE, codes of 255 (40 dB is 2.55)" }],
    )
}
