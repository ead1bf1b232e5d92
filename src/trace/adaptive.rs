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
//! * Squares that a small object or shadow may touch are cut in any case ([`super::guard`]).
//! * With anti-aliasing corners lie on the corners of pixels, so that a pixel is a square like any other; without, on
//!   the centres of pixels, so that a corner is a pixel.

use super::deferred::Deferred;
use super::guard::Guard;
use super::lanes::F;
use super::packet::{self, Context, HIT, NUMBERS, PLAIN, Sample};
use crate::noise::BLOCK;
use crate::quality::Quality;
use crate::tile::Tile;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Most lattice points along a tile's edge: quarter pixels, both ends.
const LATTICE: usize = Tile::SIZE * 4 + 1;

/// What a thread keeps from tile to tile; only memory, never values.
#[derive(Default)]
pub struct Scratch {
    /// For each lattice point the generation that traced it and its sample.
    lattice: Vec<(u32, u32)>,
    generation: u32,
    samples: Vec<Sample>,
    xs: Vec<f32>,
    ys: Vec<f32>,
    cells: Vec<(u16, u16)>,
    parts: Vec<(u16, u16)>,
    edges: Vec<(u16, u16)>,
    deferred: Deferred,
}

/// What the renderer of one tile reads.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// What packets read.
    pub context: Context<'a>,
    /// How fast the texture of every object changes.
    pub roughness: &'a [f32],
    /// Squares that must be cut.
    pub guard: &'a Guard,
    /// The knobs.
    pub quality: &'a Quality,
}

impl Scratch {
    /// The sample at a lattice point, asked for if it is not there yet.
    #[inline(always)]
    fn want(&mut self, job: &Job, tile: &Tile, x: usize, y: usize) -> u32 {
        let entry = &mut self.lattice[y * LATTICE + x];
        if entry.0 != self.generation {
            *entry = (self.generation, (self.samples.len() + self.xs.len()) as u32);
            let (step, offset) = lattice_step(job.quality);
            self.xs.push(tile.x as f32 + x as f32 * step + offset);
            self.ys.push(tile.y as f32 + y as f32 * step + offset);
        }
        entry.1
    }

    /// The sample at a lattice point that has been traced.
    #[inline(always)]
    fn at(&self, x: usize, y: usize) -> &Sample {
        &self.samples[self.lattice[y * LATTICE + x].1 as usize]
    }

    /// The corners of a square: top left, top right, bottom left, bottom right.
    #[inline(always)]
    fn corners(&self, x: usize, y: usize, size: usize) -> [&Sample; 4] {
        [self.at(x, y), self.at(x + size, y), self.at(x, y + size), self.at(x + size, y + size)]
    }

    /// Traces all that was asked for.
    #[inline(always)]
    fn trace<S: Simd>(&mut self, simd: S, job: &Job) {
        packet::trace(simd, &job.context, &self.xs, &self.ys, &mut self.samples);
        self.xs.clear();
        self.ys.clear();
    }
}

/// Pixels between lattice points, and from the pixel's corner to the first.
#[inline(always)]
fn lattice_step(quality: &Quality) -> (f32, f32) {
    if quality.subpixel == 0 { (1.0, 0.5) } else { (1.0 / (1 << quality.subpixel) as f32, 0.0) }
}

/// Draws a tile; returns the number of eye rays.
#[simd]
pub fn draw<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
    scratch.samples.clear();
    scratch.deferred.begin(job.context.world.objects.len());
    if job.quality.cell > 1 {
        scratch.lattice.resize(LATTICE * LATTICE, (0, 0));
        scratch.generation = scratch.generation.wrapping_add(1).max(1);
        subdivide(simd, job, tile, scratch);
    } else {
        every_pixel(simd, job, tile, scratch);
    }
    let Scratch { deferred, .. } = scratch;
    deferred.finish(simd, job.context.world, tile);
    scratch.samples.len() as u64
}

/// The exact limit: `grid` x `grid` samples in every pixel.
#[simd]
fn every_pixel<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) {
    let grid = job.quality.grid;
    let share = 1.0 / (grid * grid) as f32;
    tile.clear();
    for y in 0..tile.height {
        let first = scratch.samples.len();
        for x in 0..tile.width {
            for j in 0..grid {
                for i in 0..grid {
                    scratch.xs.push((tile.x + x) as f32 + (i as f32 + 0.5) / grid as f32);
                    scratch.ys.push((tile.y + y) as f32 + (j as f32 + 0.5) / grid as f32);
                }
            }
        }
        scratch.trace(simd, job);
        let Scratch { samples, deferred, .. } = scratch;
        for (n, sample) in samples[first..].iter().enumerate() {
            let pixel = y * Tile::SIZE + n / (grid * grid);
            resolve(simd, job, tile, deferred, pixel, sample, share);
        }
    }
}

/// Adds `share` of a sample to a pixel.
#[inline(always)]
fn resolve<S: Simd>(
    simd: S,
    job: &Job,
    tile: &mut Tile,
    deferred: &mut Deferred,
    pixel: usize,
    sample: &Sample,
    share: f32,
) {
    let [red, green, blue, closeness, ..] = sample.numbers;
    tile.red[pixel] += red * share;
    tile.green[pixel] += green * share;
    tile.blue[pixel] += blue * share;
    tile.closeness[pixel] = tile.closeness[pixel].max(closeness);
    tile.coverage[pixel] += if closeness > 0.0 { share } else { 0.0 };
    deferred.push(simd, job.context.world, tile, pixel as u16, sample, share);
}

/// Cuts the tile into squares, from the coarsest to the finest.
#[simd]
fn subdivide<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) {
    let unit = 1 << job.quality.subpixel;
    let coarsest = job.quality.cell * unit;
    scratch.cells.clear();
    scratch.edges.clear();
    for y in (0..tile.height * unit).step_by(coarsest) {
        for x in (0..tile.width * unit).step_by(coarsest) {
            scratch.cells.push((x as u16, y as u16));
        }
    }
    tile.clear();
    let end = ((tile.width * unit) as u16, (tile.height * unit) as u16);
    let mut size = coarsest;
    while !scratch.cells.is_empty() {
        let cells = std::mem::take(&mut scratch.cells);
        let half = size / 2;
        for &(x, y) in &cells {
            let (x, y) = (x as usize, y as usize);
            scratch.want(job, tile, x, y);
            if size == 1 && unit == 1 {
                continue;
            }
            scratch.want(job, tile, x + size, y);
            scratch.want(job, tile, x, y + size);
            scratch.want(job, tile, x + size, y + size);
            if size >= unit.max(2) {
                scratch.want(job, tile, x + half, y + half);
            }
        }
        scratch.trace(simd, job);
        for &(x, y) in &cells {
            let (cx, cy) = (x as usize, y as usize);
            if size < unit {
                // Inside of a pixel: the weights are found when all of its parts are there.
                if size > 1 && !same_chain(scratch.corners(cx, cy, size)) {
                    split(&mut scratch.parts, x, y, half, end);
                }
                continue;
            }
            if size == 1 {
                let Scratch { samples, deferred, lattice, .. } = scratch;
                let sample = &samples[lattice[cy * LATTICE + cx].1 as usize];
                resolve(simd, job, tile, deferred, cy * Tile::SIZE + cx, sample, 1.0);
                continue;
            }
            let finest = job.guard.finest(tile.x + cx / unit, tile.y + cy / unit);
            let agree = size <= finest * unit
                && agree(simd, job, scratch.corners(cx, cy, size), scratch.at(cx + half, cy + half));
            if !agree && size == unit {
                scratch.edges.push((x, y));
                split(&mut scratch.parts, x, y, half, end);
            } else if !agree {
                split(&mut scratch.parts, x, y, half, end);
            } else if size == unit {
                let Scratch { samples, deferred, lattice, .. } = scratch;
                let centre = &samples[lattice[(cy + half) * LATTICE + cx + half].1 as usize];
                resolve(simd, job, tile, deferred, cy / unit * Tile::SIZE + cx / unit, centre, 1.0);
            } else {
                let [a, b, c, d] = scratch.corners(cx, cy, size);
                let corners = [*a, *b, *c, *d];
                let offset = if unit == 1 { 0.0 } else { 0.5 };
                interpolate(simd, job, tile, &mut scratch.deferred, &corners, cx / unit, cy / unit, size / unit, offset);
            }
        }
        scratch.cells = cells;
        scratch.cells.clear();
        std::mem::swap(&mut scratch.cells, &mut scratch.parts);
        size = half;
        if size == 0 {
            break;
        }
    }
    let edges = std::mem::take(&mut scratch.edges);
    let mut groups = Groups::default();
    for &(x, y) in &edges {
        groups.count = 0;
        weigh(scratch, x as usize, y as usize, unit, 1.0, &mut groups);
        let pixel = y as usize / unit * Tile::SIZE + x as usize / unit;
        for group in &groups.list[..groups.count] {
            let mut mean = group.sum;
            let k = 1.0 / group.weight;
            for number in &mut mean.numbers {
                *number *= k;
            }
            resolve(simd, job, tile, &mut scratch.deferred, pixel, &mean, group.weight);
        }
    }
    scratch.edges = edges;
}

/// The four parts of a square, without those that lie beyond the picture's end.
#[inline(always)]
fn split(parts: &mut Vec<(u16, u16)>, x: u16, y: u16, half: usize, end: (u16, u16)) {
    let (right, below) = (x + half as u16, y + half as u16);
    for (x, y) in [(x, y), (right, y), (x, below), (right, below)] {
        if x < end.0 && y < end.1 {
            parts.push((x, y));
        }
    }
}

/// Do the corners have one chain?
#[inline(always)]
fn same_chain(c: [&Sample; 4]) -> bool {
    c[0].chain == c[1].chain && c[0].chain == c[2].chain && c[0].chain == c[3].chain
}

/// May a square be interpolated?
#[inline(always)]
fn agree<S: Simd>(simd: S, job: &Job, c: [&Sample; 4], centre: &Sample) -> bool {
    if !same_chain(c) || c[0].chain != centre.chain {
        return false;
    }
    // What the corners foretell of the centre.
    let mut mean = [0.0; NUMBERS];
    for i in (0..centre.used()).step_by(F::<S>::LEN) {
        let range = i..i + F::<S>::LEN;
        let sum = F::<S>::from_slice(simd, &c[0].numbers[range.clone()])
            + F::<S>::from_slice(simd, &c[1].numbers[range.clone()])
            + F::<S>::from_slice(simd, &c[2].numbers[range.clone()])
            + F::<S>::from_slice(simd, &c[3].numbers[range.clone()]);
        (sum * 0.25).store_slice(&mut mean[range]);
    }
    let [found, foretold] = [&centre.numbers, &mean];
    let mut error = distance(&found[..3], &foretold[..3]);
    let mut level = found[0] + found[1] + found[2];
    for n in 0..centre.count as usize {
        let at = PLAIN + HIT * n;
        let (hit, guess) = (&found[at..at + HIT], &foretold[at..at + HIT]);
        let (k, l) = (1.0 / hit[6], 1.0 / guess[6]);
        let shift = distance(&[hit[3] * k, hit[4] * k, hit[5] * k], &[guess[3] * l, guess[4] * l, guess[5] * l]);
        let roughness = job.roughness[centre.object[n] as usize];
        error += distance(&hit[..3], &guess[..3]) + hit[0].max(hit[1]).max(hit[2]) * roughness * shift;
        level += 0.5 * (hit[0] + hit[1] + hit[2]);
    }
    // The eye sees differences on the encoded scale, whose slope falls about with the root of the light.
    error <= job.quality.threshold * (level * (1.0 / 3.0)).max(1.0 / 64.0).sqrt()
}

/// The largest difference of three components.
#[inline(always)]
fn distance(a: &[f32], b: &[f32]) -> f32 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs()).max((a[2] - b[2]).abs())
}

/// Fills a square of `size` pixels from its corners.
#[simd]
#[allow(clippy::too_many_arguments)]
fn interpolate<S: Simd>(
    simd: S,
    job: &Job,
    tile: &mut Tile,
    deferred: &mut Deferred,
    corners: &[Sample; 4],
    x: usize,
    y: usize,
    size: usize,
    offset: f32,
) {
    let area = size * size;
    let shift = size.trailing_zeros();
    let step = 1.0 / size as f32;
    let solid = corners[0].closeness() > 0.0;
    // A block is as many whole rows as fit; lanes beyond the square are computed and not used.
    for start in (0..area).step_by(BLOCK) {
        let count = BLOCK.min(area - start);
        let mut us = [0.0; BLOCK];
        let mut vs = [0.0; BLOCK];
        let mut pixels = [0u16; BLOCK];
        for i in 0..count {
            let (column, row) = ((start + i) & (size - 1), (start + i) >> shift);
            us[i] = (column as f32 + offset) * step;
            vs[i] = (row as f32 + offset) * step;
            pixels[i] = ((y + row) * Tile::SIZE + x + column) as u16;
        }
        let mut block = [[0.0; BLOCK]; HIT];
        let rows = count >> shift;
        for k in 0..PLAIN {
            bilinear(simd, corners, k, &us, &vs, count, &mut block[k]);
        }
        let [red, green, blue, closeness, ..] = &block;
        for row in 0..rows {
            let from = row * size..(row + 1) * size;
            let to = pixels[from.start] as usize;
            let to = to..to + size;
            tile.red[to.clone()].copy_from_slice(&red[from.clone()]);
            tile.green[to.clone()].copy_from_slice(&green[from.clone()]);
            tile.blue[to.clone()].copy_from_slice(&blue[from.clone()]);
            tile.closeness[to.clone()].copy_from_slice(&closeness[from]);
            tile.coverage[to].fill(if solid { 1.0 } else { 0.0 });
        }
        for n in 0..corners[0].count as usize {
            for k in 0..HIT {
                bilinear(simd, corners, PLAIN + HIT * n + k, &us, &vs, count, &mut block[k]);
            }
            for i in (0..count).step_by(F::<S>::LEN) {
                let range = i..i + F::<S>::LEN;
                let k = F::<S>::splat(simd, 1.0) / F::<S>::from_slice(simd, &block[6][range.clone()]);
                for axis in 3..6 {
                    let point = &mut block[axis][range.clone()];
                    (F::<S>::from_slice(simd, point) * k).store_slice(point);
                }
            }
            deferred.push_run(simd, job.context.world, tile, corners[0].object[n], &pixels[..count], &block);
        }
    }
}

/// Bilinear interpolation of number `k` at the first `count` places, rounded up to full lanes.
#[inline(always)]
fn bilinear<S: Simd>(
    simd: S,
    corners: &[Sample; 4],
    k: usize,
    us: &[f32; BLOCK],
    vs: &[f32; BLOCK],
    count: usize,
    out: &mut [f32; BLOCK],
) {
    let [a, b, c, d] = [corners[0].numbers[k], corners[1].numbers[k], corners[2].numbers[k], corners[3].numbers[k]];
    let (du, dv, duv) = (b - a, c - a, d - c - b + a);
    for i in (0..count).step_by(F::<S>::LEN) {
        let range = i..i + F::<S>::LEN;
        let (u, v) = (F::<S>::from_slice(simd, &us[range.clone()]), F::<S>::from_slice(simd, &vs[range.clone()]));
        let value = u * (v * duv + du) + (v * dv + a);
        value.store_slice(&mut out[range]);
    }
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
    fn add(&mut self, sample: &Sample, weight: f32) {
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
        for k in 0..sample.used() {
            group.sum.numbers[k] += sample.numbers[k] * weight;
        }
    }
}

/// Gives the samples in a square their weights: a quarter to each corner of every part that is not cut further.
fn weigh(scratch: &Scratch, x: usize, y: usize, size: usize, weight: f32, groups: &mut Groups) {
    let unit_cut = size > 1 && (groups.count == 0 && weight == 1.0 || !same_chain(scratch.corners(x, y, size)));
    if unit_cut {
        let half = size / 2;
        for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
            weigh(scratch, x + dx, y + dy, half, weight * 0.25, groups);
        }
        return;
    }
    for corner in scratch.corners(x, y, size) {
        groups.add(corner, weight * 0.25);
    }
}

// Pixels of a tile are numbered in 16 bits, and the numbers of a sample come in full lanes of any width.
const _: () = assert!(Tile::AREA <= 1 << 16 && NUMBERS % 16 == 0);
