//! Clouds in a tile: which pixels get a ray, and what the others show.
//!
//! Clouds are smooth over most of the picture, so rays are cast at the corners of square cells of pixels only. A ray in
//! the middle of each cell tells how far off bilinear interpolation would be: either the cell is interpolated, or it is
//! cut into four, down to single pixels. The reference is [`cell`](crate::settings::CloudSettings::cell) at 1, a ray
//! through every pixel.
//!
//! Solids are in the tile already. A ray is cast once as if there were none; and where a solid may stand in front of
//! something that clouds hide, once more as far as the solid. The pixel's coverage mixes the two.

use super::march::Passage;
use super::seen::{SeenCloud, SeenClouds};
use super::world::CloudLight;
use crate::frame::Tile;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math::to_f32;
use fearless_simd::{Level, dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3;

/// Points along an edge of a tile's lattice: its pixels, and the first ones of the next tile.
const SIDE: usize = Tile::SIZE + 1;

/// What a ray gives: premultiplied red, green and blue; transmittance; the distance in metres beyond which no cloud
/// hides anything.
type Value = [f32; 5];

/// Indices into a [`Value`].
const TRANSMITTANCE: usize = 3;
const END: usize = 4;

/// The points of a tile.
struct Lattice {
    values: Vec<Value>,
    /// Whether a ray has been cast through the point, or is to be.
    known: Vec<bool>,
    /// Edge of the cell whose top left corner the point is, pixels.
    sizes: Vec<usize>,
    /// Points through which rays are to be cast.
    wanted: Vec<usize>,
}

/// A square cell of pixels.
#[derive(Clone, Copy)]
struct Cell {
    /// The point at its top left corner.
    at: usize,
    /// Its edge, pixels.
    size: usize,
}

impl Cell {
    #[inline(always)]
    fn corners(self) -> [usize; 4] {
        let Cell { at, size } = self;
        [at, at + size, at + size * SIDE, at + size * SIDE + size]
    }

    #[inline(always)]
    fn middle(self) -> usize {
        self.at + (self.size / 2) * (SIDE + 1)
    }
}

/// Draws clouds into a tile: adds their light, takes what they hide from what is there, and counts it as covered.
pub(super) fn draw(level: Level, clouds: &SeenClouds, tile: &mut Tile) {
    let near = clouds.near(tile);
    if !near.is_empty() {
        dispatch!(level, simd => draw_near(simd, clouds, &near, tile));
    }
}

/// Draws the clouds that rays through the tile may meet.
///
/// ```text
/// for each size of cells, from the coarsest to 1:
///     cast rays through the corners of all cells of that size
///     cast rays through their middles
///     interpolate each cell, or cut it into four of half the size
/// ```
///
/// Rays are cast for all cells of a size at once, so that vectors are full.
#[simd]
fn draw_near<S: Simd>(simd: S, clouds: &SeenClouds, near: &[&SeenCloud], tile: &mut Tile) {
    const POINTS: usize = SIDE * SIDE;
    let mut size = clouds.settings.built().cell;
    let mut lattice = Lattice {
        values: vec![[0.0; 5]; POINTS],
        known: vec![false; POINTS],
        sizes: vec![size; POINTS],
        wanted: Vec::new(),
    };
    loop {
        for pass in 0..3 {
            for y in (0..tile.height).step_by(size) {
                for x in (0..tile.width).step_by(size) {
                    let cell = Cell { at: x + y * SIDE, size };
                    if lattice.sizes[cell.at] != size {
                        continue;
                    }
                    match pass {
                        0 if size == 1 => lattice.want(cell.at),
                        0 => {
                            for corner in cell.corners() {
                                lattice.want(corner);
                            }
                        }
                        1 => lattice.want(cell.middle()),
                        _ => lattice.fill_or_cut(cell, clouds.settings.built().threshold),
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

impl Lattice {
    fn want(&mut self, at: usize) {
        if !self.known[at] {
            self.known[at] = true;
            self.wanted.push(at);
        }
    }

    /// Interpolates a cell where its middle is off by at most `threshold`; cuts it into four otherwise.
    #[inline(always)]
    fn fill_or_cut(&mut self, cell: Cell, threshold: f32) {
        let Cell { at, size } = cell;
        let middle = cell.middle();
        let [a, b, c, d] = cell.corners().map(|corner| self.values[corner]);
        let mut error = 0.0f32;
        for k in 0..4 {
            error = error.max((self.values[middle][k] - (a[k] + b[k] + c[k] + d[k]) * 0.25).abs());
        }
        if error > threshold {
            for part in [at, at + size / 2, middle - size / 2, middle] {
                self.sizes[part] = size / 2;
            }
        } else {
            self.fill(cell, [a, b, c, d]);
        }
    }

    /// Fills a cell's points by bilinear interpolation between its corners.
    fn fill(&mut self, Cell { at, size }: Cell, [a, b, c, d]: [Value; 4]) {
        let share = 1.0 / to_f32(size);
        for part in 0..size * size {
            let (x, y) = (part % size, part / size);
            let (u, v) = (to_f32(x) * share, to_f32(y) * share);
            for k in 0..4 {
                let (above, below) = (a[k] + (b[k] - a[k]) * u, c[k] + (d[k] - c[k]) * u);
                self.values[at + x + y * SIDE][k] = above + (below - above) * v;
            }
            self.values[at + x + y * SIDE][END] = a[END].max(b[END]).max(c[END]).max(d[END]);
        }
    }
}

/// Mixes the lattice into the tile. Where a solid may stand in front of something that clouds hide, a ray is cast as
/// far as the solid, for every pixel.
#[simd]
fn finish<S: Simd>(simd: S, clouds: &SeenClouds, near: &[&SeenCloud], tile: &mut Tile, lattice: &mut Lattice) {
    let free = lattice.values.clone();
    for y in 0..tile.height {
        for x in 0..tile.width {
            let (at, point) = (x + y * Tile::SIZE, x + y * SIDE);
            if tile.coverage[at] > 0.0 && tile.inv_depth[at] * free[point][END] > 1.0 {
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
                plane[at] = plane[at] * before[TRANSMITTANCE] + before[k] * covered + free[k] * (1.0 - covered);
            }
            tile.coverage[at] = covered + (1.0 - covered) * (1.0 - free[TRANSMITTANCE]);
        }
    }
}

/// Casts rays through the points that are wanted: as far as the solids there, or without end.
#[simd]
fn cast<S: Simd>(simd: S, clouds: &SeenClouds, near: &[&SeenCloud], tile: &Tile, lattice: &mut Lattice, solids: bool) {
    let grid = clouds.settings.built().grid as u32;
    let step = 1.0 / grid as f32;
    for points in lattice.wanted.chunks(BLOCK) {
        let mut sum = [[0.0; BLOCK]; 5];
        for part in 0..grid * grid {
            let [mut x, mut y] = [[0.0; BLOCK]; 2];
            let mut depth = [f32::INFINITY; BLOCK];
            for (i, point) in points.iter().enumerate() {
                let (column, row) = (point % SIDE, point / SIDE);
                x[i] = to_f32(tile.x + column) + ((part % grid) as f32 + 0.5) * step;
                y[i] = to_f32(tile.y + row) + ((part / grid) as f32 + 0.5) * step;
                if solids {
                    depth[i] = 1.0 / tile.inv_depth[column + row * Tile::SIZE];
                }
            }
            cast_block(simd, clouds, near, [&x, &y, &depth], points.len(), &mut sum);
        }
        for (i, point) in points.iter().enumerate() {
            for (k, sum) in sum.iter().enumerate() {
                lattice.values[*point][k] = sum[i] * if k < END { step * step } else { 1.0 };
            }
        }
    }
    lattice.wanted.clear();
}

/// Casts rays through the first `count` of a block's points of the picture, in pixels, each as far as the depth there,
/// in metres along the view axis. Adds light and transmittance to `sum`, and takes the maximum of ends.
#[simd]
fn cast_block<S: Simd>(
    simd: S,
    clouds: &SeenClouds,
    near: &[&SeenCloud],
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
        let (mut transmittance, mut end) = (one, load::<S, F<S>>(simd, &sum[END], i));
        for seen in near {
            let passage: Passage<S> = seen.meet(simd, eye, d, limit, clouds.settings.built().opaque);
            let sunlit = CloudLight { sun: clouds.light.sun * seen.sunlit, ..clouds.light };
            let (color, passes) = passage.shine(simd, &sunlit, d);
            let color = V3::splat(simd, seen.veil) * Lane(one - passes) + color * Lane(F::<S>::splat(simd, seen.fades));
            light = light + color * Lane(transmittance);
            transmittance *= passes;
            end = passes.simd_lt(one).select(end.max(seen.end()), end);
            // A ray that is through ends by itself, by a limit of 0: its light must not depend on its vector's others.
            let ends = transmittance.simd_lt(clouds.settings.built().hidden);
            if ends.all_true() {
                break;
            }
            limit = ends.select(F::<S>::splat(simd, 0.0), limit);
        }
        for (sum, value) in sum.iter_mut().zip([light.x, light.y, light.z, transmittance]) {
            store(load::<S, F<S>>(simd, sum, i) + value, sum, i);
        }
        store(end, &mut sum[END], i);
        i += 1;
    }
}
