//! Particles per second of motion alone, beside what memory and arithmetic allow.

use super::{SIZE, START, STEP, THREADS, camera};
use crate::limits::{self, NUMBERS};
use crate::plot::{self, Axis, Curve};
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::{Vec3A, vec3a};
use paprsek::frame::{Layer, Renderer};
use paprsek::particles::{Fire, Flakes, Lens, ParticleLayer};
use paprsek::scenes::bench::particles::{FLAKES, fires, flakes};
use paprsek::settings::Quality;
use paprsek::view::View;
use std::error::Error;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

/// Number of particles.
const COUNT: u32 = 1_000_000;
/// Kinds of particles.
const KINDS: [&str; 2] = ["flakes", "flames"];
/// The number of vector instructions for a vector of flakes and for one of flames, from the particle's index to what is
/// seen of it, by SIMD level. Counted by hand in the compiler's assembly (`cargo rustc --release --lib -- --emit asm`).
/// SSE2 is missing, as it calls functions for `floor`.
const INSTRUCTIONS: [(&str, [u32; 2]); 3] = [("avx512", [309, 438]), ("avx2", [352, 498]), ("sse4.2", [513, 665])];
/// A range along the view axis in which there is nothing, metres.
const NOWHERE: [f32; 2] = [1e30, 2e30];

/// Particles of a kind at an instant, of which some are visible or none.
fn particles(kind: usize, time: f64, seen: bool) -> ParticleLayer {
    let eye = if kind == 0 { Vec3A::ZERO } else { vec3a(0.0, 2.0, 8.0) };
    let view = View::new(camera(eye, eye + Vec3A::NEG_Z), SIZE.0, SIZE.1);
    // With an empty range the computation is the same, but nothing is visible at its end.
    let lens = |lens: Lens| if seen { lens } else { Lens { near: NOWHERE, ..lens } };
    if kind == 0 {
        let of = Flakes { count: COUNT, lens: lens(FLAKES.lens), ..FLAKES };
        ParticleLayer::new(vec![flakes(&of, time, Vec3A::ZERO).into()], &view, &Quality::EXACT.particles)
    } else {
        let fire = fires(time)[0];
        let fire = Fire { place: Vec3A::Y, count: COUNT as f32, lens: lens(fire.lens), ..fire };
        ParticleLayer::new(vec![fire.into()], &view, &Quality::EXACT.particles)
    }
}

/// Particles per second from the time to sprites that are listed by tile. The quickest round counts, as it does for limits.
fn speed(renderer: &Renderer, kind: usize, seen: bool, rounds: usize) -> f64 {
    let time = |round: usize| {
        let mut particles = particles(kind, START + round as f64 * STEP, seen);
        let began = Instant::now();
        particles.prepare(renderer.workers(), renderer.cache());
        let seconds = began.elapsed().as_secs_f64();
        assert_eq!(particles.drawn() > 0, seen);
        seconds
    };
    time(0);
    f64::from(COUNT) / (1..=rounds).map(time).fold(f64::MAX, f64::min)
}

/// The number of lanes of a level.
fn lanes(level: Level) -> f64 {
    fn count<S: Simd>(_: S) -> usize {
        <S::f32s as SimdBase<S>>::LEN
    }
    dispatch!(level, simd => count(simd)) as f64
}

/// Appends the tables, and writes their curves.
pub fn report(text: &mut String, out: &Path, rounds: usize) -> Result<(), Box<dyn Error>> {
    let seen = |kind: usize| {
        let mut particles = particles(kind, START, true);
        let renderer = Renderer::new(1)?;
        particles.prepare(renderer.workers(), renderer.cache());
        Ok::<_, String>(particles.drawn() as f64 / f64::from(COUNT))
    };
    writeln!(
        text,
        "\n## Motion alone\n\nMillion particles per second, of {COUNT}, in the quickest of {rounds} rounds: everything that a frame does before its tiles. None seen: places, sizes and visibility are computed, but nothing is visible. Seen: {:.0} % of the flakes and {:.0} % of the flames become sprites, which are listed by tile. Arithmetic: the rate at which this machine would execute the vector instructions that the compiler made for a particle ({}) if each took as long as an independent sum or product (moves take less). Of it: the share of that rate that is reached where none is seen.\n",
        100.0 * seen(0)?,
        100.0 * seen(1)?,
        INSTRUCTIONS
            .map(|(name, [flake, flame])| format!("{name}: {flake} per vector of flakes, {flame} of flames"))
            .join("; ")
    )?;
    writeln!(
        text,
        "| threads | level | sums and products, thousand million vectors per second | flakes, none seen | seen | arithmetic | of it | flames, none seen | seen | arithmetic | of it |\n|--:|---|{}",
        "--:|".repeat(9)
    )?;
    let mut curves = Vec::new();
    let mut stored = Vec::new();
    for threads in [1, THREADS] {
        let on = if threads == 1 { "1 thread".to_string() } else { format!("{threads} threads") };
        let mut lines = KINDS.map(|kind| Curve { name: format!("{kind}, {on}"), points: Vec::new() });
        for (name, level) in testkit::levels() {
            let renderer = Renderer::new(threads)?.at_level(level);
            let rate = limits::arithmetic(&renderer, level, rounds);
            write!(text, "| {threads} | {name} | {:.2}", rate * 1e-9)?;
            for (kind, line) in lines.iter_mut().enumerate() {
                let [unseen, seen] = [false, true].map(|seen| speed(&renderer, kind, seen, rounds));
                write!(text, " | {:.1} | {:.1}", unseen * 1e-6, seen * 1e-6)?;
                if let Some((_, instructions)) = INSTRUCTIONS.iter().find(|row| row.0 == name) {
                    let most = rate * lanes(level) / f64::from(instructions[kind]);
                    write!(text, " | {:.0} | {:.0} %", most * 1e-6, 100.0 * unseen / most)?;
                    line.points.push((lanes(level), unseen * 1e-6, name.to_string()));
                } else {
                    *text += " |  | ";
                }
            }
            writeln!(text, " |")?;
        }
        curves.extend(lines);
        let [read, both] = limits::memory(&Renderer::new(threads)?, rounds);
        stored.push((threads, read, both));
        let ends = |y: f64| vec![(4.0, y * 1e-6, String::new()), (16.0, y * 1e-6, String::new())];
        curves.push(Curve { name: format!("stored: read, {on}"), points: ends(read) });
    }
    writeln!(
        text,
        "\nIf particles were stored, {NUMBERS} numbers each (place and speed), memory alone would allow the following rates, with no other work than a sum or a step:\n\n| threads | GB read per second | million read per second | million read, moved and written back |\n|--:|--:|--:|--:|"
    )?;
    for (threads, read, both) in stored {
        let bytes = read * (4 * NUMBERS) as f64 * 1e-9;
        writeln!(text, "| {threads} | {bytes:.1} | {:.1} | {:.1} |", read * 1e-6, both * 1e-6)?;
    }
    let axes = [Axis { name: "lanes" }, Axis { name: "million per second, none seen" }];
    plot::draw(&out.join("particles-motion.svg"), &["motion alone"], &[curves], axes)?;
    writeln!(text, "\n![motion alone](particles-motion.svg)")?;
    Ok(())
}
