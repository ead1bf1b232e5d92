//! Pictures of worlds, made in more than one way, and how much they differ.

use fearless_simd::Level;
use glam::Vec3A;
use paprsek::frame::encode::{Transfer, quantize};
use paprsek::frame::{Frame, Layer, Tile};
use paprsek::settings::Quality;
use paprsek::trace::TraceLayer;
use paprsek::trace::reference::{self, Ray};
use paprsek::trace::world::World;
use paprsek::view::{Camera, View};

/// A picture of linear light, row by row from the top left.
#[derive(Clone)]
pub struct Light {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Red, green and blue.
    pub pixels: Vec<Vec3A>,
    /// Eye rays.
    pub samples: u64,
}

/// An empty tile.
fn tile() -> Tile {
    Tile::at(0, 0, Tile::SIZE, Tile::SIZE)
}

/// What the renderer makes of a world, tile by tile.
pub fn traced(world: &World, camera: Camera, size: (usize, usize), quality: Quality, level: Level) -> Light {
    let (width, height) = size;
    let layer = TraceLayer::new(world.clone(), &View::new(camera, width, height), &quality.trace);
    let mut pixels = vec![Vec3A::ZERO; width * height];
    let (mut tile, mut samples) = (tile(), 0);
    for y in (0..height).step_by(Tile::SIZE) {
        for x in (0..width).step_by(Tile::SIZE) {
            (tile.x, tile.y) = (x, y);
            (tile.width, tile.height) = (Tile::SIZE.min(width - x), Tile::SIZE.min(height - y));
            samples += layer.draw(level, &mut tile).samples;
            for row in 0..tile.height {
                for column in 0..tile.width {
                    let at = row * Tile::SIZE + column;
                    pixels[(y + row) * width + x + column] = Vec3A::new(tile.red[at], tile.green[at], tile.blue[at]);
                }
            }
        }
    }
    Light { width, height, pixels, samples }
}

/// The unit eye ray through the middle of a pixel, by the bench scenes' text.
pub fn eye_ray(camera: &Camera, size: (usize, usize), x: usize, y: usize) -> Vec3A {
    let (w, h) = (size.0 as f64, size.1 as f64);
    let px = (2.0 * (x as f64 + 0.5) - w) / h;
    let py = (h - 2.0 * (y as f64 + 0.5)) / h;
    let d = camera.forward.as_dvec3() + camera.right.as_dvec3() * px + camera.up.as_dvec3() * py;
    d.normalize().as_vec3a()
}

/// One ray a pixel, one after the other.
pub fn plain(world: &World, camera: Camera, size: (usize, usize)) -> Light {
    let (width, height) = size;
    let rows = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = rows.map(|(x, y)| reference::radiance(world, Ray::new(camera.eye, eye_ray(&camera, size, x, y)), 1));
    Light { width, height, pixels: pixels.collect(), samples: (width * height) as u64 }
}

impl Light {
    /// The frame that a screen shows.
    pub fn frame(&self) -> Frame {
        let code = |(i, c): (usize, &Vec3A)| {
            let (x, y) = ((i % self.width) as u32, (i / self.width) as u32);
            let [red, green, blue] = [0, 1, 2].map(|k| quantize(Transfer::Gamma22, c[k], x, y, k as u32) as u8);
            u32::from_be_bytes([0, red, green, blue])
        };
        let pixels = self.pixels.iter().enumerate().map(code).collect();
        Frame { width: self.width, height: self.height, pixels }
    }
}
