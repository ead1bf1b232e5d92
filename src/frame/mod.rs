//! How a frame is made: a scene gives layers, layers draw into tiles on all threads, tiles become pixels.

pub mod encode;
pub mod layer;
pub mod pool;
pub mod renderer;
pub mod resample;
pub mod scene;
pub mod tile;
pub mod workers;

pub use layer::{Layer, Picture, Stats};
pub use renderer::{Frame, Renderer};
pub use scene::{FrameSpec, Scene};
pub use tile::Tile;
pub use workers::Workers;
