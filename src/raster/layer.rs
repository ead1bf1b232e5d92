//! The rasterizer as a layer of a picture: the stages of a frame, and of a tile.

use super::collect::collect;
use super::context::{ShadeContext, ShadowLookup};
use super::depth_map::MapKey;
use super::fill::fill;
#[cfg(feature = "full")]
use super::inspect;
use super::memory::{RasterMemory, Scratch};
use super::project::Projection;
use super::rasters::Raster;
use super::shade::flush;
use super::shadow_views::ShadowViews;
use super::triangle::SUB;
use super::visible::SubPixel;
use super::world::World;
use crate::cuts;
use crate::frame::cache::Kept;
#[cfg(feature = "full")]
use crate::frame::inspect::{Aspect, each};
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::settings::RasterSettings;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::F;
use crate::view::View;
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::Vec3A;

/// A world seen by a camera: the first layer of a picture, which clears its tiles.
pub struct RasterLayer {
    world: World,
    view: View,
    settings: RasterSettings,
    /// The camera's raster.
    raster: Raster,
    /// Shadows of each light, and after those of falling snow.
    lookups: Vec<ShadowLookup>,
    /// What the renderer keeps; none until the layer is prepared.
    memory: Option<Kept<RasterMemory>>,
}

impl RasterLayer {
    /// A world as a view shows it. The frame must have the size of the view, at most 16,384 pixels along either side, and
    /// `coverage` must be from 1 to 16.
    pub fn new(world: World, view: &View, settings: &RasterSettings) -> RasterLayer {
        let (view, settings) = (*view, *settings);
        RasterLayer { world, view, settings, raster: Raster::default(), lookups: Vec::new(), memory: None }
    }

    /// Finds for each light, and for falling snow, where its shadows are looked up: in a map that an earlier frame has
    /// begun, or in a new one.
    #[inline(always)]
    fn look_up_shadows(&mut self, eye: &Projection, memory: &Kept<RasterMemory>) {
        let World { bodies, lights, snow, .. } = &self.world;
        let snow = snow.iter().map(|snow| &snow.fall);
        for (slot, light) in lights.iter().chain(snow).enumerate() {
            let mut lookup = None;
            // The shadows of a lamp that reaches nothing in the picture are never looked up.
            if let Some(&ShadowViews { ref views, back_faces, first_caster, .. }) = light.shadow_views()
                && light.counts(eye)
            {
                let mut key = MapKey { slot, views: views.clone(), back_faces, casters: Vec::new() };
                for body in bodies.iter().skip(first_caster) {
                    if light.reaches(body.bound.0, body.bound.1) {
                        key.casters.push(body.clone());
                    }
                }
                lookup = Some(memory.lock().maps.get(key));
            }
            self.lookups.push(lookup);
        }
    }

    /// Draws a tile; returns the number of fragments.
    ///
    /// ```text
    /// for each cell of a grid in the pixel          (one, except for the reference)
    ///     find what is visible at each sample of the cell
    ///     collect fragments, and shade those of full queues
    /// shade what is left in queues
    /// ```
    #[inline(always)]
    fn draw_in<S: Simd>(&self, simd: S, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
        let RasterLayer { world, view, raster, lookups, settings, .. } = self;
        let grid = settings.built().grid as u32;
        let count = if grid > 1 { 1 } else { settings.coverage };
        let Scratch { planes, queues } = scratch;
        let planes = &mut planes[..count];
        let at = [tile.x, tile.y].map(|n| n / Tile::SIZE);
        // Fragments are added to both planes, whether or not layers follow.
        tile.solids_matter = true;
        tile.clear();
        let share = 1.0 / (grid * grid * count as u32) as f32;
        let threshold = settings.built().threshold;
        let pixel = view.pixel() / grid as f32;
        let context = ShadeContext { world, lookups, raster, view, share, pixel, threshold };
        let mut fragments = 0;
        if raster.meshes.iter().any(|mesh| !mesh.bins.of(at).is_empty()) {
            for pass in 0..grid * grid {
                for (k, (visible, place)) in planes.iter_mut().enumerate() {
                    *place = match grid {
                        1 => spread(k as u32, count as u32),
                        _ => cell([pass % grid, pass / grid], grid),
                    };
                    visible.clear(&tile.hidden);
                }
                fill(simd, &mut raster.meshes.iter(), at, planes);
                fragments += collect(simd, &context, planes, queues, tile);
            }
            for (texture, queue) in queues.iter_mut().enumerate() {
                if queue.count > 0 {
                    flush(simd, &context, texture, queue, tile);
                }
            }
        }
        if cuts::BACKGROUND
            && let Some(color) = world.background
        {
            behind(simd, color, tile);
        }
        fragments
    }
}

/// Adds the background to what solids leave open in a tile.
#[inline(always)]
fn behind<S: Simd>(simd: S, color: Vec3A, tile: &mut Tile) {
    let planes = [&mut tile.red, &mut tile.green, &mut tile.blue];
    for (plane, light) in planes.into_iter().zip(color.to_array()) {
        let coverage = tile.coverage.as_chunks::<BLOCK>().0;
        for (block, coverage) in plane.as_chunks_mut::<BLOCK>().0.iter_mut().zip(coverage) {
            let mut i = 0;
            while i < BLOCK / F::<S>::LEN {
                let open = -load::<S, F<S>>(simd, coverage, i) + 1.0;
                store(open * light + load::<S, F<S>>(simd, block, i), block, i);
                i += 1;
            }
        }
    }
}

/// The place of sample `k` of `n` in a pixel: a lattice with one sample in each row and each column of an `n` x `n` grid.
fn spread(k: u32, n: u32) -> SubPixel {
    let multiplier = if n == 4 { 2 } else { 5 };
    cell([k, multiplier * (k + 1) % (n + 1) - 1], n)
}

/// The middle of a cell of an `n` x `n` grid in a pixel, by its column and row.
fn cell(at: [u32; 2], n: u32) -> SubPixel {
    at.map(|at| ((2 * at + 1) * (SUB as u32 / 2) / n) as i32)
}

impl Layer for RasterLayer {
    fn prepare(&mut self, workers: &Workers, cache: &Cache) {
        let memory = cache.get();
        let projection = Projection::of_view(&self.view);
        self.look_up_shadows(&projection, &memory);
        self.raster = Raster::new(workers, &projection, &self.world.bodies);
        self.memory = Some(memory);
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let memory = self.memory.as_ref().expect("a layer that is prepared");
        let mut scratch = memory.lock().spare.pop().unwrap_or_else(Scratch::new);
        let samples = dispatch!(level, simd => self.draw_in(simd, tile, &mut scratch));
        memory.lock().spare.push(scratch);
        Stats { samples }
    }

    #[cfg(feature = "full")]
    fn inspect(&self, aspect: Aspect, level: Level, tile: &mut Tile) -> Option<Vec<f32>> {
        let raster = &self.raster;
        let middle = |x: usize, y: usize| (x as f32 + 0.5, y as f32 + 0.5);
        let mapped = self.world.lights.iter().zip(&self.lookups).find(|(light, _)| light.shadow_views().is_some());
        match aspect {
            Aspect::Samples => {
                // Places of samples as `draw_in` has them: what shows several triangles is shaded as often.
                let grid = self.settings.built().grid as u32;
                let places: Vec<_> = match grid {
                    1 => (0..self.settings.coverage as u32).map(|k| spread(k, self.settings.coverage as u32)).collect(),
                    _ => (0..grid * grid).map(|pass| cell([pass % grid, pass / grid], grid)).collect(),
                };
                Some(each(tile, |x, y| {
                    let mut shown = Vec::new();
                    for place in &places {
                        let [px, py] =
                            [(x, place[0]), (y, place[1])].map(|(at, sub)| at as f32 + sub as f32 / SUB as f32);
                        shown.extend(inspect::visible(raster, &self.view, px, py).map(|shown| shown.triangle));
                    }
                    if grid == 1 {
                        shown.sort_unstable();
                        shown.dedup();
                    }
                    shown.len() as f32
                }))
            }
            Aspect::Triangles => {
                let count = inspect::listed(raster, [tile.x, tile.y].map(|n| n / Tile::SIZE)).count();
                Some(each(tile, |_, _| count as f32))
            }
            Aspect::Octaves => {
                let mut own = tile.again();
                own.octaves = vec![0.0; Tile::AREA];
                self.draw(level, &mut own);
                Some(own.octaves)
            }
            Aspect::Overdraw => Some(each(tile, |x, y| {
                let (x, y) = middle(x, y);
                inspect::overdraw(raster, x, y) as f32
            })),
            Aspect::ShadowView => {
                let (light, _) = mapped?;
                Some(each(tile, |x, y| {
                    let (x, y) = middle(x, y);
                    let shown = inspect::visible(raster, &self.view, x, y);
                    shown.and_then(|shown| inspect::shadow_view(light, &shown)).map_or(0.0, |view| 1.0 + view as f32)
                }))
            }
            Aspect::ShadowMap => {
                let (light, lookup) = mapped?;
                let views = light.shadow_views()?.views.len();
                let [width, height] = [self.view.width(), self.view.height()].map(|n| n as f32);
                let depths = inspect::MapDepths::new(lookup, views)?;
                Some(each(tile, |x, y| {
                    let (x, y) = middle(x, y);
                    depths.at(x / width, y / height)
                }))
            }
            _ => None,
        }
    }

    #[cfg(feature = "full")]
    fn explain(&self, _: Level, _: &Tile, x: usize, y: usize) -> Vec<String> {
        match inspect::visible(&self.raster, &self.view, x as f32 + 0.5, y as f32 + 0.5) {
            Some(shown) => inspect::explain(&self.world, &self.lookups, &shown),
            None => vec!["nothing at the middle of the pixel".into()],
        }
    }
}
