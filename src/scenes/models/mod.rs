//! Models from formulas and small tables. Each function returns its meshes, the same at every call.
//!
//! | module | what it is | made of |
//! |---|---|---|
//! | [`land`] | a valley with a lake, mountains around it | a height field of noise on rings around the middle |
//! | [`tree`] | firs and broadleaves, and where they stand | bodies of rings, moved by noise |
//! | [`tuft`] | grass around the middle | blades of two faces |
//! | [`chapel`] | half a ruin on the hill | boxes, a gable, a spire, pillars |
//! | [`mustang`] | a P-51D | cross sections along fuselage, wing and tail, mirrored |
//!
//! A body is a stack of rings ([`Rings`](crate::raster::form::Rings)); how bodies are put together is written as a
//! script (`script.rs`), which `build.rs` runs.

mod build;
pub mod chapel;
pub mod land;
pub mod mustang;
pub mod paint;
pub mod tree;
pub mod tuft;

pub use paint::PAINTS;
