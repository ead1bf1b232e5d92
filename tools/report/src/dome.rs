//! The computed dome of the sky: contact sheets to look at, and its error against its time.

use crate::options::{Quick, Result};
use crate::picture::rgb;
use fearless_simd::Level;
use glam::{Vec3A, vec3a};
use image::{RgbImage, imageops};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Layer, Picture, Renderer, Tile};
use paprsek::settings::{Quality, SkySettings};
use paprsek::sky::air::Air;
use paprsek::sky::dome::{Dome, Sky};
use paprsek::sky::layer::SkyLayer;
use paprsek::sky::place::Place;
use paprsek::sky::time;
use paprsek::view::{Camera, View};
use std::path::PathBuf;

const ALTITUDES: [f32; 12] = [60.0, 30.0, 10.0, 5.0, 2.0, 0.0, -2.0, -4.0, -6.0, -9.0, -12.0, -18.0];

/// The tests' sky, its sun this high above the horizon, degrees, with so much haze.
pub fn sky(altitude: f32, haze: f32) -> Sky {
    let sky = testkit::sky::sky(altitude);
    Sky { air: Air { haze, ..sky.air }, ..sky }
}

fn render(dome: Dome, settings: &SkySettings, target: Vec3A, fov: f32, size: (usize, usize)) -> RgbImage {
    let camera = Camera::look_at(Vec3A::ZERO, target, fov.to_radians(), 0.0);
    let mut frame = Frame::new(size.0, size.1);
    let layer = SkyLayer::new(dome, &View::new(camera, size.0, size.1), settings);
    Renderer::new(1).unwrap().draw(Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }, &mut frame);
    rgb(&frame)
}

/// The root mean square and the largest difference of two pictures, codes of 255.
fn difference(a: &RgbImage, b: &RgbImage) -> (f64, u8) {
    let off = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| a.abs_diff(*b));
    let squares: f64 = off.clone().map(|d| d as f64 * d as f64).sum();
    ((squares / a.as_raw().len() as f64).sqrt(), off.max().unwrap())
}

/// The sky towards the sun and away from it; and the milliseconds of one such picture on one thread, without encoding: the
/// fastest of `repeat` runs.
fn views(quality: SkySettings, altitude: f32, size: (usize, usize), repeat: u32) -> (Vec<RgbImage>, f64) {
    let mut best = f64::MAX;
    for _ in 0..repeat {
        let camera = Camera::look_at(Vec3A::ZERO, vec3a(0.0, 0.35, -1.0), 50f32.to_radians(), 0.0);
        let start = std::time::Instant::now();
        let layer =
            SkyLayer::new(Dome::new(sky(altitude, HAZE), &quality), &View::new(camera, size.0, size.1), &quality);
        for row in 0..size.1.div_ceil(Tile::SIZE) {
            for column in 0..size.0.div_ceil(Tile::SIZE) {
                layer.draw(Level::new(), &mut Tile::at(column, row, size.0, size.1));
            }
        }
        best = best.min(start.elapsed().as_secs_f64() * 1000.0);
    }
    let dome = Dome::new(sky(altitude, HAZE), &quality);
    let views = [-1.0, 1.0].map(|side| render(dome, &quality, vec3a(0.0, 0.35, side), 50.0, size));
    (views.to_vec(), best)
}

/// Prints error against milliseconds, by cell and steps.
fn table(quick: bool) {
    let size = if quick { (320, 180) } else { (1280, 720) };
    println!("| cell, rad | steps | ms by day | ms at -6 | rms, worst codes by day | at 0 | at -6 | at -12 |");
    println!("|---|---|---|---|---|---|---|---|");
    let altitudes = [30.0, 0.0, -6.0, -12.0];
    let truth = altitudes.map(|a| views(SkySettings { steps: 50, cell: 0.0, grid: 1 }, a, size, 1).0);
    for (cell, steps) in
        [(0.0, 24), (0.0, 10), (0.013, 24), (0.013, 16), (0.013, 10), (0.013, 8), (0.013, 6), (0.026, 10), (0.052, 10)]
    {
        let quality = SkySettings { steps, cell, grid: 1 };
        let repeat = if cell > 0.0 { 5 } else { 1 };
        print!("| {cell} | {steps} |");
        let mut errors = String::new();
        for (altitude, truth) in altitudes.into_iter().zip(&truth) {
            let (pictures, time) = views(quality, altitude, size, repeat);
            if altitude == 30.0 || altitude == -6.0 {
                print!(" {time:.2} |");
            }
            let off: Vec<_> = truth.iter().zip(&pictures).map(|(a, b)| difference(a, b)).collect();
            errors += &format!(" {:.2}, {} |", off[0].0.max(off[1].0), off[0].1.max(off[1].1));
        }
        println!("{errors}");
    }
}

/// Prints the milliseconds of the default quality by day and at dusk.
fn time_views(quick: bool) {
    let (size, repeat) = if quick { ((320, 180), 3) } else { ((1280, 720), 20) };
    for altitude in [30.0, -6.0] {
        println!("{altitude}: {:.2} ms", views(Quality::DEFAULT.sky, altitude, size, repeat).1);
    }
}

/// A contact sheet of pictures that have the same size.
fn sheet(pictures: &[RgbImage], columns: usize) -> RgbImage {
    let (width, height) = pictures[0].dimensions();
    let mut sheet = RgbImage::new(width * columns as u32, height * pictures.len().div_ceil(columns) as u32);
    for (i, picture) in pictures.iter().enumerate() {
        let (x, y) = ((i % columns) as i64, (i / columns) as i64);
        imageops::replace(&mut sheet, picture, x * i64::from(width), y * i64::from(height));
    }
    sheet
}

/// The sky at twelve heights of the sun, each towards the sun and away from it.
fn heights(quality: SkySettings, haze: f32) -> RgbImage {
    let mut pictures = Vec::new();
    for altitude in ALTITUDES {
        let dome = Dome::new(sky(altitude, haze), &quality);
        println!("{altitude}: level {:.3e} exposure {:.3e}", dome.level, dome.exposure);
        pictures.extend([-1.0, 1.0].map(|side| render(dome, &quality, vec3a(0.0, 0.45, side), 75.0, (320, 200))));
    }
    sheet(&pictures, 4)
}

/// Plzen on 2026-06-29 and in the night after, with a full moon: towards the sun, the moon and the north at each hour.
fn day(quality: SkySettings) -> RgbImage {
    let days = time::days(2026, 6, 29);
    let mut pictures = Vec::new();
    for hour in [11.0, 18.0, 18.9, 19.4, 19.8, 20.5, 21.5, 23.5] {
        let sky = Sky::new(days + hour / 24.0, &Place::PLZEN);
        let dome = Dome::new(sky, &quality);
        println!("{hour}: sun {:.1} {:.2?}", sky.sun.y.asin().to_degrees(), dome.lighting());
        for d in [sky.sun, sky.moon, vec3a(0.1, 0.0, -1.0)] {
            pictures.push(render(dome, &quality, vec3a(d.x, d.y.max(0.35), d.z), 50.0, (480, 270)));
        }
    }
    sheet(&pictures, 3)
}

/// The moon on every third day of a month when it is highest, at ten times its size, against the sky of night or day.
fn moon(quality: SkySettings) -> RgbImage {
    let mut pictures = Vec::new();
    for i in 0..10 {
        let days = time::days(2026, 6, 15) + 0.5 + f64::from(i) * 2.9;
        let height = |quarter: &i32| Sky::new(days + f64::from(*quarter) / 96.0, &Place::PLZEN).moon.y;
        let highest = (0..96).max_by(|a, b| height(a).total_cmp(&height(b))).unwrap_or(0);
        let sky = Sky::new(days + f64::from(highest) / 96.0, &Place::PLZEN);
        let dome = Dome::new(sky, &quality).with_sizes(2.0, 10.0);
        println!("lit {:.2} sun {:.0}", sky.lit, sky.sun.y.asin().to_degrees());
        pictures.push(render(dome, &quality, sky.moon, 8.0, (200, 200)));
    }
    sheet(&pictures, 5)
}

/// Haze of the sky in tables and sheets.
pub const HAZE: f32 = 1.3;

/// What to measure or draw of the sky.
#[derive(clap::Subcommand)]
pub enum What {
    /// Error against milliseconds, by cell and steps.
    Table(Quick),
    /// Milliseconds of the default quality, by day and at dusk.
    Time(Quick),
    /// A contact sheet of twelve heights of the sun, towards it and away from it.
    Sheet {
        /// The picture.
        #[arg(long, value_name = "FILE", default_value = "target/dome.png")]
        out: PathBuf,
        /// Haze in the air; 1 is clear air.
        #[arg(long, default_value_t = HAZE)]
        haze: f32,
        /// Number of points along each direction [default: that of `default`].
        #[arg(long)]
        steps: Option<u32>,
    },
    /// A contact sheet of a summer's day and night in Plzen.
    Day {
        /// The picture.
        #[arg(long, value_name = "FILE", default_value = "target/dome-day.png")]
        out: PathBuf,
    },
    /// A contact sheet of the moon's phases.
    Moon {
        /// The picture.
        #[arg(long, value_name = "FILE", default_value = "target/dome-moon.png")]
        out: PathBuf,
    },
}

/// Prints a table, or writes a sheet.
pub fn run(what: &What) -> Result {
    let quality = Quality::DEFAULT.sky;
    match what {
        What::Table(options) => table(options.quick),
        What::Time(options) => time_views(options.quick),
        What::Sheet { out, haze, steps } => {
            heights(SkySettings { steps: steps.unwrap_or(quality.steps), ..quality }, *haze).save(out)?;
        }
        What::Day { out } => day(quality).save(out)?,
        What::Moon { out } => moon(quality).save(out)?,
    }
    Ok(())
}
