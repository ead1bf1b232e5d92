//! How a frame is made: a scene gives a picture, the picture's layers draw into tiles on all threads, and each tile is
//! encoded into pixels.
//!
//! ```text
//! Scene, FrameSpec -> Picture of Layers -> Tile by Tile, on Workers -> encode -> Frame
//! ```

#[cfg(feature = "full")]
pub mod bands;
pub mod cache;
pub mod encode;
#[cfg(feature = "full")]
pub mod inspect;
#[cfg(feature = "full")]
pub mod knobs;
pub mod layer;
pub mod parameter;
#[cfg(feature = "full")]
pub mod placement;
pub mod pool;
#[cfg(feature = "full")]
pub mod probe;
pub mod renderer;
pub mod resample;
pub mod scene;
pub mod tile;
pub mod workers;

pub use cache::Cache;
pub use layer::{Layer, Picture, Stats};
pub use parameter::{Parameter, Values};
pub use renderer::{Frame, Options, Renderer};
pub use scene::{FrameSpec, Scene};
pub use tile::Tile;
pub use workers::Workers;
