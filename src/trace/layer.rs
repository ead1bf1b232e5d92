//! The ray tracer as a layer of a picture.

use super::adaptive::{self, Scratch};
use super::guard::Guard;
use super::job::Job;
use super::packet::{Limits, TraceContext};
use super::surface::{self, SurfaceNumbers};
use super::world::World;
use crate::frame::cache::Kept;
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::settings::TraceSettings;
use crate::simd::math::to_f32;
use crate::texture::Variation;
use crate::view::{Cone, View};
use fearless_simd::{Level, dispatch};

/// A world as a view shows it. The layer fills every pixel and writes inverse depth and coverage, so it comes first.
pub struct TraceLayer {
    world: World,
    surfaces: Vec<SurfaceNumbers>,
    /// The index of every object.
    all: Vec<u32>,
    variation: Vec<Variation>,
    view: View,
    guard: Guard,
    limits: Limits,
    settings: TraceSettings,
    /// What the renderer keeps; none until the layer is prepared.
    memory: Option<Kept<Memory>>,
}

/// Memory that tiles leave to later ones, as many pieces as threads have drawn tiles at the same time. It is not kept per
/// thread, because setting up and freeing such memory would take 3 kB of code.
#[derive(Default)]
#[expect(clippy::vec_box)] // Scratch memory is passed on by its pointer: moving all of it takes 1.4 kB of code.
struct Memory(Vec<Box<Scratch>>);

impl TraceLayer {
    /// The layer of a world. Its picture has the size of the view.
    ///
    /// The world is taken as it is: see [`world`](super::world) for what it must keep to.
    pub fn new(world: World, view: &View, settings: &TraceSettings) -> TraceLayer {
        let all: Vec<u32> = (0..world.objects.len() as u32).collect();
        let guard = Guard::new(&world, &all, view);
        let surfaces = world.objects.iter().map(|o| surface::numbers(&o.material)).collect();
        let variation = world.objects.iter().map(|o| o.material.albedo.variation()).collect();
        // What counts is light, not weight: a faint ray may meet a lamp's glare.
        let brightest = world.lights.iter().map(|l| l.color.max_element()).fold(1.0, f32::max);
        let TraceSettings { min_weight, min_detail, light_samples, .. } = settings.built();
        let limits = Limits { min_weight: min_weight / brightest, min_detail: min_detail / brightest, light_samples };
        TraceLayer { world, surfaces, all, variation, view: *view, guard, limits, settings: *settings, memory: None }
    }

    /// Lists the objects that eye rays through a tile may meet: those whose bounds touch the cone around the tile.
    fn visible(&self, tile: &Tile, visible: &mut Vec<u32>) {
        let eye = self.view.camera().eye;
        let (x, y) = (to_f32(tile.x), to_f32(tile.y));
        let half = Tile::SIZE as f32 * 0.5;
        // Corners of the grid reach one pixel beyond the tile.
        let cone = Cone::new(&self.view, (x + half, y + half), half + 1.0);
        visible.clear();
        for (index, body) in self.world.objects.iter().enumerate() {
            let (center, radius) = body.shape.bound();
            if cone.may_meet(center - eye, radius) {
                visible.push(index as u32);
            }
        }
    }

    /// Draws a tile; returns the number of eye rays.
    fn draw_in(&self, level: Level, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
        let TraceLayer { world, surfaces, all, variation, view, guard, limits, settings, .. } = self;
        let mut visible = std::mem::take(&mut scratch.visible);
        self.visible(tile, &mut visible);
        let context = TraceContext { world, surfaces, view, visible: &visible, all, limits: *limits };
        let job = Job { context, variation, guard, settings };
        let samples = dispatch!(level, simd => adaptive::draw(simd, &job, tile, scratch));
        scratch.visible = visible;
        samples
    }
}

impl Layer for TraceLayer {
    fn prepare(&mut self, _workers: &Workers, cache: &Cache) {
        self.memory = Some(cache.get());
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let memory = self.memory.as_ref().expect("a layer that is prepared");
        let mut scratch = memory.lock().0.pop().unwrap_or_default();
        let samples = self.draw_in(level, tile, &mut scratch);
        memory.lock().0.push(scratch);
        Stats { samples }
    }

    #[cfg(feature = "full")]
    fn positions(&self, level: Level, tile: &mut Tile) -> Vec<(f32, f32)> {
        let mut scratch = Scratch::default();
        self.draw_in(level, tile, &mut scratch);
        scratch.positions().collect()
    }
}
