//! The show: parts, one after another, each a scene of its own. It fades to black before a part ends.

use super::{Scene, Shot, letters, lumen};
#[cfg(feature = "day")]
use super::{clouds, day, snowfall, torches};
use crate::camera::Camera;
use crate::particles::Particles;
use crate::particles::sprite::Lens;
use crate::particles::strokes::Strokes;
use crate::tile::{Layer, Picture, Stats, Tile};
use crate::timeline::{self, ease};
use crate::view::View;
use fearless_simd::Level;
use glam::{Vec3, vec3};

/// The show.
pub const INTRO: Scene =
    Scene { name: "intro", about: "the show: its parts one after another", duration: END, picture };

/// The parts by the second that each starts, with the second of its own time that it begins at: a dawn, a morning in
/// June, the flight, a sunset in September, the first snow, and a night with fires.
#[rustfmt::skip]
pub const PARTS: &[(f64, (Scene, f64))] = &[
    (0.0, (lumen::LUMEN, 0.0)),
    #[cfg(feature = "day")]
    (21.0, (day::DAY, 2.0)),
    #[cfg(feature = "day")]
    (35.0, (clouds::CLOUDS, 0.0)),
    #[cfg(feature = "day")]
    (69.0, (day::DAY, day::LENGTH + 32.0)),
    #[cfg(feature = "day")]
    (83.0, (snowfall::SNOWFALL, 1.0)),
    #[cfg(feature = "day")]
    (113.0, (torches::TORCHES, 0.0)),
];

/// Seconds that the show takes.
const END: f64 = if cfg!(feature = "day") { 143.0 } else { 21.0 };

/// Seconds in which a part goes dark, and in which the next one comes.
pub const FADE: f64 = 0.5;

/// What is written: from when to when, seconds; what; how tall its letters are, at two metres from the eye, and where,
/// metres.
const TITLES: &[(f64, f64, &str, f32, [f32; 2])] =
    &[(2.0, 7.0, "PAPRSEK", 0.3, [0.0, -0.1]), (8.0, 12.0, "FIVE THESES ONE RAY OF LIGHT", 0.07, [0.0, -0.6])];

fn picture(shot: &Shot) -> Picture {
    let ((part, from), time) = timeline::cut(PARTS, END, shot.time);
    let mut picture = part.picture(&Shot { time: from + time, ..*shot });
    for &(from, to, text, height, [x, y]) in TITLES {
        if shot.time > from && shot.time < to {
            let comes = ease(from, from + 1.5, shot.time);
            let goes = ease(to - 1.5, to, shot.time);
            let camera = shot.camera(Camera::look_at(Vec3::ZERO, Vec3::Z, 0.8, 0.0));
            let view = View::new(camera, shot.width, shot.height);
            let size = height * 0.25;
            let strokes = Strokes {
                lines: letters::write(text, vec3(x, y, 2.0), Vec3::NEG_X * size, Vec3::Y * size),
                each: 250,
                spread: 0.07 * size + 0.5 * ((1.0 - comes) * (1.0 - comes) + goes * goes),
                radius: 0.16 * size,
                light: vec3(0.3, 0.2, 0.1) * (comes * (1.0 - goes)),
                lens: Lens {
                    radius: [0.7, 1e9],
                    near: [0.2, 0.5],
                    aperture: 0.0,
                    focus: 1.0,
                    crystals: false,
                    streaks: false,
                },
            };
            picture.layers.push(Box::new(Particles::writing(strokes, 1.6, &view, shot.width, shot.height)));
        }
    }
    let light = light(PARTS, END, shot.time);
    if light < 1.0 {
        picture.layers.push(Box::new(Fade(light)));
    }
    picture
}

/// The share of light at `time` in a show of such parts: 0 at cuts and from the `end` on, 1 away from them. It starts at
/// once, since a first frame should show something.
pub fn light<T>(parts: &[(f64, T)], end: f64, time: f64) -> f32 {
    let cuts = parts[1..].iter().map(|&(start, _)| ease(0.0, FADE, (time - start).abs()));
    let light = cuts.fold(ease(0.0, FADE, end - time), f32::min);
    // Eyes, and codes, take about the root of it.
    light * light
}

/// What is left of the light below it.
struct Fade(f32);

impl Layer for Fade {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        for plane in [&mut tile.red, &mut tile.green, &mut tile.blue] {
            for light in plane.iter_mut() {
                *light *= self.0;
            }
        }
        Stats::default()
    }
}
