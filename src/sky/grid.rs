//! The dome evaluated at the corners of square cells of pixels and interpolated between, or at every pixel.
//!
//! The sky's counterpart of the tracer's corner grid. Corners lie on whole pixels of the picture, so neighbouring tiles
//! evaluate the same ones and no seam shows.

use super::dome::{Dome, What, answer};
use crate::cuts::BENCH;
use crate::frame::Tile;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::texture::Block3;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Adds the dome to what solids have left of a tile. `size` of cells is a power of two up to 64.
#[simd]
pub fn fill<S: Simd>(simd: S, dome: &Dome, view: &View, size: u32, tile: &mut Tile) {
    if tile.coverage.iter().all(|c| *c >= 1.0) {
        return;
    }
    let (left, top) = (tile.x as u32 as f32, tile.y as u32 as f32);
    let mut lines = [[[0.0; BLOCK]; 3]; 2];
    line(simd, dome, view, size, left, top, &mut lines[1]);
    for y in 0..tile.height as u32 {
        if y % size == 0 {
            lines[0] = lines[1];
            line(simd, dome, view, size, left, top + (y + size) as f32, &mut lines[1]);
        }
        let share = ((y % size) as f32 + middle(size)) / size as f32;
        let [a, b] = &lines;
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let (a, b) = (V3::load(simd, a, i), V3::load(simd, b, i));
            put(simd, a + (b - a) * Lane(F::<S>::splat(simd, share)), None, y as usize, i, tile);
            i += 1;
        }
    }
}

/// Where pixels lie within cells: between corners, but a cell of one pixel has its light.
fn middle(size: u32) -> f32 {
    if size > 1 { 0.5 } else { 0.0 }
}

/// A row of 64 pixels from (`left`, `top`) on, between corners; or each at as many points as the quality says.
#[simd]
fn line<S: Simd>(simd: S, dome: &Dome, view: &View, size: u32, left: f32, top: f32, out: &mut Block3) {
    let grid = if size > 1 || !BENCH { 1 } else { dome.quality.grid as u32 };
    let step = 1.0 / grid as f32;
    let mut x = [0.0; BLOCK];
    for (i, x) in x.iter_mut().enumerate() {
        *x = left + (i as u32 * size) as f32;
    }
    let mut sum = [[0.0; BLOCK]; 3];
    for part in 0..grid * grid {
        let dx = ((part % grid) as f32 + 0.5) * step - middle(size);
        let dy = ((part / grid) as f32 + 0.5) * step - middle(size);
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN && i * F::<S>::LEN <= BLOCK / size as usize {
            let ray = view.rays(simd, load::<S, F<S>>(simd, &x, i) + dx, F::<S>::splat(simd, top + dy));
            let d = ray * Lane(F::<S>::splat(simd, 1.0) / ray.dot(ray).sqrt());
            let light = answer(simd, dome, d, What::Shown) * Lane(F::<S>::splat(simd, step * step));
            (V3::load(simd, &sum, i) + light).store(&mut sum, i);
            i += 1;
        }
    }
    for (sum, out) in sum.iter().zip(out) {
        for (i, out) in out.iter_mut().enumerate() {
            let cell = i / size as usize;
            let (a, b) = (sum[cell], sum[(cell + 1) % BLOCK]);
            *out = a + (b - a) * ((i as u32 % size) as f32 + middle(size)) / size as f32;
        }
    }
}

/// Adds light to what solids have left of vector `i` of a row. With the share of the sky that it hides it is drawn on the
/// sky, and less where there is light already.
#[simd]
pub fn put<S: Simd>(simd: S, light: V3<S>, hides: Option<F<S>>, row: usize, i: usize, tile: &mut Tile) {
    let one = F::<S>::splat(simd, 1.0);
    let left = one - load::<S, F<S>>(simd, &tile.coverage.as_chunks::<BLOCK>().0[row], i);
    let planes = [&mut tile.red, &mut tile.green, &mut tile.blue];
    for (plane, light) in planes.into_iter().zip([light.x, light.y, light.z]) {
        let plane = &mut plane.as_chunks_mut::<BLOCK>().0[row];
        let mut there: F<S> = load(simd, plane, i);
        let mut room = left;
        if let Some(hides) = hides {
            there *= one - hides * left;
            room *= (one - there).max(0.0);
        }
        store(there + light * room, plane, i);
    }
}
