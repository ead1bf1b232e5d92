//! What is visible at samples: the memory that triangles are drawn into.

use super::id::{Id, NOTHING};
use super::triangle::SUB;
use crate::frame::Tile;

/// The nearest triangle at one sample of each pixel of a tile.
#[derive(Clone)]
pub struct Visible {
    /// Its `inv_depth`, or that of the background.
    pub inv_depth: Box<[f32; Tile::AREA]>,
    /// The triangle; empty where that does not matter.
    pub id: Vec<Id>,
}

/// To be cleared before use: a buffer of zeros that nobody writes to takes no memory.
impl Default for Visible {
    fn default() -> Visible {
        Visible { inv_depth: Box::new([0.0; Tile::AREA]), id: vec![0; Tile::AREA] }
    }
}

impl Visible {
    /// Shows nothing anywhere, at a depth of each pixel's own, beyond which nothing will be shown.
    pub fn clear(&mut self, inv_depth: &[f32; Tile::AREA]) {
        self.inv_depth.copy_from_slice(inv_depth);
        self.id.fill(NOTHING);
    }
}

/// The place of a sample in its pixel, in steps of 1 / [`SUB`] pixel from the top left corner.
pub type SubPixel = [i32; 2];
/// The middle of the pixel.
pub const CENTER: SubPixel = [SUB / 2; 2];
