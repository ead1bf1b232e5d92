//! What drawing fewer particles of a small fire saves, and the error of its picture.

use super::fire::{MIDDLE, torch};
use super::{SIZE, START, Stage, camera};
use crate::metrics::Error as Off;
use crate::plot::{self, Axis, Curve};
use glam::{Vec3A, vec3a};
use paprsek::frame::{Frame, Layer, Renderer, Tile};
use paprsek::particles::{Emitter, Fire, ParticleLayer};
use paprsek::scenes::bench::particles::{FIRE_SKY, over};
use paprsek::settings::Quality;
use paprsek::view::View;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;
use testkit::median;

/// Distances from the eye to the fire, metres: those of the table, and those of the curve of times.
const DISTANCES: [f32; 6] = [0.3, 0.8, 3.0, 8.0, 20.0, 60.0];
const MORE: [f32; 10] = [0.15, 0.3, 0.6, 1.2, 2.4, 4.8, 9.6, 20.0, 40.0, 80.0];
/// Shares of the particles that are drawn per pixel of height.
const DETAILS: [f32; 6] = [f32::INFINITY, 1.0 / 64.0, 1.0 / 128.0, 1.0 / 256.0, 1.0 / 512.0, 1.0 / 1024.0];
/// Number of instants that errors are averaged over, and the time between them, seconds.
const INSTANTS: usize = 5;
const APART: f64 = 0.37;

/// The view of an eye at this distance, metres.
fn view(away: f32) -> View {
    let eye = vec3a(0.0, MIDDLE, away);
    View::new(camera(eye, eye + Vec3A::NEG_Z), SIZE.0, SIZE.1)
}

/// A fire at this distance, with as many particles as it has there.
fn burning(time: f64, away: f32, detail: f32) -> Fire {
    torch(time).detailed(&view(away), detail)
}

fn particles(fires: Vec<Fire>, away: f32) -> ParticleLayer {
    ParticleLayer::new(fires.into_iter().map(Emitter::Fire).collect(), &view(away), &Quality::EXACT.particles)
}

/// The median milliseconds in which a fire is moved, listed and drawn alone on one thread, for each level of detail; and
/// the speed relative to the first level, the median over the rounds. All levels take turns.
fn times(renderer: &Renderer, rounds: usize, away: f32, details: &[f32]) -> Vec<(f64, f64)> {
    let (columns, rows) = (SIZE.0.div_ceil(Tile::SIZE), SIZE.1.div_ceil(Tile::SIZE));
    let mut tiles: Vec<_> = (0..columns * rows).map(|n| Tile::at(n % columns, n / columns, SIZE.0, SIZE.1)).collect();
    let mut time = |instant: f64, detail: f32| {
        let began = Instant::now();
        let mut particles = particles(vec![burning(instant, away, detail)], away).without_solids();
        particles.prepare(renderer.workers(), renderer.cache());
        for tile in &mut tiles {
            particles.draw(renderer.level(), tile);
        }
        began.elapsed().as_secs_f64() * 1e3
    };
    let mut all = vec![Vec::new(); details.len()];
    for round in 0..=rounds {
        for (detail, times) in details.iter().zip(&mut all) {
            let ms = time(START + round as f64 * APART, *detail);
            // The first round warms up: memory is allocated and touched.
            if round > 0 {
                times.push(ms);
            }
        }
    }
    let ratio = |times: &[f64]| median(all[0].iter().zip(times).map(|(first, ms)| first / ms).collect());
    all.iter().map(|times| (median(times.clone()), ratio(times))).collect()
}

/// The pictures of a fire, one per instant.
fn pictures(stage: &mut Stage, away: f32, detail: f32) -> Vec<Frame> {
    let mut draw = |index: usize| {
        let time = START + index as f64 * APART;
        let mut frame = Frame::new(SIZE.0, SIZE.1);
        let picture = over(&stage.shot(time), FIRE_SKY, particles(vec![burning(time, away, detail)], away));
        stage.renderer.draw(picture, &mut frame);
        frame
    };
    (0..INSTANTS).map(&mut draw).collect()
}

/// The light of a frame: the sum of its codes.
fn light(frame: &Frame) -> f64 {
    frame.pixels.iter().map(|p| f64::from((p >> 16 & 255) + (p >> 8 & 255) + (p & 255))).sum()
}

/// Appends the table, and writes its curves.
pub fn report(text: &mut String, stage: &mut Stage, out: &Path) -> Result<(), Box<dyn Error>> {
    writeln!(
        text,
        "\n## Level of detail\n\nA torch alone, at `fast`. `particle_detail` is the share of its particles that is drawn per pixel of its height; the default is **bold**. Milliseconds are of that fire alone, moved and drawn on one thread, without the picture behind it. PSNR is against all particles, over the whole frame and over the pixels that the fire changes; \"off by more than 8\" is the share of the latter that are off by more than 8 codes in a channel. FLIP is of the whole frame, 99th percentile. Light: root mean square error of the sum of its light. All are means over {INSTANTS} instants.\n"
    )?;
    writeln!(
        text,
        "| metres | particle_detail | particles | ms | times as fast | PSNR, dB | within the fire | off by more than 8 | FLIP 99 % | light |\n|--:|--:|{}",
        "--:|".repeat(8)
    )?;
    let (alone, rounds) = (Renderer::new(1)?, stage.rounds);
    let mut behind = Frame::new(SIZE.0, SIZE.1);
    let picture = over(&stage.shot(START), FIRE_SKY, particles(Vec::new(), 1.0));
    stage.renderer.draw(picture, &mut behind);
    let mut curves = Vec::new();
    for away in DISTANCES {
        let truths = pictures(stage, away, f32::INFINITY);
        let changed = |truth: &Frame| truth.pixels.iter().zip(&behind.pixels).filter(|(a, b)| a != b).count();
        let share = truths.iter().map(changed).sum::<usize>() as f64 / (INSTANTS * behind.pixels.len()) as f64;
        let mut curve = Curve { name: format!("{away} m"), points: Vec::new() };
        for (detail, (ms, ratio)) in DETAILS.into_iter().zip(times(&alone, rounds, away, &DETAILS)) {
            let frames = pictures(stage, away, detail);
            let offs: Vec<_> = frames.iter().zip(&truths).map(|(frame, truth)| Off::between(frame, truth)).collect();
            let off = Off::mean(&offs);
            let lights = frames.iter().zip(&truths).map(|(frame, truth)| {
                let [frame, truth] = [frame, truth].map(|frame| light(frame) - light(&behind));
                (frame / truth - 1.0).powi(2)
            });
            let lacks = (lights.sum::<f64>() / INSTANTS as f64).sqrt();
            let name = if detail.is_finite() { format!("1/{}", 1.0 / detail) } else { "all".into() };
            let bold = if detail == Quality::FAST.particles.detail { format!("**{name}**") } else { name.clone() };
            let psnr = if off.square > 0.0 {
                curve.points.push((ratio, off.rmse(), name));
                format!("{:.1} | {:.1}", off.psnr(), off.psnr() + 10.0 * share.log10())
            } else {
                "equal | ".into()
            };
            writeln!(
                text,
                "| {away} | {bold} | {:.0} | {ms:.3} | {ratio:.2} | {psnr} | {:.1} % | {:.3} | {:.1} % |",
                burning(START, away, detail).count,
                100.0 * off.bad / share,
                off.flip99,
                100.0 * lacks
            )?;
        }
        if !curve.points.is_empty() {
            curves.push(curve);
        }
    }
    let axes = [
        Axis { name: "times as fast as all" },
        Axis { name: "error of the frame, codes of 255 (root of the mean square)" },
    ];
    plot::draw(&out.join("particles-detail.svg"), &["level of detail"], &[curves], axes)?;
    let ways = [("all", f32::INFINITY), ("as at `fast`", Quality::FAST.particles.detail)];
    let mut curves = ways.map(|(name, _)| Curve { name: name.into(), points: Vec::new() });
    for away in MORE {
        for (curve, (ms, _)) in curves.iter_mut().zip(times(&alone, rounds, away, &ways.map(|way| way.1))) {
            curve.points.push((f64::from(away), ms, format!("{ms:.2}")));
        }
    }
    let axes = [Axis { name: "metres" }, Axis { name: "milliseconds" }];
    plot::draw(&out.join("particles-distance.svg"), &["a fire by its distance"], &[curves.into()], axes)?;
    writeln!(text, "\n![level of detail](particles-detail.svg)\n\n![a fire by its distance](particles-distance.svg)")?;
    Ok(())
}
