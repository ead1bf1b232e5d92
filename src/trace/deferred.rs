//! Deferred textures: hits wait in a queue per object until a block of them is full.
//!
//! Whether a pixel was traced or interpolated, its textures are evaluated at its own hit points, so that none is smeared.
//! Noise always runs on full blocks, however many edges the picture has.

use super::sample::{GAIN, REMEMBERED, Sample, hit_point};
use super::world::World;
use crate::cuts;
use crate::frame::Tile;
#[cfg(feature = "full")]
use crate::frame::inspect::count_octaves;
use crate::simd::block::{BLOCK, Block3};
use crate::simd::lanes::Bits;
use crate::texture;
use fearless_simd::{f32x16, prelude::*};
use fearless_simd_macros::simd;

/// The most hits that are added at once.
pub const RUN: usize = 16;

/// Room in a queue: fewer hits than a block, and a run.
const ROOM: usize = BLOCK + RUN;

/// Hits that wait for the texture of one object.
struct TextureQueue {
    count: usize,
    /// Pixel of the tile, row by row.
    pixel: [u16; ROOM],
    /// Light that the pixel gets off a white surface.
    gain: [[f32; ROOM]; 3],
    /// Hit point, metres.
    point: [[f32; ROOM]; 3],
    /// Length of the pixel on the surface, metres.
    footprint: [f32; ROOM],
}

/// All waiting hits of a tile.
#[derive(Default)]
pub struct Deferred {
    queues: Vec<TextureQueue>,
    /// The bits of objects that hits may wait for, 64 to a word: among many few are seen in a tile.
    used: Vec<u64>,
    /// Whether textures are averaged over their footprint.
    filter: bool,
}

impl Deferred {
    /// Makes queues for a number of objects.
    pub fn begin(&mut self, objects: usize, filter: bool) {
        let black = [[0.0; ROOM]; 3];
        while self.queues.len() < objects {
            let (pixel, footprint) = ([0; ROOM], [0.0; ROOM]);
            self.queues.push(TextureQueue { count: 0, pixel, gain: black, point: black, footprint });
        }
        if cuts::MANY_BODIES {
            self.used.resize(self.queues.len().div_ceil(64), 0);
        }
        self.filter = filter;
    }

    /// Adds the textured hits of one sample of a pixel, for a `share` of the pixel. Footprints are metres.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    pub fn push<S: Simd>(
        &mut self,
        simd: S,
        world: &World,
        tile: &mut Tile,
        pixel: u16,
        sample: &Sample,
        share: f32,
        footprint: &[f32; REMEMBERED],
    ) {
        for ((object, hit), &footprint) in sample.hits().zip(footprint) {
            self.mark(object);
            let queue = &mut self.queues[object as usize];
            let at = queue.count & (BLOCK - 1);
            let point = hit_point(hit);
            queue.pixel[at] = pixel;
            queue.footprint[at] = footprint;
            for axis in 0..3 {
                queue.gain[axis][at] = hit[GAIN + axis] * share;
                queue.point[axis][at] = point[axis];
            }
            queue.count += 1;
            if queue.count == BLOCK {
                flush(simd, world, queue, object, self.filter, tile);
            }
        }
    }

    /// Adds a hit of one object for each of the first `count` of `pixels`, counted from the pixel `first`: gains, points and
    /// footprints in the same order.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    pub fn push_run<S: Simd>(
        &mut self,
        simd: S,
        world: &World,
        tile: &mut Tile,
        object: u32,
        (first, pixels, count): (u16, &[u16; RUN], usize),
        gain: &Block3,
        point: &Block3,
        footprint: &[f32; BLOCK],
    ) {
        self.mark(object);
        let queue = &mut self.queues[object as usize];
        // All of them, whatever their number: copies of one length need no calls.
        let start = queue.count & (BLOCK - 1);
        let to = start..start + RUN;
        for (to, pixel) in queue.pixel[to.clone()].iter_mut().zip(pixels) {
            *to = first + pixel;
        }
        // Vectors, as the 64 kB build has no fast copies of slices.
        f32x16::from_slice(simd, &footprint[..RUN]).store_slice(&mut queue.footprint[to.clone()]);
        for axis in 0..3 {
            f32x16::from_slice(simd, &gain[axis][..RUN]).store_slice(&mut queue.gain[axis][to.clone()]);
            f32x16::from_slice(simd, &point[axis][..RUN]).store_slice(&mut queue.point[axis][to.clone()]);
        }
        queue.count += count;
        if queue.count >= BLOCK {
            flush(simd, world, queue, object, self.filter, tile);
        }
    }

    /// Notes that hits of an object may wait.
    #[inline(always)]
    fn mark(&mut self, object: u32) {
        if cuts::MANY_BODIES {
            self.used[object as usize / 64] |= 1 << (object % 64);
        }
    }

    /// Looks up the hits that still wait.
    pub fn finish<S: Simd>(&mut self, simd: S, world: &World, tile: &mut Tile) {
        let words = if cuts::MANY_BODIES { self.used.len() } else { 1 };
        for word in 0..words {
            let used = match self.used.get_mut(word) {
                Some(used) if cuts::MANY_BODIES => std::mem::take(used),
                _ => u64::MAX >> (64 - self.queues.len()),
            };
            for bit in Bits(used) {
                let object = word * 64 + bit;
                let queue = &mut self.queues[object];
                if queue.count > 0 {
                    flush(simd, world, queue, object as u32, self.filter, tile);
                }
            }
        }
    }
}

/// Evaluates the texture of the first block of a queue, adds the light to its pixels and takes it out of the queue.
#[simd]
fn flush<S: Simd>(simd: S, world: &World, queue: &mut TextureQueue, object: u32, filter: bool, tile: &mut Tile) {
    let count = queue.count.min(BLOCK);
    // What stands behind the last hit is left over from earlier ones, and must not decide how many octaves are computed.
    let last = queue.footprint[0];
    queue.footprint[count..BLOCK].fill(last);
    let footprint = if filter { queue.footprint.first_chunk() } else { None };
    let albedo = &world.objects[object as usize].material.albedo;
    #[cfg(feature = "full")]
    if !tile.octaves.is_empty() {
        count_octaves(tile, albedo, footprint, &mut queue.pixel[..count].iter().map(|pixel| *pixel as usize));
    }
    let mut color = [[0.0; BLOCK]; 3];
    for (color, point) in color.iter_mut().zip(&queue.point) {
        color.copy_from_slice(&point[..BLOCK]);
    }
    texture::shade(simd, albedo, &mut color, count, footprint);
    let Tile { red, green, blue, .. } = tile;
    for (i, &pixel) in queue.pixel[..count].iter().enumerate() {
        let pixel = pixel as usize & (Tile::AREA - 1);
        red[pixel] += color[0][i] * queue.gain[0][i];
        green[pixel] += color[1][i] * queue.gain[1][i];
        blue[pixel] += color[2][i] * queue.gain[2][i];
    }
    for numbers in queue.gain.iter_mut().chain(&mut queue.point) {
        numbers.copy_within(BLOCK.., 0);
    }
    queue.pixel.copy_within(BLOCK.., 0);
    queue.footprint.copy_within(BLOCK.., 0);
    queue.count -= count;
}
