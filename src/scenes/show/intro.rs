//! The show: parts, one after another, each a scene of its own. It fades to black before a part ends.

use super::{clouds, day, snowfall, torches};
use super::{letters, lumen};
use crate::effects::Fade;
use crate::frame::Picture;
use crate::frame::{FrameSpec, Scene};
use crate::particles::{Emitter, Lens, ParticleLayer, Strokes};
use crate::timeline::{self, ease};
use crate::view::Camera;
use crate::view::View;
use glam::{Vec3, vec3};

/// The show.
pub const INTRO: Scene =
    Scene { name: "intro", about: "the show: its parts one after another", duration: END, parameters: &[], picture };

/// The parts by the second that each starts, with the second of its own time that it begins at: a dawn, a morning in
/// June, the flight, a sunset in September, the first snow, a night with fires, and the last light.
#[rustfmt::skip]
pub const PARTS: &[(f64, (Scene, f64))] = &[
    (0.0, (unless(cfg!(without = "lumen"), lumen::LUMEN), 0.0)),
    (21.0, (unless(cfg!(without = "day"), day::DAY), 2.0)),
    (35.0, (unless(cfg!(without = "clouds"), clouds::CLOUDS), 0.0)),
    (69.0, (unless(cfg!(without = "day"), day::DAY), day::LENGTH + 31.0)),
    (83.0, (unless(cfg!(without = "snowfall"), snowfall::SNOWFALL), 1.0)),
    (113.0, (unless(cfg!(without = "torches"), torches::TORCHES), 0.0)),
    (143.0, (unless(cfg!(without = "lumen"), lumen::LUMEN), 45.0)),
];

/// The scene, or nothing in its place where it is left out.
const fn unless(left_out: bool, scene: Scene) -> Scene {
    if left_out { Scene::EMPTY } else { scene }
}

/// Seconds that the show takes.
const END: f64 = 154.0;

/// Seconds in which a part goes dark, and in which the next one comes.
pub const FADE: f64 = 0.5;

fn picture(spec: &FrameSpec) -> Picture {
    let ((part, from), time) = timeline::cut(PARTS, END, spec.time);
    let mut picture = (part.picture)(&FrameSpec { time: from + time, ..*spec });
    write(spec, &mut picture);
    let light = light(PARTS, END, spec.time);
    if light < 1.0 {
        picture.layers.push(Box::new(Fade(light)));
    }
    picture
}

/// What is written: the second at which it begins to come together; left end and foot of the line, and a quarter of its
/// letters' height, sixteenths of a metre at two metres before the eye.
#[rustfmt::skip]
pub const WRITING: &[([f32; 4], &str)] = &[
    ([1.0, -12.0, -1.6, 1.2], "PAPRSEK"),
    ([144.5, 6.0, 5.0, 0.45], "FIVE THESES"),
    ([145.5, 6.0, 1.0, 0.45], "TWO CORES"),
    ([146.5, 6.0, -3.0, 0.45], "64 KB"),
];

/// Seconds after which it has flown apart.
pub const READ: f64 = 6.5;

/// Lines of sparks that come together and fly apart.
fn write(spec: &FrameSpec, picture: &mut Picture) {
    if cfg!(without = "writing") {
        return;
    }
    let mut lines = Vec::new();
    for &([start, x, y, size], text) in WRITING {
        let age = spec.time - start as f64;
        let comes = ease(0.0, 2.0, age);
        let goes = ease(5.0, READ, age);
        let light = comes * (1.0 - goes);
        if light > 0.0 {
            let [x, y, size] = [x, y, size].map(|n| n / 16.0);
            lines.push(Emitter::Strokes(Strokes {
                lines: letters::write(text, vec3(x, y, -2.0), Vec3::X * size, Vec3::Y * size),
                each: 250,
                spread: 0.005 + 0.5 * ((1.0 - comes) * (1.0 - comes) + goes * goes),
                radius: 0.16 * size,
                light: vec3(0.3, 0.2, 0.1) * light,
                lens: Lens { radius: [0.7, f32::MAX], near: [0.2, 0.5], ..Lens::SHARP },
            }));
        }
    }
    if !lines.is_empty() {
        let camera = spec.camera(Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, 0.8, 0.0));
        let view = View::new(camera, spec.width, spec.height);
        let sparks = ParticleLayer::new(lines, &view, &spec.quality.particles);
        picture.layers.push(Box::new(sparks));
    }
}

/// The share of light at `time` in a show of such parts: 0 at cuts and from the `end` on, 1 away from them. It starts at
/// once, since a first frame should show something.
pub fn light<T>(parts: &[(f64, T)], end: f64, time: f64) -> f32 {
    let cuts = parts[1..].iter().map(|&(start, _)| ease(0.0, FADE, (time - start).abs()));
    let light = cuts.fold(ease(0.0, FADE, end - time), f32::min);
    // Eyes, and codes, take about the root of it.
    light * light
}
