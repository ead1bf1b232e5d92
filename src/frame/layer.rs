//! What a layer is, and a picture as a stack of layers.

use super::encode::Transfer;
use super::tile::Tile;
use super::workers::Workers;
use fearless_simd::Level;

/// What a frame took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Eye rays traced.
    pub samples: u64,
}

/// Something that draws into tiles: layers of a picture are drawn in order.
pub trait Layer: Sync {
    /// What is done once a frame, before any tile is drawn: shadow maps, triangles in bins.
    fn prepare(&mut self, _crew: &Workers) {}

    /// Draws the tile's part of the layer over what is there; returns what that took.
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats;

    /// Where eye rays are traced in a tile, pixels from the picture's top left; none for layers that trace none.
    #[cfg(feature = "full")]
    fn positions(&self, _level: Level, _tile: &mut Tile) -> Vec<(f32, f32)> {
        Vec::new()
    }
}

/// A scene at one instant, ready to be drawn.
pub struct Picture {
    /// Back to front.
    pub layers: Vec<Box<dyn Layer>>,
    /// The screen's scale.
    pub transfer: Transfer,
}

impl Picture {
    /// No layers.
    pub const EMPTY: Picture = Picture { layers: Vec::new(), transfer: Transfer::Srgb };
}
