//! Shadows without a depth map: every triangle of a light's raster that may hide a point is asked. The exact way beside
//! [`super::shadow`]; between the point and the light there is no texel and next to no bias.

use super::bins::{Bins, parts};
use super::triangle::{Piece, Plane, SUB};
use crate::tile::Tile;

/// What a light sees, as triangles in bins.
pub struct Casters {
    /// One for each of the plan's views.
    pub views: Vec<(Vec<Piece>, Bins)>,
}

impl Casters {
    /// Is a point at (`x`, `y`) in a view, of that nearness, behind a triangle? Outside of the raster nothing is.
    pub fn hide(&self, view: usize, x: f32, y: f32, nearness: f32) -> bool {
        let (pieces, bins) = &self.views[view];
        let [column, row] = [x, y].map(|n| (n / Tile::SIZE as f32) as usize);
        let (sx, sy) = (x as f64 * SUB as f64, y as f64 * SUB as f64);
        bins.of(column, row).iter().any(|&id| {
            let (piece, number) = parts(id);
            let t = &pieces[piece].triangles[number];
            let inside = |&(a, b, c): &(i32, i32, i64)| a as f64 * sx + b as f64 * sy + c as f64 >= 0.0;
            t.edges.iter().all(inside) && {
                let Plane { at, by } = t.nearness;
                let near = at + by[0] * (x - t.anchor[0]) + by[1] * (y - t.anchor[1]);
                near.clamp(t.range[0], t.range[1]) > nearness
            }
        })
    }
}
