//! Prints the README's table of scenes: speed, samples and error of every scene, in Markdown.
//!
//! `cargo run --release --example figures`: about two minutes on two cores. The qualities take turns frame by frame, so
//! that what else the machine does hits all alike. Samples are eye rays; of the rasterizer's scenes, fragments; `sky`
//! counts none.

#[path = "common/difference.rs"]
mod difference;
#[path = "common/likeness.rs"]
mod likeness;
#[path = "common/maps.rs"]
mod maps;

use difference::Difference;
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::time::Instant;

/// Size of the frames that are timed, and of those that are compared with 64 samples a pixel, which take long.
const FULL: (usize, usize) = (1280, 720);
const HALF: (usize, usize) = (640, 360);
const THREADS: usize = 2;
/// Instants of a scene, in the middle of equal parts: in `lumen` one in every shot.
const INSTANTS: usize = 5;
/// Times that every frame is rendered; the median counts.
const ROUNDS: usize = 9;

fn main() -> Result<(), String> {
    let mut renderer = Renderer::new(THREADS)?;
    // The show's parts are scenes of their own.
    let scenes: Vec<_> = scenes::all().iter().filter(|scene| scene.name != scenes::INTRO.name).copied().collect();
    let times = time(&mut renderer, &scenes);
    println!("| scene | quality | fps | samples a pixel | {} | against |", likeness::head());
    println!("|---|---|---|---|---|---|---|");
    for (scene, [fast, default]) in scenes.iter().zip(times) {
        let mut compare = |at| {
            let [ours, truth] = [Quality::FAST, Quality::EXACT].map(|q| render(&mut renderer, FULL, scene, at, q));
            Difference::between(&ours, &truth)
        };
        row(scene, "fast", fast, &instants(scene).map(&mut compare), "exact");
        let at = instants(scene)[INSTANTS / 2];
        let [ours, truth] = [Quality::DEFAULT, Quality::REFERENCE].map(|q| render(&mut renderer, HALF, scene, at, q));
        row(scene, "default", default, &[Difference::between(&ours, &truth)], "reference");
    }
    let (width, height) = FULL;
    println!();
    println!("{width}x{height}, {THREADS} threads, {}.", renderer.simd());
    Ok(())
}

/// What the frames of one quality took.
#[derive(Clone, Copy, Default)]
struct Cost {
    /// Seconds, the median of the rounds, and eye rays: sums over the instants.
    seconds: f64,
    samples: u64,
}

/// The cost of `fast` and of `default` in every scene.
fn time(renderer: &mut Renderer, scenes: &[Scene]) -> Vec<[Cost; 2]> {
    let mut frame = Frame::new(FULL.0, FULL.1);
    // Seconds of every scene, instant, quality and round.
    let mut seconds = vec![<[[Vec<f64>; 2]; INSTANTS]>::default(); scenes.len()];
    let mut costs = vec![[Cost::default(); 2]; scenes.len()];
    for round in 0..ROUNDS {
        for (s, scene) in scenes.iter().enumerate() {
            for (i, at) in instants(scene).into_iter().enumerate() {
                for (q, quality) in [Quality::FAST, Quality::DEFAULT].iter().enumerate() {
                    // The sun has moved as far as it does while the scene plays.
                    renderer.render(scene, at - 1.0 / 60.0, quality, &mut frame);
                    maps::forget(renderer);
                    let began = Instant::now();
                    let stats = renderer.render(scene, at, quality, &mut frame);
                    seconds[s][i][q].push(began.elapsed().as_secs_f64());
                    costs[s][q].samples += if round == 0 { stats.samples } else { 0 };
                }
            }
        }
    }
    for (costs, seconds) in costs.iter_mut().zip(&mut seconds) {
        for instant in seconds {
            for (cost, rounds) in costs.iter_mut().zip(instant) {
                rounds.sort_by(f64::total_cmp);
                cost.seconds += rounds[ROUNDS / 2];
            }
        }
    }
    costs
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
    let fps = INSTANTS as f64 / cost.seconds;
    let samples = cost.samples as f64 / (INSTANTS * FULL.0 * FULL.1) as f64;
    let likeness = likeness::columns(differences);
    println!("| `{name}` | {quality} | {fps:.1} | {samples:.3} | {likeness} | {truth} |");
}
