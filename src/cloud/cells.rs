//! Clouds in a tile: rays at the corners of cells of pixels, interpolated between where that is as good.

use super::imposter;
use super::march::{Look, march};
use super::{CloudLayer, ROOT, Seen};
use crate::cuts::BENCH;
use crate::frame::Tile;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, V3};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;

/// Points of a tile along an edge, with the first ones of the next tile.
const SIDE: usize = Tile::SIZE + 1;

/// Points of a tile.
struct Lattice {
    /// Premultiplied light and transmittance; and beyond how many metres no cloud hides anything.
    values: Vec<[f32; 5]>,
    /// Has a point been cast, or is it to be?
    known: Vec<bool>,
    /// Edge of the cell that begins at a point.
    sizes: Vec<usize>,
    /// Points to be cast.
    wanted: Vec<usize>,
}

impl Lattice {
    fn want(&mut self, at: usize) {
        if !self.known[at] {
            self.known[at] = true;
            self.wanted.push(at);
        }
    }
}

/// Draws clouds into a tile: adds their light, and what they hide to what is covered.
#[simd]
pub fn draw<S: Simd>(simd: S, clouds: &CloudLayer, near: &[&Seen], tile: &mut Tile) {
    const POINTS: usize = SIDE * SIDE;
    let mut size = clouds.quality.cell;
    let mut lattice = Lattice {
        values: vec![[0.0; 5]; POINTS],
        known: vec![false; POINTS],
        sizes: vec![size; POINTS],
        wanted: Vec::new(),
    };
    loop {
        // First their corners, then their middles, then what the middles tell.
        for pass in 0..3 {
            for y in (0..tile.height).step_by(size) {
                for x in (0..tile.width).step_by(size) {
                    let at = x + y * SIDE;
                    let corners = [at, at + size, at + size * SIDE, at + size * SIDE + size];
                    let middle = at + (size / 2) * (SIDE + 1);
                    if lattice.sizes[at] != size {
                        continue;
                    }
                    match pass {
                        0 if size == 1 => lattice.want(at),
                        0 => {
                            for corner in corners {
                                lattice.want(corner);
                            }
                        }
                        1 => lattice.want(middle),
                        _ => {
                            let [a, b, c, d] = corners.map(|corner| lattice.values[corner]);
                            let mut error = 0.0f32;
                            for k in 0..4 {
                                error =
                                    error.max((lattice.values[middle][k] - (a[k] + b[k] + c[k] + d[k]) * 0.25).abs());
                            }
                            if error > clouds.quality.threshold {
                                for part in [at, at + size / 2, middle - size / 2, middle] {
                                    lattice.sizes[part] = size / 2;
                                }
                            } else {
                                interpolate(&mut lattice, at, size, [a, b, c, d]);
                            }
                        }
                    }
                }
            }
            cast(simd, clouds, near, tile, &mut lattice, false);
            if size == 1 {
                finish(simd, clouds, near, tile, &mut lattice);
                return;
            }
        }
        size /= 2;
    }
}

/// Fills a cell's points between its corners.
fn interpolate(lattice: &mut Lattice, at: usize, size: usize, [a, b, c, d]: [[f32; 5]; 4]) {
    let share = 1.0 / size as u32 as f32;
    for part in 0..size * size {
        let (x, y) = (part % size, part / size);
        let (u, v) = (x as u32 as f32 * share, y as u32 as f32 * share);
        for k in 0..4 {
            let (above, below) = (a[k] + (b[k] - a[k]) * u, c[k] + (d[k] - c[k]) * u);
            lattice.values[at + x + y * SIDE][k] = above + (below - above) * v;
        }
        lattice.values[at + x + y * SIDE][4] = a[4].max(b[4]).max(c[4]).max(d[4]);
    }
}

/// From the lattice to the tile; where solids may be before what clouds hide, a ray is cast for each pixel.
#[simd]
fn finish<S: Simd>(simd: S, clouds: &CloudLayer, near: &[&Seen], tile: &mut Tile, lattice: &mut Lattice) {
    let free = lattice.values.clone();
    for y in 0..tile.height {
        for x in 0..tile.width {
            let (at, point) = (x + y * Tile::SIZE, x + y * SIDE);
            if tile.coverage[at] > 0.0 && tile.inv_depth[at] * free[point][4] > 1.0 {
                lattice.wanted.push(point);
            }
        }
    }
    cast(simd, clouds, near, tile, lattice, true);
    for y in 0..tile.height {
        for x in 0..tile.width {
            let (at, point) = (x + y * Tile::SIZE, x + y * SIDE);
            let covered = tile.coverage[at];
            let (before, free) = (lattice.values[point], free[point]);
            for (k, plane) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().enumerate() {
                plane[at] = plane[at] * before[3] + before[k] * covered + free[k] * (1.0 - covered);
            }
            tile.coverage[at] = covered + (1.0 - covered) * (1.0 - free[3]);
        }
    }
}

/// Casts the rays of the points that are wanted, as far as the solids there or on and on.
#[simd]
fn cast<S: Simd>(simd: S, clouds: &CloudLayer, near: &[&Seen], tile: &Tile, lattice: &mut Lattice, solids: bool) {
    let grid = if BENCH { clouds.quality.grid as u32 } else { 1 };
    let step = 1.0 / grid as f32;
    for points in lattice.wanted.chunks(BLOCK) {
        let mut sum = [[0.0; BLOCK]; 5];
        for part in 0..grid * grid {
            let [mut x, mut y] = [[0.0; BLOCK]; 2];
            let mut depth = [f32::INFINITY; BLOCK];
            for (i, point) in points.iter().enumerate() {
                let (column, row) = (point % SIDE, point / SIDE);
                x[i] = (tile.x + column) as u32 as f32 + ((part % grid) as f32 + 0.5) * step;
                y[i] = (tile.y + row) as u32 as f32 + ((part / grid) as f32 + 0.5) * step;
                if solids {
                    depth[i] = 1.0 / tile.inv_depth[column + row * Tile::SIZE];
                }
            }
            see(simd, clouds, near, [&x, &y, &depth], points.len(), &mut sum);
        }
        for (i, point) in points.iter().enumerate() {
            for (k, sum) in sum.iter().enumerate() {
                lattice.values[*point][k] = sum[i] * if k < 4 { step * step } else { 1.0 };
            }
        }
    }
    lattice.wanted.clear();
}

/// Adds light and transmittance of the first `count` of 64 points of the picture, in pixels, and puts clouds' end off.
#[simd]
fn see<S: Simd>(
    simd: S,
    clouds: &CloudLayer,
    near: &[&Seen],
    [x, y, depth]: [&[f32; BLOCK]; 3],
    count: usize,
    sum: &mut [[f32; BLOCK]; 5],
) {
    let eye = clouds.view.camera().eye;
    let one = F::<S>::splat(simd, 1.0);
    let mut i = 0;
    while i * F::<S>::LEN < count {
        let ray = clouds.view.rays(simd, load(simd, x, i), load(simd, y, i));
        let length = ray.dot(ray).sqrt();
        let d = ray * Lane(one / length);
        let mut limit = load::<S, F<S>>(simd, depth, i) * length;
        let mut light = V3::splat(simd, Vec3::ZERO);
        let (mut transmittance, mut end) = (one, load::<S, F<S>>(simd, &sum[4], i));
        for seen in near {
            let passage = if !BENCH || seen.imposters.is_empty() {
                march(simd, &seen.cloud, eye, d, limit, [seen.steps, clouds.quality.opaque])
            } else {
                imposter::look_up(simd, seen, eye, d, limit, clouds.quality.opaque)
            };
            let look = Look { sun: clouds.look.sun * seen.sunlit, ..clouds.look };
            let (color, passes) = passage.shine(simd, &look, d);
            let color = V3::splat(simd, seen.veil) * Lane(one - passes) + color * Lane(F::<S>::splat(simd, seen.fades));
            light = light + color * Lane(transmittance);
            transmittance *= passes;
            end = passes.simd_lt(one).select(end.max(seen.distance + ROOT * seen.cloud.size), end);
            // Each lane for itself, lest its light depends on its neighbours.
            let ends = transmittance.simd_lt(clouds.quality.hidden);
            if ends.all_true() {
                break;
            }
            limit = ends.select(F::<S>::splat(simd, 0.0), limit);
        }
        for (sum, value) in sum.iter_mut().zip([light.x, light.y, light.z, transmittance]) {
            store(load::<S, F<S>>(simd, sum, i) + value, sum, i);
        }
        store(end, &mut sum[4], i);
        i += 1;
    }
}
