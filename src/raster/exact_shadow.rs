//! Shadows without a depth map: a point is tested against every triangle in the light's view that may hide it.
//!
//! The exact way beside [`super::depth_map`]: between the point and the light there are no texels, and only as much bias
//! as the snapping of corners needs. Bins serve as the acceleration structure.

use super::id::parts;
use super::rasters::LightView;
use super::triangle::SUB;
use crate::frame::Tile;

/// Whether a point at pixel coordinates (`x`, `y`) of a light's view and at that depth is hidden by a triangle. The point
/// has to lie within the view.
pub fn hides(view: &LightView, x: f32, y: f32, inv_depth: f32) -> bool {
    let [column, row] = [x, y].map(|n| (n / Tile::SIZE as f32) as usize);
    let (sx, sy) = (x as f64 * SUB as f64, y as f64 * SUB as f64);
    let inside = |&(a, b, c): &(i32, i32, i64)| a as f64 * sx + b as f64 * sy + c as f64 >= 0.0;
    view.at(column, row).any(|(mesh, ids)| {
        ids.iter().any(|&id| {
            let t = &mesh.triangles[parts(id).1];
            t.edges.iter().all(inside) && t.inv_depth(x, y) > inv_depth
        })
    })
}
