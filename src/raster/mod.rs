//! The rasterizer: triangles, shadow depth maps, several lights.
//!
//! One flow: [`mesh`] (what there is) -> [`triangle`] (clipped and snapped, in the camera's raster and in each light's) ->
//! [`bins`] (by tile) -> [`mod@fill`] (which triangle each pixel shows; in a light's raster that is all, a [`shadow`] map) ->
//! [`shade`] (each visible fragment once, under all [`light`]s that reach it).

pub mod bins;
pub mod fill;
pub mod fit;
pub mod form;
pub mod light;
pub mod mesh;
pub mod project;
pub mod shade;
pub mod shadow;
pub mod traced;
pub mod triangle;

use crate::block::{BLOCK, load, store};
use crate::lanes::F;
use crate::quality::Quality;
use crate::texture::Texture;
use crate::tile::{Crew, Layer, Stats, Tile};
use crate::view::View;
use bins::{Bins, NOTHING, PLAIN};
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use fill::{CENTER, Sample, Visible, fill};
use glam::{Affine3A, Vec3};
use light::{Haze, Light, Sight};
use mesh::Mesh;
use project::Projection;
use shade::{Context, Queue, collect, flush};
use shadow::{DepthMap, Key, Plan};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use triangle::{Piece, SUB, Setup};

/// A mesh in the world.
#[derive(Clone)]
pub struct Body {
    /// Its surface: at most 8,192 faces.
    mesh: Arc<Mesh>,
    /// From its own space to the world.
    place: Affine3A,
    /// Middle and radius of a ball around it in the world.
    bound: (Vec3, f32),
}

impl Body {
    /// A mesh of at most 8,192 faces where `place` takes it: turned, moved, scaled alike in all directions.
    pub fn new(mesh: Arc<Mesh>, place: Affine3A) -> Body {
        let (center, radius) = mesh.bound();
        let scale = place.matrix3.x_axis.length();
        Body { bound: (place.transform_point3(center), radius * scale), mesh, place }
    }
}

/// Equal are bodies of one mesh in one place.
impl PartialEq for Body {
    fn eq(&self, other: &Body) -> bool {
        Arc::ptr_eq(&self.mesh, &other.mesh) && self.place == other.place
    }
}

/// Are the bench scenes there? What they alone ask for, the intro does without: a background, light without film, lookups
/// of depth maps in which each texel counts alike.
const BENCH: bool = cfg!(feature = "bench-scenes");

/// All that the rasterizer draws.
#[derive(Clone)]
pub struct World {
    /// The surfaces: those after the first 16,384 are left out.
    pub bodies: Vec<Body>,
    /// The textures that paints name: at most 15.
    pub textures: Vec<Texture>,
    /// The lights: up to 32 reach one place.
    pub lights: Vec<Light>,
    /// Light from all around: on a wall, and what is added towards the zenith and taken off towards the ground.
    pub ambient: [Vec3; 2],
    /// The haze before what is far, and the sky at the horizon that gloss mirrors.
    pub haze: Haze,
    /// The sky straight above, for gloss.
    pub zenith: Vec3,
    /// Is light squeezed by `1 - exp(-light)`, as on film? Haze and zenith are taken to be so already.
    pub film: bool,
    /// What is behind all, if the raster is to fill it.
    pub background: Option<Vec3>,
}

/// The bodies in one raster.
pub struct Raster {
    setup: Setup,
    /// One for each body.
    pieces: Vec<Piece>,
    bins: Bins,
}

/// A world seen by a camera, as a layer of a picture: the first one.
pub struct Drawn {
    world: World,
    view: View,
    size: [u32; 2],
    quality: Quality,
    /// The camera's, then those of lights that have no map from an earlier frame.
    rasters: Vec<Raster>,
    /// What each light sees.
    sights: Vec<Sight>,
}

impl Drawn {
    /// Prepares a picture of `width` x `height` pixels.
    pub fn new(world: World, view: View, width: usize, height: usize, quality: Quality) -> Drawn {
        let size = [width as u32, height as u32];
        Drawn { world, view, size, quality, rasters: Vec::new(), sights: Vec::new() }
    }

    /// Draws a tile; returns the number of fragments.
    #[inline(always)]
    fn draw_in<S: Simd>(&self, simd: S, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
        let Drawn { world, view, rasters, sights, quality, .. } = self;
        let grid = quality.grid;
        let count = if grid > 1 { 1 } else { quality.coverage };
        let Scratch { visible, queues } = scratch;
        visible.resize_with(count.max(visible.len()), Visible::new);
        queues.resize(PLAIN as usize + 1, Queue::EMPTY);
        let visible = &mut visible[..count];
        let ids = rasters[0].bins.of(tile.x / Tile::SIZE, tile.y / Tile::SIZE);
        tile.clear();
        tile.coverage.fill(0.0);
        tile.closeness.fill(0.0);
        let share = 1.0 / (grid * grid * count) as u32 as f32;
        let context = Context { world, sights, rasters, view, share };
        let mut fragments = 0;
        if !ids.is_empty() {
            for pass in 0..grid * grid {
                let mut places = [CENTER; 16];
                for (k, (plane, place)) in visible.iter_mut().zip(&mut places).enumerate() {
                    *place = match grid {
                        1 => spread(k, count),
                        _ => [pass % grid, pass / grid].map(|n| ((2 * n + 1) * SUB as usize / (2 * grid)) as i32),
                    };
                    plane.clear(0.0);
                    fill(simd, &rasters[0].pieces, ids, tile.x as i32, tile.y as i32, *place, plane);
                }
                fragments += collect(simd, &context, visible, &places[..count], queues, tile);
            }
            for (texture, queue) in queues.iter_mut().enumerate() {
                if queue.count > 0 {
                    flush(simd, &context, texture, queue, tile);
                }
            }
        }
        if BENCH && let Some(color) = world.background {
            behind(simd, color, tile);
        }
        fragments
    }
}

/// Fills what solids left of a tile.
#[inline(always)]
fn behind<S: Simd>(simd: S, color: Vec3, tile: &mut Tile) {
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

/// Where sample `k` of `n` lies in a pixel: one in each row and column of an `n` x `n` grid, spread like a lattice.
fn spread(k: usize, n: usize) -> Sample {
    let step = SUB as usize / n;
    let multiplier = if n == 4 { 2 } else { 5 };
    let row = multiplier * (k + 1) % (n + 1) - 1;
    [k, row].map(|cell| (cell * step + step / 2) as i32)
}

impl Visible {
    fn new() -> Visible {
        Visible { nearness: Box::new([0.0; Tile::AREA]), id: Box::new([NOTHING; Tile::AREA]) }
    }

    /// Nothing is visible, at that nearness.
    fn clear(&mut self, nearness: f32) {
        self.nearness.fill(nearness);
        self.id.fill(NOTHING);
    }
}

/// Memory that a tile needs.
#[derive(Default)]
struct Scratch {
    visible: Vec<Visible>,
    queues: Vec<Queue>,
}

/// Memory that tiles leave to the next ones, as much as threads have needed at a time.
static SPARE: Mutex<Vec<Scratch>> = Mutex::new(Vec::new());

fn spare() -> MutexGuard<'static, Vec<Scratch>> {
    SPARE.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Layer for Drawn {
    fn prepare(&mut self, crew: &Crew) {
        let Drawn { world, rasters, sights, .. } = self;
        let bodies = &world.bodies;
        let raster = |projection, back_faces, shaded| Raster {
            setup: Setup { projection, back_faces, shaded },
            pieces: Vec::new(),
            bins: Bins::default(),
        };
        rasters.push(raster(Projection::of_view(&self.view, self.size), false, true));
        let mut missing = Vec::new();
        for (slot, light) in world.lights.iter().enumerate() {
            let mut sight = Sight { map: None, first: rasters.len() };
            if let Some(&Plan { ref views, back_faces, traced, .. }) = light.plan() {
                let mut key = Key { slot, views: views.clone(), back_faces, casters: Vec::new() };
                for body in bodies {
                    if light.reaches(body.bound.0, body.bound.1) {
                        key.casters.push(body.clone());
                    }
                }
                match shadow::recall(&key) {
                    Ok(map) => sight.map = Some(map),
                    Err(map) => {
                        for view in views {
                            rasters.push(raster(*view, back_faces, false));
                        }
                        if !traced {
                            missing.push((key, map));
                        }
                    }
                }
            }
            sights.push(sight);
        }
        let mut jobs = Vec::new();
        for Raster { setup, pieces, .. } in rasters.iter_mut() {
            pieces.resize_with(bodies.len(), Piece::default);
            for (piece, body) in pieces.iter_mut().zip(bodies) {
                if !setup.projection.misses(body.bound.0, body.bound.1) {
                    jobs.push((&*setup, piece, body));
                }
            }
        }
        crew.each(jobs.iter_mut(), |(setup, piece, body)| **piece = setup.piece(&body.mesh, &body.place));
        crew.each(rasters.iter_mut(), |raster| {
            raster.bins = Bins::new(&raster.pieces, raster.setup.projection.size);
        });
        for (key, mut map) in missing {
            let sight = &mut sights[key.slot];
            map.resize(key.views[0].size[0] as usize, key.views.len());
            draw_map(crew, &mut map, &rasters[sight.first..]);
            sight.map = Some(shadow::keep(key, map));
        }
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let mut scratch = spare().pop().unwrap_or_default();
        let samples = dispatch!(level, simd => self.draw_in(simd, tile, &mut scratch));
        spare().push(scratch);
        Stats { samples }
    }
}

/// Draws the depths of triangles, a row of tiles at a time.
fn draw_map(crew: &Crew, map: &mut DepthMap, rasters: &[Raster]) {
    let (size, level) = (map.size, crew.level());
    crew.each(map.bands().enumerate(), |(index, texels)| {
        let (view, band) = (index * Tile::SIZE / size, index % (size / Tile::SIZE));
        let Raster { pieces, bins, .. } = &rasters[view];
        let mut visible = Visible::new();
        for x in (0..size).step_by(Tile::SIZE) {
            let ids = bins.of(x / Tile::SIZE, band);
            visible.clear(shadow::NOTHING);
            let y = (band * Tile::SIZE) as i32;
            dispatch!(level, simd => fill(simd, pieces, ids, x as i32, y, CENTER, &mut visible));
            for (from, to) in visible.nearness.chunks(Tile::SIZE).zip(texels.chunks_mut(size)) {
                to[x..][..Tile::SIZE].copy_from_slice(from);
            }
        }
    });
}
