//! The samples of a tile, on a lattice whose steps are pixels or halves of pixels.

use super::job::Job;
use super::packet;
use super::sample::Sample;
use crate::cuts;
use crate::frame::Tile;
use crate::simd::math::to_f32;
use fearless_simd::prelude::*;

/// Most lattice points along a tile's edge: at half pixels, with both ends.
const LATTICE: usize = Tile::SIZE * 2 + 1;
/// Lattice points from one row to the next: behind each row as many that have no sample as a pixel has, so that a pixel beyond
/// either end of a row has none either.
const ROW: usize = LATTICE + 2;

/// A place in a square, halves of its edge from its top left.
type Place = (usize, usize);

/// The sides of a square: middle and ends.
pub const SIDES: [(Place, [Place; 2]); 4] =
    [((1, 0), [(0, 0), (2, 0)]), ((0, 1), [(0, 0), (0, 2)]), ((2, 1), [(2, 0), (2, 2)]), ((1, 2), [(0, 2), (2, 2)])];

/// A square of the lattice. It is one word, since squares are copied a lot.
#[derive(Clone, Copy)]
#[repr(align(8))]
pub struct Square {
    x: u16,
    y: u16,
    size: u16,
}

impl Square {
    /// The square whose top left is at the column `x` and the row `y` of the lattice, and whose edges have `size` steps.
    #[inline(always)]
    pub fn new(x: usize, y: usize, size: usize) -> Square {
        Square { x: x as u16, y: y as u16, size: size as u16 }
    }

    /// Left column and top row.
    #[inline(always)]
    pub fn place(self) -> (usize, usize) {
        (self.x.into(), self.y.into())
    }

    /// Length of an edge, lattice steps.
    #[inline(always)]
    pub fn size(self) -> usize {
        self.size.into()
    }

    /// The lattice point at a place in it. The edge has to be even.
    #[inline(always)]
    pub fn point(self, (column, row): Place) -> (usize, usize) {
        let ((x, y), half) = (self.place(), self.size() / 2);
        (x + column * half, y + row * half)
    }
}

/// The samples of a tile, and the points of the lattice that are to be traced next.
#[derive(Default)]
pub struct Grid {
    /// For each lattice point the generation that traced it, and the index of its sample. A generation is one use of the
    /// grid, so that the lattice need not be cleared for the next one.
    lattice: Vec<(u32, u32)>,
    generation: u32,
    /// Where the lattice begins, pixels from the picture's top left.
    first: (f32, f32),
    /// Length of a lattice step, pixels.
    step: f32,
    /// Samples, of which the first `count` are of this tile.
    samples: Vec<Sample>,
    count: usize,
    /// How many of these are foretold and not traced.
    foretold: usize,
    /// Where the samples lie, pixels from the picture's top left, NaN where they are foretold; behind the last sample, the
    /// points that are wanted. There is room for the whole lattice: in the packed file a list that may grow takes three times
    /// as long to add to.
    xs: Vec<f32>,
    ys: Vec<f32>,
    /// The number of samples and wanted points together.
    wanted: usize,
}

impl Grid {
    /// Forgets all samples, for another tile. The lattice begins `dx` and `dy` pixels from the tile's top left.
    pub fn begin(&mut self, job: &Job, tile: &Tile, dx: f32, dy: f32) {
        self.first = (to_f32(tile.x) + dx, to_f32(tile.y) + dy);
        self.step = 1.0 / to_f32(job.unit());
        if self.lattice.is_empty() {
            self.lattice = vec![(0, 0); ROW * LATTICE];
            self.xs = vec![0.0; LATTICE * LATTICE];
            self.ys = vec![0.0; LATTICE * LATTICE];
        }
        self.generation = self.generation.wrapping_add(1).max(1);
        self.count = 0;
        self.foretold = 0;
        self.wanted = 0;
    }

    /// Asks for the sample at a lattice point, if it is not there yet.
    #[inline(never)] // As fast as inlined, and 90 bytes less packed.
    pub fn want(&mut self, x: usize, y: usize) {
        if !self.has(x, y) {
            self.add(x, y);
        }
    }

    /// Whether there is a sample at a lattice point, or one is wanted.
    #[inline(always)]
    pub fn has(&self, x: usize, y: usize) -> bool {
        self.lattice[y * ROW + x].0 == self.generation
    }

    /// Puts the mean of a side's ends in its middle, instead of tracing it, where nothing is there and both ends are of one
    /// surface. No point may be wanted.
    #[inline(always)]
    pub fn foretell<S: Simd>(&mut self, simd: S, square: Square, middle: Place, ends: [Place; 2]) {
        let (x, y) = square.point(middle);
        let [a, b] = ends.map(|end| self.index(square.point(end)));
        if self.has(x, y) || self.samples[a].path_signature != self.samples[b].path_signature {
            return;
        }
        self.add(x, y);
        self.make_room();
        let (known, new) = self.samples.split_at_mut(self.count);
        new[0].set_mean(simd, [&known[a], &known[b], &known[a], &known[b]]);
        if cuts::BENCH {
            self.xs[self.count] = f32::NAN;
            self.foretold += 1;
        }
        self.count += 1;
    }

    /// Makes room for the samples at all points that are wanted.
    fn make_room(&mut self) {
        while self.samples.len() < self.wanted {
            self.samples.push(Sample::default());
        }
    }

    fn add(&mut self, x: usize, y: usize) {
        let at = self.wanted;
        self.lattice[y * ROW + x] = (self.generation, at as u32);
        self.xs[at] = self.first.0 + to_f32(x) * self.step;
        self.ys[at] = self.first.1 + to_f32(y) * self.step;
        self.wanted = at + 1;
    }

    /// The number of samples that have been traced.
    pub fn samples(&self) -> usize {
        self.count - self.foretold
    }

    /// Where the samples lie that have been traced, pixels from the picture's top left.
    #[cfg(feature = "full")]
    pub fn positions(&self) -> impl Iterator<Item = (f32, f32)> {
        let points = self.xs.iter().copied().zip(self.ys.iter().copied());
        points.take(self.count).filter(|(x, _)| !x.is_nan())
    }

    /// The sample at a lattice point, which must be there.
    pub fn at(&self, x: usize, y: usize) -> &Sample {
        &self.samples[self.index((x, y))]
    }

    /// The index of the sample at a lattice point.
    #[inline(always)]
    fn index(&self, (x, y): (usize, usize)) -> usize {
        self.lattice[y * ROW + x].1 as usize
    }

    /// The samples at two places of a square.
    #[inline(always)]
    pub fn pair(&self, square: Square, [a, b]: [Place; 2]) -> [&Sample; 2] {
        let ((ax, ay), (bx, by)) = (square.point(a), square.point(b));
        [self.at(ax, ay), self.at(bx, by)]
    }

    /// The corners of a square: top left, top right, bottom left, bottom right.
    pub fn corners(&self, square: Square) -> [&Sample; 4] {
        let ((x, y), size) = (square.place(), square.size());
        [self.at(x, y), self.at(x + size, y), self.at(x, y + size), self.at(x + size, y + size)]
    }

    /// The sample in the middle of a square.
    pub fn centre(&self, square: Square) -> &Sample {
        let (x, y) = square.point((1, 1));
        self.at(x, y)
    }

    /// How the edge between two surfaces lies in a pixel whose corners see both, as its neighbours tell: up to 1/4 where the
    /// surface whose path signature is `first` has more of the pixel, down to -1/4 where the other one has.
    ///
    /// A side whose ends are of one surface counts for it, unless the edge crosses its line within a pixel beyond one of its
    /// ends.
    #[inline(never)]
    pub fn lean(&self, pixel: Square, first: u32) -> f32 {
        let mut lean = 0.0;
        let (x, y) = pixel.place();
        let start = y * ROW + x;
        // Side by side, around the pixel.
        let (mut near, mut step, mut next) = (start, 2, 2 * ROW);
        loop {
            let far = near.wrapping_add(step);
            let corner = self.path(near, 0);
            let before = self.path(near.wrapping_sub(step), corner);
            if self.path(far, 0) == corner && before == self.path(far.wrapping_add(step), corner) {
                lean += if corner == first { 0.125 } else { -0.125 };
            }
            (step, next) = (next, step.wrapping_neg());
            near = far;
            if near == start {
                return lean;
            }
        }
    }

    /// The path signature of the sample at an index of the lattice, or another number if there is none.
    fn path(&self, index: usize, otherwise: u32) -> u32 {
        match self.lattice.get(index) {
            Some(&(generation, sample)) if generation == self.generation => {
                self.samples[sample as usize].path_signature
            }
            _ => otherwise,
        }
    }

    /// Traces the points that are wanted.
    #[inline(always)]
    pub fn trace<S: Simd>(&mut self, simd: S, job: &Job) {
        let (first, end) = (self.count, self.wanted);
        self.make_room();
        let [xs, ys] = [&self.xs, &self.ys].map(|numbers| &numbers[first..end]);
        packet::trace(simd, &job.context, xs, ys, &mut self.samples[first..end]);
        self.count = end;
    }

    /// Whether a sample between the ends of a line of lattice points has another path signature.
    ///
    /// Lines are halved: where the middle has not been traced, no point between it and the ends has been.
    fn crossed(&self, (x, y): (usize, usize), (dx, dy): (usize, usize), length: usize, path_signature: u32) -> bool {
        let half = length / 2;
        if half == 0 {
            return false;
        }
        let middle = (x + dx * half, y + dy * half);
        if !self.has(middle.0, middle.1) {
            return false;
        }
        self.at(middle.0, middle.1).path_signature != path_signature
            || self.crossed((x, y), (dx, dy), half, path_signature)
            || self.crossed(middle, (dx, dy), half, path_signature)
    }

    /// Whether an edge enters a square between two corners: whether a neighbour's sample on its border has another path
    /// signature than its corners.
    pub fn entered(&self, square: Square) -> bool {
        let ((x, y), size) = (square.place(), square.size());
        let path_signature = self.at(x, y).path_signature;
        self.crossed((x, y), (1, 0), size, path_signature)
            || self.crossed((x, y), (0, 1), size, path_signature)
            || self.crossed((x, y + size), (1, 0), size, path_signature)
            || self.crossed((x + size, y), (0, 1), size, path_signature)
    }
}

/// Whether the corners of a square have the same path signature.
pub fn same_path(c: [&Sample; 4]) -> bool {
    c[0].path_signature == c[1].path_signature
        && c[0].path_signature == c[2].path_signature
        && c[0].path_signature == c[3].path_signature
}
