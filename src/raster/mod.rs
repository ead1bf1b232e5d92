//! The rasterizer: triangles with shadow maps, many lights, anti-aliasing by coverage, and snow that settles.
//!
//! A [`World`] of bodies and lights becomes a picture in these stages, each of which has its file:
//!
//! ```text
//! once a frame    fit        views of lights, fitted to what the camera sees         (asked for by scenes)
//!                 triangle   faces clipped, snapped and turned into planes, for the camera and for each view of a light
//!                 bins       triangles sorted into tiles of 64x64 pixels
//!                 rasters    shadow maps drawn by `fill`; `shadow_maps` keeps those that stay the same
//! per tile        fill       which triangle each sample shows
//!                 collect    fragments: the part of a pixel that shows one triangle, gathered by texture
//!                 shade      surfaces, textures, snow, haze; `lighting` adds what each light in reach gives
//! ```
//!
//! So visibility is decided before anything is shaded (deferred shading per tile), a fragment is shaded once whatever the
//! number of its samples, and lights are summed up over visible points only.
//!
//! What approximates, and where its reference stands: shadow maps ([`depth_map`]) against shadows traced through the
//! same triangles ([`exact_shadow`]), and a few samples per pixel against a grid of 64. Edges are exact at any sample:
//! coverage is decided in whole numbers. `tests/raster.rs`, `tests/clip.rs`, `tests/shadow.rs`, `tests/torch.rs`,
//! `tests/lights.rs`, `tests/depth_map.rs` and `tests/settle.rs` hold the stages against formulas in f64.

pub mod bins;
pub mod cloud_shadow;
mod collect;
mod context;
pub mod depth_map;
mod exact_shadow;
pub mod fill;
pub mod fit;
pub mod form;
pub mod haze;
pub mod id;
mod layer;
pub mod light;
mod lighting;
mod memory;
pub mod mesh;
pub mod project;
mod queue;
mod rasters;
mod shade;
pub mod shadow_maps;
pub mod shadow_views;
pub mod snow_cover;
pub mod triangle;
pub mod world;

pub use cloud_shadow::CloudShadow;
pub use haze::Haze;
pub use layer::RasterLayer;
pub use light::{Light, Source};
pub use memory::RasterMemory;
pub use mesh::{Face, Mesh, Paint};
pub use project::Projection;
pub use shadow_views::{Bias, ShadowViews};
pub use snow_cover::SnowCover;
pub use world::{Body, World};
