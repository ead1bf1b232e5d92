//! The show: parts, one after another, each a scene of its own. It fades to black before a part ends.

use super::{Scene, Shot, letters, lumen};
#[cfg(feature = "day")]
use super::{clouds, day, snowfall, torches};
use crate::camera::Camera;
use crate::particles::sprite::Lens;
use crate::particles::strokes::Strokes;
use crate::particles::{Emitter, Particles};
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

fn picture(shot: &Shot) -> Picture {
    let ((part, from), time) = timeline::cut(PARTS, END, shot.time);
    let mut picture = part.picture(&Shot { time: from + time, ..*shot });
    if shot.time < TITLE {
        picture.layers.push(Box::new(title(shot)));
    }
    let light = light(PARTS, END, shot.time);
    if light < 1.0 {
        picture.layers.push(Box::new(Fade(light)));
    }
    picture
}

/// The second at which the title has gone.
pub const TITLE: f64 = 7.0;

/// The show's name, of sparks that come together and fly apart, two metres before the eye.
fn title(shot: &Shot) -> Particles {
    let comes = ease(1.5, 3.5, shot.time);
    let goes = ease(TITLE - 1.5, TITLE, shot.time);
    let camera = shot.camera(Camera::look_at(Vec3::ZERO, Vec3::Z, 0.8, 0.0));
    let strokes = Strokes {
        lines: letters::write("PAPRSEK", vec3(0.75, -0.1, 2.0), Vec3::X * -SIZE, Vec3::Y * SIZE),
        each: 250,
        spread: 0.005 + 0.5 * ((1.0 - comes) * (1.0 - comes) + goes * goes),
        radius: 0.16 * SIZE,
        light: vec3(0.3, 0.2, 0.1) * (comes * (1.0 - goes)),
        lens: Lens { radius: [0.7, f32::MAX], near: [0.2, 0.5], ..Lens::SHARP },
    };
    let view = View::new(camera, shot.width, shot.height);
    Particles::new(vec![Emitter::Strokes(strokes)], Vec3::ZERO, 1.6, &view, shot.width, shot.height)
}

/// A quarter of its letters' height, metres.
const SIZE: f32 = 0.075;

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
