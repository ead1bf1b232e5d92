//! The rasterizer: coverage, clipping, lights, shadow maps and snow cover against exact integers and rays in f64.

mod clip;
mod coverage;
mod depth_map;
mod grazing;
mod lights;
mod shadow;
mod snow_cover;
mod torch;
