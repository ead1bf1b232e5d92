//! Frames per second against flakes, as in `[Snow07]`.

use super::{START, STEP, Stage};
use crate::plot::{self, Axis, Curve};
use paprsek::frame::Layer;
use paprsek::particles::Flakes;
use paprsek::scenes::bench::particles::{FLAKES, SNOW_SKY, over, snowfall};
use std::error::Error;
use std::fmt::Write;
use std::path::Path;

/// The thesis: flakes around the eye, flakes drawn, frames per second.
const THEIRS: [(u32, u32, f64); 6] = [
    (50_000, 10_000, 160.0),
    (100_000, 21_500, 80.0),
    (200_000, 42_000, 40.0),
    (300_000, 64_000, 28.0),
    (400_000, 85_000, 21.0),
    (500_000, 106_000, 17.0),
];
const MILLION: u32 = 1_000_000;

/// The bench scene's flakes with another number of them around the eye.
fn flakes(around: u32) -> Flakes {
    // The count is of the whole box; the flakes in its corners are never seen and do not count as around the eye.
    Flakes { count: (around as f64 * FLAKES.count as f64 / 200_000.0) as u32, ..FLAKES }
}

/// Appends the table, and writes its curves.
pub fn report(text: &mut String, stage: &mut Stage, out: &Path) -> Result<(), Box<dyn Error>> {
    let counts: Vec<u32> = THEIRS.iter().map(|row| row.0).chain([MILLION]).collect();
    let drawn = |count: &u32| {
        let instants = [0.0, 10.0, 20.0, 30.0, 40.0];
        let sum = instants.map(|k| {
            let mut particles = snowfall(&stage.shot(START + k * STEP), &flakes(*count));
            particles.prepare(stage.renderer.workers(), stage.renderer.cache());
            particles.drawn()
        });
        sum.iter().sum::<usize>() / instants.len()
    };
    let drawn: Vec<_> = counts.iter().map(drawn).collect();
    let fps = stage.fps(&counts, |count, shot| over(shot, SNOW_SKY, snowfall(shot, &flakes(*count))));
    writeln!(
        text,
        "\n## Snow\n\nThe bench scene `snow` with other numbers of flakes around the eye, at `fast`. The thesis (Pilsen 2007) measured on a Pentium M at 1.7 GHz and its graphics card, with one texture per flake.\n"
    )?;
    writeln!(
        text,
        "| flakes around the eye | thesis: drawn | fps | million drawn per second | ours: drawn | fps | million drawn per second | ns per flake around the eye |\n|--:|--:|--:|--:|--:|--:|--:|--:|"
    )?;
    for (index, count) in counts.iter().enumerate() {
        let theirs = THEIRS.get(index).map_or(" |  | ".into(), |(_, drawn, fps)| {
            format!("{drawn} | {fps:.0} | {:.2}", *drawn as f64 * fps * 1e-6)
        });
        let (drawn, fps) = (drawn[index], fps[index]);
        writeln!(
            text,
            "| {count} | {theirs} | {drawn} | {fps:.1} | {:.2} | {:.1} |",
            drawn as f64 * fps * 1e-6,
            1e9 / fps / *count as f64
        )?;
    }
    let curve = |name: &str, points: Vec<(f64, f64)>| {
        let points = points.into_iter().map(|(x, y)| (x, y, format!("{y:.0}"))).collect();
        Curve { name: name.into(), points }
    };
    let curves = vec![
        curve("thesis, 2007", THEIRS.iter().map(|row| (row.0 as f64, row.2)).collect()),
        curve("fast", counts.iter().zip(&fps).map(|(count, fps)| (*count as f64, *fps)).collect()),
    ];
    let axes = [Axis { name: "flakes around the eye" }, Axis { name: "frames per second" }];
    plot::draw(&out.join("particles-snow.svg"), &["snow"], &[curves], axes)?;
    writeln!(text, "\n![snow](particles-snow.svg)")?;
    Ok(())
}
