//! The dome at the corners of square cells of pixels, interpolated between, or at every pixel.
//!
//! It is the sky's counterpart of the tracer's corner grid. Corners lie on whole pixels of the picture, so neighbouring
//! tiles evaluate the same ones and no seam shows. Within a cell light is bilinear. With cells of one pixel the dome is
//! evaluated at each pixel, or at a grid of samples of it: that is the limit that cells are held against.

use super::dome::{Dome, Quantity, evaluate};
use crate::frame::Tile;
use crate::settings::SkySettings;
use crate::simd::block::{BLOCK, Block3, load, store};
use crate::simd::lanes::{F, Lane, STEPS, V3, float};
use crate::simd::math::to_f32;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3A;
use std::sync::atomic::{AtomicU32, Ordering};

/// How finely the dome is evaluated on the screen, and what has been.
pub struct Cells {
    /// Edge of a cell, pixels: a power of two up to 64. At 1 every pixel is evaluated.
    size: u32,
    settings: SkySettings,
    /// Number of runs of corners in a line.
    runs: usize,
    /// Light at the corners of cells, or the mean of each pixel's samples, as bits; 0 where it has not been evaluated.
    /// In lines from the picture's top left corner on, which hold red, green and blue of one [`RUN`] after the other.
    /// Whichever tile needs a run first has it evaluated for all that meet there. Two threads may do so at once, and
    /// write the same.
    light: Vec<AtomicU32>,
}

/// Neighbouring corners that are evaluated together: a full vector at every SIMD level.
const RUN: usize = 16;

impl Cells {
    /// The largest cells of a view that the settings allow.
    pub fn new(view: &View, settings: &SkySettings) -> Cells {
        let mut size = 64;
        while size > 1 && size as f32 * view.pixel() > settings.built().cell {
            size /= 2;
        }
        // Up to the end of the last tiles, in 32 bits, as a division of 64 takes several times the code.
        let [columns, rows] =
            [view.width(), view.height()].map(|pixels| (pixels as u32).next_multiple_of(Tile::SIZE as u32) / size + 1);
        let runs = columns.div_ceil(RUN as u32) as usize;
        let mut light = Vec::new();
        light.resize_with(runs * rows as usize * 3 * RUN, AtomicU32::default);
        Cells { size, settings: *settings, runs, light }
    }

    /// Samples along each axis of a cell. Asked for where it is used, since it is the constant 1 in the 64 kB build.
    #[inline(always)]
    fn samples(&self) -> u32 {
        if self.size > 1 { 1 } else { self.settings.built().grid as u32 }
    }

    /// How far the middle of a cell's first pixel is from where its light is taken, pixels along each axis: 1/2 from a
    /// corner, and 0 where the cell is one pixel, whose light is taken in its middle.
    fn middle(&self) -> f32 {
        if self.size > 1 { 0.5 } else { 0.0 }
    }
}

/// Adds the dome to what solids have left of a tile.
#[simd]
pub fn fill<S: Simd>(simd: S, dome: &Dome, view: &View, cells: &Cells, tile: &mut Tile) {
    if tile.coverage.iter().all(|c| *c >= 1.0) {
        return;
    }
    let size = cells.size;
    // The rows of corners above and below a row of pixels, already interpolated along x.
    let mut lines = [[[0.0; BLOCK]; 3]; 2];
    line(simd, dome, view, cells, [tile.x, tile.y], &mut lines[1]);
    for y in 0..tile.height as u32 {
        if y % size == 0 {
            lines[0] = lines[1];
            line(simd, dome, view, cells, [tile.x, tile.y + (y + size) as usize], &mut lines[1]);
        }
        let share = ((y % size) as f32 + cells.middle()) / size as f32;
        let [a, b] = &lines;
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let (a, b) = (V3::load(simd, a, i), V3::load(simd, b, i));
            put(simd, a + (b - a) * Lane(F::<S>::splat(simd, share)), None, y as usize, i, tile);
            i += 1;
        }
    }
}

/// The light of 64 pixels from a point of the picture on: interpolated between the corners of cells that lie on this
/// line, or the mean of each pixel's samples.
#[simd]
fn line<S: Simd>(simd: S, dome: &Dome, view: &View, cells: &Cells, [left, top]: [usize; 2], out: &mut Block3) {
    let size = cells.size as usize;
    let (first, row) = (left / size, top / size);
    // The corners, one more than there are cells.
    let mut sum = [[0.0; BLOCK + 1]; 3];
    for i in 0..BLOCK / size + 1 {
        let (run, corner) = ((first + i) / RUN, (first + i) % RUN);
        let at = (row * cells.runs + run) * 3 * RUN + corner;
        // Red is written last.
        if cells.light[at].load(Ordering::Acquire) == 0 {
            evaluate_run(simd, dome, view, cells, run, row);
        }
        for (k, sum) in sum.iter_mut().enumerate() {
            sum[i] = f32::from_bits(cells.light[at + k * RUN].load(Ordering::Relaxed));
        }
    }
    for (sum, out) in sum.iter().zip(out) {
        for (i, out) in out.iter_mut().enumerate() {
            let cell = i / size;
            let (a, b) = (sum[cell], sum[cell + 1]);
            *out = a + (b - a) * (to_f32(i % size) + cells.middle()) / to_f32(size);
        }
    }
}

/// Evaluates a run of corners in a row of them.
#[simd]
#[cold] // Once per run.
#[inline(never)]
fn evaluate_run<S: Simd>(simd: S, dome: &Dome, view: &View, cells: &Cells, run: usize, row: usize) {
    let (size, grid) = (cells.size, cells.samples());
    let step = 1.0 / grid as f32;
    let top = to_f32(row * size as usize);
    let lanes = F::<S>::LEN;
    for at in (0..RUN).step_by(lanes) {
        let number = S::u32s::from_slice(simd, &STEPS[..lanes]) + (run * RUN + at) as u32;
        let x = float(simd, number * size);
        let mut light = V3::splat(simd, Vec3A::ZERO);
        for sample in 0..grid * grid {
            let dx = ((sample % grid) as f32 + 0.5) * step - cells.middle();
            let dy = ((sample / grid) as f32 + 0.5) * step - cells.middle();
            let ray = view.rays(simd, x + dx, F::<S>::splat(simd, top + dy));
            let d = ray * Lane(F::<S>::splat(simd, 1.0) / ray.dot(ray).sqrt());
            light = light + evaluate(simd, dome, d, Quantity::Shown) * Lane(F::<S>::splat(simd, step * step));
        }
        let out = &cells.light[(row * cells.runs + run) * 3 * RUN + at..];
        for (k, light) in [light.x, light.y, light.z].into_iter().enumerate().rev() {
            for (out, light) in out[k * RUN..].iter().zip(light.as_slice()) {
                out.store(light.to_bits(), Ordering::Release);
            }
        }
    }
}

/// Adds light to what solids have left of vector `i` of a row of pixels.
///
/// With `hides`, the share of the sky behind it that it hides, the light is drawn onto the sky, and adds the less the
/// more light is there already.
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
