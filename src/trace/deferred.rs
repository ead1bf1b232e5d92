//! Textures, looked up late: hits wait in a queue for each object until a block is full.
//!
//! Whether a pixel was traced or interpolated, its textures are evaluated at its own hit points, so none is smeared;
//! and noise always runs on full blocks, however broken the picture is.

use super::lanes::F;
use super::packet::Textured;
use super::texture::{self, Block3};
use super::world::World;
use crate::noise::BLOCK;
use crate::tile::Tile;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// Hits that wait for one object's texture.
#[derive(Clone)]
struct Queue {
    count: usize,
    pixel: [u16; BLOCK],
    gain: Block3,
    point: Block3,
}

/// All waiting hits of a tile.
#[derive(Default)]
pub struct Deferred {
    queues: Vec<Queue>,
}

impl Deferred {
    /// Ready for a world of that many objects.
    pub fn begin(&mut self, objects: usize) {
        let empty = Queue { count: 0, pixel: [0; BLOCK], gain: [[0.0; BLOCK]; 3], point: [[0.0; BLOCK]; 3] };
        self.queues.resize(objects, empty);
    }

    /// Adds one hit of a pixel.
    #[inline(always)]
    pub fn push<S: Simd>(&mut self, simd: S, world: &World, tile: &mut Tile, pixel: u16, hit: &Textured) {
        let queue = &mut self.queues[hit.object as usize];
        let at = queue.count;
        queue.pixel[at] = pixel;
        for axis in 0..3 {
            queue.gain[axis][at] = hit.gain[axis];
            queue.point[axis][at] = hit.point[axis];
        }
        queue.count += 1;
        if queue.count == BLOCK {
            flush(simd, world, queue, hit.object, tile);
        }
    }

    /// Adds a run of hits of one object; all slices are of the same length.
    #[inline(always)]
    pub fn push_run<S: Simd>(
        &mut self,
        simd: S,
        world: &World,
        tile: &mut Tile,
        object: u32,
        pixels: &[u16],
        gain: &Block3,
        point: &Block3,
    ) {
        let queue = &mut self.queues[object as usize];
        let mut done = 0;
        while done < pixels.len() {
            let (at, n) = (queue.count, (BLOCK - queue.count).min(pixels.len() - done));
            queue.pixel[at..at + n].copy_from_slice(&pixels[done..done + n]);
            for axis in 0..3 {
                queue.gain[axis][at..at + n].copy_from_slice(&gain[axis][done..done + n]);
                queue.point[axis][at..at + n].copy_from_slice(&point[axis][done..done + n]);
            }
            queue.count += n;
            done += n;
            if queue.count == BLOCK {
                flush(simd, world, queue, object, tile);
            }
        }
    }

    /// Looks up all that still waits.
    pub fn finish<S: Simd>(&mut self, simd: S, world: &World, tile: &mut Tile) {
        for (object, queue) in self.queues.iter_mut().enumerate() {
            if queue.count > 0 {
                flush(simd, world, queue, object as u32, tile);
            }
        }
    }
}

/// Evaluates a queue's texture and adds the light to its pixels.
#[simd]
fn flush<S: Simd>(simd: S, world: &World, queue: &mut Queue, object: u32, tile: &mut Tile) {
    let mut color = [[0.0; BLOCK]; 3];
    texture::shade(simd, &world.objects[object as usize].material.albedo, &queue.point, &mut color);
    for (channel, plane) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().enumerate() {
        for i in (0..BLOCK).step_by(F::<S>::LEN) {
            let range = i..i + F::<S>::LEN;
            let light = F::<S>::from_slice(simd, &color[channel][range.clone()])
                * F::<S>::from_slice(simd, &queue.gain[channel][range.clone()]);
            light.store_slice(&mut color[channel][range]);
        }
        for (&pixel, &light) in queue.pixel[..queue.count].iter().zip(&color[channel]) {
            plane[pixel as usize & (Tile::AREA - 1)] += light;
        }
    }
    queue.count = 0;
}
