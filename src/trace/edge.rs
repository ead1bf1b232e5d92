//! Pixels that an edge runs through: the surfaces seen in them, each with its share of the area.
//!
//! Samples with the same path signature are of one surface. They are averaged before textures are looked up, so that each
//! surface in a pixel has its textures evaluated once.

use super::grid::{Grid, Square, same_path};
use super::sample::{self, NUMBERS, Sample};
use crate::simd::lanes::F;
use fearless_simd::prelude::*;

/// Most lattice points along the edge of a pixel: at quarter pixels, with both ends.
const POINTS: usize = 5;

/// One surface in a pixel.
#[derive(Clone, Copy)]
pub struct Group {
    /// Share of the pixel's area, 0 to 1.
    pub share: f32,
    /// The mean of its samples, which have one path signature.
    pub mean: Sample,
}

/// The surfaces in one pixel, with memory for as many as there can be.
pub struct Groups {
    count: usize,
    list: [Group; POINTS * POINTS],
}

impl Default for Groups {
    fn default() -> Groups {
        Groups { count: 0, list: [Group { share: 0.0, mean: Sample::default() }; POINTS * POINTS] }
    }
}

impl Groups {
    /// The surfaces in a pixel, given as a square of the lattice that has been cut.
    #[inline(always)]
    pub fn of_pixel<S: Simd>(&mut self, simd: S, grid: &Grid, pixel: Square) -> &[Group] {
        let mut weights = Weights::default();
        for part in pixel.quarters() {
            weigh(grid, part, 0.25, pixel, &mut weights);
        }
        self.count = 0;
        for (row, weights) in weights[..=pixel.size].iter().enumerate() {
            for (column, &weight) in weights[..=pixel.size].iter().enumerate() {
                if weight > 0.0 {
                    self.add(simd, grid.at(pixel.x + column, pixel.y + row), weight);
                }
            }
        }
        let groups = &mut self.list[..self.count];
        for group in &mut *groups {
            let k = 1.0 / group.share;
            for i in (0..group.mean.used()).step_by(F::<S>::LEN) {
                let sum = sample::load(simd, &group.mean.numbers, i);
                sample::store::<S>(sum * k, &mut group.mean.numbers, i);
            }
        }
        groups
    }

    /// Adds a sample to those with its path signature.
    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, sample: &Sample, weight: f32) {
        let mut at = 0;
        while at < self.count && self.list[at].mean.path_signature != sample.path_signature {
            at += 1;
        }
        let group = &mut self.list[at];
        if at == self.count {
            self.count += 1;
            // Field by field, because a whole sample would be copied twice.
            group.share = 0.0;
            (group.mean.path_signature, group.mean.count, group.mean.object) =
                (sample.path_signature, sample.count, sample.object);
            group.mean.numbers = [0.0; NUMBERS];
        }
        group.share += weight;
        for i in (0..sample.used()).step_by(F::<S>::LEN) {
            let sum = sample::load(simd, &group.mean.numbers, i);
            let number = sample::load(simd, &sample.numbers, i);
            sample::store::<S>(sum + number * weight, &mut group.mean.numbers, i);
        }
    }
}

/// Weights of the lattice points of a pixel, by row and column.
type Weights = [[f32; POINTS]; POINTS];

/// Adds the weights of the samples in a part of a pixel: each square that is not cut further gives a quarter of its own
/// `weight` to each corner.
fn weigh(grid: &Grid, square: Square, weight: f32, pixel: Square, weights: &mut Weights) {
    let Square { x, y, size } = square;
    if size > 1 && !same_path(grid.corners(square)) {
        for part in square.quarters() {
            weigh(grid, part, weight * 0.25, pixel, weights);
        }
        return;
    }
    let (column, row) = (x - pixel.x, y - pixel.y);
    for (column, row) in [(column, row), (column + size, row), (column, row + size), (column + size, row + size)] {
        weights[row][column] += weight * 0.25;
    }
}
