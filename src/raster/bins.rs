//! Which triangles each tile of a raster has to draw.

use super::triangle::Piece;
use crate::tile::Tile;

/// A triangle: its piece and its number in that, or [`NOTHING`].
pub type Id = u32;
/// No triangle.
pub const NOTHING: Id = u32::MAX;
/// Bits of an [`Id`] that number the triangle; those above number the piece.
pub const LOCAL: u32 = 16;

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
    pub fn new(pieces: &[Piece], size: [u32; 2]) -> Bins {
        let [columns, rows] = size.map(|n| n.div_ceil(Tile::SIZE as u32));
        // Counted, summed, filled from the back: after that each start is where it belongs.
        let mut starts = vec![0; (columns * rows + 1) as usize];
        each(pieces, columns, |tile, _| starts[tile] += 1);
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let mut list = vec![NOTHING; sum as usize];
        each(pieces, columns, |tile, id| {
            starts[tile] -= 1;
            list[starts[tile] as usize] = id;
        });
        Bins { columns, starts, list }
    }

    /// The triangles of the tile in that column and row of tiles.
    pub fn of(&self, column: usize, row: usize) -> &[Id] {
        let tile = row * self.columns as usize + column;
        &self.list[self.starts[tile] as usize..self.starts[tile + 1] as usize]
    }
}

/// Every tile that every triangle may touch, the last triangle first.
fn each(pieces: &[Piece], columns: u32, mut put: impl FnMut(usize, Id)) {
    for (p, piece) in pieces.iter().enumerate().rev() {
        for (t, triangle) in piece.triangles.iter().enumerate().rev() {
            let [x0, x1, y0, y1] = triangle.bound.map(|n| n as u32 / Tile::SIZE as u32);
            for y in y0..=y1 {
                for x in x0..=x1 {
                    put((y * columns + x) as usize, (p as u32) << LOCAL | t as u32);
                }
            }
        }
    }
}
