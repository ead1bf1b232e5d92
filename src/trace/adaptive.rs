//! Adaptive subdivision by corners `[Intro07]`, made safe: where the corners of a square agree, no more rays are traced.
//!
//! A tile is cut into squares. The corners of each, which neighbours share, and its centre are traced. Where all five
//! have the same path signature (the objects on every path, the state of every light at each hit) and the centre is what
//! the corners foretell, the square is interpolated; else it is cut in four, down to one pixel. With anti-aliasing, pixels
//! that an edge runs through have samples within. Departures from the thesis:
//!
//! * Light, gain and hit point are interpolated; textures are evaluated at every pixel ([`super::deferred`]).
//! * The test measures the error of the interpolation itself, at the centre where it is largest, rather than the
//!   difference of the corners, so that a smooth gradient is no reason to cut. The centre is no extra cost where the
//!   square is cut, being a corner of its parts.
//! * An edge that enters a square between two corners is followed: where the border of a square meets samples of its
//!   neighbours that have another signature, the square is cut after all.
//! * Squares that a small object or shadow may touch are cut in any case ([`super::guard`]).
//! * With anti-aliasing, corners lie on the corners of pixels, so that a pixel is a square like any other; without it, on
//!   the centres of pixels, so that a corner is a pixel.
//! * With anti-aliasing, squares of two pixels are judged by their corners alone, and the middles of sides that no edge
//!   crosses are foretold in squares of two and four pixels that one does.
//!
//! The limit without approximation is a coarsest square of 1 pixel, which traces every pixel.

use super::deferred::Deferred;
use super::edge::Groups;
use super::fill::{self, Ramps};
use super::grid::{Grid, SIDES, Square, same_path};
use super::job::Job;
use super::sample::{self, GAIN, NUMBERS, POINT, REMEMBERED, Sample, hit_point, hits};
use super::surface::ALBEDO;
use crate::frame::Tile;
use crate::settings::TraceSettings;
use crate::simd::math::to_f32;
use crate::texture::Variation;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3A;
use std::ops::Range;

/// The number of sizes of squares, from 16 pixels down to one.
const LEVELS: usize = 5;

/// Memory for drawing a tile, passed from tile to tile. No value in it survives a tile.
#[derive(Default)]
pub struct Scratch {
    /// The bits of the objects that eye rays may meet.
    pub visible: Vec<u64>,
    grid: Grid,
    /// Squares to be examined, by size from the coarsest.
    work: [Vec<Square>; LEVELS],
    /// Squares that are interpolated, and pixels that are traced themselves.
    whole: Vec<Square>,
    /// Pixels that an edge runs through.
    edges: Vec<Square>,
    deferred: Deferred,
    ramps: Ramps,
}

impl Scratch {
    /// Where the samples of the tile drawn last lie, pixels from the picture's top left.
    #[cfg(feature = "full")]
    pub fn positions(&self) -> impl Iterator<Item = (f32, f32)> {
        self.grid.positions()
    }

    /// The squares that the tile drawn last was cut into, of `unit` lattice steps per pixel: column and row of their top
    /// left pixel in the tile, and their edge, pixels; 1/2 for a pixel with samples within. With a grid of samples per
    /// pixel, those of its last point.
    #[cfg(feature = "full")]
    pub fn squares(&self, unit: usize) -> impl Iterator<Item = (usize, usize, f32)> {
        let place = move |square: &Square| (square.place().0 / unit, square.place().1 / unit);
        let whole = self.whole.iter().map(move |square| (place(square), to_f32(square.size()) / to_f32(unit)));
        let edges = self.edges.iter().map(move |square| (place(square), 0.5));
        whole.chain(edges).map(|((x, y), size)| (x, y, size))
    }
}

/// Draws a tile; returns the number of eye rays.
///
/// With a grid of samples per pixel, as in the reference, the tile is drawn once per grid point with a share of the light.
#[simd]
pub fn draw<S: Simd>(simd: S, job: &Job, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
    scratch.deferred.begin(job.context.world.objects.len(), job.settings.antialias);
    tile.clear();
    let across = job.settings.built().grid;
    let step = 1.0 / to_f32(across);
    let mut count = 0;
    for n in 0..across * across {
        // Lattice points are centres of pixels, or corners of them.
        let middle = if job.settings.antialias { 0.0 } else { 0.5 };
        let [dx, dy] = [n % across, n / across].map(|n| (to_f32(n) + middle) * step);
        scratch.grid.begin(job, tile, dx, dy);
        subdivide(simd, job, tile, scratch);
        paint(simd, job, tile, step * step, scratch);
        count += scratch.grid.samples();
    }
    scratch.deferred.finish(simd, job.context.world, tile);
    count as u64
}

/// Cuts the tile into squares that are interpolated, single pixels, and pixels that an edge runs through.
///
/// ```text
/// start with squares of the coarsest size
/// repeat:
///     for each size, from coarse to fine:
///         trace the corners and centres of all squares of that size at once, so that packets are full
///         keep the squares that agree, cut the others; note pixels whose corners differ
///     cut the kept squares that an edge enters from a neighbour
/// until no edge enters any
/// ```
#[simd]
fn subdivide<S: Simd>(simd: S, job: &Job, tile: &Tile, scratch: &mut Scratch) {
    let Scratch { grid, work, whole, edges, .. } = scratch;
    let unit = job.unit();
    let coarsest = job.settings.built().cell * unit;
    let cutter = Cutter { coarsest, unit, end: (tile.width * unit, tile.height * unit) };
    whole.clear();
    edges.clear();
    add_squares(&mut work[0], 0..cutter.end.0, 0..cutter.end.1, coarsest);
    // Here, so that it is cleared once.
    let mut mean = [0.0; NUMBERS];
    loop {
        for level in 0..LEVELS {
            let squares = std::mem::take(&mut work[level]);
            for &square in &squares {
                want(job, grid, square);
            }
            grid.trace(simd, job);
            for &square in &squares {
                match judge(simd, job, tile, grid, square, &mut mean) {
                    Verdict::Whole => whole.push(square),
                    Verdict::Cut => {
                        foretell_sides(simd, job, tile, grid, square);
                        cutter.cut(work, square);
                    }
                    Verdict::FaintEdge => edges.push(square),
                    Verdict::Edge => {
                        edges.push(square);
                        want_within(job, tile, grid, square);
                    }
                }
            }
            work[level] = squares;
            work[level].clear();
        }
        // Within pixels.
        grid.trace(simd, job);
        if !follow(grid, &cutter, work, whole) {
            break;
        }
    }
}

/// Asks for the samples that a square is judged by: its corners, and its centre if they are not enough. Where a corner is a
/// pixel, a pixel has one sample.
#[inline(always)]
fn want(job: &Job, grid: &mut Grid, square: Square) {
    let ((x, y), size) = (square.place(), square.size());
    grid.want(x, y);
    if size == 1 && job.unit() == 1 {
        return;
    }
    grid.want(x + size, y);
    grid.want(x, y + size);
    grid.want(x + size, y + size);
    if size > by_corners(job) {
        grid.want(x + size / 2, y + size / 2);
    }
}

/// Edge of the largest squares that are judged by their corners alone, lattice steps: pixels, and with anti-aliasing squares
/// of two pixels.
#[inline(always)]
fn by_corners(job: &Job) -> usize {
    if foretells(job) { 2 * job.unit() } else { job.unit() }
}

/// Whether a sample may be left out that others foretell: with anti-aliasing, but at a contrast of 0, where all are traced.
#[inline(always)]
fn foretells(job: &Job) -> bool {
    let TraceSettings { antialias, contrast, .. } = job.settings.built();
    antialias && contrast > 0.0
}

/// Asks for the samples within a pixel that an edge runs through: its centre, and the middle of every side that the edge
/// crosses.
fn want_within(job: &Job, tile: &Tile, grid: &mut Grid, pixel: Square) {
    let (x, y) = pixel.point((1, 1));
    grid.want(x, y);
    let trusted = trusted(job, tile, pixel);
    for &(middle, ends) in &SIDES {
        let [a, b] = grid.pair(pixel, ends);
        if !(trusted && a.path_signature == b.path_signature) {
            let (x, y) = pixel.point(middle);
            grid.want(x, y);
        }
    }
}

/// Foretells the middle of every side that the edge which runs through a square of two or four pixels does not cross, so
/// that it is not traced.
fn foretell_sides<S: Simd>(simd: S, job: &Job, tile: &Tile, grid: &mut Grid, square: Square) {
    let pixels = job.pixels(square.size());
    if !trusted(job, tile, square) || pixels > 4 || same_path(grid.corners(square)) {
        return;
    }
    if pixels == 4 && !one_edge(grid, square) {
        return;
    }
    for &(middle, ends) in &SIDES {
        grid.foretell(simd, square, middle, ends);
    }
}

/// Whether the corners and the centre of a square see two surfaces at most. What is seen at the centre alone may be a line
/// that leaves the square between two corners.
fn one_edge(grid: &Grid, square: Square) -> bool {
    let (first, mut second) = (grid.centre(square).path_signature, None);
    grid.corners(square).iter().all(|corner| {
        corner.path_signature == first || corner.path_signature == *second.get_or_insert(corner.path_signature)
    })
}

/// Whether a side of a square is taken for one surface where its ends are of one, as nothing smaller than the square may be
/// there.
fn trusted(job: &Job, tile: &Tile, square: Square) -> bool {
    foretells(job) && finest(job, tile, square) >= job.pixels(square.size())
}

/// What becomes of a square.
enum Verdict {
    /// It is interpolated, or it is a pixel that is traced itself.
    Whole,
    /// It is cut.
    Cut,
    /// It is a pixel that an edge runs through, and gets more samples for the shares of its surfaces.
    Edge,
    /// It is such a pixel, and its corners are enough to tell the shares.
    FaintEdge,
}

/// Judges a square whose samples are there; `mean` is memory.
#[inline(always)]
fn judge<S: Simd>(simd: S, job: &Job, tile: &Tile, grid: &Grid, square: Square, mean: &mut [f32; NUMBERS]) -> Verdict {
    let size = square.size();
    let unit = job.unit();
    if size == 1 {
        return Verdict::Whole;
    }
    let corners = grid.corners(square);
    let same = same_path(corners);
    let finest = finest(job, tile, square);
    // A pixel whose corners have one signature is their mean, however much light and point differ.
    let agree = same
        && if size == unit {
            finest > 0
        } else {
            size <= unit * finest
                && (size <= by_corners(job) || agree(simd, job, job.pixels(size), corners, grid.centre(square), mean))
        };
    match agree {
        true => Verdict::Whole,
        false if size == unit && !same && faint(job, corners) => Verdict::FaintEdge,
        false if size == unit => Verdict::Edge,
        false => Verdict::Cut,
    }
}

/// Edge of the largest square that the guard lets pass where a square is, pixels.
#[inline(always)]
fn finest(job: &Job, tile: &Tile, square: Square) -> usize {
    let (x, y) = square.place();
    job.guard.finest(tile.x + job.pixels(x), tile.y + job.pixels(y))
}

/// Cuts the squares that were to be interpolated but that an edge enters from a neighbour. Returns whether there were any.
#[inline(always)]
fn follow(grid: &Grid, cutter: &Cutter, work: &mut [Vec<Square>; LEVELS], whole: &mut Vec<Square>) -> bool {
    let mut at = 0;
    let mut any = false;
    // Squares are removed on the way, so there is no range to iterate over.
    while at < whole.len() {
        let square = whole[at];
        // Edges are followed down to pixels, not into them: samples on a pixel's border are half a pixel apart at most.
        if square.size() == cutter.unit || !grid.entered(square) {
            at += 1;
            continue;
        }
        any = true;
        whole.swap_remove(at);
        cutter.cut(work, square);
    }
    any
}

/// What cutting a square needs to know of the tile, in lattice steps.
struct Cutter {
    /// Edge of the largest squares.
    coarsest: usize,
    /// Edge of a pixel.
    unit: usize,
    /// Right and lower end of the tile.
    end: (usize, usize),
}

impl Cutter {
    /// Cuts a square in four, without the parts that lie beyond the picture's end.
    ///
    /// Where a corner is a pixel, squares of 4 are cut into their pixels at once. That is exact, and takes no more rays than
    /// trying squares of 2, whose middle is a fourth of what they could save.
    fn cut(&self, work: &mut [Vec<Square>; LEVELS], square: Square) {
        let ((x, y), size) = (square.place(), square.size());
        let part = size >> if self.unit == 1 && size == 4 { 2 } else { 1 };
        let work = &mut work[(self.coarsest / part).trailing_zeros() as usize];
        add_squares(work, x..self.end.0.min(x + size), y..self.end.1.min(y + size), part);
    }
}

/// Adds squares of one size that tile these columns and rows, from the first ones on. Not by `step_by`, which divides to count
/// its steps.
#[inline(always)]
fn add_squares(squares: &mut Vec<Square>, columns: Range<usize>, rows: Range<usize>, size: usize) {
    let mut y = rows.start;
    while y < rows.end {
        let mut x = columns.start;
        while x < columns.end {
            squares.push(Square::new(x, y, size));
            x += size;
        }
        y += size;
    }
}

/// Adds to every pixel a `share` of its light.
#[simd]
fn paint<S: Simd>(simd: S, job: &Job, tile: &mut Tile, share: f32, scratch: &mut Scratch) {
    let Scratch { grid, whole, edges, deferred, ramps, .. } = scratch;
    let unit = job.unit();
    ramps.prepare(job.settings.antialias);
    let mut middle = Sample::default();
    for &square in whole.iter() {
        if square.size() > unit {
            fill::interpolate(simd, job, tile, deferred, ramps, grid, square);
        } else if unit == 1 {
            let (x, y) = square.place();
            fill::add(simd, job, tile, deferred, square, grid.at(x, y), share, &[0.0; REMEMBERED]);
        } else {
            let corners = grid.corners(square);
            let footprint = fill::footprints(corners);
            middle.set_mean(simd, corners);
            fill::add(simd, job, tile, deferred, square, &middle, share, &footprint);
        }
    }
    let mut groups = Groups::default();
    for &square in edges.iter() {
        // Rims of balls of less than four pixels turn too much from one pixel to the next.
        let straight = finest(job, tile, square) > 1;
        for group in groups.of_pixel(simd, grid, square, straight) {
            fill::add(simd, job, tile, deferred, square, &group.mean, group.share, &[0.0; REMEMBERED]);
        }
    }
}

/// Whether a square of `size` pixels may be interpolated whose corners have one path signature.
///
/// The error at the centre is the sum of three: of untextured light; of each hit's gain; and of each hit's texture, which
/// is displaced by as much as the hit point is off. What the corners foretell is written to `mean`.
#[inline(always)]
fn agree<S: Simd>(
    simd: S,
    job: &Job,
    size: usize,
    c: [&Sample; 4],
    centre: &Sample,
    mean: &mut [f32; NUMBERS],
) -> bool {
    if c[0].path_signature != centre.path_signature {
        return false;
    }
    sample::mean(simd, c, mean);
    let [found, foretold] = [&centre.numbers, mean];
    let mut error = distance(&found[..3], &foretold[..3]);
    let mut level = found[0] + found[1] + found[2];
    for n in 0..centre.count as usize {
        let (hit, guess) = (&hits(found)[n], &hits(foretold)[n]);
        let shift = distance(&hit_point(hit), &hit_point(guess));
        let (first, last) = (hit_point(&hits(&c[0].numbers)[n]), hit_point(&hits(&c[3].numbers)[n]));
        let pixel = distance(&first, &last) / to_f32(size);
        let Variation { contrast, slope } = job.variation[centre.object[n] as usize];
        // A texture finer than pixels may be displaced by a part of one.
        let texture = (slope * shift).min(contrast * SUBPIXEL * shift / pixel.max(1e-20)).min(contrast);
        let (gain, guess) = (&hit[GAIN..POINT], &guess[GAIN..POINT]);
        error += distance(gain, guess) + gain[0].max(gain[1]).max(gain[2]) * texture;
        level += 0.5 * (gain[0] + gain[1] + gain[2]);
    }
    error <= job.settings.built().threshold * visible(level)
}

/// Whether the light of a pixel's corners differs so little that the shares of its surfaces need not be exact.
fn faint(job: &Job, corners: [&Sample; 4]) -> bool {
    let (mut low, mut high) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
    for corner in corners {
        let mut light = Vec3A::from_slice(&corner.numbers);
        for (object, hit) in corner.hits() {
            light +=
                Vec3A::from_slice(&hit[GAIN..]) * Vec3A::from_slice(&job.context.surfaces[object as usize][ALBEDO..]);
        }
        (low, high) = (low.min(light), high.max(light));
    }
    (high - low).max_element() <= job.settings.built().contrast * visible(0.5 * (low + high).element_sum())
}

/// The scale of differences that are seen beside a level of light, given as the sum of its colours: the slope of the encoded
/// scale falls about with the root of the light.
#[inline(always)]
fn visible(level: f32) -> f32 {
    (level * (1.0 / 3.0)).max(1.0 / 64.0).sqrt()
}

/// What a displacement of a texture by one pixel counts, as a share of the texture's contrast.
const SUBPIXEL: f32 = 0.25;

/// The largest difference of three components.
#[inline(always)]
fn distance(a: &[f32], b: &[f32]) -> f32 {
    (a[0] - b[0]).abs().max((a[1] - b[1]).abs()).max((a[2] - b[2]).abs())
}
