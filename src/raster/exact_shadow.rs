//! Shadows without a depth map: a point is tested against every triangle of the light's raster that may hide it.
//!
//! The exact way beside [`super::depth_map`]: between the point and the light there are no texels, and only as much bias
//! as the snapping of corners needs. Bins serve as the acceleration structure.

use super::id::parts;
use super::rasters::Raster;
use super::triangle::SUB;
use crate::frame::Tile;

/// Whether a point at pixel coordinates (`x`, `y`) of a light's raster and at that depth is hidden by a triangle. The
/// point has to lie within the raster.
pub fn hides(raster: &Raster, x: f32, y: f32, inv_depth: f32) -> bool {
    let [column, row] = [x, y].map(|n| (n / Tile::SIZE as f32) as usize);
    let (sx, sy) = (x as f64 * SUB as f64, y as f64 * SUB as f64);
    raster.bins.of(column, row).iter().any(|&id| {
        let (mesh, number) = parts(id);
        let t = &raster.meshes[mesh].triangles[number];
        let inside = |&(a, b, c): &(i32, i32, i64)| a as f64 * sx + b as f64 * sy + c as f64 >= 0.0;
        t.edges.iter().all(inside) && t.inv_depth(x, y) > inv_depth
    })
}
