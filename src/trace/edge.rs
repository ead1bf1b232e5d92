//! Pixels that an edge runs through: the surfaces in them, each with its share.

use super::grid::{Grid, Square, same_path};
use super::sample::{NUMBERS, Sample};
use crate::simd::lanes::F;
use fearless_simd::prelude::*;

/// The surfaces seen through one pixel, each with its share of the area; memory for as many as can be.
pub struct Groups {
    count: usize,
    list: [Group; 25],
}

impl Default for Groups {
    fn default() -> Groups {
        Groups { count: 0, list: [Group { share: 0.0, mean: Sample::default() }; 25] }
    }
}

/// One surface: its share of the pixel and the mean of its samples.
#[derive(Clone, Copy)]
pub struct Group {
    /// 0 to 1.
    pub share: f32,
    /// All of one chain.
    pub mean: Sample,
}

impl Groups {
    /// The surfaces in a pixel, a square of the lattice.
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
                let range = i..i + F::<S>::LEN;
                let sum = F::<S>::from_slice(simd, &group.mean.numbers[range.clone()]);
                (sum * k).store_slice(&mut group.mean.numbers[range]);
            }
        }
        groups
    }

    /// Adds a sample to those of its chain.
    #[inline(always)]
    fn add<S: Simd>(&mut self, simd: S, sample: &Sample, weight: f32) {
        let mut at = 0;
        while at < self.count && self.list[at].mean.path_signature != sample.path_signature {
            at += 1;
        }
        let group = &mut self.list[at];
        if at == self.count {
            self.count += 1;
            // Field by field: a whole sample would be copied twice.
            group.share = 0.0;
            (group.mean.path_signature, group.mean.count, group.mean.object) =
                (sample.path_signature, sample.count, sample.object);
            group.mean.numbers = [0.0; NUMBERS];
        }
        group.share += weight;
        for i in (0..sample.used()).step_by(F::<S>::LEN) {
            let range = i..i + F::<S>::LEN;
            let sum = F::<S>::from_slice(simd, &group.mean.numbers[range.clone()]);
            let number = F::<S>::from_slice(simd, &sample.numbers[range.clone()]);
            (sum + number * weight).store_slice(&mut group.mean.numbers[range]);
        }
    }
}

/// Weights of the lattice points of a pixel, up to quarters.
type Weights = [[f32; 5]; 5];

/// Gives the samples in a part of a pixel their weights: a quarter to each corner of what is not cut further.
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
