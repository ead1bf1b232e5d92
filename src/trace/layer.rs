//! The ray tracer as a layer of a picture.

use super::adaptive::{self, Scratch};
use super::bounds::{Bounds, WORD};
use super::guard::Guard;
#[cfg(feature = "full")]
use super::inspect;
use super::job::Job;
use super::packet::{Limits, TraceContext};
#[cfg(feature = "full")]
use super::reference::Ray;
use super::surface::{self, SurfaceNumbers};
use super::world::World;
use crate::cuts;
use crate::frame::cache::{Kept, keep};
#[cfg(feature = "full")]
use crate::frame::inspect::{Aspect, each};
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::settings::TraceSettings;
use crate::simd::lanes::Bits;
use crate::simd::math::to_f32;
use crate::texture::Variation;
use crate::view::{Cone, View};
use fearless_simd::{Level, dispatch};
use glam::Vec3A;

/// A world as a view shows it. The layer fills every pixel and writes inverse depth and coverage, so it comes first.
pub struct TraceLayer {
    world: World,
    surfaces: Vec<SurfaceNumbers>,
    bounds: Bounds,
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
#[expect(clippy::vec_box)] // Scratch memory is passed on by its pointer: moving all of it takes 1.4 kB of code.
struct Memory(Vec<Box<Scratch>>);
keep!(Memory, Memory(Vec::new()));

impl TraceLayer {
    /// The layer of a world. Its picture has the size of the view.
    ///
    /// The world is taken as it is: see [`world`](super::world) for what it must keep to.
    pub fn new(world: World, view: &View, settings: &TraceSettings) -> TraceLayer {
        let bounds = Bounds::new(&world);
        let guard = Guard::new(&world, &bounds, view);
        let surfaces = world.objects.iter().map(|o| surface::numbers(&o.material)).collect();
        let variation = world.objects.iter().map(|o| o.material.albedo.variation()).collect();
        // What counts is light, not weight: a faint ray may meet a lamp's glare.
        let brightest = world.lights.iter().map(|l| l.color.max_element()).fold(1.0, f32::max);
        let TraceSettings { min_weight, min_detail, light_samples, .. } = settings.built();
        let limits = Limits { min_weight: min_weight / brightest, min_detail: min_detail / brightest, light_samples };
        TraceLayer { world, surfaces, bounds, variation, view: *view, guard, limits, settings: *settings, memory: None }
    }

    /// Lists the objects that eye rays through a tile may meet: those whose bounds touch the cone around the tile.
    fn visible(&self, tile: &Tile, visible: &mut Vec<u64>) {
        let eye = self.view.camera().eye;
        let (x, y) = (to_f32(tile.x), to_f32(tile.y));
        let half = Tile::SIZE as f32 * 0.5;
        // Corners of the grid reach one pixel beyond the tile.
        let cone = Cone::new(&self.view, (x + half, y + half), half + 1.0);
        visible.clear();
        for (word, &all) in self.bounds.all.iter().enumerate() {
            let mut bits = 0;
            let meets = |(center, radius): (Vec3A, f32)| cone.may_meet(center - eye, radius);
            if !cuts::MANY_BODIES || self.bounds.all.len() == 1 || meets(self.bounds.around(word)) {
                for bit in Bits(all) {
                    let body = &self.world.objects[self.bounds.index(word * WORD + bit)];
                    bits |= (meets(body.shape.bound()) as u64) << bit;
                }
            }
            visible.push(bits);
        }
    }

    /// The eye ray through a point of the picture, pixels.
    #[cfg(feature = "full")]
    fn eye_ray(&self, x: usize, y: usize) -> Ray {
        Ray::new(self.view.camera().eye, self.view.direction(x as f32, y as f32))
    }

    /// Draws a tile; returns the number of eye rays.
    fn draw_in(&self, level: Level, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
        let TraceLayer { world, surfaces, bounds, variation, view, guard, limits, settings, .. } = self;
        let mut visible = std::mem::take(&mut scratch.visible);
        self.visible(tile, &mut visible);
        let context = TraceContext { world, surfaces, view, bounds, visible: &visible, limits: *limits };
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
        // A layer that was not prepared draws too, with memory of its own.
        let mut scratch = self.memory.as_ref().and_then(|memory| memory.lock().0.pop()).unwrap_or_default();
        let samples = self.draw_in(level, tile, &mut scratch);
        if let Some(memory) = &self.memory {
            memory.lock().0.push(scratch);
        }
        Stats { samples }
    }

    #[cfg(feature = "full")]
    fn positions(&self, level: Level, tile: &mut Tile) -> Vec<(f32, f32)> {
        let mut scratch = Scratch::default();
        self.draw_in(level, tile, &mut scratch);
        scratch.positions().collect()
    }

    #[cfg(feature = "full")]
    fn inspect(&self, aspect: Aspect, level: Level, tile: &mut Tile) -> Option<Vec<f32>> {
        match aspect {
            Aspect::Samples => {
                let mut numbers = vec![0.0; Tile::AREA];
                for (x, y) in self.positions(level, &mut tile.again()) {
                    let [column, row] = [(x, tile.x), (y, tile.y)].map(|(at, corner)| at as usize - corner);
                    if column < tile.width && row < tile.height {
                        numbers[row * Tile::SIZE + column] += 1.0;
                    }
                }
                Some(numbers)
            }
            Aspect::Squares => {
                let mut scratch = Scratch::default();
                self.draw_in(level, &mut tile.again(), &mut scratch);
                Some(inspect::squares(scratch.squares(1 + self.settings.antialias as usize)))
            }
            Aspect::Octaves => {
                let mut own = tile.again();
                own.octaves = vec![0.0; Tile::AREA];
                self.draw_in(level, &mut own, &mut Scratch::default());
                Some(own.octaves)
            }
            Aspect::Candidates => {
                let mut visible = Vec::new();
                self.visible(tile, &mut visible);
                let count: u32 = visible.iter().map(|word| word.count_ones()).sum();
                Some(each(tile, |_, _| count as f32))
            }
            Aspect::RayDepth => {
                let mut row = Vec::new();
                Some(each(tile, |x, y| {
                    let (column, even) = (x - tile.x, (y - tile.y).is_multiple_of(2));
                    if column == 0 && even {
                        row.clear();
                    }
                    if even && column.is_multiple_of(2) {
                        row.push(inspect::depth(&self.world, self.eye_ray(x + 1, y + 1), 1) as f32);
                    }
                    row[column / 2]
                }))
            }
            _ => None,
        }
    }

    #[cfg(feature = "full")]
    fn explain(&self, level: Level, tile: &Tile, x: usize, y: usize) -> Vec<String> {
        let within = |at: &(f32, f32)| at.0 as usize == x && at.1 as usize == y;
        let count = self.positions(level, &mut tile.again()).iter().filter(|at| within(at)).count();
        let mut lines = vec![match count {
            0 => "no eye ray here: interpolated between the corners of a square".into(),
            1 => "1 eye ray here".into(),
            _ => format!("{count} eye rays here"),
        }];
        lines.push("through its middle, without thresholds, lights as points:".into());
        let middle = self.view.direction(x as f32 + 0.5, y as f32 + 0.5);
        let ray = Ray::new(self.view.camera().eye, middle);
        inspect::trail(&self.world, ("from the eye", ray, Vec3A::ONE), 1, &mut lines);
        lines
    }
}
