//! The samples of a tile, on a lattice of pixels or parts of pixels.

use super::adaptive::Job;
use super::packet;
use super::sample::Sample;
use crate::frame::Tile;
use fearless_simd::prelude::*;

/// Most lattice points along a tile's edge: quarter pixels, both ends.
const LATTICE: usize = Tile::SIZE * 4 + 1;

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

impl Square {
    /// Its four parts.
    pub fn quarters(self) -> [Square; 4] {
        let (Square { x, y, .. }, size) = (self, self.size / 2);
        [(x, y), (x + size, y), (x, y + size), (x + size, y + size)].map(|(x, y)| Square { x, y, size })
    }
}

/// The samples of a tile, on a lattice of pixels or parts of pixels.
#[derive(Default)]
pub struct Grid {
    /// For each lattice point the generation that traced it and its sample.
    lattice: Vec<(u32, u32)>,
    generation: u32,
    /// Where the lattice begins, pixels of the picture, and its steps.
    first: (f32, f32),
    step: f32,
    /// The first `count` are of this tile.
    samples: Vec<Sample>,
    count: usize,
    /// Where the samples are, pixels of the picture; behind the last sample, where those lie that are asked for.
    xs: Vec<f32>,
    ys: Vec<f32>,
}

impl Grid {
    /// Forgets all samples, for a tile of a job; the lattice begins so many pixels from the tile's corner.
    pub fn begin(&mut self, job: &Job, tile: &Tile, dx: f32, dy: f32) {
        self.first = (tile.x as u32 as f32 + dx, tile.y as u32 as f32 + dy);
        self.step = 1.0 / job.unit() as u32 as f32;
        if self.lattice.is_empty() {
            self.lattice = vec![(0, 0); LATTICE * LATTICE];
        }
        self.generation = self.generation.wrapping_add(1).max(1);
        self.count = 0;
        self.xs.clear();
        self.ys.clear();
    }

    /// Asks for the sample at a lattice point, if it is not there yet.
    #[inline(always)]
    pub fn want(&mut self, x: usize, y: usize) {
        // Most corners are there, from a neighbour: that much is asked on the spot.
        if self.lattice[y * LATTICE + x].0 != self.generation {
            self.add(x, y);
        }
    }

    fn add(&mut self, x: usize, y: usize) {
        self.lattice[y * LATTICE + x] = (self.generation, self.xs.len() as u32);
        self.xs.push(self.first.0 + x as u32 as f32 * self.step);
        self.ys.push(self.first.1 + y as u32 as f32 * self.step);
    }

    /// How many samples have been traced.
    pub fn samples(&self) -> usize {
        self.count
    }

    /// Where the samples are, pixels of the picture.
    #[cfg(feature = "full")]
    pub fn positions(&self) -> impl Iterator<Item = (f32, f32)> {
        self.xs.iter().copied().zip(self.ys.iter().copied())
    }

    /// The sample at a lattice point that has been traced.
    pub fn at(&self, x: usize, y: usize) -> &Sample {
        &self.samples[self.lattice[y * LATTICE + x].1 as usize]
    }

    /// The corners of a square: top left, top right, bottom left, bottom right.
    pub fn corners(&self, Square { x, y, size }: Square) -> [&Sample; 4] {
        [self.at(x, y), self.at(x + size, y), self.at(x, y + size), self.at(x + size, y + size)]
    }

    /// The sample in the middle of a square.
    pub fn centre(&self, Square { x, y, size }: Square) -> &Sample {
        self.at(x + size / 2, y + size / 2)
    }

    /// Traces all that was asked for.
    #[inline(always)]
    pub fn trace<S: Simd>(&mut self, simd: S, job: &Job) {
        let (first, end) = (self.count, self.xs.len());
        while self.samples.len() < end {
            self.samples.push(Sample::default());
        }
        packet::trace(simd, &job.context, &self.xs[first..], &self.ys[first..], &mut self.samples[first..end]);
        self.count = end;
    }

    /// Does a sample between the ends of a line of lattice points have another chain?
    ///
    /// Lines are cut in the middle: where the middle has not been traced, nothing between it and the ends has.
    fn crossed(&self, (x, y): (usize, usize), (dx, dy): (usize, usize), length: usize, path_signature: u32) -> bool {
        let half = length / 2;
        if half == 0 {
            return false;
        }
        let middle = (x + dx * half, y + dy * half);
        if self.lattice[middle.1 * LATTICE + middle.0].0 != self.generation {
            return false;
        }
        self.at(middle.0, middle.1).path_signature != path_signature
            || self.crossed((x, y), (dx, dy), half, path_signature)
            || self.crossed(middle, (dx, dy), half, path_signature)
    }

    /// Does an edge enter a square from a neighbour?
    pub fn entered(&self, Square { x, y, size }: Square) -> bool {
        let path_signature = self.at(x, y).path_signature;
        self.crossed((x, y), (1, 0), size, path_signature)
            || self.crossed((x, y), (0, 1), size, path_signature)
            || self.crossed((x, y + size), (1, 0), size, path_signature)
            || self.crossed((x + size, y), (0, 1), size, path_signature)
    }
}

/// Do the corners have one chain?
pub fn same_path(c: [&Sample; 4]) -> bool {
    c[0].path_signature == c[1].path_signature
        && c[0].path_signature == c[2].path_signature
        && c[0].path_signature == c[3].path_signature
}
