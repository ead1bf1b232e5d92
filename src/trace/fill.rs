//! From samples to pixels: squares between agreeing corners, and single pixels.

use super::adaptive::{Grid, Job, Square};
use super::deferred::Deferred;
use super::lanes::{F, Lane, V3};
use super::packet::{HIT, PLAIN, REMEMBERED, Sample};
use super::texture;
use crate::block::{BLOCK, load, store};
use crate::tile::Tile;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Adds `share` of a sample to a pixel, its textures averaged over their `footprint`s.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn add<S: Simd>(
    simd: S,
    job: &Job,
    tile: &mut Tile,
    deferred: &mut Deferred,
    pixel: usize,
    sample: &Sample,
    share: f32,
    footprint: &[f32; REMEMBERED],
) {
    let [red, green, blue, closeness, ..] = sample.numbers;
    tile.red[pixel] += red * share;
    tile.green[pixel] += green * share;
    tile.blue[pixel] += blue * share;
    if tile.solids_matter {
        tile.closeness[pixel] = tile.closeness[pixel].max(closeness);
        tile.coverage[pixel] += if closeness > 0.0 { share } else { 0.0 };
    }
    deferred.push(simd, job.context.world, tile, pixel as u16, sample, share, footprint);
}

/// The footprint of each textured hit of a pixel, metres: the longer of its two middle lines.
#[inline(always)]
pub fn footprints(corners: [&Sample; 4]) -> [f32; REMEMBERED] {
    let mut footprints = [0.0; REMEMBERED];
    for n in 0..corners[0].count as usize {
        let mut across = [[0.0; 3]; 4];
        for (corner, point) in corners.iter().zip(&mut across) {
            let hit = &corner.numbers[PLAIN + HIT * n..][..HIT];
            let k = 1.0 / hit[6];
            *point = [hit[3] * k, hit[4] * k, hit[5] * k];
        }
        let [a, b, c, d] = across;
        let (mut x, mut y) = (0.0, 0.0);
        for k in 0..3 {
            let (right, down) = (0.5 * (b[k] + d[k] - a[k] - c[k]), 0.5 * (c[k] + d[k] - a[k] - b[k]));
            x += right * right;
            y += down * down;
        }
        footprints[n] = x.max(y).sqrt();
    }
    footprints
}

/// Where the pixels of a square lie between its corners.
#[derive(Clone)]
struct Ramp {
    u: [f32; BLOCK],
    v: [f32; BLOCK],
    /// From the square's first pixel.
    pixel: [u16; BLOCK],
    count: usize,
}

/// The ramps of squares of 1, 2, 4, 8 and 16 pixels, in blocks of whole rows.
#[derive(Default)]
pub struct Ramps {
    centred: Option<bool>,
    by_size: [Vec<Ramp>; 5],
}

impl Ramps {
    /// Ready for corners on pixel centres, or (`centred`) for pixel centres between corners.
    pub fn prepare(&mut self, centred: bool) {
        if self.centred == Some(centred) {
            return;
        }
        self.centred = Some(centred);
        let offset = if centred { 0.5 } else { 0.0 };
        for (log, ramps) in self.by_size.iter_mut().enumerate() {
            let size = 1 << log;
            let count = BLOCK.min(size * size);
            ramps.clear();
            for first in (0..size * size).step_by(count) {
                let mut ramp = Ramp { u: [0.0; BLOCK], v: [0.0; BLOCK], pixel: [0; BLOCK], count };
                for i in 0..count {
                    let (x, y) = ((first + i) % size, (first + i) / size);
                    ramp.u[i] = (x as f32 + offset) / size as f32;
                    ramp.v[i] = (y as f32 + offset) / size as f32;
                    ramp.pixel[i] = (y * Tile::SIZE + x) as u16;
                }
                ramps.push(ramp);
            }
        }
    }
}

/// Fills a square from its corners.
#[simd]
pub fn interpolate<S: Simd>(
    simd: S,
    job: &Job,
    tile: &mut Tile,
    deferred: &mut Deferred,
    ramps: &Ramps,
    grid: &Grid,
    square: Square,
) {
    let corners = grid.corners(square);
    let unit = job.unit();
    let size = square.size / unit;
    let first = (square.y / unit) * Tile::SIZE + square.x / unit;
    let filter = job.quality.subpixel > 0;
    let solid = if corners[0].closeness() > 0.0 { 1.0 } else { 0.0 };
    for ramp in &ramps.by_size[size.trailing_zeros() as usize] {
        let mut plain = [[0.0; BLOCK]; PLAIN];
        for (k, plane) in plain.iter_mut().enumerate().take(if tile.solids_matter { PLAIN } else { 3 }) {
            bilinear(simd, corners, k, ramp, plane);
        }
        for n in 0..corners[0].count as usize {
            let mut hits = [[0.0; BLOCK]; HIT];
            for (k, plane) in hits.iter_mut().enumerate() {
                bilinear(simd, corners, PLAIN + HIT * n + k, ramp, plane);
            }
            let mut footprint = [0.0; BLOCK];
            project(simd, corners, n, size, ramp, filter, &mut hits, &mut footprint);
            let object = corners[0].object[n];
            if ramp.count == BLOCK {
                let mut color = [[0.0; BLOCK]; 3];
                let points = [hits[3], hits[4], hits[5]];
                let albedo = &job.context.world.objects[object as usize].material.albedo;
                texture::shade(simd, albedo, &points, filter.then_some(&footprint), &mut color);
                for k in 0..3 {
                    accumulate(simd, &hits[k], &color[k], &mut plain[k]);
                }
            } else {
                let mut pixels = [0; BLOCK];
                for (pixel, offset) in pixels.iter_mut().zip(&ramp.pixel) {
                    *pixel = first as u16 + offset;
                }
                let pixels = &pixels[..ramp.count];
                deferred.push_run(simd, job.context.world, tile, object, pixels, &hits, &footprint);
            }
        }
        let mut row = 0;
        while row < ramp.count {
            let to = first + ramp.pixel[row] as usize;
            // Added, not set: a queue of textures may have been emptied into these pixels already.
            match size {
                2 => add_row::<2>(tile, to, &plain, row, solid),
                4 => add_row::<4>(tile, to, &plain, row, solid),
                8 => add_row::<8>(tile, to, &plain, row, solid),
                _ => add_row::<16>(tile, to, &plain, row, solid),
            }
            row += size;
        }
    }
}

/// Adds a row of `N` pixels, from place `from` of a block, to the tile at pixel `to`.
#[inline(always)]
fn add_row<const N: usize>(tile: &mut Tile, to: usize, plain: &[[f32; BLOCK]; PLAIN], from: usize, solid: f32) {
    let planes = [&mut tile.red, &mut tile.green, &mut tile.blue];
    for (plane, values) in planes.into_iter().zip(plain) {
        for (sum, value) in plane[to..to + N].iter_mut().zip(&values[from..from + N]) {
            *sum += value;
        }
    }
    if tile.solids_matter {
        tile.closeness[to..to + N].copy_from_slice(&plain[3][from..from + N]);
        tile.coverage[to..to + N].fill(solid);
    }
}

/// Bilinear interpolation of number `k` over a ramp.
#[inline(always)]
fn bilinear<S: Simd>(simd: S, corners: [&Sample; 4], k: usize, ramp: &Ramp, out: &mut [f32; BLOCK]) {
    let [a, b, c, d] = [corners[0].numbers[k], corners[1].numbers[k], corners[2].numbers[k], corners[3].numbers[k]];
    let (du, dv, duv) = (b - a, c - a, d - c - b + a);
    let mut i = 0;
    while i * F::<S>::LEN < ramp.count {
        let (u, v): (F<S>, F<S>) = (load(simd, &ramp.u, i), load(simd, &ramp.v, i));
        store(u * (v * duv + du) + (v * dv + a), out, i);
        i += 1;
    }
}

/// From homogeneous points to points, and the footprint of a pixel around each.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
fn project<S: Simd>(
    simd: S,
    corners: [&Sample; 4],
    n: usize,
    size: usize,
    ramp: &Ramp,
    filter: bool,
    hits: &mut [[f32; BLOCK]; HIT],
    footprint: &mut [f32; BLOCK],
) {
    let step = 1.0 / size as f32;
    let mut i = 0;
    while i * F::<S>::LEN < ramp.count {
        let k = F::<S>::splat(simd, 1.0) / load::<S, F<S>>(simd, &hits[6], i);
        let homogeneous =
            V3::<S> { x: load(simd, &hits[3], i), y: load(simd, &hits[4], i), z: load(simd, &hits[5], i) };
        let point = homogeneous * Lane(k);
        store(point.x, &mut hits[3], i);
        store(point.y, &mut hits[4], i);
        store(point.z, &mut hits[5], i);
        if filter {
            let (u, v): (F<S>, F<S>) = (load(simd, &ramp.u, i), load(simd, &ramp.v, i));
            let at = PLAIN + HIT * n;
            let (wu, wv) = slopes(corners, at + 6, u, v);
            let (xu, xv) = slopes(corners, at + 3, u, v);
            let (yu, yv) = slopes(corners, at + 4, u, v);
            let (zu, zv) = slopes(corners, at + 5, u, v);
            // The derivative of a quotient, point = homogeneous / closeness.
            let across = V3::<S> { x: xu, y: yu, z: zu } - point * Lane(wu);
            let down = V3::<S> { x: xv, y: yv, z: zv } - point * Lane(wv);
            let longest = across.dot(across).max(down.dot(down)).sqrt();
            store(longest * k.abs() * step, footprint, i);
        }
        i += 1;
    }
}

/// The derivatives of a number along u and v.
#[inline(always)]
fn slopes<L: Copy + std::ops::Mul<f32, Output = L> + std::ops::Add<f32, Output = L>>(
    corners: [&Sample; 4],
    k: usize,
    u: L,
    v: L,
) -> (L, L) {
    let [a, b, c, d] = [corners[0].numbers[k], corners[1].numbers[k], corners[2].numbers[k], corners[3].numbers[k]];
    let duv = d - c - b + a;
    (v * duv + (b - a), u * duv + (c - a))
}

/// `sum += a b`.
#[inline(always)]
fn accumulate<S: Simd>(simd: S, a: &[f32; BLOCK], b: &[f32; BLOCK], sum: &mut [f32; BLOCK]) {
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let product = load::<S, F<S>>(simd, a, i) * load::<S, F<S>>(simd, b, i);
        store(load::<S, F<S>>(simd, sum, i) + product, sum, i);
        i += 1;
    }
}
