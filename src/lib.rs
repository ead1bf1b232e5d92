//! Paprsek: a CPU-only software renderer in the style of a 64 kB intro.
//!
//! One straight flow: time -> scene -> layers -> tiles in parallel -> `0RGB` pixels. See `ARCHITECTURE.md`.

pub mod block;
pub mod camera;
pub mod cloud;
pub mod color;
pub mod hash;
pub mod lanes;
pub mod math;
pub mod noise;
pub mod particles;
pub mod pool;
pub mod quality;
pub mod raster;
pub mod scale;
pub mod scenes;
pub mod sky;
pub mod texture;
pub mod tile;
pub mod timeline;
pub mod trace;
pub mod view;

/// Are the bench scenes there? What they alone ask for, the intro does without: in the rasterizer a background, light
/// without film, and lookups of depth maps in which each texel counts alike; pictures that stand for clouds.
const BENCH: bool = cfg!(feature = "bench-scenes");
