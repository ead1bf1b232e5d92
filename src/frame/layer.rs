//! Layers: what a picture is made of.
//!
//! The contract of a layer is here and nowhere else:
//!
//! 1. Layers are drawn in order. The first one writes every pixel of a tile; each later one adds to what is there.
//! 2. [`Layer::prepare`] runs once per frame, before any tile is drawn, and may use all threads.
//! 3. [`Layer::draw`] runs once per tile, on any thread and in any order. What it writes depends on the layer and the
//!    tile alone, so a frame has the same bytes on every number of threads.
//! 4. A layer of solids writes `inv_depth` and `coverage` where [`Tile::solids_matter`]; particles and clouds read them
//!    to be hidden by what is in front, and a sky reads `coverage` to fill what solids left.
//! 5. [`Layer::foresee`] runs before the first layer is drawn into a tile. A layer that will hide what is far away says
//!    so in [`Tile::hidden`], for every pixel, and a layer of solids may leave out what is there.

use super::cache::Cache;
use super::encode::Transfer;
#[cfg(feature = "full")]
use super::inspect::Aspect;
use super::tile::Tile;
use super::workers::Workers;
use fearless_simd::Level;
#[cfg(feature = "full")]
use std::any::type_name;

/// What drawing took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Eye rays traced, or fragments shaded.
    pub samples: u64,
}

/// Something that draws into tiles. The module has the contract.
pub trait Layer: Sync {
    /// Does what is done once per frame: triangles in bins. What may serve a later frame goes into `cache`.
    fn prepare(&mut self, _workers: &Workers, _cache: &Cache) {}

    /// Says from where on the layer will hide what is drawn before it. At most one layer of a picture does.
    fn foresee(&self, _level: Level, _tile: &mut Tile) {}

    /// Draws the layer's part of a tile over what is there.
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats;

    /// What the layer is called: the name of its type.
    #[cfg(feature = "full")]
    fn name(&self) -> &'static str {
        let path = type_name::<Self>();
        path.rsplit("::").next().unwrap_or(path)
    }

    /// A number for each pixel of a tile that says what the layer does there; none for what it does not know. The layer
    /// is prepared, and the tile is as all layers have left it.
    #[cfg(feature = "full")]
    fn inspect(&self, _aspect: Aspect, _level: Level, _tile: &mut Tile) -> Option<Vec<f32>> {
        None
    }

    /// How the layer's part of the pixel at a column and row of the picture comes to be, a fact per line. The layer is
    /// prepared, and the tile is as this layer has left it.
    #[cfg(feature = "full")]
    fn explain(&self, _level: Level, _tile: &Tile, _x: usize, _y: usize) -> Vec<String> {
        Vec::new()
    }

    /// Where eye rays are traced in a tile, in pixels from the picture's top left corner; none for layers that trace
    /// none.
    #[cfg(feature = "full")]
    fn positions(&self, _level: Level, _tile: &mut Tile) -> Vec<(f32, f32)> {
        Vec::new()
    }
}

/// A scene at one instant, ready to be drawn.
pub struct Picture {
    /// The layers in the order in which they are drawn.
    pub layers: Vec<Box<dyn Layer>>,
    /// From linear light to codes.
    pub transfer: Transfer,
}

impl Picture {
    /// A picture without layers.
    pub const EMPTY: Picture = Picture { layers: Vec::new(), transfer: Transfer::Srgb };
}
