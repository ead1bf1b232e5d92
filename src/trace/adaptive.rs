//! Adaptive corner subdivision (thesis A, made safe): where the corners of a square agree, nothing new is traced.
//!
//! A tile is cut into squares. The corners of each, shared with its neighbours, and its centre are traced. Where all
//! five have the same chain (objects hit on every path, state of every light at each hit) and the centre is what the
//! corners foretell, the square is interpolated; else it is cut in four, down to one pixel and, where anti-aliasing is
//! on, below. Departures from the thesis:
//!
//! * What is interpolated is light, gain and hit point; textures are evaluated for every pixel ([`super::deferred`]).
//! * The test of contributions is an estimate of the interpolation's own error, at the centre where it is largest,
//!   rather than the difference of the corners: a smooth gradient is no reason to split. The centre is no extra cost
//!   where the square is cut, being a corner of its parts.
//! * An edge that enters a square between two corners is followed: where the border of a square meets samples of its
//!   neighbours that have another chain, the square is cut after all.
//! * Squares that a small object or shadow may touch are cut in any case ([`super::guard`]).
//! * With anti-aliasing corners lie on the corners of pixels, so that a pixel is a square like any other; without, on
//!   the centres of pixels, so that a corner is a pixel.

use super::deferred::Deferred;
use super::edge::Groups;
use super::fill::{self, Ramps};
use super::grid::{Grid, Square, same_path};
use super::guard::Guard;
use super::packet::Context;
use super::sample::{HIT, NUMBERS, PLAIN, REMEMBERED, Sample};
use crate::frame::Tile;
use crate::settings::{TraceSettings, samples_per_axis};
use crate::simd::lanes::F;
use crate::texture::Variation;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Sizes of squares from 16 pixels down to a quarter.
const LEVELS: usize = 7;

/// What the renderer of one tile reads.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// What packets read.
    pub context: Context<'a>,
    /// How the texture of every object changes.
    pub variation: &'a [Variation],
    /// Squares that must be cut.
    pub guard: &'a Guard,
    /// The knobs.
    pub quality: &'a TraceSettings,
}

impl Job<'_> {
    /// Lattice steps of a pixel.
    #[inline(always)]
    pub fn unit(&self) -> usize {
        1 << self.quality.subpixel
    }

    /// Whole pixels of so many lattice steps.
    #[inline(always)]
    pub fn pixels(&self, steps: usize) -> usize {
        steps >> self.quality.subpixel
    }
}

/// What a thread keeps from tile to tile; only memory, never values.
#[derive(Default)]
pub struct Scratch {
    /// The objects that eye rays may meet.
    pub visible: Vec<u32>,
    grid: Grid,
    /// Squares to look at, by level.
    work: [Vec<Square>; LEVELS],
    /// Squares whose corners agree, and pixels that are traced themselves.
    whole: Vec<Square>,
    /// Pixels that an edge runs through.
    edges: Vec<Square>,
    deferred: Deferred,
    ramps: Ramps,
}

/// Draws a tile; returns the number of eye rays.
#[simd]
pub fn draw<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
    scratch.deferred.begin(job.context.world.objects.len(), job.quality.subpixel > 0);
    tile.clear();
    let across = samples_per_axis(job.quality.grid);
    let step = 1.0 / across as u32 as f32;
    let mut count = 0;
    for n in 0..across * across {
        // Corners are centres of pixels, or corners of them.
        let middle = if job.quality.subpixel > 0 { 0.0 } else { 0.5 };
        let [dx, dy] = [n % across, n / across].map(|n| (n as u32 as f32 + middle) * step);
        scratch.grid.begin(job, tile, dx, dy);
        subdivide(simd, job, tile, scratch);
        paint(simd, job, tile, step * step, scratch);
        count += scratch.grid.samples();
    }
    scratch.deferred.finish(simd, job.context.world, tile);
    count as u64
}

impl Scratch {
    /// Where the samples of the tile drawn last lie, pixels of the picture.
    #[cfg(feature = "full")]
    pub fn positions(&self) -> impl Iterator<Item = (f32, f32)> {
        self.grid.positions()
    }
}

/// Cuts the tile into squares whose corners agree, pixels, and pixels that an edge runs through.
#[simd]
fn subdivide<S: Simd>(simd: S, job: &Job, tile: &Tile, scratch: &mut Scratch) {
    let Scratch { grid, work, whole, edges, .. } = scratch;
    let unit = job.unit();
    let coarsest = job.quality.cell * unit;
    let cutter = Cutter { coarsest, unit, end: (tile.width * unit, tile.height * unit) };
    whole.clear();
    edges.clear();
    for y in (0..cutter.end.1).step_by(coarsest) {
        for x in (0..cutter.end.0).step_by(coarsest) {
            work[0].push(Square { x, y, size: coarsest });
        }
    }
    loop {
        for level in 0..LEVELS {
            let squares = std::mem::take(&mut work[level]);
            for &Square { x, y, size } in &squares {
                grid.want(x, y);
                if size == 1 && unit == 1 {
                    continue;
                }
                grid.want(x + size, y);
                grid.want(x, y + size);
                grid.want(x + size, y + size);
                if size > unit {
                    grid.want(x + size / 2, y + size / 2);
                }
            }
            grid.trace(simd, job);
            for &square in &squares {
                let Square { x, y, size } = square;
                if size == 1 {
                    if unit == 1 {
                        whole.push(square);
                    }
                    continue;
                }
                let corners = grid.corners(square);
                let same = same_path(corners);
                if size < unit {
                    if !same {
                        cutter.cut(work, square);
                    }
                    continue;
                }
                let finest = job.guard.finest(tile.x + job.pixels(x), tile.y + job.pixels(y));
                // A pixel is the mean of its corners, whatever they differ in but their chain.
                let agree = same
                    && if size == unit {
                        finest > 1
                    } else {
                        size <= unit * finest && agree(simd, job, job.pixels(size), corners, grid.centre(square))
                    };
                if agree {
                    whole.push(square);
                } else {
                    if size == unit {
                        edges.push(square);
                    }
                    cutter.cut(work, square);
                }
            }
            work[level] = squares;
            work[level].clear();
        }
        let mut at = 0;
        let mut done = true;
        while at < whole.len() {
            let square = whole[at];
            // Pixels are not asked: half a pixel's edge is as near as they come.
            if square.size == unit || !grid.entered(square) {
                at += 1;
                continue;
            }
            done = false;
            whole.swap_remove(at);
            cutter.cut(work, square);
        }
        if done {
            break;
        }
    }
}

/// What cutting a square needs to know of the tile: its largest squares, its pixels and its end, lattice steps.
struct Cutter {
    coarsest: usize,
    unit: usize,
    end: (usize, usize),
}

impl Cutter {
    /// Cuts a square in four, without what lies beyond the picture's end.
    ///
    /// Where a corner is a pixel, squares of 4 are cut into their pixels at once: it takes no more rays than to try squares
    /// of 2 (whose middle is a fourth of what they could save), and is exact.
    fn cut(&self, work: &mut [Vec<Square>; LEVELS], Square { x, y, size }: Square) {
        let part = size >> if self.unit == 1 && size == 4 { 2 } else { 1 };
        let work = &mut work[(self.coarsest / part).trailing_zeros() as usize];
        for y in (y..self.end.1.min(y + size)).step_by(part) {
            for x in (x..self.end.0.min(x + size)).step_by(part) {
                work.push(Square { x, y, size: part });
            }
        }
    }
}

/// Gives every pixel a `share` of its light.
#[simd]
fn paint<S: Simd>(simd: S, job: &Job, tile: &mut Tile, share: f32, scratch: &mut Scratch) {
    let Scratch { grid, whole, edges, deferred, ramps, .. } = scratch;
    let unit = job.unit();
    ramps.prepare(job.quality.subpixel > 0);
    for &square in whole.iter() {
        let Square { x, y, size } = square;
        if size > unit {
            fill::interpolate(simd, job, tile, deferred, ramps, grid, square);
        } else if unit == 1 {
            fill::add(simd, job, tile, deferred, square, grid.at(x, y), share, &[0.0; REMEMBERED]);
        } else {
            let corners = grid.corners(square);
            let footprint = fill::footprints(corners);
            let Sample { path_signature, count, object, .. } = *corners[0];
            let mean = Sample { path_signature, count, object, numbers: foretell(simd, corners) };
            fill::add(simd, job, tile, deferred, square, &mean, share, &footprint);
        }
    }
    let mut groups = Groups::default();
    for &square in edges.iter() {
        for group in groups.of_pixel(simd, grid, square) {
            fill::add(simd, job, tile, deferred, square, &group.mean, group.share, &[0.0; REMEMBERED]);
        }
    }
}

/// What the corners of a square foretell of its centre: their mean.
#[simd]
fn foretell<S: Simd>(simd: S, c: [&Sample; 4]) -> [f32; NUMBERS] {
    let mut mean = [0.0; NUMBERS];
    for i in (0..c[0].used()).step_by(F::<S>::LEN) {
        let range = i..i + F::<S>::LEN;
        let sum = F::<S>::from_slice(simd, &c[0].numbers[range.clone()])
            + F::<S>::from_slice(simd, &c[1].numbers[range.clone()])
            + F::<S>::from_slice(simd, &c[2].numbers[range.clone()])
            + F::<S>::from_slice(simd, &c[3].numbers[range.clone()]);
        (sum * 0.25).store_slice(&mut mean[range]);
    }
    mean
}

/// May a square be interpolated whose corners have one chain?
#[inline(always)]
fn agree<S: Simd>(simd: S, job: &Job, size: usize, c: [&Sample; 4], centre: &Sample) -> bool {
    if c[0].path_signature != centre.path_signature {
        return false;
    }
    let mean = foretell(simd, c);
    let [found, foretold] = [&centre.numbers, &mean];
    let mut error = distance(&found[..3], &foretold[..3]);
    let mut level = found[0] + found[1] + found[2];
    for n in 0..centre.count as usize {
        let at = PLAIN + HIT * n;
        let (hit, guess) = (&found[at..at + HIT], &foretold[at..at + HIT]);
        let shift = distance(&point(hit), &point(guess));
        let (first, last) = (point(&c[0].numbers[at..at + HIT]), point(&c[3].numbers[at..at + HIT]));
        let pixel = distance(&first, &last) / size as u32 as f32;
        let Variation { contrast, slope } = job.variation[centre.object[n] as usize];
        // A texture finer than pixels may be displaced by a part of one.
        let texture = (slope * shift).min(contrast * SUBPIXEL * shift / pixel.max(1e-20)).min(contrast);
        error += distance(&hit[..3], &guess[..3]) + hit[0].max(hit[1]).max(hit[2]) * texture;
        level += 0.5 * (hit[0] + hit[1] + hit[2]);
    }
    // The eye sees differences on the encoded scale, whose slope falls about with the root of the light.
    error <= job.quality.threshold * (level * (1.0 / 3.0)).max(1.0 / 64.0).sqrt()
}

/// What a displacement by one pixel counts, as a share of a texture's contrast.
const SUBPIXEL: f32 = 0.25;

/// The hit point of a textured hit.
#[inline(always)]
fn point(hit: &[f32]) -> [f32; 3] {
    let k = 1.0 / hit[6];
    [hit[3] * k, hit[4] * k, hit[5] * k]
}

/// The largest difference of three components.
#[inline(always)]
fn distance(a: &[f32], b: &[f32]) -> f32 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs()).max((a[2] - b[2]).abs())
}
