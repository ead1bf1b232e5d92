//! Shadows without a depth map: every triangle of a light's raster that may hide a point is asked. The exact way beside
//! [`super::shadow`]; between the point and the light there is no texel and next to no bias.

use super::Raster;
use super::bins::parts;
use super::triangle::SUB;
use crate::frame::Tile;

/// Is a point at (`x`, `y`) in a raster, of that nearness, behind a triangle? The point lies in the raster.
pub fn hides(raster: &Raster, x: f32, y: f32, inv_depth: f32) -> bool {
    let [column, row] = [x, y].map(|n| (n / Tile::SIZE as f32) as usize);
    let (sx, sy) = (x as f64 * SUB as f64, y as f64 * SUB as f64);
    raster.bins.of(column, row).iter().any(|&id| {
        let (piece, number) = parts(id);
        let t = &raster.pieces[piece].triangles[number];
        let inside = |&(a, b, c): &(i32, i32, i64)| a as f64 * sx + b as f64 * sy + c as f64 >= 0.0;
        t.edges.iter().all(inside) && t.inv_depth(x, y) > inv_depth
    })
}
