//! From samples to pixels: squares that are interpolated between their corners, and single pixels.

use super::deferred::Deferred;
use super::grid::{Grid, Square};
use super::job::Job;
use super::sample::{self, HIT, HIT_INV_DEPTH, INV_DEPTH, NUMBERS, PLAIN, POINT, REMEMBERED, Sample, hit_point, hits};
use crate::frame::Tile;
#[cfg(feature = "full")]
use crate::frame::inspect::count_octaves;
use crate::simd::block::{BLOCK, Block3, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math::to_f32;
use crate::texture::{self, Texture};
use fearless_simd::{f32x8, prelude::*};
use fearless_simd_macros::simd;

/// Adds a `share` of a sample to the pixel that a square of the lattice is. Textures are averaged over their footprints,
/// metres.
#[simd]
#[allow(clippy::too_many_arguments)]
pub fn add<S: Simd>(
    simd: S,
    job: &Job,
    tile: &mut Tile,
    deferred: &mut Deferred,
    square: Square,
    sample: &Sample,
    share: f32,
    footprint: &[f32; REMEMBERED],
) {
    let [red, green, blue, inv_depth, ..] = sample.numbers;
    // The mask changes nothing; it tells the compiler that the index is inside the tile.
    let pixel = first_pixel(job, square) & (Tile::AREA - 1);
    tile.red[pixel] += red * share;
    tile.green[pixel] += green * share;
    tile.blue[pixel] += blue * share;
    if tile.solids_matter {
        tile.inv_depth[pixel] = tile.inv_depth[pixel].max(inv_depth);
        tile.coverage[pixel] += if inv_depth > 0.0 { share } else { 0.0 };
    }
    deferred.push(simd, job.context.world, tile, pixel as u16, sample, share, footprint);
}

/// The index in the tile of a square's first pixel.
#[inline(always)]
fn first_pixel(job: &Job, square: Square) -> usize {
    let (x, y) = square.place();
    job.pixels(y) * Tile::SIZE + job.pixels(x)
}

/// The footprint of each textured hit of a pixel, metres: the longer of the two lines through the middle of the pixel's
/// picture on the surface.
pub fn footprints(corners: [&Sample; 4]) -> [f32; REMEMBERED] {
    let mut footprints = [0.0; REMEMBERED];
    for (n, footprint) in footprints.iter_mut().enumerate().take(corners[0].count as usize) {
        let mut across = [[0.0; 3]; 4];
        for (corner, point) in corners.iter().zip(&mut across) {
            *point = hit_point(&hits(&corner.numbers)[n]);
        }
        let [a, b, c, d] = across;
        let (mut x, mut y) = (0.0, 0.0);
        for k in 0..3 {
            let (right, down) = (0.5 * (b[k] + d[k] - a[k] - c[k]), 0.5 * (c[k] + d[k] - a[k] - b[k]));
            x += right * right;
            y += down * down;
        }
        *footprint = x.max(y).sqrt();
    }
    footprints
}

/// Pixels that are added as one vector: they lie side by side in squares of this size and larger.
const ROW: usize = 8;

/// Where up to a block of the pixels of a square lie between its corners.
#[derive(Clone)]
struct Ramp {
    /// 0 at the left corners to 1 at the right ones.
    u: [f32; BLOCK],
    /// 0 at the top corners to 1 at the bottom ones.
    v: [f32; BLOCK],
    /// The pixel's index in the tile, less that of the square's first pixel.
    pixel: [u16; BLOCK],
    /// The number of pixels.
    count: usize,
    /// The square's edge, pixels.
    size: usize,
    /// Share of the square's edge that a pixel takes.
    step: f32,
}

/// The numbers of a sample for each of a block of pixels.
type Rows = [[f32; BLOCK]; NUMBERS];

/// The ramps of squares of 1, 2, 4, 8 and 16 pixels, in blocks of whole rows.
#[derive(Default)]
pub struct Ramps {
    centred: Option<bool>,
    by_size: [Vec<Ramp>; 5],
    /// Memory for what lies between the corners of a square; no value in it survives the square.
    rows: Option<Box<Rows>>,
    patch: Patch,
}

impl Ramps {
    /// Computes the ramps, unless they are there: with corners on the centres of pixels, or, if `centred`, with the centres
    /// of pixels between the corners.
    pub fn prepare(&mut self, centred: bool) {
        if self.centred == Some(centred) {
            return;
        }
        self.centred = Some(centred);
        let offset = if centred { 0.5 } else { 0.0 };
        for (log, ramps) in self.by_size.iter_mut().enumerate() {
            let size = 1 << log;
            let count = BLOCK.min(size * size);
            ramps.clear();
            for first in (0..size * size).step_by(count) {
                let step = 1.0 / to_f32(size);
                let mut ramp = Ramp { u: [0.0; BLOCK], v: [0.0; BLOCK], pixel: [0; BLOCK], count, size, step };
                for i in 0..count {
                    let (x, y) = ((first + i) % size, (first + i) / size);
                    ramp.u[i] = (to_f32(x) + offset) / to_f32(size);
                    ramp.v[i] = (to_f32(y) + offset) / to_f32(size);
                    ramp.pixel[i] = (y * Tile::SIZE + x) as u16;
                }
                ramps.push(ramp);
            }
        }
    }
}

/// The numbers of a sample, bilinear over a square: `start + u along + v (down + u twist)`.
#[derive(Default)]
struct Patch {
    start: [f32; NUMBERS],
    along: [f32; NUMBERS],
    down: [f32; NUMBERS],
    twist: [f32; NUMBERS],
}

impl Patch {
    /// Spans the square between four corners.
    #[inline(always)]
    fn span<S: Simd>(&mut self, simd: S, corners: [&Sample; 4]) {
        for i in (0..corners[0].used()).step_by(F::<S>::LEN) {
            let a = sample::load(simd, &corners[0].numbers, i);
            let b = sample::load(simd, &corners[1].numbers, i);
            let c = sample::load(simd, &corners[2].numbers, i);
            let d = sample::load(simd, &corners[3].numbers, i);
            sample::store::<S>(a, &mut self.start, i);
            sample::store::<S>(b - a, &mut self.along, i);
            sample::store::<S>(c - a, &mut self.down, i);
            sample::store::<S>(d - c - b + a, &mut self.twist, i);
        }
    }

    /// The numbers at the points of a ramp, one row of `out` per number.
    #[inline(always)]
    fn values<S: Simd>(&self, simd: S, ramp: &Ramp, out: &mut [[f32; BLOCK]]) {
        for (k, row) in out.iter_mut().enumerate() {
            let (start, down) = (F::<S>::splat(simd, self.start[k]), F::<S>::splat(simd, self.down[k]));
            // u is the same in every row of pixels, so it is for vectors that are this far apart.
            let apart = (ramp.size / F::<S>::LEN).max(1);
            for first in 0..apart {
                let u: F<S> = load(simd, &ramp.u, first);
                let (top, fall) = (start + u * self.along[k], down + u * self.twist[k]);
                let mut i = first;
                while i * F::<S>::LEN < ramp.count {
                    store(top + load::<S, F<S>>(simd, &ramp.v, i) * fall, row, i);
                    i += apart;
                }
            }
        }
    }

    /// The derivatives of number `k` along u and v.
    #[inline(always)]
    fn slopes<S: Simd>(&self, k: usize, u: F<S>, v: F<S>) -> (F<S>, F<S>) {
        (v * self.twist[k] + self.along[k], u * self.twist[k] + self.down[k])
    }

    /// Divides the homogeneous points of the textured hit whose numbers begin at `at` by their inverse depth; if `filter`, the
    /// latter gives place to how long a pixel is on the surface there, metres.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn project<S: Simd>(
        &self,
        simd: S,
        at: usize,
        ramp: &Ramp,
        points: &mut Block3,
        inv_depth: &mut [f32; BLOCK],
        filter: bool,
    ) {
        let mut i = 0;
        while i * F::<S>::LEN < ramp.count {
            let k = F::<S>::splat(simd, 1.0) / load::<S, F<S>>(simd, inv_depth, i);
            let point = V3::load(simd, points, i) * Lane(k);
            point.store(points, i);
            if filter {
                let (u, v): (F<S>, F<S>) = (load(simd, &ramp.u, i), load(simd, &ramp.v, i));
                let (wu, wv) = self.slopes::<S>(at + HIT_INV_DEPTH, u, v);
                let (xu, xv) = self.slopes::<S>(at + POINT, u, v);
                let (yu, yv) = self.slopes::<S>(at + POINT + 1, u, v);
                let (zu, zv) = self.slopes::<S>(at + POINT + 2, u, v);
                // The derivative of a quotient, point = homogeneous point / inverse depth.
                let across = V3::<S> { x: xu, y: yu, z: zu } - point * Lane(wu);
                let down = V3::<S> { x: xv, y: yv, z: zv } - point * Lane(wv);
                let longest = across.dot(across).max(down.dot(down)).sqrt();
                store(longest * k.abs() * ramp.step, inv_depth, i);
            }
            i += 1;
        }
    }
}

/// Fills a square from its corners, a ramp of at most a block of pixels at a time.
///
/// ```text
/// plain = the untextured light, interpolated
/// for each textured hit that the corners remember:
///     interpolate gain and homogeneous point, divide the point by its inverse depth
///     a full block: look the texture up, add gain times colour to plain
///     a smaller square: leave the hits to the object's queue
/// add plain to the tile; write inverse depth and coverage
/// ```
#[simd]
pub fn interpolate<S: Simd>(
    simd: S,
    job: &Job,
    tile: &mut Tile,
    deferred: &mut Deferred,
    ramps: &mut Ramps,
    grid: &Grid,
    square: Square,
) {
    let corners = grid.corners(square);
    let size = job.pixels(square.size());
    let first = first_pixel(job, square);
    let filter = job.settings.antialias;
    let solid = if corners[0].inv_depth() > 0.0 { 1.0 } else { 0.0 };
    let Ramps { by_size, rows, patch, .. } = ramps;
    patch.span(simd, corners);
    let rows = rows.get_or_insert_with(|| Box::new([[0.0; BLOCK]; NUMBERS]));
    for ramp in &by_size[size.trailing_zeros() as usize] {
        patch.values(simd, ramp, &mut rows[..corners[0].used()]);
        let (plain, numbers) = rows.split_first_chunk_mut::<PLAIN>().expect("numbers of hits are more");
        for (n, numbers) in numbers.as_chunks_mut::<HIT>().0[..corners[0].count as usize].iter_mut().enumerate() {
            let ([gain, points], [inv_depth]) = numbers.as_chunks_mut::<3>() else {
                unreachable!("a hit is two vectors and a number");
            };
            patch.project(simd, PLAIN + HIT * n, ramp, points, inv_depth, filter);
            let footprint = &*inv_depth;
            let object = corners[0].object[n];
            if ramp.count == BLOCK {
                let albedo = &job.context.world.objects[object as usize].material.albedo;
                let footprint = if filter { Some(footprint) } else { None };
                #[cfg(feature = "full")]
                if !tile.octaves.is_empty() {
                    count_octaves(
                        tile,
                        albedo,
                        footprint,
                        &mut ramp.pixel.iter().map(|offset| first + *offset as usize),
                    );
                }
                add_texture(simd, albedo, gain, points, footprint, plain);
            } else {
                let pixels = ramp.pixel.first_chunk().expect("it is shorter than a block");
                let run = (first as u16, pixels, ramp.count);
                deferred.push_run(simd, job.context.world, tile, object, run, gain, points, footprint);
            }
        }
        deposit(simd, tile, ramp, first, size >= ROW, plain);
        if tile.solids_matter {
            for (offset, value) in ramp.pixel[..ramp.count].iter().zip(&plain[INV_DEPTH]) {
                tile.inv_depth[first + *offset as usize] = *value;
                tile.coverage[first + *offset as usize] = solid;
            }
        }
    }
}

/// Looks a texture up for a full block of points, and adds gain times colour to the block's light.
#[inline(always)]
fn add_texture<S: Simd>(
    simd: S,
    albedo: &Texture,
    gain: &Block3,
    points: &mut Block3,
    footprint: Option<&[f32; BLOCK]>,
    light: &mut [[f32; BLOCK]; PLAIN],
) {
    texture::shade(simd, albedo, points, BLOCK, footprint);
    let color = points;
    for k in 0..3 {
        let mut i = 0;
        while i * F::<S>::LEN < BLOCK {
            let textured = load::<S, F<S>>(simd, &gain[k], i) * load::<S, F<S>>(simd, &color[k], i);
            store(load::<S, F<S>>(simd, &light[k], i) + textured, &mut light[k], i);
            i += 1;
        }
    }
}

/// Adds the light of a ramp to the pixels of the tile from `first` on; the ramp consists of whole rows of [`ROW`] pixels if
/// it is `wide`.
///
/// Light is added, not set: a queue of textures may have been emptied into these pixels already.
#[inline(always)]
fn deposit<S: Simd>(simd: S, tile: &mut Tile, ramp: &Ramp, first: usize, wide: bool, light: &[[f32; BLOCK]; PLAIN]) {
    let Tile { red, green, blue, .. } = tile;
    if wide {
        for (plane, values) in [red, green, blue].into_iter().zip(light) {
            for (offsets, values) in ramp.pixel.as_chunks::<ROW>().0.iter().zip(values.as_chunks::<ROW>().0) {
                let row = &mut plane[first + offsets[0] as usize..][..ROW];
                (f32x8::from_slice(simd, row) + f32x8::from_slice(simd, values)).store_slice(row);
            }
        }
    } else {
        for (i, &offset) in ramp.pixel[..ramp.count].iter().enumerate() {
            let pixel = (first + offset as usize) & (Tile::AREA - 1);
            red[pixel] += light[0][i];
            green[pixel] += light[1][i];
            blue[pixel] += light[2][i];
        }
    }
}
