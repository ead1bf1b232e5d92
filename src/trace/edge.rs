//! Pixels that an edge runs through: the surfaces seen in them, each with its share of the area.
//!
//! Samples with the same path signature are of one surface. They are averaged before textures are looked up, so that each
//! surface in a pixel has its textures evaluated once.

use super::grid::{Grid, SIDES, Square};
use super::sample::{self, Sample};
use crate::simd::lanes::F;
use fearless_simd::prelude::*;

/// Lattice points in a pixel.
const POINTS: usize = 9;
/// A share of a pixel.
const SIXTEENTH: f32 = 1.0 / 16.0;
/// The least share of a surface that a corner of the pixel sees.
const LEAST: f32 = SIXTEENTH;

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
    list: [Group; POINTS],
}

impl Default for Groups {
    fn default() -> Groups {
        Groups { count: 0, list: [Group { share: 0.0, mean: Sample::default() }; POINTS] }
    }
}

impl Groups {
    /// The surfaces in a pixel, given as a square of two lattice steps. Where edges are `straight` for some pixels, the samples
    /// of its neighbours tell the shares of two surfaces too.
    #[inline(always)]
    pub fn of_pixel<S: Simd>(&mut self, simd: S, grid: &Grid, pixel: Square, straight: bool) -> &[Group] {
        let (x, y) = pixel.place();
        self.count = 0;
        // The centre stands for a quarter of the pixel, the middle of a side for an eighth, a corner for a sixteenth. Sides
        // without a sample see what their ends see, and leave their share to them.
        let centre = grid.has(x + 1, y + 1);
        let corner = if centre { SIXTEENTH } else { 2.0 * SIXTEENTH };
        let mut weights = [[corner, 0.0, corner], [0.0; 3], [corner, 0.0, corner]];
        weights[1][1] = if centre { 4.0 * SIXTEENTH } else { 0.0 };
        for &((column, row), ends) in &SIDES {
            if grid.has(x + column, y + row) {
                weights[row][column] = 2.0 * SIXTEENTH;
            } else {
                for (column, row) in ends {
                    weights[row][column] += SIXTEENTH;
                }
            }
        }
        for (row, weights) in weights.iter().enumerate() {
            for (column, &weight) in weights.iter().enumerate() {
                if weight > 0.0 {
                    self.add(simd, grid.at(x + column, y + row), weight);
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
        if straight && let [first, second] = groups {
            let lean = grid.lean(pixel, first.mean.path_signature);
            // 2 for corners alone, 1/2 beside samples within, which have told most of it.
            let share = first.share + lean * (128.0 * corner * corner);
            first.share = share.clamp(LEAST, 1.0 - LEAST);
            second.share = 1.0 - first.share;
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
        let first = at == self.count;
        if first {
            self.count += 1;
            // Field by field, because a whole sample would be copied twice.
            group.share = 0.0;
            (group.mean.path_signature, group.mean.count, group.mean.object) =
                (sample.path_signature, sample.count, sample.object);
        }
        group.share += weight;
        for i in (0..sample.used()).step_by(F::<S>::LEN) {
            let number = sample::load(simd, &sample.numbers, i) * weight;
            let sum = if first { number } else { sample::load(simd, &group.mean.numbers, i) + number };
            sample::store::<S>(sum, &mut group.mean.numbers, i);
        }
    }
}
