//! Coverage and depth of triangles in a tile, a vector of pixels at a time.
//!
//! Edge functions in whole numbers, as in J. Pineda, "A parallel algorithm for polygon rasterization", 1988: each sample
//! on a shared edge belongs to exactly one of the two triangles.

use super::bins::{Id, parts};
use super::triangle::{SUB, SetupMesh, Triangle};
use crate::frame::Tile;
use crate::simd::lanes::{F, STEPS};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// The nearest triangle of each pixel of a tile.
#[derive(Clone)]
pub struct Visible {
    /// Its nearness, or that of nothing.
    pub inv_depth: Box<[f32; Tile::AREA]>,
    /// Which it is.
    pub id: Box<[Id; Tile::AREA]>,
}

/// Where in a pixel the sample is, steps of [`SUB`] from the pixel's top left.
pub type Sample = [i32; 2];
/// In the pixel's middle.
pub const CENTER: Sample = [SUB / 2; 2];

/// Beyond this an edge function has one sign in the whole tile.
const FAR: i64 = 1 << 30;

/// Draws triangles over what is visible of the tile whose top left pixel is (`x`, `y`).
#[simd]
pub fn fill<S: Simd>(simd: S, pieces: &[SetupMesh], ids: &[Id], x: i32, y: i32, sample: Sample, out: &mut Visible) {
    for &id in ids {
        let (piece, number) = parts(id);
        fill_one(simd, &pieces[piece].triangles[number], id, x, y, sample, out);
    }
}

/// Draws one triangle.
#[inline(always)]
fn fill_one<S: Simd>(simd: S, t: &Triangle, id: Id, x: i32, y: i32, sample: Sample, out: &mut Visible) {
    let lanes = F::<S>::LEN;
    let size = Tile::SIZE as i32;
    // The part of the tile that the triangle may touch, from a multiple of the lanes on.
    let (x0, x1) = ((t.bound[0] - x).max(0) & !(lanes as i32 - 1), (t.bound[1] - x).min(size - 1));
    let (y0, y1) = ((t.bound[2] - y).max(0), (t.bound[3] - y).min(size - 1));
    let steps = S::u32s::from_slice(simd, &STEPS[..lanes]).bitcast::<S::i32s>();
    let mut row = [S::i32s::splat(simd, 0); 3];
    let mut along = [0; 3];
    let mut down = [0; 3];
    let mut k = 0;
    while k < 3 {
        let (a, b, c) = t.edges[k];
        // At the tile's first sample. A pixel is `SUB` steps, so the rest of the division never matters.
        let far = |pixel: i32, sample: i32| pixel as i64 * SUB as i64 + sample as i64;
        let first = (a as i64 * far(x, sample[0]) + b as i64 * far(y, sample[1]) + c) >> SUB.trailing_zeros();
        let first = first.clamp(-FAR, FAR) as i32;
        row[k] = steps * a + (first + a * x0 + b * y0);
        along[k] = a * lanes as i32;
        down[k] = b;
        k += 1;
    }
    // Not summed up along the way: each pixel's nearness is the same at any number of lanes.
    let (zx, zy) = (t.by[0].w, t.by[1].w);
    let offset = |pixel: i32, sample: i32| pixel as f32 + sample as f32 * (1.0 / SUB as f32);
    let (dx, dy) = (offset(x, sample[0]) - t.anchor[0], offset(y, sample[1]) - t.anchor[1]);
    let steps: F<S> = steps.to_float();
    let nothing = S::i32s::splat(simd, 0);
    let mut at = y0;
    while at <= y1 {
        let z = t.at.w + zy * (dy + at as f32);
        let mut edge = row;
        let mut column = x0;
        while column <= x1 {
            let place = (at * size + column) as usize;
            let inv_depth = (steps + (dx + column as f32)) * zx + z;
            let inv_depth = inv_depth.max(t.range[0]).min(t.range[1]);
            let inside = (edge[0] | edge[1] | edge[2]).simd_ge(nothing);
            let (depths, ids) = (&mut out.inv_depth[place..place + lanes], &mut out.id[place..place + lanes]);
            let old = F::<S>::from_slice(simd, depths);
            let nearer = inside & inv_depth.simd_gt(old);
            nearer.select(inv_depth, old).store_slice(depths);
            let old = S::u32s::from_slice(simd, ids);
            nearer.select(S::u32s::splat(simd, id), old).store_slice(ids);
            let mut k = 0;
            while k < 3 {
                edge[k] += along[k];
                k += 1;
            }
            column += lanes as i32;
        }
        let mut k = 0;
        while k < 3 {
            row[k] += down[k];
            k += 1;
        }
        at += 1;
    }
}
