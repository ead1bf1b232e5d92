//! Clouds: cubes of voxels, lit by the sun, through which rays are cast.
//!
//! A cloud is drawn after solids and before the sky: what it hides counts as covered, so the sky fills what is left.

mod cells;
pub mod march;
pub mod shape;
pub mod sunlight;
pub mod voxels;

use crate::tile::{Layer, Stats, Tile};
use crate::view::View;
use fearless_simd::{Level, dispatch};
use glam::Vec3;
use march::{Cloud, Look};

/// Speed against error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudQuality {
    /// Steps through a cube.
    pub steps: u32,
    /// Edge of the coarsest cell of pixels whose corners are cast, a power of two up to 16; 1 casts a ray for every pixel.
    pub cell: usize,
    /// A cell is interpolated where its middle is off by at most this, linear light.
    pub threshold: f32,
    /// Samples of a pixel along each axis, where every pixel has a ray.
    pub grid: usize,
}

/// Clouds before a camera, as a layer of a picture.
pub struct Clouds {
    /// Nearest first.
    clouds: Vec<Cloud>,
    look: Look,
    view: View,
    /// What the air between adds, and the distance at which 1/e of a cloud is left.
    haze: (Vec3, f32),
    quality: CloudQuality,
}

impl Clouds {
    /// The layer for clouds in any order.
    pub fn new(mut clouds: Vec<Cloud>, look: Look, haze: (Vec3, f32), view: View, quality: CloudQuality) -> Clouds {
        let eye = view.camera().eye;
        clouds.sort_by(|a, b| a.centre.distance_squared(eye).total_cmp(&b.centre.distance_squared(eye)));
        Clouds { clouds, look, view, haze, quality }
    }

    /// The clouds that rays through a tile may meet, nearest first.
    fn near(&self, tile: &Tile) -> Vec<&Cloud> {
        let (x, y) = (tile.x as u32 as f32, tile.y as u32 as f32);
        let size = Tile::SIZE as f32;
        let axis = self.view.ray(x + 0.5 * size, y + 0.5 * size).normalize();
        let corners = [(0.0, 0.0), (size, 0.0), (0.0, size), (size, size)];
        let cos = corners.iter().fold(1.0, |cos: f32, (dx, dy)| cos.min(self.view.ray(x + dx, y + dy).normalize().dot(axis)));
        let sin = (1.0 - cos * cos).sqrt();
        let meets = |cloud: &&Cloud| {
            let way = cloud.centre - self.view.camera().eye;
            let along = way.dot(axis);
            let across = (way.length_squared() - along * along).max(0.0).sqrt();
            across * cos - along * sin <= 1.7320508 * cloud.size
        };
        self.clouds.iter().filter(meets).collect()
    }
}

impl Layer for Clouds {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let near = self.near(tile);
        if !near.is_empty() {
            dispatch!(level, simd => cells::draw(simd, self, &near, tile));
        }
        Stats::default()
    }
}
