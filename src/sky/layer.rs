//! The sky as a layer of a picture.

use super::disc::{self, Disc};
use super::dome::Dome;
use super::grid;
use super::stars::{self, Star};
use crate::frame::{Layer, Stats, Tile};
use crate::view::Camera;
use crate::view::View;
use fearless_simd::{Level, dispatch};

/// The sky seen by a camera.
pub struct SkyLayer {
    dome: Dome,
    view: View,
    size: u32,
    behind: bool,
    discs: [Disc; 2],
    stars: Vec<Star>,
}

/// How a backdrop is seen.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// It only fills what solids have left of each pixel. Else it fills every pixel.
    pub behind: bool,
    /// The sun's size over its true one.
    pub sun: f32,
    /// The moon's size over its true one.
    pub moon: f32,
    /// The time that stars twinkle by, seconds: the show's, not the sky's, which may run faster.
    pub shimmer: f64,
}

impl Default for Look {
    /// The whole sky, sun and moon as large as they seem: twice their size.
    fn default() -> Look {
        Look { behind: false, sun: 2.0, moon: 2.0, shimmer: 0.0 }
    }
}

impl SkyLayer {
    /// The sky for a picture of `width` x `height` pixels.
    pub fn new(dome: Dome, camera: Camera, width: usize, height: usize, look: Look) -> SkyLayer {
        let view = View::new(camera, width, height);
        let mut size = 64;
        while size > 1 && size as f32 * view.pixel() > dome.quality.cell {
            size /= 2;
        }
        let discs = [dome.sun_disc(camera.forward, look.sun), dome.moon_disc(look.moon)];
        let mut stars = Vec::new();
        if !cfg!(without = "stars") {
            stars = dome.stars(&view, width, height, look.shimmer, look.moon);
        }
        SkyLayer { dome, view, size, behind: look.behind, discs, stars }
    }
}

impl Layer for SkyLayer {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        if !self.behind {
            tile.solids_matter = true;
            tile.clear();
        }
        dispatch!(level, simd => grid::fill(simd, &self.dome, &self.view, self.size, tile));
        if !cfg!(without = "stars") {
            stars::draw(&self.stars, tile);
        }
        for disc in self.discs.iter().filter(|_| !cfg!(without = "discs")) {
            dispatch!(level, simd => disc::draw(simd, disc, &self.view, tile));
        }
        Stats::default()
    }
}
