//! Shadow maps: the depths that a light sees `[Williams78]`, looked up by percentage-closer filtering `[Reeves87]`.
//!
//! A lookup compares the depths of 3x3 texels with that of a point, and averages the outcomes. With `smooth` the 3x3
//! texels are a window that moves with the point and meets 4x4 texels, whose borders count by how much of them it covers:
//! bilinear interpolation of the averages. It is an approximation of `exact_shadow`.

use crate::cuts;
use crate::frame::Tile;
use crate::simd::lanes::{Bits, F, M};
use fearless_simd::f32x4;
use fearless_simd::prelude::*;

/// `inv_depth` of a texel that shows nothing, -1.7e38: it never hides a point. All bytes are the same, so that a map is
/// cleared by one call.
pub const EMPTY: f32 = f32::from_bits(0xfefe_fefe);
/// Texels after the last row, besides one row after the last view: lookups read whole vectors, and disregard these.
const SLACK: usize = 4;

/// The depths of all views of a light.
#[derive(Default)]
pub struct DepthMap {
    /// Number of texels along an edge of a view: a multiple of [`Tile::SIZE`].
    pub size: usize,
    /// `inv_depth`, view by view and row by row.
    texels: Vec<f32>,
}

/// Where the points of a vector appear in the views of a light.
pub struct MapPoints<S: Simd> {
    /// Numbers of the views.
    pub view: F<S>,
    /// Texel coordinates along a row.
    pub x: F<S>,
    /// Texel coordinates down a column.
    pub y: F<S>,
    /// Depths of the points, bias included.
    pub inv_depth: F<S>,
    /// Which points appear in a view. The others are not looked up, and get any number.
    pub inside: M<S>,
}

impl DepthMap {
    /// Makes room for a number of views of `size` x `size` texels. Old texels may stay: what is used has to be written.
    /// Panics if `size` is no multiple of [`Tile::SIZE`].
    pub fn resize(&mut self, size: usize, views: usize) {
        assert!(size.is_multiple_of(Tile::SIZE));
        self.size = size;
        let texels = (views * size + 1) * size + SLACK;
        if self.texels.len() != texels {
            self.texels = vec![0.0; texels];
        }
    }

    /// The rows of tiles of all views, one view after the other.
    pub fn bands(&mut self) -> impl Iterator<Item = &mut [f32]> {
        // The row after the last view is less than a chunk.
        self.texels.chunks_exact_mut((self.size * Tile::SIZE).max(1))
    }

    /// `inv_depth` at a texel of a view.
    pub fn at(&self, view: usize, x: usize, y: usize) -> f32 {
        self.texels[(view * self.size + y) * self.size + x]
    }

    /// The share of the light that reaches points, 0 to 1: of the 3x3 texels around each, those whose surfaces are not
    /// nearer. Along the border of the map and beyond, the nearest 3x3 texels within.
    #[inline(always)]
    pub fn lit<S: Simd>(&self, simd: S, points: &MapPoints<S>, smooth: bool) -> F<S> {
        let (size, lanes) = (self.size, F::<S>::LEN);
        // Smooth, the window of 3x3 texels begins 1.5 before the point; else at the texel before the point's own.
        let smooth = smooth || !cuts::COUNTED_TEXELS;
        let shift = if smooth { 1.5 } else { 1.0 };
        let end = (size - 3) as u32 as f32;
        let zero = F::<S>::splat(simd, 0.0);
        let (x, y) = ((points.x - shift).max(zero).min(end), (points.y - shift).max(zero).min(end));
        let (column, row) = (x.floor(), y.floor());
        let line = (points.view * size as u32 as f32 + row).to_int::<S::i32s>();
        let first = line * size as i32 + column.to_int::<S::i32s>();
        // A coordinate that is NaN may lead anywhere, but not out of the map.
        let beyond = self.texels.len() - (3 * size + SLACK);
        let first = first.bitcast::<S::u32s>().min(S::u32s::splat(simd, beyond as u32));
        let (mut places, mut depths, mut sums) = ([0u32; 16], [0f32; 16], [0f32; 16]);
        let (mut fx, mut fy) = ([0f32; 16], [0f32; 16]);
        first.store_slice(&mut places[..lanes]);
        points.inv_depth.store_slice(&mut depths[..lanes]);
        (x - column).store_slice(&mut fx[..lanes]);
        (y - row).store_slice(&mut fy[..lanes]);
        for lane in Bits(points.inside.to_bitmask()) {
            let lane = lane & 15;
            let texels = &self.texels[places[lane] as usize..][..3 * size + SLACK];
            let inv_depth = f32x4::splat(simd, depths[lane]);
            sums[lane] = if smooth {
                weighted(simd, texels, size, inv_depth, fx[lane], fy[lane])
            } else {
                counted(simd, texels, size, inv_depth)
            };
        }
        F::<S>::from_slice(simd, &sums[..lanes]) * (1.0 / 9.0)
    }
}

/// Area of lit texels in a window of 3x3 that begins at (`fx`, `fy`) in the first of `texels`, rows of which are `size`
/// apart.
#[inline(always)]
fn weighted<S: Simd>(simd: S, texels: &[f32], size: usize, inv_depth: f32x4<S>, fx: f32, fy: f32) -> f32 {
    let weight = f32x4::from_slice(simd, &[1.0 - fx, 1.0, 1.0, fx]);
    let mut sum = f32x4::splat(simd, 0.0);
    let mut k = 0;
    while k < 4 {
        let row = f32x4::from_slice(simd, &texels[k * size..][..4]);
        let share = [1.0 - fy, 1.0, 1.0, fy][k];
        sum += row.simd_le(inv_depth).select(weight * share, f32x4::splat(simd, 0.0));
        k += 1;
    }
    let mut four = [0.0; 4];
    sum.store_slice(&mut four);
    (four[0] + four[1]) + (four[2] + four[3])
}

/// Number of lit texels among the 3x3 that begin with the first of `texels`, rows of which are `size` apart.
#[inline(always)]
fn counted<S: Simd>(simd: S, texels: &[f32], size: usize, inv_depth: f32x4<S>) -> f32 {
    let a = f32x4::from_slice(simd, &texels[..4]).simd_le(inv_depth).to_bitmask();
    let b = f32x4::from_slice(simd, &texels[size..][..4]).simd_le(inv_depth).to_bitmask();
    let c = f32x4::from_slice(simd, &texels[2 * size..][..4]).simd_le(inv_depth).to_bitmask();
    ((a & 7) | (b & 7) << 3 | (c & 7) << 6).count_ones() as f32
}
