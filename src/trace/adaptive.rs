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
use super::packet::{self, Limits, REMEMBERED, Sample, Textured, View};
use super::world::World;
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
    /// The scene.
    pub world: &'a World,
    /// The camera.
    pub view: &'a View,
    /// Squares that must be cut.
    pub guard: &'a Guard,
    /// The knobs.
    pub quality: &'a Quality,
    /// The knobs of the recursion.
    pub limits: Limits,
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
        packet::trace(simd, job.world, job.view, &job.limits, &self.xs, &self.ys, &mut self.samples);
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
    scratch.deferred.begin(job.world.objects.len());
    if job.quality.cell > 1 {
        scratch.lattice.resize(LATTICE * LATTICE, (0, 0));
        scratch.generation = scratch.generation.wrapping_add(1).max(1);
        subdivide(simd, job, tile, scratch);
    } else {
        every_pixel(simd, job, tile, scratch);
    }
    let Scratch { deferred, .. } = scratch;
    deferred.finish(simd, job.world, tile);
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
    tile.red[pixel] += sample.light[0] * share;
    tile.green[pixel] += sample.light[1] * share;
    tile.blue[pixel] += sample.light[2] * share;
    tile.closeness[pixel] = tile.closeness[pixel].max(sample.closeness);
    tile.coverage[pixel] += if sample.closeness > 0.0 { share } else { 0.0 };
    for hit in &sample.textured[..sample.count as usize] {
        let gain = hit.gain.map(|g| g * share);
        deferred.push(simd, job.world, tile, pixel as u16, &Textured { gain, ..*hit });
    }
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
                    split(&mut scratch.parts, x, y, half);
                }
                continue;
            }
            if size == 1 {
                let Scratch { samples, deferred, lattice, .. } = scratch;
                let sample = &samples[lattice[cy * LATTICE + cx].1 as usize];
                if cx < tile.width && cy < tile.height {
                    resolve(simd, job, tile, deferred, cy * Tile::SIZE + cx, sample, 1.0);
                }
                continue;
            }
            let finest = job.guard.finest(tile.x + cx / unit, tile.y + cy / unit);
            let agree = size <= finest * unit
                && agree(job, scratch.corners(cx, cy, size), scratch.at(cx + half, cy + half));
            if !agree && size == unit {
                scratch.edges.push((x, y));
                split(&mut scratch.parts, x, y, half);
            } else if !agree {
                split(&mut scratch.parts, x, y, half);
                // Parts of a square on the tile's edge may lie outside of the picture.
                let (w, h) = ((tile.width * unit) as u16, (tile.height * unit) as u16);
                scratch.parts.retain(|&(x, y)| x < w && y < h);
            } else if size == unit {
                let Scratch { samples, deferred, lattice, .. } = scratch;
                let centre = &samples[lattice[(cy + half) * LATTICE + cx + half].1 as usize];
                resolve(simd, job, tile, deferred, cy / unit * Tile::SIZE + cx / unit, centre, 1.0);
            } else {
                let corners = scratch.corners(cx, cy, size).map(|s| *s);
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
    for &(x, y) in &edges {
        let mut groups = Groups::default();
        weigh(scratch, x as usize, y as usize, unit, 1.0, &mut groups);
        let pixel = y as usize / unit * Tile::SIZE + x as usize / unit;
        for group in &groups.list[..groups.count] {
            let k = 1.0 / group.weight;
            let mut mean = group.sum;
            for hit in &mut mean.textured[..mean.count as usize] {
                hit.point = hit.point.map(|p| p * k);
                hit.gain = hit.gain.map(|g| g * k);
            }
            mean.light = mean.light.map(|l| l * k);
            mean.closeness *= k;
            resolve(simd, job, tile, &mut scratch.deferred, pixel, &mean, group.weight);
        }
    }
    scratch.edges = edges;
}

/// The four parts of a square.
fn split(parts: &mut Vec<(u16, u16)>, x: u16, y: u16, half: usize) {
    let half = half as u16;
    parts.extend([(x, y), (x + half, y), (x, y + half), (x + half, y + half)]);
}

/// Do the corners have one chain?
#[inline(always)]
fn same_chain(c: [&Sample; 4]) -> bool {
    c[0].chain == c[1].chain && c[0].chain == c[2].chain && c[0].chain == c[3].chain
}

/// May a square be interpolated?
#[inline(always)]
fn agree(job: &Job, c: [&Sample; 4], centre: &Sample) -> bool {
    if !same_chain(c) || c[0].chain != centre.chain {
        return false;
    }
    let mean = |f: &dyn Fn(&Sample) -> f32| 0.25 * (f(c[0]) + f(c[1]) + f(c[2]) + f(c[3]));
    let mut error = 0.0f32;
    let mut level = 0.0f32;
    for k in 0..3 {
        error = error.max((mean(&|s| s.light[k]) - centre.light[k]).abs());
        level += centre.light[k];
    }
    for (n, hit) in centre.textured[..centre.count as usize].iter().enumerate() {
        let mut gain_error = 0.0f32;
        for k in 0..3 {
            gain_error = gain_error.max((mean(&|s| s.textured[n].gain[k]) - hit.gain[k]).abs());
            level += 0.5 * hit.gain[k];
        }
        let closeness = mean(&|s| s.textured[n].closeness);
        let mut shift = 0.0;
        for k in 0..3 {
            let p = mean(&|s| s.textured[n].point[k] * s.textured[n].closeness) / closeness;
            shift += (p - hit.point[k]) * (p - hit.point[k]);
        }
        let gain = hit.gain[0].max(hit.gain[1]).max(hit.gain[2]);
        let roughness = job.world.objects[hit.object as usize].material.albedo.roughness();
        error += gain_error + gain * roughness * shift.sqrt();
    }
    // The eye sees differences on the encoded scale, whose slope falls about with the root of the light.
    error <= job.quality.threshold * (level * (1.0 / 3.0)).max(1.0 / 64.0).sqrt()
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
    let mut us = [0.0; 256];
    let mut vs = [0.0; 256];
    for i in 0..area {
        us[i] = ((i & (size - 1)) as f32 + offset) * step;
        vs[i] = ((i >> shift) as f32 + offset) * step;
    }
    for start in (0..area).step_by(BLOCK) {
        let count = BLOCK.min(area - start);
        let (us, vs) = (&us[start..start + BLOCK], &vs[start..start + BLOCK]);
        let mut pixels = [0u16; BLOCK];
        for (i, pixel) in pixels[..count].iter_mut().enumerate() {
            let i = start + i;
            *pixel = ((y + (i >> shift)) * Tile::SIZE + x + (i & (size - 1))) as u16;
        }
        let rows = size.min(count / size);
        let mut block = [0.0; BLOCK];
        let channel = |f: &dyn Fn(&Sample) -> f32| corners.each_ref().map(|c| f(c));
        for k in 0..4 {
            let values = if k < 3 { channel(&|s| s.light[k]) } else { channel(&|s| s.closeness) };
            bilinear(simd, values, us, vs, count, &mut block);
            let plane = match k {
                0 => &mut tile.red,
                1 => &mut tile.green,
                2 => &mut tile.blue,
                _ => &mut tile.closeness,
            };
            for row in 0..rows {
                let at = pixels[row * size] as usize;
                plane[at..at + size].copy_from_slice(&block[row * size..(row + 1) * size]);
            }
        }
        if corners[0].closeness > 0.0 {
            for row in 0..rows {
                let at = pixels[row * size] as usize;
                tile.coverage[at..at + size].fill(1.0);
            }
        }
        for n in 0..corners[0].count as usize {
            let mut gain = [[0.0; BLOCK]; 3];
            let mut point = [[0.0; BLOCK]; 3];
            let mut closeness = [0.0; BLOCK];
            bilinear(simd, channel(&|s| s.textured[n].closeness), us, vs, count, &mut closeness);
            for k in 0..3 {
                bilinear(simd, channel(&|s| s.textured[n].gain[k]), us, vs, count, &mut gain[k]);
                let scaled = channel(&|s| s.textured[n].point[k] * s.textured[n].closeness);
                bilinear(simd, scaled, us, vs, count, &mut point[k]);
            }
            for i in (0..count).step_by(F::<S>::LEN) {
                let range = i..i + F::<S>::LEN;
                let k = F::<S>::splat(simd, 1.0) / F::<S>::from_slice(simd, &closeness[range.clone()]);
                for p in &mut point {
                    (F::<S>::from_slice(simd, &p[range.clone()]) * k).store_slice(&mut p[range.clone()]);
                }
            }
            deferred.push_run(simd, job.world, tile, corners[0].textured[n].object, &pixels[..count], &gain, &point);
        }
    }
}

/// Bilinear interpolation of one number at the first `count` places, rounded up to full lanes.
#[inline(always)]
fn bilinear<S: Simd>(simd: S, c: [f32; 4], us: &[f32], vs: &[f32], count: usize, out: &mut [f32; BLOCK]) {
    let (du, dv, duv) = (c[1] - c[0], c[2] - c[0], c[3] - c[2] - c[1] + c[0]);
    for i in (0..count).step_by(F::<S>::LEN) {
        let range = i..i + F::<S>::LEN;
        let (u, v) = (F::<S>::from_slice(simd, &us[range.clone()]), F::<S>::from_slice(simd, &vs[range.clone()]));
        let value = u * (v * duv + du) + (v * dv + c[0]);
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
        let found = self.list[..self.count].iter().position(|g| g.sum.chain == sample.chain);
        let at = found.unwrap_or(self.count);
        if found.is_none() {
            self.count += 1;
            self.list[at].sum = Sample { chain: sample.chain, count: sample.count, ..Sample::default() };
        }
        let group = &mut self.list[at];
        group.weight += weight;
        let sum = &mut group.sum;
        for k in 0..3 {
            sum.light[k] += sample.light[k] * weight;
        }
        sum.closeness += sample.closeness * weight;
        for (sum, hit) in sum.textured.iter_mut().zip(&sample.textured[..sample.count as usize]) {
            sum.object = hit.object;
            for k in 0..3 {
                sum.gain[k] += hit.gain[k] * weight;
                sum.point[k] += hit.point[k] * weight;
            }
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

const _: () = assert!(REMEMBERED > 0 && Tile::AREA <= 1 << 16);
