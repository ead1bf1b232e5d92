//! The dome of the sky: contact sheets through the day, and error against milliseconds.
//!
//! usage: dome sheet FILE.png [HAZE] | dome day FILE.png | dome moon FILE.png | dome table | dome time

use fearless_simd::Level;
use glam::{Mat3, Vec3, vec3};
use image::{Rgb, RgbImage, imageops};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Layer, Picture, Renderer, Tile};
use paprsek::settings::{Quality, SkySettings};
use paprsek::sky::air::Air;
use paprsek::sky::dome::{Dome, Sky};
use paprsek::sky::layer::SkyLayer;
use paprsek::sky::place::Place;
use paprsek::sky::time;
use paprsek::view::{Camera, View};

const ALTITUDES: [f32; 12] = [60.0, 30.0, 10.0, 5.0, 2.0, 0.0, -2.0, -4.0, -6.0, -9.0, -12.0, -18.0];

fn sky(altitude: f32, haze: f32) -> Sky {
    let a = altitude.to_radians();
    Sky {
        sun: vec3(0.0, a.sin(), -a.cos()),
        moon: -Vec3::Y,
        moon_to_sun: Vec3::X,
        lit: 0.0,
        moon_radius: 0.0045,
        turn: Mat3::IDENTITY,
        air: Air { haze, ozone: 1.1, again: 0.7 },
    }
}

fn render(dome: Dome, settings: &SkySettings, target: Vec3, fov: f32, size: (usize, usize)) -> RgbImage {
    let camera = Camera::look_at(Vec3::ZERO, target, fov.to_radians(), 0.0);
    let mut frame = Frame::new(size.0, size.1);
    let layer = SkyLayer::new(dome, &View::new(camera, size.0, size.1), settings);
    Renderer::new(1).unwrap().draw(Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }, &mut frame);
    RgbImage::from_fn(size.0 as u32, size.1 as u32, |x, y| {
        let p = frame.pixels[y as usize * size.0 + x as usize];
        Rgb([(p >> 16) as u8, (p >> 8) as u8, p as u8])
    })
}

/// Root mean square and largest difference, codes.
fn difference(a: &RgbImage, b: &RgbImage) -> (f64, u8) {
    let off = a.as_raw().iter().zip(b.as_raw()).map(|(a, b)| a.abs_diff(*b));
    let squares: f64 = off.clone().map(|d| d as f64 * d as f64).sum();
    ((squares / a.as_raw().len() as f64).sqrt(), off.max().unwrap())
}

/// The sky towards the sun and away from it, and the fastest of some times that one takes, milliseconds of one thread
/// without what encodes it.
fn views(quality: SkySettings, altitude: f32, size: (usize, usize), repeat: u32) -> (Vec<RgbImage>, f64) {
    let mut best = f64::MAX;
    for _ in 0..repeat {
        let camera = Camera::look_at(Vec3::ZERO, vec3(0.0, 0.35, -1.0), 50f32.to_radians(), 0.0);
        let start = std::time::Instant::now();
        let layer =
            SkyLayer::new(Dome::new(sky(altitude, 1.3), &quality), &View::new(camera, size.0, size.1), &quality);
        for row in 0..size.1.div_ceil(Tile::SIZE) {
            for column in 0..size.0.div_ceil(Tile::SIZE) {
                layer.draw(Level::new(), &mut Tile::at(column, row, size.0, size.1));
            }
        }
        best = best.min(start.elapsed().as_secs_f64() * 1000.0);
    }
    let dome = Dome::new(sky(altitude, 1.3), &quality);
    let views = [-1.0, 1.0].map(|side| render(dome, &quality, vec3(0.0, 0.35, side), 50.0, size));
    (views.to_vec(), best)
}

fn table() {
    let size = (1280, 720);
    println!("| cell, rad | steps | ms by day | ms at -6 | rms, worst codes by day | at 0 | at -6 | at -12 |");
    println!("|---|---|---|---|---|---|---|---|");
    let altitudes = [30.0, 0.0, -6.0, -12.0];
    let truth = altitudes.map(|a| views(SkySettings { steps: 50, cell: 0.0, grid: 1 }, a, size, 1).0);
    for (cell, steps) in
        [(0.0, 24), (0.0, 10), (0.011, 24), (0.011, 16), (0.011, 10), (0.011, 8), (0.011, 6), (0.022, 10), (0.044, 10)]
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

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let quality = Quality::DEFAULT.sky;
    match arguments[0].as_str() {
        "sheet" => {
            let quality =
                SkySettings { steps: arguments.get(3).map_or(quality.steps, |s| s.parse().unwrap()), ..quality };
            let haze = arguments.get(2).map_or(1.3, |h| h.parse().unwrap());
            let size = (320, 200);
            let mut sheet = RgbImage::new(size.0 as u32 * 4, size.1 as u32 * 6);
            for (i, altitude) in ALTITUDES.into_iter().enumerate() {
                let dome = Dome::new(sky(altitude, haze), &quality);
                println!("{altitude}: level {:.3e} exposure {:.3e}", dome.level, dome.exposure);
                for (j, side) in [-1.0, 1.0].into_iter().enumerate() {
                    let picture = render(dome, &quality, vec3(0.0, 0.45, side), 75.0, size);
                    let (x, y) = (i % 2 * 2 + j, i / 2);
                    imageops::replace(&mut sheet, &picture, (x * size.0) as i64, (y * size.1) as i64);
                }
            }
            sheet.save(&arguments[1]).unwrap();
        }
        "day" => {
            // Plzen through 2026-06-29 and the night after, with a full moon; each towards the sun, the moon, the north.
            let days = time::days(2026, 6, 29);
            let size = (480, 270);
            let hours = [11.0, 18.0, 18.9, 19.4, 19.8, 20.5, 21.5, 23.5];
            let mut sheet = RgbImage::new(size.0 as u32 * 3, size.1 as u32 * hours.len() as u32);
            for (row, hour) in hours.into_iter().enumerate() {
                let sky = Sky::new(days + hour / 24.0, &Place::PLZEN);
                let dome = Dome::new(sky, &quality);
                let light = dome.lighting();
                println!("{hour}: sun {:.1} {:.2?}", sky.sun.y.asin().to_degrees(), light);
                for (column, d) in [sky.sun, sky.moon, vec3(0.1, 0.0, -1.0)].into_iter().enumerate() {
                    let d = vec3(d.x, d.y.max(0.35), d.z);
                    let picture = render(dome, &quality, d, 50.0, size);
                    imageops::replace(&mut sheet, &picture, (column * size.0) as i64, (row * size.1) as i64);
                }
            }
            sheet.save(&arguments[1]).unwrap();
        }
        "moon" => {
            // Every third day of a month at the moon's highest, ten times its size, up on a night's sky and on a day's.
            let size = (200, 200);
            let mut sheet = RgbImage::new(size.0 as u32 * 5, size.1 as u32 * 2);
            for i in 0..10 {
                let mut days = time::days(2026, 6, 15) + 0.5 + i as f64 * 2.9;
                let height = |t: f64| Sky::new(t, &Place::PLZEN).moon.y;
                days += (0..96)
                    .map(|q| q as f64 / 96.0)
                    .max_by(|a, b| height(days + a).total_cmp(&height(days + b)))
                    .unwrap();
                let sky = Sky::new(days, &Place::PLZEN);
                let dome = Dome::new(sky, &quality).with_sizes(2.0, 10.0);
                let picture = render(dome, &quality, sky.moon, 8.0, size);
                println!("lit {:.2} sun {:.0}", sky.lit, sky.sun.y.asin().to_degrees());
                imageops::replace(&mut sheet, &picture, (i % 5 * size.0) as i64, (i / 5 * size.1) as i64);
            }
            sheet.save(&arguments[1]).unwrap();
        }
        "time" => {
            for altitude in [30.0, -6.0] {
                println!("{altitude}: {:.2} ms", views(quality, altitude, (1280, 720), 20).1);
            }
        }
        "table" => table(),
        _ => panic!("unknown"),
    }
}
