//! Which triangles each tile of a raster has to draw.

use super::triangle::SetupMesh;
use crate::frame::Tile;

/// A triangle: from the lowest bit on its number in its piece, the piece, and its texture; or [`NOTHING`].
pub type Id = u32;
/// No triangle.
pub const NOTHING: Id = u32::MAX;
/// Bits of an [`Id`] that number the triangle, and as many that number the piece.
const BITS: u32 = 14;
/// Triangles that a piece may have; the last number is left to [`NOTHING`].
pub const MOST: usize = (1 << BITS) - 1;
/// The bit from which on an [`Id`] has the index of a texture, or [`PLAIN`].
pub const TEXTURE: u32 = 2 * BITS;
/// In the place of a texture, that there is none.
pub const PLAIN: u32 = 15;

/// The piece of a triangle, and its number in that.
#[inline(always)]
pub fn parts(id: Id) -> (usize, usize) {
    ((id >> BITS) as usize & ((1 << BITS) - 1), id as usize & ((1 << BITS) - 1))
}

/// The triangles of a raster by tile, in the order of pieces.
#[derive(Default)]
pub struct Bins {
    /// Tiles in a row.
    columns: u32,
    /// Where each tile's list begins, and where the last one ends.
    starts: Vec<u32>,
    list: Vec<Id>,
}

impl Bins {
    /// Sorts triangles into the tiles of a raster of `size` pixels, by their bounds.
    pub fn new(pieces: &[SetupMesh], size: [u32; 2]) -> Bins {
        let [columns, rows] = size.map(|n| n.div_ceil(Tile::SIZE as u32));
        // Counted down from 0, summed, and counted down again: after that each start is where it belongs.
        let mut starts = vec![0u32; (columns * rows + 1) as usize];
        let mut list = Vec::new();
        for _ in 0..2 {
            // The last triangle first.
            for (p, piece) in pieces.iter().take(1 << BITS).enumerate().rev() {
                for (t, triangle) in piece.triangles.iter().enumerate().rev() {
                    let [x0, x1, y0, y1] = triangle.bound.map(|n| n as u32 / Tile::SIZE as u32);
                    for y in y0..y1 + 1 {
                        for x in x0..x1 + 1 {
                            let start = &mut starts[(y * columns + x) as usize];
                            *start = start.wrapping_sub(1);
                            // While they are counted there is no list yet.
                            if let Some(id) = list.get_mut(*start as usize) {
                                let texture = triangle.paint.texture.map_or(PLAIN, u32::from);
                                *id = (texture << BITS | p as u32) << BITS | t as u32;
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

    /// The triangles of the tile in that column and row of tiles; none where there is no such tile.
    pub fn of(&self, column: usize, row: usize) -> &[Id] {
        let tile = row * self.columns as usize + column;
        match self.starts.get(tile..tile + 2) {
            Some(&[from, to]) => &self.list[from as usize..to as usize],
            _ => &[],
        }
    }
}
