//! Stars: a made catalogue, from a hash, that turns with the true sky.
//!
//! Star `n` of N is the n-th brightest, of magnitude `6 + 2 log10(n / N)`, so there are as many of each magnitude as in
//! the true sky. The light of the sky says which magnitude is still seen, so stars come out one after another, and dusk
//! is where the loop over them ends.
//!
//! Stars are drawn as small soft spots rather than looked for in each pixel: a few hundred are in view, and they glide.

use super::dome::{Dome, power};
use super::time::turned;
use crate::frame::Tile;
use crate::simd::hash::rnd;
use crate::simd::math::to_f32;
use crate::view::View;
use glam::{Vec3A, vec3a};

/// The number of stars, of which the faintest has the magnitude 6.
const COUNT: f32 = 5000.0;
/// Stream of their random numbers.
const SEED: u32 = 50;
/// Radius of a spot, pixels.
const REACH: f32 = 2.5;
/// Pixels along an edge of the square that holds a spot wherever it lies.
const SPOT: i32 = 6;

/// A star in view.
#[derive(Clone, Copy, Debug)]
pub struct Star {
    /// Its place in the picture, pixels from the top left corner.
    pub at: (f32, f32),
    /// Its linear light, in a spot that is as bright as about four pixels.
    pub color: Vec3A,
}

impl Dome {
    /// The stars that are seen in a view, but for those behind the moon.
    pub fn stars(&self, view: &View) -> Vec<Star> {
        let mut stars = Vec::new();
        // The number of the faintest that is seen. The first star is out when the sun is 2 degrees down.
        let end = 6295.0 * power(3e-7 / self.level.max(1e-9), 230);
        let moon = self.sky.moon_radius * self.moon_size;
        for n in 0..end.min(COUNT) as u32 {
            let place = 2.0 * vec3a(rnd(SEED, n, 0), rnd(SEED, n, 1), rnd(SEED, n, 2)) - 1.0;
            // Points of a cube outside of its ball are left out, or stars would crowd towards its corners.
            let length = place.length();
            let d = self.sky.turn * place / length;
            if length > 1.0 || d.y < 0.0 || d.distance(self.sky.moon) < moon {
                continue;
            }
            let Some((x, y, _)) = view.project(view.camera().eye + d) else { continue };
            let outside = |at: f32, size: usize| {
                let half = 0.5 * to_f32(size);
                (at - half).abs() > half + 3.0
            };
            if outside(x, view.width()) || outside(y, view.height()) {
                continue;
            }
            // Low stars are dimmed and twinkle most.
            let low = 1.0 / (1.0 + 12.0 * d.y);
            let hue = rnd(SEED, n, 3) - 0.5;
            let phase = self.shimmer * (300.0 + 340.0 * hue as f64) + n as f64 * 57.3;
            let twinkle = 1.0 + (0.1 + 0.4 * low) * turned(phase).0 as f32;
            // A fourth root, as `power` counts in 256ths, instead of magnitudes.
            let seen = power(end / (n as f32 + 0.5), 64) - 1.0;
            let light = (0.38 * seen).clamp(0.0, 1.8) * twinkle * (1.0 - low);
            // Colours from orange to blue, as black bodies have them.
            stars.push(Star { at: (x, y), color: vec3a(1.0 + 0.5 * hue, 1.0, 1.0 - 0.5 * hue) * light });
        }
        stars
    }
}

/// Adds stars to what solids have left of a tile.
pub fn draw(stars: &[Star], tile: &mut Tile) {
    for star in stars {
        let (x, y) = (star.at.0 - to_f32(tile.x), star.at.1 - to_f32(tile.y));
        if (x - 32.0).abs() > 35.0 || (y - 32.0).abs() > 35.0 {
            continue;
        }
        for k in 0..SPOT * SPOT {
            // The first column is floor(x - 2.5), by a conversion of a number above 0, which truncates.
            let (column, row) = ((x + 61.5) as i32 - 64 + k % SPOT, (y + 61.5) as i32 - 64 + k / SPOT);
            // Both are within the tile: a negative number has the highest bit, and the tile's edge is a power of two.
            if (column | row) as u32 >= Tile::SIZE as u32 {
                continue;
            }
            let (dx, dy) = (column as f32 + 0.5 - x, row as f32 + 0.5 - y);
            // Flat in the middle and at the rim, so that a spot keeps its light as it glides over pixels.
            let fall = (1.0 - (dx * dx + dy * dy) / (REACH * REACH)).max(0.0);
            let at = row as usize * Tile::SIZE + column as usize;
            let light = star.color * (fall * fall * fall * (1.0 - tile.coverage[at]));
            tile.red[at] += light.x;
            tile.green[at] += light.y;
            tile.blue[at] += light.z;
        }
    }
}
