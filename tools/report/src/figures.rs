//! Prints the README's table of scenes: speed, samples and error of every scene, in Markdown.
//!
//! It takes about four minutes on two cores. Qualities and SIMD levels take turns frame by frame, so that other load on the
//! machine affects them alike. Samples are eye rays, in the rasterizer's scenes shaded fragments; `sky` has none.

use crate::likeness;
use crate::machine;
use crate::options::{Quick, Result};
use fearless_simd::Level;
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::time::Instant;
use testkit::drawn::forget_maps;
use testkit::median;
use testkit::metrics::Difference;

/// How much is measured.
struct Effort {
    /// Size of the frames that are timed and compared with `exact`, pixels.
    timed: (usize, usize),
    /// Size of those that are compared with 64 samples per pixel, which take long.
    compared: (usize, usize),
    /// How often every frame is rendered; the median counts.
    rounds: usize,
}

const FULL: Effort = Effort { timed: (1280, 720), compared: (640, 360), rounds: 9 };
const QUICK: Effort = Effort { timed: (320, 180), compared: (64, 36), rounds: 1 };
const THREADS: usize = 2;
/// The number of instants of a scene, in the middle of equal parts: in `lumen` one in every shot.
const INSTANTS: usize = 5;

/// Prints the table.
pub fn run(options: &Quick) -> Result {
    let effort = if options.quick { QUICK } else { FULL };
    let mut renderer = Renderer::new(THREADS)?;
    // The show's parts are scenes of their own.
    let scenes: Vec<_> = scenes::all().iter().filter(|scene| scene.name != scenes::INTRO.name).copied().collect();
    let levels = machine::levels();
    let times = time(&levels, &scenes, &effort)?;
    let names: Vec<_> = levels.iter().map(|(name, _)| format!("fps, {name}")).collect();
    println!("| scene | quality | {} | samples per pixel | {} | against |", names.join(" | "), likeness::head());
    println!("|---|---|{}---|---|---|---|", "---|".repeat(levels.len()));
    for (scene, [fast, default]) in scenes.iter().zip(times) {
        let mut compare = |at| {
            let [ours, truth] =
                [Quality::FAST, Quality::EXACT].map(|q| render(&mut renderer, effort.timed, scene, at, q));
            Difference::between(&ours, &truth)
        };
        row(scene, "fast", fast, &instants(scene).map(&mut compare), "exact");
        let at = instants(scene)[INSTANTS / 2];
        let [ours, truth] =
            [Quality::DEFAULT, Quality::REFERENCE].map(|q| render(&mut renderer, effort.compared, scene, at, q));
        row(scene, "default", default, &[Difference::between(&ours, &truth)], "reference");
    }
    let (width, height) = effort.timed;
    println!();
    println!("{width}x{height}, {THREADS} threads.");
    Ok(())
}

/// What the frames of one quality took.
#[derive(Clone, Default)]
struct Cost {
    /// Seconds at each SIMD level: the medians of the rounds, added over the instants.
    seconds: Vec<f64>,
    /// Eye rays per pixel, added over the instants.
    samples: f64,
}

/// The cost of `fast` and of `default` in every scene.
fn time(levels: &[(&str, Level)], scenes: &[Scene], effort: &Effort) -> Result<Vec<[Cost; 2]>> {
    let mut frame = Frame::new(effort.timed.0, effort.timed.1);
    let mut renderers = Vec::new();
    for (_, level) in levels {
        renderers.push(Renderer::new(THREADS)?.at_level(*level));
    }
    // Seconds of every scene, instant, quality, level and round.
    let mut seconds = vec![<[[Vec<Vec<f64>>; 2]; INSTANTS]>::default(); scenes.len()];
    let mut costs = vec![<[Cost; 2]>::default(); scenes.len()];
    for round in 0..effort.rounds {
        for (s, scene) in scenes.iter().enumerate() {
            for (i, at) in instants(scene).into_iter().enumerate() {
                for (q, quality) in [Quality::FAST, Quality::DEFAULT].iter().enumerate() {
                    let seconds = &mut seconds[s][i][q];
                    seconds.resize(renderers.len(), Vec::new());
                    for (l, renderer) in renderers.iter_mut().enumerate() {
                        // The frame before, so that the sun has moved by as much as it does while the scene plays.
                        renderer.render(scene, at - 1.0 / 60.0, quality, &mut frame);
                        forget_maps(renderer);
                        let began = Instant::now();
                        let stats = renderer.render(scene, at, quality, &mut frame);
                        seconds[l].push(began.elapsed().as_secs_f64());
                        if round == 0 && l == 0 {
                            costs[s][q].samples += stats.samples as f64 / frame.pixels.len() as f64;
                        }
                    }
                }
            }
        }
    }
    for (costs, seconds) in costs.iter_mut().zip(&mut seconds) {
        for instant in seconds {
            for (cost, levels) in costs.iter_mut().zip(instant) {
                cost.seconds.resize(levels.len(), 0.0);
                for (sum, rounds) in cost.seconds.iter_mut().zip(levels) {
                    *sum += median(std::mem::take(rounds));
                }
            }
        }
    }
    Ok(costs)
}

fn instants(scene: &Scene) -> [f64; INSTANTS] {
    std::array::from_fn(|k| scene.duration * (k as f64 + 0.5) / INSTANTS as f64)
}

fn render(renderer: &mut Renderer, size: (usize, usize), scene: &Scene, at: f64, quality: Quality) -> Frame {
    let mut frame = Frame::new(size.0, size.1);
    renderer.render(scene, at, &quality, &mut frame);
    frame
}

fn row(scene: &Scene, quality: &str, cost: Cost, differences: &[Difference], truth: &str) {
    let name = scene.name;
    let fps: Vec<_> = cost.seconds.iter().map(|seconds| format!("{:.1}", INSTANTS as f64 / seconds)).collect();
    let fps = fps.join(" | ");
    let samples = cost.samples / INSTANTS as f64;
    let likeness = likeness::columns(differences);
    println!("| `{name}` | {quality} | {fps} | {samples:.3} | {likeness} | {truth} |");
}
