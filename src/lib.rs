//! Paprsek: a CPU-only software renderer in the style of a 64 kB intro.
//!
//! One straight flow: time -> scene -> layers -> tiles in parallel -> `0RGB` pixels. See `ARCHITECTURE.md`.

pub mod cloud;
pub mod cuts;
pub mod effects;
pub mod frame;
pub mod noise;
pub mod particles;
pub mod raster;
pub mod scenes;
pub mod settings;
pub mod simd;
pub mod sky;
pub mod texture;
pub mod timeline;
pub mod trace;
pub mod view;
