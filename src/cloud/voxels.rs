//! Density and light of a cloud in a cube of voxels, and lookups of both for a vector of points.
//!
//! A lookup is trilinear, and takes two reads of memory per point: the bytes of both values at two neighbours are packed
//! into one word, and two words lie side by side. Space is divided into blocks of 2 x 2 x 2 cells, each of which knows how
//! far around it nothing is, so that rays can leap over emptiness.

use crate::simd::lanes::{Bits, F, U, V3, float};
use crate::simd::math::to_f32;
use fearless_simd::prelude::*;
use glam::Vec3A;
use std::ops::Range;

/// Cells along an edge of a block, for which one leap is stored.
const LEAP: usize = 2;

/// Rings of blocks that are searched for emptiness: a leap is at most `RINGS * LEAP` cells.
const RINGS: usize = 28 / LEAP;

/// Steps from a point to the next one along y.
const DOWN: i32 = 1 << 14;

/// Density and sunlight at the points of a cubic lattice, trilinear between the points and constant beyond the outer
/// ones.
///
/// Light is kept in the words that lookups read alone; what is derived from the density is made again whenever that is
/// replaced.
#[derive(Clone)]
pub struct Voxels {
    /// Points along an edge: a multiple of 4, at most 128.
    edge: usize,
    /// See [`Voxels::density`].
    density: Vec<u8>,
    /// For each point, density and light of its own and of the next one along y. A layer and a point more: every lookup
    /// reads the next points along all axes, even where their share is 0.
    cells: Vec<[u8; 4]>,
    /// For each block, 0 where something is in it, otherwise 1 more than the number of cells around it, along any axis,
    /// within which nothing is.
    leaps: Vec<u8>,
    /// The binary logarithm of the length of a row of leaps, and of the number of rows in a layer.
    shift: u32,
    /// See [`Voxels::reach`].
    reach: f32,
    /// See [`Voxels::bounds`].
    bounds: [Vec3A; 2],
}

impl Voxels {
    /// What lookups give where the density, or the light, is 255.
    pub const FULL: f32 = (255 * DOWN) as f32;

    /// Fully lit voxels of `edge^3` densities, where `edge` is a multiple of 4 and at most 128.
    pub fn new(edge: usize, density: Vec<u8>) -> Voxels {
        let (cells, leaps) = (vec![[255; 4]; edge * edge * (edge + 1) + 1], Vec::new());
        debug_assert!(edge.is_multiple_of(4) && edge <= LEAP * u64::BITS as usize);
        let shift = (edge / LEAP).next_power_of_two().ilog2();
        let mut voxels = Voxels { edge, density, cells, leaps, shift, reach: 0.0, bounds: [Vec3A::ZERO; 2] };
        voxels.measure();
        voxels
    }

    /// Replaces the `edge^3` densities. The light stays as it is.
    pub fn set_density(&mut self, density: Vec<u8>) {
        self.density = density;
        self.measure();
    }

    /// Replaces the light of all `edge^3` points.
    pub fn set_light(&mut self, light: Vec<u8>) {
        for (point, light) in light.into_iter().enumerate() {
            self.put_light(point, light);
        }
    }

    /// Points along an edge.
    pub fn edge(&self) -> usize {
        self.edge
    }

    /// Density of each point, x fastest, then y, then z; 255 has the extinction coefficient of the [`Cloud`](super::Cloud).
    pub fn density(&self) -> &[u8] {
        &self.density
    }

    /// The share of the sun's light that reaches a point, numbered as [densities](Voxels::density) are, and is scattered
    /// there, of 255. It matters within the [bounds](Voxels::bounds).
    pub fn light(&self, point: usize) -> u8 {
        self.cells[point][1]
    }

    /// Distance from the centre of the cube to the farthest point where the density is not 0, halves of the cube's
    /// edge.
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// Least and largest coordinates of the box that holds every point where the density is not 0, halves of the cube's edge
    /// from its centre. Infinite, the least above the largest, where there is none.
    pub fn bounds(&self) -> [Vec3A; 2] {
        self.bounds
    }

    /// The points within the [bounds](Voxels::bounds) along an axis: those where the density is not 0, their neighbours, and
    /// what is between them.
    #[inline(never)]
    pub(super) fn extent(&self, axis: usize) -> Range<usize> {
        let edge = to_f32(self.edge);
        // The bounds are halfway between points.
        let point = |bound: f32| ((bound + 1.0) * edge * 0.5).max(0.0).min(edge - 1.0) as i32 as usize;
        let [low, high] = self.bounds;
        point(low[axis])..point(high[axis]) + 1
    }

    /// Writes the light of a point.
    #[inline(always)]
    pub(super) fn put_light(&mut self, point: usize, light: u8) {
        self.put(point, 1, light);
    }

    /// Writes a point's density, part 0, or light, part 1, into the words that lookups read.
    #[inline(always)]
    fn put(&mut self, point: usize, part: usize, value: u8) {
        self.cells[point][part] = value;
        if let Some(before) = point.checked_sub(self.edge) {
            self.cells[before][2 + part] = value;
        }
    }

    /// Derives from the density what lookups read, how far around each block nothing is, and how far the cloud reaches.
    fn measure(&mut self) {
        for point in 0..self.density.len() {
            self.put(point, 0, self.density[point]);
        }
        let n = self.edge / LEAP;
        let mut full = self.occupied();
        let (rows, mut known) = (full.len(), vec![0; full.len()]);
        self.leaps = vec![(1 + RINGS * LEAP) as u8; rows << self.shift];
        for ring in 0..RINGS + 1 {
            for row in 0..rows {
                for block in Bits(full[row] & !known[row]) {
                    self.leaps[(row << self.shift) + block] = (ring * LEAP).saturating_sub(LEAP - 1) as u8;
                }
            }
            known = full.clone();
            // One ring wider, an axis at a time. What runs over an edge comes in at the next layer, which can only make
            // leaps shorter.
            for row in &mut full {
                *row = (*row | *row << 1 | *row >> 1) & u64::MAX >> (64 - n);
            }
            for stride in [1, 1 << self.shift] {
                let before = full.clone();
                for row in stride..rows {
                    full[row] |= before[row - stride];
                    full[row - stride] |= before[row];
                }
            }
        }
    }

    /// Measures the reach. Returns for each row of blocks a word, in which a bit is set where anything is in a block's
    /// cells.
    #[inline(always)]
    fn occupied(&mut self) -> Vec<u64> {
        let half = to_f32(self.edge) * 0.5;
        let mut full = vec![0; (self.edge / LEAP) << self.shift];
        (self.reach, self.bounds) = (0.0, [Vec3A::INFINITY, Vec3A::NEG_INFINITY]);
        for (number, densities) in self.density.chunks(self.edge).enumerate() {
            let (y, z) = (number % self.edge, number / self.edge);
            let mut row = 0;
            for (x, _) in densities.iter().enumerate().filter(|(_, density)| **density > 0) {
                // Density falls to 0 only at the next point: hence one more.
                let at = Vec3A::from([x, y, z].map(|i| to_f32(i) + 0.5 - half));
                self.reach = self.reach.max((at.abs() + 1.0).length() / half);
                let [low, high] = self.bounds;
                self.bounds = [low.min((at - 1.0) / half), high.max((at + 1.0) / half)];
                // A point belongs to the cells on both of its sides along each axis.
                row |= 1 << (x / LEAP) | 1 << (x.saturating_sub(1) / LEAP);
            }
            for side in 0..4 {
                let [y, z] = [y.saturating_sub(side & 1), z.saturating_sub(side >> 1)].map(|place| place / LEAP);
                full[y + (z << self.shift)] |= row;
            }
        }
        full
    }

    /// 0 where something may be in the blocks that points `u` are in; otherwise 1 more than the number of cells along any
    /// axis, at least, within which nothing is around. Coordinates are those of [`Voxels::look_up`].
    #[inline(always)]
    pub fn leap<S: Simd>(&self, simd: S, u: V3<S>) -> U<S> {
        let block = |u: F<S>| u.to_int::<S::i32s>().bitcast::<U<S>>() >> LEAP.ilog2();
        let index = block(u.x) + (block(u.y) << self.shift) + (block(u.z) << (2 * self.shift));
        U::<S>::from_fn(simd, |lane| self.leaps[index[lane] as usize] as u32)
    }

    /// Density and light at points `u`, both of [`Voxels::FULL`]. Coordinates count points, from 0 to `edge - 1` along each axis.
    ///
    /// Along y places have steps of 2^-14 points, since there values are interpolated as whole numbers: two products
    /// and their sum are one instruction, and half as many numbers become floats. So are the numbers of points summed up.
    #[inline(always)]
    pub fn look_up<S: Simd>(&self, simd: S, u: V3<S>) -> [F<S>; 2] {
        let [x, y, z] = [u.x.to_int::<S::i32s>(), u.y.to_int::<S::i32s>(), u.z.to_int::<S::i32s>()];
        let (fx, fy, fz) = (u.x - x.to_float::<F<S>>(), u.y - y.to_float::<F<S>>(), u.z - z.to_float::<F<S>>());
        let (row, layer) = (self.edge as i32, (self.edge * self.edge) as i32);
        let in_layer = pairwise::<S>(x | y << 16, S::i32s::splat(simd, 1 | row << 16));
        let at = (in_layer + pairwise::<S>(z, S::i32s::splat(simd, layer))).bitcast();
        let (near, far) = (self.pairs(simd, at, 0), self.pairs(simd, at, self.edge * self.edge));
        let share = (fy * DOWN as f32 + 0.5).to_int::<S::i32s>();
        // The share of this point, and that of the next one 16 bits higher.
        let shares = share << 16 | (-share + DOWN);
        // A loop: what `map` calls is not always inlined, and then no lane operation in it is.
        let mut found = [F::<S>::splat(simd, 0.0); 2];
        let mut k = 0;
        while k < 2 {
            let shift = 8 * k as u32;
            let (a, b) = (square::<S>(near, shift, shares, fx), square::<S>(far, shift, shares, fx));
            found[k] = a + (b - a) * fz;
            k += 1;
        }
        found
    }

    /// The words of points, and of the next ones along x, a number of points further on.
    #[inline(always)]
    fn pairs<S: Simd>(&self, simd: S, at: U<S>, further: usize) -> [U<S>; 2] {
        let cells = &self.cells[further..];
        // A loop: `map` is not inlined.
        let mut halves = [U::<S>::splat(simd, 0); 2];
        for (k, half) in halves.iter_mut().enumerate() {
            let pairs = S::u64s::from_fn(
                simd,
                #[inline(always)]
                |lane| {
                    let at = at[k * S::u64s::LEN + lane] as usize;
                    let pair = &cells[at..at + 2];
                    u32::from_le_bytes(pair[0]) as u64 | (u32::from_le_bytes(pair[1]) as u64) << 32
                },
            );
            *half = pairs.bitcast();
        }
        let [low, high] = halves;
        [low.unzip_low(high), low.unzip_high(high)]
    }
}

/// Bilinear interpolation of a square's four corners, times [`DOWN`]: the bytes at `shift` and `shift + 16` of two words,
/// along y by `shares`, and the words along x.
#[inline(always)]
fn square<S: Simd>([left, right]: [U<S>; 2], shift: u32, shares: S::i32s, fx: F<S>) -> F<S> {
    let a = pairwise::<S>((left >> shift & 0x00ff_00ff).bitcast(), shares);
    let b = pairwise::<S>((right >> shift & 0x00ff_00ff).bitcast(), shares);
    a.to_float::<F<S>>() + (b - a).to_float::<F<S>>() * fx
}

/// The product of the lower 16 bits, plus that of the upper 16, both signed.
#[inline(always)]
fn pairwise<S: Simd>(a: S::i32s, b: S::i32s) -> S::i32s {
    a.bitcast::<S::i16s>().pairwise_dot_product(b.bitcast::<S::i16s>())
}

/// Bilinear interpolation of a square's four corners, which are the bytes of a word: x fastest.
#[inline(always)]
pub(super) fn bilinear<S: Simd>(simd: S, word: U<S>, x: F<S>, y: F<S>) -> F<S> {
    let a = float(simd, word & 255);
    let b = float(simd, word >> 8 & 255);
    let c = float(simd, word >> 16 & 255);
    let d = float(simd, word >> 24);
    let (a, c) = (a + (b - a) * x, c + (d - c) * x);
    a + (c - a) * y
}
