//! Visibility: coverage and depth of triangles in a tile, a vector of pixels at a time.
//!
//! A pixel's sample is inside of a triangle where three edge functions are not negative `[Pineda88]`. They are whole
//! numbers, and the top-left rule is part of their constants, so each sample on a shared edge belongs to exactly one of
//! the two triangles. Depth is a plane over the raster; the larger `inv_depth` wins, and of equals the first one.

use super::hidden::{UNKNOWN, hidden};
use super::id::{Id, of_mesh};
use super::setup::SetupMesh;
use super::triangle::{SUB, Triangle};
use super::visible::{SubPixel, Visible};
use crate::frame::Tile;
use crate::simd::lanes::{F, STEPS};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Where the value of an edge function at a tile's corner exceeds this, it has one sign in the whole tile.
const FAR: i64 = 1 << 30;

/// Of fewer rows all are drawn, as it takes as long to find those that an edge leaves out.
const FEW: i32 = 3;

/// Draws meshes into the tile of a column and a row of tiles, over what is visible there at each sample of its pixels: one
/// triangle after the other, as most of the time their numbers have to be fetched. The nearer the first ones are, the more
/// of the others are hidden.
#[simd]
#[inline(never)] // For eye and lights one copy, as of what it calls.
pub fn fill<S: Simd>(
    simd: S,
    meshes: &mut dyn Iterator<Item = &SetupMesh>,
    tile: [usize; 2],
    planes: &mut [(Visible, SubPixel)],
) {
    let mut blocks = UNKNOWN;
    for (number, mesh) in meshes.enumerate() {
        for (id, triangle) in mesh.in_tile(tile) {
            if !hidden(simd, triangle, tile, planes, &mut blocks) {
                for (visible, sample) in &mut *planes {
                    fill_one(simd, triangle, of_mesh(number, id), tile, *sample, visible);
                }
            }
        }
    }
}

/// Draws one triangle.
///
/// ```text
/// for each strip, as wide as a vector, of the triangle's bounding box within the tile
///     for each row of the strip that the edges may leave something of      (found for a vector of strips at once)
///         inside  = no edge function is negative          (the sign of their disjunction)
///         nearer  = inside and inv_depth > what is there
///         keep inv_depth and id where nearer
///         step the edge functions down
/// ```
///
/// Along rows instead the loops would be shorter, and their ends harder to predict.
#[simd]
#[inline(never)]
fn fill_one<S: Simd>(simd: S, t: &Triangle, id: Id, tile: [usize; 2], sample: SubPixel, visible: &mut Visible) {
    let (depths, ids) = (&mut *visible.inv_depth, &mut *visible.id);
    let lanes = F::<S>::LEN;
    let size = Tile::SIZE as i32;
    let [x, y] = tile.map(|n| n as i32 * size);
    // The part of the tile that the triangle may touch, its columns from a multiple of the lanes on.
    let (mut column, x1) = ((t.bound[0] - x).max(0) & !(lanes as i32 - 1), (t.bound[1] - x).min(size - 1));
    let rows = [(t.bound[2] - y).max(0), (t.bound[3] - y).min(size - 1)];
    let edges = t.edges.map(|edge| Edge::new(edge, [x, y], sample));
    // `inv_depth` is computed anew at each pixel, not summed up along the row: so it is the same for any number of lanes.
    let (zx, zy) = (t.by[0].w, t.by[1].w);
    let offset = |pixel: i32, sample: i32| pixel as f32 + sample as f32 * (1.0 / SUB as f32);
    let (dx, dy) = (offset(x, sample[0]) - t.anchor[0], offset(y, sample[1]) - t.anchor[1]);
    let steps = S::u32s::from_slice(simd, &STEPS[..lanes]).bitcast::<S::i32s>();
    let lane: F<S> = steps.to_float();
    let nothing = S::i32s::splat(simd, 0);
    let least = F::<S>::splat(simd, f32::NEG_INFINITY);
    while column <= x1 {
        let (mut firsts, mut lasts) = ([0; 16], [0; 16]);
        let [first, last] = strips(simd, &edges, rows, steps * lanes as i32 + column);
        first.store_slice(&mut firsts[..lanes]);
        last.store_slice(&mut lasts[..lanes]);
        for (&first, &last) in firsts[..lanes].iter().zip(&lasts) {
            let mut edge = [nothing; 3];
            let mut k = 0;
            while k < 3 {
                let Edge { a, b, start, .. } = edges[k];
                edge[k] = steps * a + (start + a * column + b * first);
                k += 1;
            }
            let along = (lane + (dx + column as f32)) * zx;
            let mut row = first;
            while row <= last {
                let place = (row * size + column) as usize;
                let z = t.at.w + zy * (dy + row as f32);
                let inv_depth = (along + z).max(t.range[0]).min(t.range[1]);
                let inside = (edge[0] | edge[1] | edge[2]).simd_ge(nothing);
                let depths = &mut depths[place..place + lanes];
                let old = F::<S>::from_slice(simd, depths);
                let nearer = inside & inv_depth.simd_gt(old);
                // Not what `nearer` selects, which compilers make a masked store of: on AMD's processors that takes as long
                // as all else here.
                inside.select(inv_depth, least).max(old).store_slice(depths);
                if !ids.is_empty() {
                    let ids = &mut ids[place..place + lanes];
                    let old = S::u32s::from_slice(simd, ids);
                    nearer.select(S::u32s::splat(simd, id), old).store_slice(ids);
                }
                let mut k = 0;
                while k < 3 {
                    edge[k] += edges[k].b;
                    k += 1;
                }
                row += 1;
            }
            column += lanes as i32;
            if column > x1 {
                break;
            }
        }
    }
}

/// An edge function of a triangle over a tile, `a x + b y + start` of whole pixels.
///
/// A pixel is [`SUB`] steps wide, so in 1 / [`SUB`] of their unit the functions change by whole numbers from pixel to
/// pixel, and the remainder of the division never changes a sign.
struct Edge {
    a: i32,
    b: i32,
    /// Value at the sample of the tile's first pixel.
    start: i32,
}

impl Edge {
    /// An edge function in the tile whose top left pixel is `corner`.
    #[inline(always)]
    fn new((a, b, c): (i32, i32, i64), corner: [i32; 2], sample: SubPixel) -> Edge {
        let far = |pixel: i32, sample: i32| pixel as i64 * SUB as i64 + sample as i64;
        let start = a as i64 * far(corner[0], sample[0]) + b as i64 * far(corner[1], sample[1]) + c;
        let start = (start >> SUB.trailing_zeros()).clamp(-FAR, FAR) as i32;
        Edge { a, b, start }
    }
}

/// The first and the last of some rows that may have a pixel inside of three edges, in each of the strips that begin at
/// `columns`.
///
/// Each edge is met where a strip lies farthest inside of it. In floating point a row within a tile is off by less than
/// 1/1024.
#[inline(always)]
fn strips<S: Simd>(simd: S, edges: &[Edge; 3], rows: [i32; 2], columns: S::i32s) -> [S::i32s; 2] {
    let [mut first, mut last] = rows.map(|row| S::i32s::splat(simd, row));
    let worth = rows[1] - rows[0] >= FEW;
    for &Edge { a, b, start } in edges.iter().filter(|_| worth) {
        let best = if a > 0 { F::<S>::LEN as i32 - 1 } else { 0 };
        let value: F<S> = (columns * a + (start + best * a)).to_float();
        // The row where the edge passes, half of the least value below 0; where the edge is level, one beyond the tile.
        let row = (value + 0.5) * if b == 0 { 1e20 } else { -1.0 / b as f32 };
        let row = row.max(-1.0).min(Tile::SIZE as f32);
        if b > 0 {
            first = first.max((row - 1.0 / 1024.0).ceil().to_int::<S::i32s>());
        } else {
            last = last.min((row + 1.0 / 1024.0).floor().to_int::<S::i32s>());
        }
    }
    [first, last]
}
