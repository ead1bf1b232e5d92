//! The Whitted ray tracer: shapes, materials and lights; packets; and the adaptive corner grid.
//!
//! One flow: [`world`] (what is there) -> [`guard`] (what must not be missed) -> [`adaptive`] (which rays) ->
//! [`packet`] (what they see) -> [`fill`] (which pixels that is) -> [`deferred`] (what colour that is).
//! [`mod@reference`] is the plain truth beside the packets.

pub mod adaptive;
pub mod deferred;
pub mod edge;
pub mod fill;
pub mod grid;
pub mod guard;
pub mod light;
pub mod packet;
pub mod reference;
pub mod sample;
pub mod shape;
pub mod world;

use crate::frame::{Layer, Stats, Tile};
use crate::settings::{Quality, TraceSettings};
use crate::texture::Variation;
use crate::view::Camera;
use crate::view::View;
use adaptive::{Job, Scratch};
use fearless_simd::{Level, dispatch};
use guard::Guard;
use packet::{Context, Limits};
use std::sync::{Mutex, MutexGuard, PoisonError};
use world::{SURFACE, World};

/// A world seen by a camera, as a layer of a picture. It fills every pixel.
pub struct TraceLayer {
    world: World,
    surfaces: Vec<[f32; SURFACE]>,
    all: Vec<u32>,
    variation: Vec<Variation>,
    view: View,
    guard: Guard,
    quality: TraceSettings,
}

impl TraceLayer {
    /// Prepares a picture of `width` x `height` pixels.
    pub fn new(world: World, camera: Camera, width: usize, height: usize, quality: Quality) -> TraceLayer {
        let view = View::new(camera, width, height);
        let all: Vec<u32> = (0..world.objects.len() as u32).collect();
        let guard = Guard::new(&world, &all, &view, width, height);
        let surfaces = world.objects.iter().map(|o| o.material.numbers()).collect();
        let variation = world.objects.iter().map(|o| o.material.albedo.variation()).collect();
        TraceLayer { world, surfaces, all, variation, view, guard, quality: quality.trace }
    }

    /// The objects that eye rays through a tile may meet: by the distance of their bounds from a cone around the tile.
    fn visible(&self, tile: &Tile, visible: &mut Vec<u32>) {
        let eye = self.view.camera().eye;
        let (x, y) = (tile.x as u32 as f32, tile.y as u32 as f32);
        let half = Tile::SIZE as f32 * 0.5;
        let middle = self.view.ray(x + half, y + half).normalize();
        // Corners of the grid reach one pixel beyond the tile.
        let reach = half + 1.0;
        let corners = [(-reach, -reach), (reach, -reach), (-reach, reach), (reach, reach)];
        let cosine = |(dx, dy)| middle.dot(self.view.ray(x + half + dx, y + half + dy).normalize());
        let cosine = corners.map(cosine).into_iter().fold(1.0f32, f32::min);
        let sine = (1.0 - cosine * cosine).sqrt();
        visible.clear();
        for (index, body) in self.world.objects.iter().enumerate() {
            let (center, radius) = body.shape.bound();
            let way = center - eye;
            let along = way.dot(middle);
            let across = way.distance(middle * along);
            // How far the centre lies outside of the cone around the tile, unless it is behind the eye.
            let outside = across * cosine - along * sine;
            if along >= -radius && outside <= radius * 1.001 + way.length() * 1e-3 {
                visible.push(index as u32);
            }
        }
    }
}

/// Memory that tiles leave to the next ones, as much as threads have needed at a time. Not a thread's own: that would take
/// 3 kB of code to be set up and given back.
static SPARE: Mutex<Vec<Scratch>> = Mutex::new(Vec::new());

fn spare() -> MutexGuard<'static, Vec<Scratch>> {
    SPARE.lock().unwrap_or_else(PoisonError::into_inner)
}

impl TraceLayer {
    /// Draws a tile; returns the number of eye rays and the memory that it took.
    fn draw_in(&self, level: Level, tile: &mut Tile) -> (u64, Scratch) {
        let TraceLayer { world, surfaces, all, variation, view, guard, quality } = self;
        let TraceSettings { min_weight, min_detail, light_samples, .. } = *quality;
        // What counts is light, not weight: a faint ray may meet a lamp's glare.
        let brightest = world.lights.iter().map(|l| l.color.max_element()).fold(1.0, f32::max);
        let (min_weight, min_detail) = (min_weight / brightest, min_detail / brightest);
        let limits = Limits { min_weight, min_detail, light_samples };
        let mut scratch = spare().pop().unwrap_or_default();
        let mut visible = std::mem::take(&mut scratch.visible);
        self.visible(tile, &mut visible);
        let context = Context { world, surfaces, view, visible: &visible, all, limits };
        let job = Job { context, variation, guard, quality };
        let samples = dispatch!(level, simd => adaptive::draw(simd, &job, tile, &mut scratch));
        scratch.visible = visible;
        (samples, scratch)
    }
}

impl Layer for TraceLayer {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let (samples, scratch) = self.draw_in(level, tile);
        spare().push(scratch);
        Stats { samples }
    }

    #[cfg(feature = "full")]
    fn positions(&self, level: Level, tile: &mut Tile) -> Vec<(f32, f32)> {
        self.draw_in(level, tile).1.positions().collect()
    }
}
