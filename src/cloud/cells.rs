//! Clouds in a tile: which pixels get a ray, and what the others show.
//!
//! Clouds are smooth over most of the picture, so rays are cast at the corners of square cells of pixels only. A ray in
//! the middle of each cell tells how far off bilinear interpolation would be: either the cell is interpolated, or it is
//! cut into four, down to single pixels. The reference is [`cell`](crate::settings::CloudSettings::cell) at 1, a ray
//! through every pixel.
//!
//! Solids are in the tile already. A ray is cast once as if there were none; and where a solid may stand in front of
//! something that clouds hide, once more as far as the solid. The pixel's coverage mixes the two.
//!
//! The first of the two is cast before solids are drawn, so that those which clouds hide anyway are left out.

use super::march::Passage;
use super::seen::{SeenCloud, SeenClouds};
use super::world::CloudLight;
use crate::frame::Tile;
use crate::settings::CloudSettings;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{Bits, F, Lane, STEPS, V3, masked};
use crate::simd::math::to_f32;
use fearless_simd::{Level, dispatch, f32x8, prelude::*, u32x8};
use fearless_simd_macros::simd;
use glam::Vec3A;
use std::f32::consts::SQRT_2;

/// Points along an edge of a tile's lattice: its pixels, and the first ones of the next tile.
const SIDE: usize = Tile::SIZE + 1;

/// Points from one row of a lattice to the next: a vector may begin at each point of a row.
const ROW: usize = Tile::SIZE + 16;
/// Edge of cells that are coarse enough for no picture, pixels.
const LEAST: usize = 4;
/// Coarser cells are at most as high as the picture's height divided by this.
const CELLS: usize = 45;

/// Solids of which no more than this comes through clouds are never drawn: it is a thirtieth of a code where codes are
/// darkest. Were they drawn, they would show beside nearer ones in the same pixel, which has one depth.
const NOTHING: f32 = 1.0 / 65536.0;

/// A plane of a lattice.
type Plane = [f32; ROW * SIDE];

/// The planes of a lattice. What a ray gives: premultiplied red, green and blue; transmittance; the distance in metres
/// beyond which no cloud hides anything.
type Planes = [Plane; 5];

/// Indices into [`Planes`].
const TRANSMITTANCE: usize = 3;
const END: usize = 4;

/// The points of a tile.
struct Lattice<'a> {
    planes: &'a mut Planes,
    /// Whether a ray has been cast through the point, or is to be.
    known: Vec<bool>,
    /// The top left corners of all cells of the size that is next.
    cells: Vec<usize>,
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
        [at, at + size, at + size * ROW, at + size * ROW + size]
    }

    #[inline(always)]
    fn middle(self) -> usize {
        self.at + (self.size / 2) * (ROW + 1)
    }
}

/// Finds what rays through a tile meet, as if there were no solids, and says from where on clouds hide all but
/// [`hidden`](crate::settings::CloudSettings::hidden) of what is there.
pub(super) fn foresee(level: Level, clouds: &SeenClouds, tile: &mut Tile) {
    let near = clouds.near(tile);
    if near.is_empty() {
        tile.hidden.fill(0.0);
    } else {
        dispatch!(level, simd => foresee_near(simd, clouds, &near, tile));
    }
}

/// Draws clouds into a tile: adds their light, takes what they hide from what is there, and counts it as covered.
pub(super) fn draw(level: Level, clouds: &SeenClouds, tile: &mut Tile) {
    let near = clouds.near(tile);
    if !near.is_empty() {
        dispatch!(level, simd => draw_near(simd, clouds, &near, tile));
    }
}

#[simd]
fn foresee_near<S: Simd>(simd: S, clouds: &SeenClouds, near: &[&SeenCloud], tile: &mut Tile) {
    let lanes = F::<S>::LEN;
    let mut planes = std::mem::take(&mut tile.foreseen);
    planes.resize(size_of::<Planes>() / size_of::<f32>(), 0.0);
    let free = &mut planes.as_chunks_mut().0.as_chunks_mut().0[0];
    find(simd, clouds, near, tile, free);
    for y in 0..Tile::SIZE {
        for x in (0..Tile::SIZE).step_by(lanes) {
            let point = x + y * ROW..x + y * ROW + lanes;
            let passes = F::<S>::from_slice(simd, &free[TRANSMITTANCE][point.clone()]);
            let end = F::<S>::from_slice(simd, &free[END][point]);
            let ends = passes.simd_lt(clouds.settings.built().hidden.max(NOTHING));
            let hidden = masked::<S>(F::<S>::splat(simd, 1.0) / end, ends);
            hidden.store_slice(&mut tile.hidden[x + y * Tile::SIZE..][..lanes]);
        }
    }
    tile.foreseen = planes;
}

/// Draws the clouds that rays through a tile may meet.
#[simd]
fn draw_near<S: Simd>(simd: S, clouds: &SeenClouds, near: &[&SeenCloud], tile: &mut Tile) {
    if tile.foreseen.is_empty() {
        foresee_near(simd, clouds, near, tile);
    }
    let mut planes = std::mem::take(&mut tile.foreseen);
    mix(simd, clouds, near, tile, &planes.as_chunks().0.as_chunks().0[0]);
    // The memory serves the next tile.
    planes.clear();
    tile.foreseen = planes;
}

/// Finds what rays through all pixels of a tile meet, as if there were no solids.
///
/// ```text
/// for each size of cells, from the coarsest to 1:
///     cast rays through the corners and the middles of all cells of that size
///     interpolate each cell, or cut it into four of half the size
/// ```
///
/// Rays are cast for all cells of a size at once, so that vectors are full.
#[simd]
fn find<S: Simd>(simd: S, clouds: &SeenClouds, near: &[&SeenCloud], tile: &Tile, planes: &mut Planes) {
    let CloudSettings { cell: mut size, threshold, .. } = clouds.settings.built();
    // In a small picture as many pixels are a larger part of a cloud, and what lies between their rays is missed.
    while size > LEAST && size * CELLS > clouds.view.height() {
        size /= 2;
    }
    // The middles of the smallest cells to be interpolated, of two pixels, may be off by the threshold. In a larger cell more
    // pixels are off, and its rays cost no more: the larger, the less is allowed, by (2 / size)^1.5.
    let share = 2.0 / to_f32(size);
    let mut allowed = threshold * share * share.sqrt();
    let known = vec![false; planes[0].len()];
    let mut lattice = Lattice { planes, known, cells: Vec::new(), wanted: Vec::new() };
    let mut y = 0;
    while y < tile.height {
        let mut x = 0;
        while x < tile.width {
            lattice.cells.push(x + y * ROW);
            x += size;
        }
        y += size;
    }
    loop {
        let cells = std::mem::take(&mut lattice.cells);
        for &at in &cells {
            let cell = Cell { at, size };
            let [a, b, c, d] = cell.corners();
            // Of a pixel the middle is its first corner.
            for &point in &[cell.middle(), a, b, c, d][..if size == 1 { 1 } else { 5 }] {
                if !lattice.known[point] {
                    lattice.known[point] = true;
                    lattice.wanted.push(point);
                }
            }
        }
        cast(simd, clouds, near, tile, &lattice.wanted, false, lattice.planes);
        lattice.wanted.clear();
        if size == 1 {
            return;
        }
        for &at in &cells {
            lattice.fill_or_cut(simd, tile, Cell { at, size }, allowed);
        }
        size /= 2;
        allowed *= 2.0 * SQRT_2;
    }
}

impl Lattice<'_> {
    /// Interpolates a cell where its middle is off by at most `allowed`; cuts it into four otherwise.
    #[inline(always)]
    fn fill_or_cut<S: Simd>(&mut self, simd: S, tile: &Tile, cell: Cell, allowed: f32) {
        let Cell { at, size } = cell;
        let (corners, middle) = (cell.corners(), cell.middle());
        let mut error = 0.0f32;
        for plane in &self.planes[..END] {
            let [a, b, c, d] = corners.map(|corner| plane[corner]);
            error = error.max((plane[middle] - (a + b + c + d) * 0.25).abs());
        }
        if error > allowed {
            for part in [at, at + size / 2, middle - size / 2, middle] {
                // Not those beyond the picture's end.
                if part % ROW < tile.width && part / ROW < tile.height {
                    self.cells.push(part);
                }
            }
        } else {
            self.fill(simd, cell);
        }
    }

    /// Fills a cell's points by bilinear interpolation between its corners, over which a tent is put up so that it meets the
    /// middle and goes nowhere beyond the five; but ends are the farthest of the four corners'.
    #[inline(always)]
    fn fill<S: Simd>(&mut self, simd: S, cell: Cell) {
        let Cell { at, size } = cell;
        let (middle, share) = (cell.middle(), 1.0 / to_f32(size));
        for (k, plane) in self.planes.iter_mut().enumerate() {
            let [mut a, mut b, mut c, mut d] = cell.corners().map(|corner| plane[corner]);
            let mut off = plane[middle] - (a + b + c + d) * 0.25;
            if k == END {
                a = a.max(b).max(c).max(d);
                (b, c, d, off) = (a, a, a, 0.0);
            }
            let one = f32x8::splat(simd, 1.0);
            let mut u = u32x8::from_slice(simd, &STEPS[..8]).to_float::<f32x8<S>>() * share;
            for column in (0..size).step_by(8) {
                let (above, below) = (u * (b - a) + a, u * (d - c) + c);
                let (change, tent) = (below - above, u.min(one - u));
                let mut down = f32x8::splat(simd, 0.0);
                for y in 0..size {
                    let light = above + change * down + tent * (down.min(one - down) * (4.0 * off));
                    // What is written is a cell's width and no more: vectors that hang over would have to read what the
                    // cell before has just written, and wait for it.
                    let row = &mut plane[at + column + y * ROW..];
                    match size {
                        2 => row[..2].copy_from_slice(&light.as_slice()[..2]),
                        4 => row[..4].copy_from_slice(&light.as_slice()[..4]),
                        _ => light.store_slice(&mut row[..8]),
                    }
                    down += share;
                }
                u += 8.0 * share;
            }
        }
    }
}

/// Mixes into the tile what rays meet: `free`, as if there were no solids. Where a solid may stand in front of something
/// that clouds hide, a ray is cast as far as the solid, for every pixel.
#[simd]
fn mix<S: Simd>(simd: S, clouds: &SeenClouds, near: &[&SeenCloud], tile: &mut Tile, free: &Planes) {
    let lanes = F::<S>::LEN;
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let mut wanted = Vec::new();
    for y in 0..tile.height {
        for x in (0..tile.width).step_by(lanes) {
            let (at, point) = (x + y * Tile::SIZE, x + y * ROW);
            let vector = |plane: &[f32], at: usize| F::<S>::from_slice(simd, &plane[at..at + lanes]);
            let within = vector(&*tile.inv_depth, at) * vector(&free[END], point);
            let stands = vector(&*tile.coverage, at).simd_gt(zero) & within.simd_gt(one);
            for lane in Bits(stands.to_bitmask()) {
                if x + lane < tile.width {
                    wanted.push(point + lane);
                }
            }
        }
    }
    let mut planes = Vec::new();
    let mut before = free;
    if !wanted.is_empty() {
        planes.extend_from_slice(free);
        let planes = &mut planes.as_chunks_mut().0[0];
        cast(simd, clouds, near, tile, &wanted, true, planes);
        before = planes;
    }
    for y in 0..tile.height {
        for x in (0..tile.width).step_by(lanes) {
            let (at, point) = (x + y * Tile::SIZE, x + y * ROW);
            let vector = |plane: &[f32], at: usize| F::<S>::from_slice(simd, &plane[at..at + lanes]);
            let covered = vector(&*tile.coverage, at);
            let open = one - covered;
            for (k, plane) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().enumerate() {
                let light = vector(&**plane, at) * vector(&before[TRANSMITTANCE], point)
                    + vector(&before[k], point) * covered
                    + vector(&free[k], point) * open;
                light.store_slice(&mut plane[at..at + lanes]);
            }
            let covered = covered + open * (one - vector(&free[TRANSMITTANCE], point));
            covered.store_slice(&mut tile.coverage[at..at + lanes]);
        }
    }
}

/// Casts rays through points: as far as the solids there, or without end.
#[simd]
fn cast<S: Simd>(
    simd: S,
    clouds: &SeenClouds,
    near: &[&SeenCloud],
    tile: &Tile,
    points: &[usize],
    solids: bool,
    planes: &mut Planes,
) {
    let grid = clouds.settings.built().grid as u32;
    let step = 1.0 / grid as f32;
    for points in points.chunks(BLOCK) {
        let mut sum = [[0.0; BLOCK]; 5];
        for part in 0..grid * grid {
            let [mut x, mut y] = [[0.0; BLOCK]; 2];
            let mut depth = [f32::INFINITY; BLOCK];
            for (i, point) in points.iter().enumerate() {
                let (column, row) = (point % ROW, point / ROW);
                x[i] = to_f32(tile.x + column) + ((part % grid) as f32 + 0.5) * step;
                y[i] = to_f32(tile.y + row) + ((part / grid) as f32 + 0.5) * step;
                if solids {
                    depth[i] = 1.0 / tile.inv_depth[column + row * Tile::SIZE];
                }
            }
            cast_block(simd, clouds, near, [&x, &y, &depth], points.len(), &mut sum);
        }
        for (k, (plane, sum)) in planes.iter_mut().zip(&sum).enumerate() {
            let share = if k < END { step * step } else { 1.0 };
            for (point, sum) in points.iter().zip(sum) {
                plane[*point] = sum * share;
            }
        }
    }
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
    let (eye, settings) = (clouds.view.camera().eye, clouds.settings.built());
    let one = F::<S>::splat(simd, 1.0);
    let mut i = 0;
    while i * F::<S>::LEN < count {
        let ray = clouds.view.rays(simd, load(simd, x, i), load(simd, y, i));
        let length = ray.dot(ray).sqrt();
        let d = ray * Lane(one / length);
        let mut limit = load::<S, F<S>>(simd, depth, i) * length;
        let mut light = V3::splat(simd, Vec3A::ZERO);
        let (mut transmittance, mut end) = (one, load::<S, F<S>>(simd, &sum[END], i));
        for seen in near {
            // The less nearer clouds let through, the earlier it ends in this one.
            let mut opaque = F::<S>::splat(simd, settings.opaque) / transmittance;
            // But not where it has met nothing, lest its company say when.
            if settings.opaque > settings.hidden {
                opaque = opaque.min(one);
            }
            let passage: Passage<S> = seen.meet(simd, eye, d, limit, opaque);
            let ended = passage.end.min(seen.end());
            let sunlit = CloudLight { sun: clouds.light.sun * seen.sunlit, ..clouds.light };
            let hides = passage.hidden;
            let (color, passes) = passage.shine(simd, &sunlit, d);
            let color = V3::splat(simd, seen.veil) * Lane(hides) + color * Lane(F::<S>::splat(simd, seen.fades));
            light = light + color * Lane(transmittance);
            transmittance *= passes;
            end = passes.simd_lt(one).select(end.max(ended), end);
            // A ray that is through ends by itself, by a limit of 0: its light must not depend on its vector's others.
            let ends = transmittance.simd_lt(settings.hidden);
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
