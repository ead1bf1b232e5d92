//! The rasterizer: triangles, depth maps, lights.

pub mod mesh;
