//! What fewer particles of a small fire save, and how far the picture is off.

use crate::fire::{MIDDLE, torch};
use crate::metrics::Error as Off;
use crate::plot::{self, Axis, Curve};
use crate::{SIZE, START, Stage, camera, median};
use glam::{Vec3, vec3};
use paprsek::particles::Particles;
use paprsek::quality::Quality;
use paprsek::scenes::particles::{FIRE_SKY, over};
use paprsek::tile::{Frame, Layer, Renderer, Tile};
use paprsek::view::View;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

/// Metres from the eye to the fire.
const DISTANCES: [f32; 6] = [0.3, 0.8, 3.0, 8.0, 20.0, 60.0];
/// Shares of the particles for each pixel of height.
const DETAILS: [f32; 7] =
    [f32::INFINITY, 1.0 / 64.0, 1.0 / 128.0, 1.0 / 256.0, 1.0 / 512.0, 1.0 / 1024.0, 1.0 / 2048.0];
/// Instants that errors are the mean of, and the seconds between them.
const INSTANTS: usize = 5;
const APART: f64 = 0.37;

/// The view of an eye so far away.
fn view(away: f32) -> View {
    let eye = vec3(0.0, MIDDLE, away);
    View::new(camera(eye, eye + Vec3::NEG_Z), SIZE.0, SIZE.1)
}

/// A fire so far away, and how many particles it has.
fn particles(time: f64, away: f32, detail: f32) -> (Particles, f32) {
    let view = view(away);
    let fire = torch(time).detailed(&view, detail);
    (Particles::fire(vec![fire], 1.6, &view, SIZE.0, SIZE.1), fire.count)
}

/// Milliseconds that a fire takes alone, on one thread: moving, listing and drawing it, without the picture behind.
fn ms(alone: &Renderer, rounds: usize, tiles: &mut [Tile], away: f32, detail: f32) -> f64 {
    let times = (0..rounds).map(|round| {
        let began = Instant::now();
        let mut particles = particles(START + round as f64 * APART, away, detail).0.without_solids();
        particles.prepare(alone.crew());
        for tile in tiles.iter_mut() {
            particles.draw(alone.level(), tile);
        }
        began.elapsed().as_secs_f64() * 1e3
    });
    median(times.collect())
}

/// The light of a frame, sum of codes.
fn light(frame: &Frame) -> f64 {
    frame.pixels.iter().map(|p| f64::from((p >> 16 & 255) + (p >> 8 & 255) + (p & 255))).sum()
}

/// Appends tables, and writes their curves.
pub fn report(text: &mut String, stage: &mut Stage, out: &Path) -> Result<(), Box<dyn Error>> {
    let (columns, rows) = (SIZE.0.div_ceil(Tile::SIZE), SIZE.1.div_ceil(Tile::SIZE));
    let mut tiles: Vec<_> = (0..columns * rows).map(|n| Tile::at(n % columns, n / columns, SIZE.0, SIZE.1)).collect();
    writeln!(
        text,
        "\n## Level of detail\n\nA torch alone, at `fast`. `particle_detail` is the share of its particles that is drawn for each pixel of its height; the default is **bold**. Milliseconds are of that fire alone, moved and drawn on one thread, without the picture behind. PSNR is against all particles, of the whole frame and of the pixels that the fire changes; so are the pixels off by more than 8 codes; FLIP is the whole frame's, 99th percentile. Light: root of the mean square by which the sum of its light is off. Means over {INSTANTS} instants.\n"
    )?;
    writeln!(
        text,
        "| metres | particle_detail | particles | ms | times as fast | PSNR, dB | within the fire | off by more than 8 | FLIP 99 % | light |\n|--:|--:|{}",
        "--:|".repeat(8)
    )?;
    let (alone, rounds) = (Renderer::new(1)?, stage.rounds);
    let mut curves = Vec::new();
    let black = || Frame::new(SIZE.0, SIZE.1);
    for away in DISTANCES {
        let mut draw = |index: usize, detail: f32| {
            let time = START + index as f64 * APART;
            let mut frame = black();
            let picture = over(&stage.shot(time), FIRE_SKY, particles(time, away, detail).0);
            stage.renderer.draw(picture, &mut frame);
            frame
        };
        let truths: Vec<_> = (0..INSTANTS).map(|index| draw(index, f32::INFINITY)).collect();
        let errors: Vec<_> =
            DETAILS.iter().map(|detail| (0..INSTANTS).map(|index| draw(index, *detail)).collect::<Vec<_>>()).collect();
        let mut behind = black();
        let picture = over(&stage.shot(START), FIRE_SKY, Particles::fire(Vec::new(), 1.6, &view(away), SIZE.0, SIZE.1));
        stage.renderer.draw(picture, &mut behind);
        let mut curve = Curve { name: format!("{away} m"), points: Vec::new() };
        let all = ms(&alone, rounds, &mut tiles, away, f32::INFINITY);
        for (detail, frames) in DETAILS.iter().zip(errors) {
            let offs: Vec<_> = frames.iter().zip(&truths).map(|(frame, truth)| Off::between(frame, truth)).collect();
            let off = Off::mean(&offs);
            let share: f64 = truths
                .iter()
                .map(|truth| truth.pixels.iter().zip(&behind.pixels).filter(|(a, b)| a != b).count() as f64)
                .sum::<f64>()
                / (INSTANTS * behind.pixels.len()) as f64;
            let lights = frames
                .iter()
                .zip(&truths)
                .map(|(frame, truth)| ((light(frame) - light(truth)) / (light(truth) - light(&behind))).powi(2));
            let flicker = (lights.sum::<f64>() / INSTANTS as f64).sqrt();
            let ms = ms(&alone, rounds, &mut tiles, away, *detail);
            let [psnr, within] = [off.psnr(), off.psnr() + 10.0 * share.log10()];
            let name = if detail.is_finite() { format!("1/{}", 1.0 / detail) } else { "all".into() };
            let bold = if *detail == Quality::FAST.particle_detail { format!("**{name}**") } else { name.clone() };
            let (_, count) = particles(START, away, *detail);
            let number = if off.square > 0.0 { format!("{psnr:.1} | {within:.1}") } else { "equal | ".into() };
            writeln!(
                text,
                "| {away} | {bold} | {count:.0} | {ms:.3} | {:.2} | {number} | {:.1} % | {:.3} | {:.1} % |",
                all / ms,
                100.0 * off.bad / share,
                off.flip99,
                100.0 * flicker
            )?;
            if off.square > 0.0 {
                curve.points.push((all / ms, psnr, name));
            }
        }
        if !curve.points.is_empty() {
            curves.push(curve);
        }
    }
    let axes = [Axis { name: "times as fast as all" }, Axis { name: "PSNR, dB" }];
    plot::draw(&out.join("particles-detail.svg"), &["level of detail"], &[curves], axes)?;
    writeln!(text, "\n![level of detail](particles-detail.svg)")?;
    Ok(())
}
