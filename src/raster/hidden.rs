//! Triangles that a tile need not draw, since what it shows already is nearer everywhere.
//!
//! This is the coarse depth of `[Greene93]` at one level, found when it is asked for: nothing is written while triangles
//! are drawn. It only says what the comparison of each sample would, so no sample changes.

use super::triangle::Triangle;
use super::visible::{SubPixel, Visible};
use crate::frame::Tile;
use crate::simd::lanes::F;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Rows of a block of pixels, which is as wide as a vector.
const ROWS: usize = 8;
/// Most columns of blocks of a tile: of vectors of four lanes.
const COLUMNS: usize = Tile::SIZE / 4;

/// For each block of a tile a number that every `inv_depth` there has at least.
pub type Blocks = [f32; Tile::SIZE / ROWS * COLUMNS];
/// Nothing is known.
pub const UNKNOWN: Blocks = [f32::NEG_INFINITY; Tile::SIZE / ROWS * COLUMNS];

/// Whether a triangle is certainly hidden in a tile by what the planes show there.
///
/// ```text
/// for each block that the triangle's bounding box touches
///     as far as is known every sample is nearer than the triangle?      next block
///     for each plane: a sample that is farther?                         it may be seen
///     now the least depth of the block is known
/// ```
#[simd]
pub fn hidden<S: Simd>(
    simd: S,
    t: &Triangle,
    tile: [usize; 2],
    planes: &[(Visible, SubPixel)],
    blocks: &mut Blocks,
) -> bool {
    let lanes = F::<S>::LEN;
    let nearest = t.range[1];
    let [x, y] = tile.map(|n| (n * Tile::SIZE) as i32);
    let within = |pixel: i32, first: i32| (pixel - first).max(0).min(Tile::SIZE as i32 - 1) as usize;
    let (columns, rows) = ([t.bound[0], t.bound[1]], [t.bound[2], t.bound[3]]);
    let [left, right] = columns.map(|column| within(column, x) / lanes);
    let [top, bottom] = rows.map(|row| within(row, y) / ROWS);
    for across in top..bottom + 1 {
        for along in left..right + 1 {
            let block = &mut blocks[across * COLUMNS + along];
            if *block >= nearest {
                continue;
            }
            let mut least = F::<S>::splat(simd, f32::INFINITY);
            for (visible, _) in planes {
                for row in 0..ROWS {
                    let place = (across * ROWS + row) * Tile::SIZE + along * lanes;
                    least = least.min(F::<S>::from_slice(simd, &visible.inv_depth[place..place + lanes]));
                }
                if least.simd_lt(nearest).any_true() {
                    return false;
                }
            }
            *block = least.reduce_min();
        }
    }
    true
}
