//! The rasterizer: coverage, clipping, lights, shadow maps, snow cover and the reference, against exact integers, rays in f64 and brute force.

mod clip;
mod coverage;
mod depth_map;
mod grazing;
mod lights;
mod reference;
mod shadow;
mod snow_cover;
mod torch;
