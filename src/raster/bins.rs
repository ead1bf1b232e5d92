//! Binning: which triangles each tile of a raster has to draw.
//!
//! A counting sort over the bounds of triangles. A triangle is listed in every tile that its bounding box touches, and
//! each tile lists triangles in the order of meshes, so that what a tile shows does not depend on threads.

use super::id::{Id, MESHES, PLAIN, join};
use super::triangle::SetupMesh;
use crate::frame::Tile;

/// The triangles of a raster by tile.
#[derive(Default)]
pub struct Bins {
    /// Number of tiles in a row.
    columns: u32,
    /// Where each tile's part of the list begins, and where the last one ends.
    starts: Vec<u32>,
    /// The triangles of all tiles, tile by tile.
    list: Vec<Id>,
}

impl Bins {
    /// Sorts triangles into the tiles of a raster of `size` pixels. Meshes after the first 16,384 are left out.
    ///
    /// ```text
    /// start[tile] = -(number of triangles of the tile)     first pass: every triangle counts its tiles down
    /// start[tile] = end of the tile's part of the list     running sum
    /// start[tile] = its beginning                          second pass: down again, each place takes a triangle
    /// ```
    ///
    /// Both passes are one piece of code, which finds no place to write to while the list is still empty. They go from
    /// the last triangle to the first, as the places of a tile fill from its end.
    pub fn new(meshes: &[SetupMesh], size: [u32; 2]) -> Bins {
        let [columns, rows] = size.map(|n| n.div_ceil(Tile::SIZE as u32));
        let mut starts = vec![0u32; (columns * rows + 1) as usize];
        let mut list = Vec::new();
        for _ in 0..2 {
            for (m, mesh) in meshes.iter().take(MESHES).enumerate().rev() {
                for (t, triangle) in mesh.triangles.iter().enumerate().rev() {
                    let [x0, x1, y0, y1] = triangle.bound.map(|n| n as u32 / Tile::SIZE as u32);
                    for y in y0..y1 + 1 {
                        for x in x0..x1 + 1 {
                            let start = &mut starts[(y * columns + x) as usize];
                            *start = start.wrapping_sub(1);
                            if let Some(id) = list.get_mut(*start as usize) {
                                *id = join(m, t, triangle.paint.texture.map_or(PLAIN, u32::from));
                            }
                        }
                    }
                }
            }
            if list.is_empty() {
                let mut sum = 0u32;
                for start in &mut starts {
                    sum = sum.wrapping_sub(*start);
                    *start = sum;
                }
                list = vec![0; sum as usize];
            }
        }
        Bins { columns, starts, list }
    }

    /// The triangles of the tile in a column and a row of tiles; none where there is no such tile.
    pub fn of(&self, column: usize, row: usize) -> &[Id] {
        let tile = row * self.columns as usize + column;
        match self.starts.get(tile..tile + 2) {
            Some(&[from, to]) => &self.list[from as usize..to as usize],
            _ => &[],
        }
    }
}
