//! Binning: which triangles of a mesh each tile of a raster has to draw.
//!
//! A counting sort over the bounds of triangles. A triangle is listed in every tile that its bounding box touches, and
//! each tile lists triangles in their order in the mesh.

use super::id::{Id, PLAIN, join};
use super::triangle::Triangle;
use crate::frame::Tile;

/// The triangles of a mesh by tile, as those of mesh 0.
#[derive(Default)]
pub struct Bins {
    /// Column and row of the first tile that any of them touches.
    first: [u32; 2],
    /// Number of columns and rows of tiles that they touch.
    size: [u32; 2],
    /// Where each tile's part of the list begins, and where the last one ends.
    starts: Vec<u32>,
    /// The triangles of all tiles, tile by tile.
    list: Vec<Id>,
}

impl Bins {
    /// Sorts triangles into tiles.
    ///
    /// ```text
    /// start[tile] = -(number of triangles of the tile)     first pass: every triangle counts its tiles down
    /// start[tile] = end of the tile's part of the list     running sum
    /// start[tile] = its beginning                          second pass: down again, each place takes a triangle
    /// ```
    ///
    /// Both passes are one piece of code, which finds no place to write to while the list is still empty. They go from
    /// the last triangle to the first, as the places of a tile fill from its end.
    pub fn new(triangles: &[Triangle]) -> Bins {
        let tiles = |triangle: &Triangle| triangle.bound.map(|n| n as u32 / Tile::SIZE as u32);
        let (mut first, mut end) = ([u32::MAX; 2], [0; 2]);
        for triangle in triangles {
            let [x0, x1, y0, y1] = tiles(triangle);
            first = [first[0].min(x0), first[1].min(y0)];
            end = [end[0].max(x1 + 1), end[1].max(y1 + 1)];
        }
        let size = [end[0].saturating_sub(first[0]), end[1].saturating_sub(first[1])];
        let mut starts = vec![0u32; (size[0] * size[1] + 1) as usize];
        let mut list = Vec::new();
        for _ in 0..2 {
            for (number, triangle) in triangles.iter().enumerate().rev() {
                let [x0, x1, y0, y1] = tiles(triangle);
                for y in y0..y1 + 1 {
                    for x in x0..x1 + 1 {
                        let start = &mut starts[((y - first[1]) * size[0] + (x - first[0])) as usize];
                        *start = start.wrapping_sub(1);
                        if let Some(id) = list.get_mut(*start as usize) {
                            *id = join(number, triangle.paint.texture.map_or(PLAIN, u32::from));
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
        Bins { first, size, starts, list }
    }

    /// The triangles of the tile in a column and a row of tiles; none where there is no such tile.
    pub fn of(&self, [column, row]: [usize; 2]) -> &[Id] {
        let (x, y) = ((column as u32).wrapping_sub(self.first[0]), (row as u32).wrapping_sub(self.first[1]));
        if x >= self.size[0] || y >= self.size[1] {
            return &[];
        }
        let tile = (y * self.size[0] + x) as usize;
        &self.list[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}
