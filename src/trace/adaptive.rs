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
use super::fill::{self, Ramps};
use super::guard::Guard;
use super::lanes::F;
use super::packet::{self, Context, HIT, NUMBERS, PLAIN, REMEMBERED, Sample};
use super::texture::Variation;
use crate::quality::Quality;
use crate::tile::Tile;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Most lattice points along a tile's edge: quarter pixels, both ends.
const LATTICE: usize = Tile::SIZE * 4 + 1;
/// Sizes of squares from 16 pixels down to a quarter.
const LEVELS: usize = 7;

/// A square of the lattice: its top left corner and its edge, lattice steps.
#[derive(Clone, Copy)]
pub struct Square {
    /// Left.
    pub x: usize,
    /// Top.
    pub y: usize,
    /// Edge.
    pub size: usize,
}

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
    pub quality: &'a Quality,
}

impl Job<'_> {
    /// Lattice steps of a pixel.
    #[inline(always)]
    pub fn unit(&self) -> usize {
        1 << self.quality.subpixel
    }
}

/// What a thread keeps from tile to tile; only memory, never values.
#[derive(Default)]
pub struct Scratch {
    grid: Grid,
    /// Squares to look at, by level.
    work: [Vec<(u16, u16)>; LEVELS],
    /// Squares whose corners agree.
    whole: Vec<Square>,
    /// Pixels that are traced themselves, and those that an edge runs through.
    pixels: Vec<(u16, u16)>,
    edges: Vec<(u16, u16)>,
    deferred: Deferred,
    ramps: Ramps,
}

/// The samples of a tile, on a lattice of pixels or parts of pixels.
#[derive(Default)]
pub struct Grid {
    /// For each lattice point the generation that traced it and its sample.
    lattice: Vec<(u32, u32)>,
    generation: u32,
    /// The first `count` are of this tile.
    samples: Vec<Sample>,
    count: usize,
    /// Where the samples are, pixels of the picture; behind the last sample, where those lie that are asked for.
    xs: Vec<f32>,
    ys: Vec<f32>,
}

impl Grid {
    /// Forgets the last tile.
    fn begin(&mut self) {
        self.lattice.resize(LATTICE * LATTICE, (0, 0));
        self.generation = self.generation.wrapping_add(1).max(1);
        self.clear();
    }

    /// Forgets all samples.
    fn clear(&mut self) {
        self.count = 0;
        self.xs.clear();
        self.ys.clear();
    }

    /// Asks for the sample at a lattice point, if it is not there yet.
    #[inline(always)]
    fn want(&mut self, job: &Job, tile: &Tile, x: usize, y: usize) {
        let entry = &mut self.lattice[y * LATTICE + x];
        if entry.0 != self.generation {
            *entry = (self.generation, self.xs.len() as u32);
            let (step, offset) = if job.quality.subpixel == 0 { (1.0, 0.5) } else { (1.0 / job.unit() as f32, 0.0) };
            self.xs.push(tile.x as f32 + x as f32 * step + offset);
            self.ys.push(tile.y as f32 + y as f32 * step + offset);
        }
    }

    /// The sample at a lattice point that has been traced.
    #[inline(always)]
    pub fn at(&self, x: usize, y: usize) -> &Sample {
        &self.samples[self.lattice[y * LATTICE + x].1 as usize]
    }

    /// The corners of a square: top left, top right, bottom left, bottom right.
    #[inline(always)]
    pub fn corners(&self, Square { x, y, size }: Square) -> [&Sample; 4] {
        [self.at(x, y), self.at(x + size, y), self.at(x, y + size), self.at(x + size, y + size)]
    }

    /// The sample in the middle of a square.
    #[inline(always)]
    pub fn centre(&self, Square { x, y, size }: Square) -> &Sample {
        self.at(x + size / 2, y + size / 2)
    }

    /// Traces all that was asked for.
    #[inline(always)]
    fn trace<S: Simd>(&mut self, simd: S, job: &Job) {
        let (first, end) = (self.count, self.xs.len());
        if self.samples.len() < end {
            self.samples.resize(end.next_power_of_two(), Sample::default());
        }
        packet::trace(simd, &job.context, &self.xs[first..], &self.ys[first..], &mut self.samples[first..end]);
        self.count = end;
    }

    /// Does a sample between the ends of a line of lattice points have another chain?
    ///
    /// Lines are cut in the middle: where the middle has not been traced, nothing between it and the ends has.
    fn crossed(&self, (x, y): (usize, usize), (dx, dy): (usize, usize), length: usize, chain: u32) -> bool {
        let half = length / 2;
        if half == 0 {
            return false;
        }
        let middle = (x + dx * half, y + dy * half);
        if self.lattice[middle.1 * LATTICE + middle.0].0 != self.generation {
            return false;
        }
        self.at(middle.0, middle.1).chain != chain
            || self.crossed((x, y), (dx, dy), half, chain)
            || self.crossed(middle, (dx, dy), half, chain)
    }

    /// Does an edge enter a square from a neighbour?
    #[inline(always)]
    fn entered(&self, Square { x, y, size }: Square) -> bool {
        let chain = self.at(x, y).chain;
        self.crossed((x, y), (1, 0), size, chain)
            || self.crossed((x, y), (0, 1), size, chain)
            || self.crossed((x, y + size), (1, 0), size, chain)
            || self.crossed((x + size, y), (0, 1), size, chain)
    }
}

/// Draws a tile; returns the number of eye rays.
#[simd]
pub fn draw<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
    scratch.grid.begin();
    scratch.deferred.begin(job.context.world.objects.len(), job.quality.subpixel > 0);
    tile.clear();
    let count = if job.quality.cell > 1 {
        subdivide(simd, job, tile, scratch);
        paint(simd, job, tile, scratch);
        scratch.grid.count
    } else {
        every_pixel(simd, job, tile, scratch);
        tile.width * tile.height * job.quality.grid * job.quality.grid
    };
    scratch.deferred.finish(simd, job.context.world, tile);
    count as u64
}

impl Scratch {
    /// Where the samples of the tile drawn last lie, pixels of the picture.
    pub fn positions(&self) -> impl Iterator<Item = (f32, f32)> {
        self.grid.xs.iter().copied().zip(self.grid.ys.iter().copied())
    }
}

/// The exact limit: `grid` x `grid` samples in every pixel.
#[simd]
fn every_pixel<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) {
    let Scratch { grid, deferred, .. } = scratch;
    let across = job.quality.grid;
    let share = 1.0 / (across * across) as f32;
    let step = 1.0 / across as f32;
    for y in 0..tile.height {
        grid.clear();
        for x in 0..tile.width {
            for n in 0..across * across {
                grid.xs.push((tile.x + x) as f32 + ((n % across) as f32 + 0.5) * step);
                grid.ys.push((tile.y + y) as f32 + ((n / across) as f32 + 0.5) * step);
            }
        }
        grid.trace(simd, job);
        for (n, sample) in grid.samples[..grid.count].iter().enumerate() {
            let pixel = y * Tile::SIZE + n / (across * across);
            fill::add(simd, job, tile, deferred, pixel, sample, share, &[0.0; REMEMBERED]);
        }
    }
}

/// Cuts the tile into squares whose corners agree, pixels, and pixels that an edge runs through.
#[simd]
fn subdivide<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) {
    let Scratch { grid, work, whole, pixels, edges, .. } = scratch;
    let unit = job.unit();
    let coarsest = job.quality.cell * unit;
    let end = ((tile.width * unit) as u16, (tile.height * unit) as u16);
    whole.clear();
    pixels.clear();
    edges.clear();
    for y in (0..end.1).step_by(coarsest) {
        for x in (0..end.0).step_by(coarsest) {
            work[0].push((x, y));
        }
    }
    loop {
        let mut size = coarsest;
        let mut level = 0;
        while size > 0 {
            let squares = std::mem::take(&mut work[level]);
            for &(x, y) in &squares {
                let (x, y) = (x as usize, y as usize);
                grid.want(job, tile, x, y);
                if size == 1 && unit == 1 {
                    continue;
                }
                grid.want(job, tile, x + size, y);
                grid.want(job, tile, x, y + size);
                grid.want(job, tile, x + size, y + size);
                if size > unit || unit == 1 {
                    grid.want(job, tile, x + size / 2, y + size / 2);
                }
            }
            grid.trace(simd, job);
            for &(x, y) in &squares {
                let square = Square { x: x as usize, y: y as usize, size };
                let agree = if size < unit {
                    size == 1 || same_chain(grid.corners(square))
                } else {
                    let finest = job.guard.finest(tile.x + square.x / unit, tile.y + square.y / unit);
                    if size == unit && unit > 1 {
                        // A pixel is the mean of its corners, whatever they differ in but their chain.
                        finest > 1 && same_chain(grid.corners(square))
                    } else {
                        size > 1
                            && size <= unit * finest
                            && agree(simd, job, size.div_ceil(unit), grid.corners(square), grid.centre(square))
                    }
                };
                if size < unit && agree {
                    continue;
                }
                if size == 1 {
                    pixels.push((x, y));
                } else if agree {
                    whole.push(square);
                } else {
                    if size == unit {
                        edges.push((x, y));
                    }
                    cut(work, level, square, unit, end);
                }
            }
            work[level] = squares;
            work[level].clear();
            level += 1;
            size /= 2;
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
            cut(work, (coarsest / square.size).trailing_zeros() as usize, square, unit, end);
        }
        if done {
            break;
        }
    }
}

/// Cuts a square in four, without what lies beyond the picture's end.
///
/// Where a corner is a pixel, squares of 4 are cut into their pixels at once: it takes no more rays than to try squares of
/// 2 (whose middle is a fourth of what they could save), and is exact.
#[inline(always)]
fn cut(
    work: &mut [Vec<(u16, u16)>; LEVELS],
    level: usize,
    Square { x, y, size }: Square,
    unit: usize,
    end: (u16, u16),
) {
    let levels = if unit == 1 && size == 4 { 2 } else { 1 };
    let part = size >> levels;
    for y in (y..y + size).step_by(part) {
        for x in (x..x + size).step_by(part) {
            if x < end.0 as usize && y < end.1 as usize {
                work[level + levels].push((x as u16, y as u16));
            }
        }
    }
}

/// Gives every pixel its light.
#[simd]
fn paint<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) {
    let Scratch { grid, whole, pixels, edges, deferred, ramps, .. } = scratch;
    let unit = job.unit();
    ramps.prepare(job.quality.subpixel > 0);
    for &square in whole.iter() {
        if square.size == unit {
            let pixel = square.y / unit * Tile::SIZE + square.x / unit;
            let corners = grid.corners(square);
            let footprint = fill::footprints(corners);
            let mut mean = *corners[0];
            mean.numbers = foretell(simd, corners);
            fill::add(simd, job, tile, deferred, pixel, &mean, 1.0, &footprint);
        } else {
            fill::interpolate(simd, job, tile, deferred, ramps, grid, square);
        }
    }
    for &(x, y) in pixels.iter() {
        let pixel = y as usize * Tile::SIZE + x as usize;
        let sample = grid.at(x as usize, y as usize);
        fill::add(simd, job, tile, deferred, pixel, sample, 1.0, &[0.0; REMEMBERED]);
    }
    let mut groups = Groups::default();
    for &(x, y) in edges.iter() {
        let (x, y) = (x as usize, y as usize);
        let pixel = (x, y);
        let mut weights = Weights::default();
        let half = unit / 2;
        for (x, y) in [(x, y), (x + half, y), (x, y + half), (x + half, y + half)] {
            weigh(grid, Square { x, y, size: half }, 0.25, pixel, &mut weights);
        }
        groups.count = 0;
        for (row, weights) in weights.iter().enumerate() {
            for (column, &weight) in weights.iter().enumerate() {
                if weight > 0.0 {
                    groups.add(simd, grid.at(x + column, y + row), weight);
                }
            }
        }
        let pixel = y / unit * Tile::SIZE + x / unit;
        for group in &mut groups.list[..groups.count] {
            let k = 1.0 / group.weight;
            for number in &mut group.sum.numbers {
                *number *= k;
            }
            fill::add(simd, job, tile, deferred, pixel, &group.sum, group.weight, &[0.0; REMEMBERED]);
        }
    }
}

/// Do the corners have one chain?
#[inline(always)]
fn same_chain(c: [&Sample; 4]) -> bool {
    c[0].chain == c[1].chain && c[0].chain == c[2].chain && c[0].chain == c[3].chain
}

/// What the corners of a square foretell of its centre: their mean.
#[inline(always)]
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

/// May a square be interpolated?
#[inline(always)]
fn agree<S: Simd>(simd: S, job: &Job, size: usize, c: [&Sample; 4], centre: &Sample) -> bool {
    if !same_chain(c) || c[0].chain != centre.chain {
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
        let pixel = distance(&first, &last) / size as f32;
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

/// The surfaces seen through one pixel, each with its share of the area.
struct Groups {
    count: usize,
    list: [Group; 25],
}

impl Default for Groups {
    fn default() -> Groups {
        Groups { count: 0, list: [Group { weight: 0.0, sum: Sample::default() }; 25] }
    }
}

#[derive(Clone, Copy)]
struct Group {
    weight: f32,
    sum: Sample,
}

impl Groups {
    /// Adds a sample to those of its chain.
    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, sample: &Sample, weight: f32) {
        let mut at = 0;
        while at < self.count && self.list[at].sum.chain != sample.chain {
            at += 1;
        }
        let group = &mut self.list[at];
        if at == self.count {
            self.count += 1;
            *group = Group { weight: 0.0, sum: Sample { numbers: [0.0; NUMBERS], ..*sample } };
        }
        group.weight += weight;
        for i in (0..sample.used()).step_by(F::<S>::LEN) {
            let range = i..i + F::<S>::LEN;
            let sum = F::<S>::from_slice(simd, &group.sum.numbers[range.clone()]);
            let number = F::<S>::from_slice(simd, &sample.numbers[range.clone()]);
            (sum + number * weight).store_slice(&mut group.sum.numbers[range]);
        }
    }
}

/// Weights of the lattice points of a pixel, up to quarters.
type Weights = [[f32; 5]; 5];

/// Gives the samples in a part of a pixel their weights: a quarter to each corner of what is not cut further.
fn weigh(grid: &Grid, square: Square, weight: f32, pixel: (usize, usize), weights: &mut Weights) {
    let Square { x, y, size } = square;
    if size > 1 && !same_chain(grid.corners(square)) {
        let half = size / 2;
        for (x, y) in [(x, y), (x + half, y), (x, y + half), (x + half, y + half)] {
            weigh(grid, Square { x, y, size: half }, weight * 0.25, pixel, weights);
        }
        return;
    }
    let (column, row) = (x - pixel.0, y - pixel.1);
    for (column, row) in [(column, row), (column + size, row), (column, row + size), (column + size, row + size)] {
        weights[row][column] += weight * 0.25;
    }
}

// The numbers of a sample come in full lanes of any width.
const _: () = assert!(NUMBERS.is_multiple_of(16));
