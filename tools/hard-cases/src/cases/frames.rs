//! Fog, eyes, and bytes of frames.

use crate::case::{Case, Effort, Runs};
use glam::{Vec3A, vec3a};
use paprsek::effects::{Fog, FogLayer};
use paprsek::frame::{Frame, Layer, Renderer, Tile};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::view::{Camera, Stereo, View};
use testkit::drawn::ray;
use testkit::metrics::Difference;
use testkit::random::Random;
use testkit::{Found, ULP, levels};

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Levels,
        "fog of 1e-5 to 1e3 a metre before what is 0.3 m to 30 km away",
        "Beer and Lambert",
        "f64",
        2e-6,
        fog,
    ),
    Case::new(
        Runs::Scalar,
        "two eyes: places of a point by its depth",
        "parallel axes",
        "closed form in f64",
        0.02,
        eyes,
    )
    .unit("pixels"),
    Case::new(
        Runs::Levels,
        "bytes of every scene on 1 and 3 threads, at each level, after another frame",
        "threads, history",
        "1 thread, the best level, nothing before",
        0.0,
        bytes,
    )
    .unit("bytes"),
    Case::new(
        Runs::Scalar,
        "a capture at 24 and at 60 frames a second",
        "frame rate",
        "the same instants, bit for bit",
        0.0,
        rates,
    )
    .unit("bytes"),
    Case::new(
        Runs::Best,
        "imposters of clouds beside rays, decibels short of 35",
        "[Clouds10]",
        "the same camera without imposters",
        0.0,
        imposters,
    )
    .unit("dB"),
];

fn fog(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(144));
    let size = [150, 100];
    for _ in 0..effort.of(60) {
        let camera =
            Camera::look_at(vec3a(3.0, 2.0, -1.0), random.direction() * 9.0, random.range(0.2, 1.5) as f32, 0.1);
        let fog = Fog {
            light: vec3a(0.5, 0.6, 0.8),
            density: random.log(1e-5, 1e3) as f32,
            end: random.log(1.0, 1e5) as f32,
        };
        let mut before = Tile::at(2, 1, size[0], size[1]);
        for at in 0..Tile::AREA {
            before.coverage[at] = [0.0, 0.25, 0.75, 1.0][at % 4];
            before.inv_depth[at] = if at % 4 > 0 { random.log(1.0 / 3e4, 3.0) as f32 } else { 0.0 };
            before.red[at] = random.range(0.0, 1.5) as f32;
        }
        for (name, level) in levels() {
            let mut tile = Tile::at(2, 1, size[0], size[1]);
            (tile.coverage, tile.inv_depth, tile.red) =
                (before.coverage.clone(), before.inv_depth.clone(), before.red.clone());
            FogLayer::new(fog, &View::new(camera, size[0], size[1])).draw(level, &mut tile);
            for (row, column) in (0..tile.height).flat_map(|row| (0..tile.width).map(move |column| (row, column))) {
                let at = row * Tile::SIZE + column;
                let d = ray(&camera, size, (tile.x + column) as f64 + 0.5, (tile.y + row) as f64 + 0.5);
                let (density, end) = (fog.density as f64, fog.end as f64);
                let near = before.inv_depth[at] as f64;
                let way = if near > 0.0 { (d.length() / near).min(end) } else { end };
                let covered = before.coverage[at] as f64;
                let clear = (-density * way).exp() * covered + (-density * end).exp() * (1.0 - covered);
                let due = before.red[at] as f64 * clear + fog.light.x as f64 * (1.0 - clear);
                found.see((tile.red[at] as f64 - due).abs(), || {
                    format!("{name}, {fog:?}, pixel {at}: {} for {due}", tile.red[at])
                });
            }
        }
    }
    found
}

fn eyes(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(145));
    let (width, height) = (640, 720);
    for _ in 0..effort.of(20_000) {
        let fov = random.range(0.3, 1.4) as f32;
        let camera = Camera::look_at(Vec3A::ZERO, random.direction(), fov, random.range(-1.0, 1.0) as f32);
        let stereo = Stereo { eye_distance: random.log(1e-3, 1.0) as f32, convergence: random.log(0.5, 50.0) as f32 };
        let [left, right] = [-0.5, 0.5].map(|side| View::new(camera.at(stereo.eye(side)), width, height));
        let depth = stereo.convergence as f64 * random.log(0.3, 1e4);
        let across = camera.right.normalize() * random.range(-0.3, 0.3) as f32;
        let p = (camera.forward + across) * depth as f32;
        let focal = 0.5 * height as f64 / (0.5 * fov as f64).tan();
        let due = focal * stereo.eye_distance as f64 * (1.0 / depth - 1.0 / stereo.convergence as f64);
        let what = || format!("{stereo:?}, {depth} m");
        match (left.project(p), right.project(p)) {
            (Some(l), Some(r)) => {
                // Places are rounded to f32 at their own size.
                let doubt = 8.0 * ULP * (l.0.abs() + r.0.abs()) as f64;
                found.see(((l.0 - r.0) as f64 - due).abs().max((l.1 - r.1).abs() as f64) - doubt, what);
            }
            _ => found.see(f64::INFINITY, what),
        }
    }
    found
}

/// Pixels in which two frames differ.
fn differing(a: &Frame, b: &Frame) -> f64 {
    a.pixels.iter().zip(&b.pixels).filter(|(a, b)| a != b).count() as f64
}

fn bytes(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(146));
    let few: Vec<_> = scenes::all().to_vec();
    for scene in effort.some(&few, 6) {
        let size = (67 + (random.unit() * 60.0) as usize, 3 + (random.unit() * 70.0) as usize);
        let time = random.range(0.0, scene.duration);
        let draw = |threads: usize, level, before: Option<f64>| {
            let mut renderer = Renderer::new(threads).ok()?.at_level(level);
            let mut frame = Frame::new(size.0, size.1);
            for time in before.into_iter().chain([time]) {
                renderer.render(scene, time, &Quality::DEFAULT, &mut frame);
            }
            Some(frame)
        };
        let all = levels();
        let Some(truth) = draw(1, all[0].1, None) else { return Found::default() };
        for (name, level) in all {
            let what = || format!("{} at {time} s, {size:?}, {name}", scene.name);
            match draw(3, level, Some(random.range(0.0, scene.duration))) {
                Some(frame) => found.see(differing(&frame, &truth), what),
                None => found.see(f64::INFINITY, what),
            }
        }
    }
    found
}

/// The frames that two rates share, each by a renderer that has drawn all others of its rate before.
fn rates(effort: &Effort) -> Found {
    let mut found = Found::default();
    for &name in effort.some(&["snow", "fire", "rain", "sky-of-clouds"], 2) {
        let Some(scene) = scenes::named(name) else { continue };
        let run = |rate: u32| {
            let mut renderer = Renderer::new(1).ok()?;
            let mut shared = Vec::new();
            for frame in 0..=rate / 4 {
                let mut drawn = Frame::new(64, 36);
                renderer.render(&scene, frame as f64 / rate as f64, &Quality::DEFAULT, &mut drawn);
                // Every twelfth of a second.
                if (frame * 12).is_multiple_of(rate) {
                    shared.push(drawn);
                }
            }
            Some(shared)
        };
        let (Some(slow), Some(fast)) = (run(24), run(60)) else { return Found::default() };
        for (a, b) in slow.iter().zip(&fast) {
            found.see(differing(a, b), || name.to_string());
        }
    }
    found
}

fn imposters(effort: &Effort) -> Found {
    let mut found = Found::default();
    let (Some(scene), Ok(mut renderer)) = (scenes::named("sky-of-clouds"), Renderer::new(2)) else { return found };
    for &time in effort.some(&[2.0, 3.3, 7.5, 11.0], 1) {
        let mut draw = |imposter: f32| {
            let mut quality = Quality::FAST;
            quality.cloud.imposter = imposter;
            let mut frame = Frame::new(1280, 720);
            renderer.render(&scene, time, &quality, &mut frame);
            frame
        };
        let psnr = Difference::between(&draw(0.0), &draw(1.0)).psnr();
        found.see((35.0 - psnr).max(0.0), || format!("at {time} s: {psnr} dB"));
    }
    found
}
