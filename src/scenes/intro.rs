//! The show: parts, one after another, each a scene of its own. It fades to black before a part ends.

use super::{Scene, Shot, lumen};
#[cfg(feature = "day")]
use super::{clouds, day};
use crate::tile::{Layer, Picture, Stats, Tile};
use crate::timeline::{self, ease};
use fearless_simd::Level;

/// The show.
pub const INTRO: Scene =
    Scene { name: "intro", about: "the show: its parts one after another", duration: END, picture };

/// The parts by the second that each starts, with the second of its own time that it begins at.
pub const PARTS: &[(f64, (Scene, f64))] = &[
    (0.0, (lumen::LUMEN, 0.0)),
    // A day in summer, and one in winter.
    #[cfg(feature = "day")]
    (56.0, (day::DAY, 0.0)),
    #[cfg(feature = "day")]
    (56.0 + day::LENGTH, (day::DAY, 2.0 * day::LENGTH)),
    #[cfg(feature = "day")]
    (56.0 + 2.0 * day::LENGTH, (clouds::CLOUDS, 0.0)),
];

/// Seconds that the show takes.
const END: f64 = 56.0 + if cfg!(feature = "day") { 2.0 * 60.0 + 50.0 } else { 0.0 };

/// Seconds in which a part goes dark, and in which the next one comes.
pub const FADE: f64 = 0.5;

fn picture(shot: &Shot) -> Picture {
    let ((part, from), time) = timeline::cut(PARTS, END, shot.time);
    let mut picture = part.picture(&Shot { time: from + time, ..*shot });
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
