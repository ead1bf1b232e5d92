//! Stars: a made catalogue that turns with the true sky.
//!
//! Drawn as small soft spots rather than looked for in each pixel: a few hundred are in view, and they glide.

use super::dome::Dome;
use crate::tile::Tile;
use crate::view::View;
use glam::{Vec3, vec3};

/// How many are brighter than the faintest, of magnitude 6.
const COUNT: u32 = 5000;

/// A star in view.
#[derive(Clone, Copy, Debug)]
pub struct Star {
    /// Its place in the picture, pixels.
    pub at: (f32, f32),
    /// Its linear light, spread over about four pixels.
    pub color: Vec3,
}

/// The three words of entry `n` of a table of noise. Widynski's Squares would do; this is murmur's finalizer (Appleby).
fn hash(n: u32) -> u32 {
    let n = (n ^ n >> 16).wrapping_mul(0x85eb_ca6b);
    let n = (n ^ n >> 13).wrapping_mul(0xc2b2_ae35);
    n ^ n >> 16
}

/// A number of -1 to 1.
fn random(n: u32) -> f32 {
    (hash(n) >> 8) as f32 * (2.0 / 16_777_216.0) - 1.0
}

impl Dome {
    /// The stars that a view shows beside a moon `moon` times its true size; `shimmer` is the time that they twinkle by,
    /// seconds.
    ///
    /// They come out one after another: star `n` of N is the n-th brightest, of magnitude 6 + 2 log10(n / N), as many
    /// are of each as in the true sky, and the light of the sky says which magnitude is seen.
    pub fn stars(&self, view: &View, width: usize, height: usize, shimmer: f64, moon: f32) -> Vec<Star> {
        let mut stars = Vec::new();
        // Decades of light from the darkest sky. Each costs 1.8 magnitudes: the first star is out when
        // the sun is 2 degrees down.
        let faintest = 6.2 - 1.8 * (self.level.max(1e-9) / 3e-7).log10();
        let moon = (self.sky.moon, self.sky.moon_radius * moon);
        for n in 0..COUNT {
            let magnitude = 6.0 + 2.0 * ((n as f32 + 0.5) / COUNT as f32).log10();
            let seen = faintest - magnitude;
            if seen <= 0.0 {
                break;
            }
            let place = vec3(random(3 * n), random(3 * n + 1), random(3 * n + 2));
            // Points of a cube beyond its ball would crowd in its corners.
            let d = self.sky.turn * place.normalize_or_zero();
            let (x, y) = match view.project(view.camera().eye + d) {
                Some((x, y, _)) => (x, y),
                None => continue,
            };
            let inside = |at: f32, size: usize| at > -3.0 && at < size as u32 as f32 + 3.0;
            if place.length_squared() > 1.0 || d.y < 0.0 || d.distance(moon.0) < moon.1 {
                continue;
            }
            if inside(x, width) && inside(y, height) {
                // Low ones are dimmed and twinkle most.
                let low = 1.0 / (1.0 + 12.0 * d.y);
                let phase = shimmer * (5.0 + 3.0 * random(n) as f64) + n as f64;
                let twinkle = 1.0 + (0.1 + 0.4 * low) * phase.sin() as f32;
                let light = (0.09 * seen + 0.03 * seen * seen).min(1.8) * twinkle * (1.0 - low);
                // From orange to blue, as black bodies are.
                let hue = random(n + 7) * 0.25;
                stars.push(Star { at: (x, y), color: vec3(1.0 + hue, 1.0, 1.0 - hue) * light });
            }
        }
        stars
    }
}

/// Adds stars to what solids have left of a tile.
pub fn draw(stars: &[Star], behind: bool, tile: &mut Tile) {
    const REACH: f32 = 2.5;
    for star in stars {
        let (x, y) = (star.at.0 - tile.x as u32 as f32, star.at.1 - tile.y as u32 as f32);
        let clip = |at: f32, size: usize| at.clamp(0.0, size as u32 as f32) as usize;
        for row in clip(y - REACH, tile.height)..clip(y + REACH, tile.height) {
            for column in clip(x - REACH, tile.width)..clip(x + REACH, tile.width) {
                let (dx, dy) = (column as u32 as f32 + 0.5 - x, row as u32 as f32 + 0.5 - y);
                // Flat in the middle and at the rim, so that a spot that glides over pixels keeps its light.
                let fall = (1.0 - (dx * dx + dy * dy) / (REACH * REACH)).max(0.0);
                let at = row * Tile::SIZE + column;
                let left = if behind { 1.0 - tile.coverage[at] } else { 1.0 };
                let light = star.color * (fall * fall * fall * left);
                tile.red[at] += light.x;
                tile.green[at] += light.y;
                tile.blue[at] += light.z;
            }
        }
    }
}
