//! Stars: a made catalogue that turns with the true sky.
//!
//! Drawn as small soft spots rather than looked for in each pixel: a few hundred are in view, and they glide.

use super::dome::{Dome, power};
use super::time::turned;
use crate::frame::Tile;
use crate::simd::hash::rnd;
use crate::view::View;
use glam::{Vec3, vec3};

/// How many are brighter than the faintest, of magnitude 6.
const COUNT: f32 = 5000.0;

/// A star in view.
#[derive(Clone, Copy, Debug)]
pub struct Star {
    /// Its place in the picture, pixels.
    pub at: (f32, f32),
    /// Its linear light, spread over about four pixels.
    pub color: Vec3,
}

impl Dome {
    /// The stars that a view shows beside a moon `moon` times its true size; `shimmer` is the time that they twinkle by,
    /// seconds.
    ///
    /// They come out one after another: star `n` of N is the n-th brightest, of magnitude 6 + 2 log10(n / N), as many
    /// are of each as in the true sky, and the light of the sky says which magnitude is seen.
    pub fn stars(&self, view: &View, width: usize, height: usize, shimmer: f64, moon: f32) -> Vec<Star> {
        let mut stars = Vec::new();
        // The number of the faintest. The first star is out when the sun is 2 degrees down.
        let end = 6295.0 * power(3e-7 / self.level.max(1e-9), 230);
        let moon = self.sky.moon_radius * moon;
        for n in 0..end.min(COUNT) as u32 {
            let place = 2.0 * vec3(rnd(50, n, 0), rnd(50, n, 1), rnd(50, n, 2)) - 1.0;
            // Points of a cube beyond its ball would crowd in its corners.
            let length = place.length();
            let d = self.sky.turn * place / length;
            if length > 1.0 || d.y < 0.0 || d.distance(self.sky.moon) < moon {
                continue;
            }
            let Some((x, y, _)) = view.project(view.camera().eye + d) else { continue };
            let outside = |at: f32, size: usize| {
                let half = 0.5 * size as u32 as f32;
                (at - half).abs() > half + 3.0
            };
            if outside(x, width) || outside(y, height) {
                continue;
            }
            // Low ones are dimmed and twinkle most.
            let low = 1.0 / (1.0 + 12.0 * d.y);
            let hue = rnd(50, n, 3) - 0.5;
            let phase = shimmer * (300.0 + 340.0 * hue as f64) + n as f64 * 57.3;
            let twinkle = 1.0 + (0.1 + 0.4 * low) * turned(phase).0 as f32;
            // Fourth roots instead of magnitudes.
            let seen = power(end / (n as f32 + 0.5), 64) - 1.0;
            let light = (0.38 * seen).clamp(0.0, 1.8) * twinkle * (1.0 - low);
            // From orange to blue, as black bodies are.
            stars.push(Star { at: (x, y), color: vec3(1.0 + 0.5 * hue, 1.0, 1.0 - 0.5 * hue) * light });
        }
        stars
    }
}

/// Adds stars to what solids have left of a tile.
pub fn draw(stars: &[Star], tile: &mut Tile) {
    const REACH: f32 = 2.5;
    for star in stars {
        let (x, y) = (star.at.0 - tile.x as u32 as f32, star.at.1 - tile.y as u32 as f32);
        if (x - 32.0).abs() > 35.0 || (y - 32.0).abs() > 35.0 {
            continue;
        }
        for k in 0..36 {
            let (column, row) = ((x + 61.5) as i32 - 64 + k % 6, (y + 61.5) as i32 - 64 + k / 6);
            if (column | row) as u32 >= Tile::SIZE as u32 {
                continue;
            }
            let (dx, dy) = (column as f32 + 0.5 - x, row as f32 + 0.5 - y);
            // Flat in the middle and at the rim, so that a spot that glides over pixels keeps its light.
            let fall = (1.0 - (dx * dx + dy * dy) / (REACH * REACH)).max(0.0);
            let at = row as usize * Tile::SIZE + column as usize;
            let light = star.color * (fall * fall * fall * (1.0 - tile.coverage[at]));
            tile.red[at] += light.x;
            tile.green[at] += light.y;
            tile.blue[at] += light.z;
        }
    }
}
