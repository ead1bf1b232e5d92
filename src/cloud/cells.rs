//! Clouds in a tile: rays at the corners of cells of pixels, interpolated between where that is as good.

use super::march::{OPAQUE, march};
use super::{Clouds, Seen};
use crate::block::{BLOCK, load, store};
use crate::lanes::{F, Lane, V3};
use crate::tile::Tile;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;

/// Points of a tile along an edge, with the first ones of the next tile.
const SIDE: usize = Tile::SIZE + 1;

/// Light and transmittance of points of a tile.
struct Lattice {
    values: Vec<[f32; 4]>,
    known: Vec<bool>,
    /// Points to be cast.
    wanted: Vec<u16>,
}

impl Lattice {
    fn want(&mut self, x: usize, y: usize) {
        let at = x + y * SIDE;
        if !self.known[at] {
            self.known[at] = true;
            self.wanted.push(at as u16);
        }
    }

    fn at(&self, x: usize, y: usize) -> [f32; 4] {
        self.values[x + y * SIDE]
    }
}

/// Draws clouds into a tile: adds their light and what they hide to what is covered.
#[simd]
pub fn draw<S: Simd>(simd: S, clouds: &Clouds, near: &[&Seen], tile: &mut Tile) {
    let mut lattice =
        Lattice { values: vec![[0.0; 4]; SIDE * SIDE], known: vec![false; SIDE * SIDE], wanted: Vec::new() };
    let mut size = clouds.quality.cell;
    let mut cells = Vec::new();
    for y in (0..tile.height).step_by(size) {
        for x in (0..tile.width).step_by(size) {
            let full = |row: usize| tile.coverage[row * Tile::SIZE + x..][..size].iter().all(|covered| *covered >= 1.0);
            if (y..y + size).all(full) {
                continue;
            }
            cells.push((x, y));
            for (dx, dy) in [(0, 0), (size, 0), (0, size), (size, size)] {
                if size > 1 || dx + dy == 0 {
                    lattice.want(x + dx, y + dy);
                }
            }
        }
    }
    cast(simd, clouds, near, tile, &mut lattice);
    while size > 1 {
        let half = size / 2;
        for &(x, y) in &cells {
            lattice.want(x + half, y + half);
        }
        cast(simd, clouds, near, tile, &mut lattice);
        let mut parts = Vec::new();
        for &(x, y) in &cells {
            let corners = [(0, 0), (size, 0), (0, size), (size, size)].map(|(dx, dy)| lattice.at(x + dx, y + dy));
            let middle = lattice.at(x + half, y + half);
            let mut error = 0.0f32;
            for k in 0..4 {
                let mean = (corners[0][k] + corners[1][k] + corners[2][k] + corners[3][k]) * 0.25;
                error = error.max((middle[k] - mean).abs());
            }
            if error > clouds.quality.threshold {
                for (dx, dy) in [(half, 0), (0, half), (size, half), (half, size)] {
                    lattice.want(x + dx, y + dy);
                }
                parts.extend([(x, y), (x + half, y), (x, y + half), (x + half, y + half)]);
            } else {
                interpolate(&mut lattice, corners, x, y, size);
            }
        }
        cast(simd, clouds, near, tile, &mut lattice);
        (cells, size) = (parts, half);
    }
    cover(simd, clouds, near, tile);
    for y in 0..tile.height {
        for x in 0..tile.width {
            let at = y * Tile::SIZE + x;
            let [r, g, b, transmittance] = lattice.at(x, y);
            let left = 1.0 - tile.coverage[at];
            tile.red[at] += r * left;
            tile.green[at] += g * left;
            tile.blue[at] += b * left;
            tile.coverage[at] += left * (1.0 - transmittance);
        }
    }
}

/// Draws what of the clouds is before solids: a ray for each pixel that has one.
#[simd]
fn cover<S: Simd>(simd: S, clouds: &Clouds, near: &[&Seen], tile: &mut Tile) {
    let mut points = Vec::new();
    for y in 0..tile.height {
        for x in 0..tile.width {
            let at = x + y * Tile::SIZE;
            if tile.coverage[at] > 0.0 {
                points.push(at as u16);
            }
        }
    }
    for points in points.chunks(BLOCK) {
        let [mut x, mut y, mut depth] = [[0.0; BLOCK]; 3];
        let mut sum = [[0.0; BLOCK]; 4];
        for (i, point) in points.iter().enumerate() {
            let at = *point as usize;
            x[i] = (tile.x + at % Tile::SIZE) as u32 as f32 + 0.5;
            y[i] = (tile.y + at / Tile::SIZE) as u32 as f32 + 0.5;
            depth[i] = 1.0 / tile.closeness[at];
        }
        see(simd, clouds, near, [&x, &y, &depth], points.len(), &mut sum);
        for (i, point) in points.iter().enumerate() {
            let at = *point as usize;
            for (plane, light) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().zip(&sum) {
                plane[at] = plane[at] * sum[3][i] + light[i] * tile.coverage[at];
            }
        }
    }
}

/// Fills a cell's points between its corners.
fn interpolate(lattice: &mut Lattice, corners: [[f32; 4]; 4], x: usize, y: usize, size: usize) {
    let share = 1.0 / size as u32 as f32;
    for dy in 0..size {
        let v = dy as u32 as f32 * share;
        for dx in 0..size {
            let at = x + dx + (y + dy) * SIDE;
            if !lattice.known[at] {
                let u = dx as u32 as f32 * share;
                for k in 0..4 {
                    let a = corners[0][k] + (corners[1][k] - corners[0][k]) * u;
                    let b = corners[2][k] + (corners[3][k] - corners[2][k]) * u;
                    lattice.values[at][k] = a + (b - a) * v;
                }
            }
        }
    }
}

/// Casts the rays of the points that are wanted.
#[simd]
fn cast<S: Simd>(simd: S, clouds: &Clouds, near: &[&Seen], tile: &Tile, lattice: &mut Lattice) {
    let grid = clouds.quality.grid as u32;
    let step = 1.0 / grid as f32;
    let limit = [f32::INFINITY; BLOCK];
    for points in lattice.wanted.chunks(BLOCK) {
        let mut sum = [[0.0; BLOCK]; 4];
        for part in 0..grid * grid {
            let [mut x, mut y] = [[0.0; BLOCK]; 2];
            for ((x, y), point) in x.iter_mut().zip(&mut y).zip(points) {
                let point = *point as usize;
                *x = (tile.x + point % SIDE) as u32 as f32 + ((part % grid) as f32 + 0.5) * step;
                *y = (tile.y + point / SIDE) as u32 as f32 + ((part / grid) as f32 + 0.5) * step;
            }
            see(simd, clouds, near, [&x, &y, &limit], points.len(), &mut sum);
        }
        for (i, point) in points.iter().enumerate() {
            lattice.values[*point as usize] = [0, 1, 2, 3].map(|k| sum[k][i] * step * step);
        }
    }
    lattice.wanted.clear();
}

/// Adds light and transmittance of the first `count` of 64 points of the picture, in pixels.
#[simd]
fn see<S: Simd>(
    simd: S,
    clouds: &Clouds,
    near: &[&Seen],
    [x, y, depth]: [&[f32; BLOCK]; 3],
    count: usize,
    sum: &mut [[f32; BLOCK]; 4],
) {
    let eye = clouds.view.camera().eye;
    let one = F::<S>::splat(simd, 1.0);
    let mut i = 0;
    while i * F::<S>::LEN < count {
        let ray = clouds.view.rays(simd, load(simd, x, i), load(simd, y, i));
        let length = ray.dot(ray).sqrt();
        let d = ray * Lane(one / length);
        let limit = load::<S, F<S>>(simd, depth, i) * length;
        let mut light = V3::splat(simd, Vec3::ZERO);
        let mut transmittance = one;
        for Seen { cloud, steps, fades, veil, .. } in near {
            let (color, passes) = march(simd, cloud, &clouds.look, eye, d, limit, *steps);
            let color = V3::splat(simd, *veil) * Lane(one - passes) + color * Lane(F::<S>::splat(simd, *fades));
            light = light + color * Lane(transmittance);
            transmittance *= passes;
            if transmittance.simd_lt(OPAQUE).all_true() {
                break;
            }
        }
        for (sum, value) in sum.iter_mut().zip([light.x, light.y, light.z, transmittance]) {
            store(load::<S, F<S>>(simd, sum, i) + value, sum, i);
        }
        i += 1;
    }
}
