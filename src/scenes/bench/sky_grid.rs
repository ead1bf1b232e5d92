//! Light that varies slowly, evaluated at the corners of square cells of pixels and interpolated between.
//!
//! The bench sky's counterpart of the tracer's corner grid. Corners lie on whole pixels of the picture, so neighbouring
//! tiles evaluate the same ones and no seam shows.

use crate::frame::Tile;
use crate::simd::block::{BLOCK, Block3, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Light by direction.
pub trait Field: Sync {
    /// Linear light from unit directions. To be `#[inline(always)]`, as every leaf of a kernel.
    fn light<S: Simd>(&self, simd: S, d: V3<S>) -> V3<S>;

    /// Whether the light has an edge on the horizon. If so, every pixel of a cell on the horizon is evaluated.
    const HORIZON: bool;
}

/// How densely a field is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Cells {
    /// Edge of a cell, pixels: a power of two from 8 to 64, or 1 for every pixel.
    pub size: usize,
    /// Samples per pixel along each axis, where every pixel is evaluated.
    pub grid: usize,
}

/// The most corners of a tile, in blocks.
const CORNERS: usize = 2;

/// Fills a tile with the light of a field.
#[simd]
pub fn fill<S: Simd, G: Field>(simd: S, field: &G, view: &View, cells: Cells, tile: &mut Tile) {
    let (left, top) = (tile.x as u32 as f32, tile.y as u32 as f32);
    let size = cells.size;
    let row = Tile::SIZE / size + 1;
    let mut corners = [[[0.0; BLOCK]; 3]; CORNERS];
    if size > 1 {
        for (block, light) in corners.iter_mut().enumerate() {
            let [mut x, mut y] = [[0.0; BLOCK]; 2];
            for i in 0..BLOCK {
                let corner = block * BLOCK + i;
                x[i] = left + (corner % row * size) as u32 as f32;
                y[i] = top + (corner / row * size) as u32 as f32;
            }
            let count = (row * row).saturating_sub(block * BLOCK).min(BLOCK);
            evaluate(simd, field, view, &x, &y, count, light);
        }
    }
    let mut bounds = [[[0.0; BLOCK]; 3]; 2];
    let mut sharp = true;
    for y in 0..tile.height {
        let within = y % size;
        if size > 1 && within == 0 {
            // How far a ray points above the horizon is linear over the picture, so the corners of the band tell
            // whether the horizon crosses it.
            let at = top + y as u32 as f32;
            let (mut low, mut high) = (f32::MAX, f32::MIN);
            for (x, y) in [(0.0, 0.0), (64.0, 0.0), (0.0, size as u32 as f32), (64.0, size as u32 as f32)] {
                let up = view.ray(left + x, at + y).y;
                (low, high) = (low.min(up), high.max(up));
            }
            sharp = G::HORIZON && low <= 0.0 && high >= 0.0;
            for (below, bound) in bounds.iter_mut().enumerate() {
                widen(&corners, (y / size + below) * row, size, bound);
            }
        }
        let mut line = [[0.0; BLOCK]; 3];
        if sharp {
            sample(simd, field, view, cells.grid, left, top + y as u32 as f32, &mut line);
        } else {
            let share = (within as u32 as f32 + 0.5) / size as u32 as f32;
            for (channel, line) in line.iter_mut().enumerate() {
                let mut i = 0;
                while i < BLOCK / F::<S>::LEN {
                    let a: F<S> = load(simd, &bounds[0][channel], i);
                    let b: F<S> = load(simd, &bounds[1][channel], i);
                    store(a + (b - a) * share, line, i);
                    i += 1;
                }
            }
        }
        for (plane, line) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().zip(&line) {
            plane.as_chunks_mut::<BLOCK>().0[y] = *line;
        }
    }
}

/// The light of the first `count` of 64 points of the picture, in pixels.
#[simd]
pub fn evaluate<S: Simd, G: Field>(
    simd: S,
    field: &G,
    view: &View,
    x: &[f32; BLOCK],
    y: &[f32; BLOCK],
    count: usize,
    out: &mut Block3,
) {
    let mut i = 0;
    while i * F::<S>::LEN < count {
        let ray = view.rays(simd, load(simd, x, i), load(simd, y, i));
        let light = field.light(simd, ray * Lane(F::<S>::splat(simd, 1.0) / ray.dot(ray).sqrt()));
        store(light.x, &mut out[0], i);
        store(light.y, &mut out[1], i);
        store(light.z, &mut out[2], i);
        i += 1;
    }
}

/// A row of pixels from (`left`, `top`) on, evaluated at `grid` times `grid` points of each.
#[simd]
fn sample<S: Simd, G: Field>(simd: S, field: &G, view: &View, grid: usize, left: f32, top: f32, out: &mut Block3) {
    let step = 1.0 / grid as u32 as f32;
    let [mut x, mut y] = [[0.0; BLOCK]; 2];
    let mut light = [[0.0; BLOCK]; 3];
    for part in 0..grid * grid {
        y.fill(top + ((part / grid) as u32 as f32 + 0.5) * step);
        for (i, x) in x.iter_mut().enumerate() {
            *x = left + i as u32 as f32 + ((part % grid) as u32 as f32 + 0.5) * step;
        }
        evaluate(simd, field, view, &x, &y, BLOCK, &mut light);
        for (sum, light) in out.iter_mut().zip(&light) {
            for (sum, light) in sum.iter_mut().zip(light) {
                *sum += light * step * step;
            }
        }
    }
}

/// A row of corners, from `first` on, interpolated along x.
fn widen(corners: &[Block3; CORNERS], first: usize, size: usize, out: &mut Block3) {
    let step = 1.0 / size as u32 as f32;
    for (channel, out) in out.iter_mut().enumerate() {
        for (cell, pixels) in out.chunks_mut(size).enumerate() {
            let at = |i: usize| corners[i / BLOCK][channel][i % BLOCK];
            let (a, b) = (at(first + cell), at(first + cell + 1));
            for (i, pixel) in pixels.iter_mut().enumerate() {
                *pixel = a + (b - a) * ((i as u32 as f32 + 0.5) * step);
            }
        }
    }
}
