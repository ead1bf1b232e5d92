//! The rasterizer: triangles, depth maps, lights.

pub mod form;
pub mod mesh;
