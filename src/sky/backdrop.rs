//! The sky as a layer of a picture.

use super::dome::Dome;
use super::grid::{self, Cells};
use crate::camera::Camera;
use crate::tile::{Layer, Stats, Tile};
use crate::view::View;
use fearless_simd::{Level, dispatch};

/// The sky seen by a camera.
pub struct Backdrop {
    dome: Dome,
    view: View,
    cells: Cells,
}

impl Backdrop {
    /// The sky for a picture of `width` x `height` pixels.
    ///
    /// `behind`: it only fills what solids have left of each pixel. Else it fills every pixel.
    pub fn new(dome: Dome, camera: Camera, width: usize, height: usize, behind: bool) -> Backdrop {
        let view = View::new(camera, width, height);
        // The angle of a pixel in the middle, the widest.
        let pixel = camera.up.length() * 2.0 / height as u32 as f32;
        let mut size = 64;
        while size > 1 && size as u32 as f32 * pixel > dome.quality.cell {
            size /= 2;
        }
        let cells = Cells { size: if size < 8 { 1 } else { size }, grid: dome.quality.grid, behind };
        Backdrop { dome, view, cells }
    }
}

impl Layer for Backdrop {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        dispatch!(level, simd => grid::fill(simd, &self.dome, &self.view, self.cells, tile));
        Stats::default()
    }
}
