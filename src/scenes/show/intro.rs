//! The show: parts one after another, each a scene of its own, and writing made of sparks over the first and the last.

use super::{clouds, day, letters, lumen, snowfall, torches};
use crate::cuts;
use crate::effects::Fade;
use crate::frame::{FrameSpec, Picture, Scene};
use crate::particles::{Emitter, Lens, ParticleLayer, Strokes};
use crate::timeline::{self, ease};
use crate::view::Camera;
use glam::{Vec3A, vec3a};

/// The show.
pub const INTRO: Scene = Scene {
    name: "intro",
    about: if cuts::SCENES { "the show: its parts one after another" } else { "" },
    duration: END,
    parameters: &[],
    picture,
};

/// The parts: the second of the show at which each starts, its scene, and the second of the scene at which it begins.
#[rustfmt::skip]
pub const PARTS: &[(f64, (Scene, f64))] = &[
    // A dawn.
    (0.0, (part(lumen::LUMEN, !cfg!(without = "lumen")), 0.0)),
    // A morning in June.
    (21.0, (part(day::DAY, !cfg!(without = "day")), 2.0)),
    // The flight.
    (35.0, (part(clouds::CLOUDS, !cfg!(without = "clouds")), 0.0)),
    // A sunset in September.
    (69.0, (part(day::DAY, !cfg!(without = "day")), day::LENGTH + 31.0)),
    // The first snow.
    (83.0, (part(snowfall::SNOWFALL, !cfg!(without = "snowfall")), 1.0)),
    // A night with fires.
    (113.0, (part(torches::TORCHES, !cfg!(without = "torches")), 0.0)),
    // The last light.
    (143.0, (part(lumen::LUMEN, !cfg!(without = "lumen")), 45.0)),
];

/// A scene, or nothing in its place in a build that leaves it out to learn what it costs.
const fn part(scene: Scene, built: bool) -> Scene {
    if built { scene } else { Scene::EMPTY }
}

/// The seconds of cuts that fade through black. The others match: the aeroplane flies on in another season, the light in
/// a door becomes a torch, and the moon a ball of glass.
pub const DARK: [f64; 3] = [21.0, 35.0, 83.0];

/// The length of the show, seconds.
const END: f64 = 154.0;

/// The time in which a part goes dark, and in which the next one gets light, seconds.
pub const FADE: f64 = 0.5;

fn picture(spec: &FrameSpec) -> Picture {
    let ((part, from), time) = timeline::cut(PARTS, END, spec.time);
    // The show has no parameters, so its parts have their defaults.
    let mut picture = (part.picture)(&FrameSpec { time: from + time, ..*spec });
    write(spec, &mut picture);
    let brightness = brightness(&DARK, END, spec.time);
    if brightness < 1.0 {
        picture.layers.push(Box::new(Fade(brightness)));
    }
    picture
}

/// The writing: each line of text with the second of the show at which it begins to come together, where it starts and
/// how large it is.
pub const WRITING: &[([f32; 4], &str)] = &[
    line(1.0, [-12.0, -1.6], 1.2, "PAPRSEK"),
    line(144.5, [6.0, 5.0], 0.45, "FIVE THESES"),
    line(145.5, [6.0, 1.0], 0.45, "TWO CORES"),
    line(146.5, [6.0, -3.0], 0.45, "64 KB"),
];

/// A line of text from second `start` on. The left end of its foot and a quarter of its height are in sixteenths of a
/// metre, on a plane two metres before the eye.
const fn line(start: f32, [x, y]: [f32; 2], size: f32, text: &'static str) -> ([f32; 4], &'static str) {
    ([start, x, y, size], text)
}

/// The time after which a line has flown apart, seconds.
pub const READ: f64 = 6.5;

/// Adds the lines of this instant to a picture: sparks that come together and fly apart.
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
                lines: letters::write(text, vec3a(x, y, -2.0), Vec3A::X * size, Vec3A::Y * size),
                each: 250,
                spread: 0.005 + 0.5 * ((1.0 - comes) * (1.0 - comes) + goes * goes),
                radius: 0.16 * size,
                light: vec3a(0.3, 0.2, 0.1) * light,
                lens: Lens { radius: [0.7, f32::MAX], near: [0.2, 0.5], ..Lens::SHARP },
            }));
        }
    }
    if !lines.is_empty() {
        // Written on the screen, wherever in the scene its eye is put.
        let view = spec.screen(Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, 0.8, 0.0));
        let sparks = ParticleLayer::new(lines, &view, &spec.quality.particles);
        picture.layers.push(Box::new(sparks));
    }
}

/// The share of light at `time` seconds in a show with these `dark` cuts: 0 at each and from the `end` on, 1 away from
/// them. The show itself starts without a fade, since its first frame should show something.
pub fn brightness(dark: &[f64], end: f64, time: f64) -> f32 {
    let cuts = dark.iter().map(|&cut| ease(0.0, FADE, (time - cut).abs()));
    let light = cuts.fold(ease(0.0, FADE, end - time), f32::min);
    // Squared, since the eye and the codes of a display go by about the root of the light.
    light * light
}
