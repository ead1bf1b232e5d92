//! The rasterizer: triangles, shadow depth maps, several lights.
//!
//! One flow: [`mesh`] (what there is) -> [`triangle`] (clipped and snapped, in the camera's raster and in each light's) ->
//! [`bins`] (by tile) -> [`mod@fill`] (which triangle each pixel shows; in a light's raster that is all, a [`shadow`] map) ->
//! [`shade`] (each visible fragment once, whitened by [`snow_cover`], under all [`light`]s that reach it).

pub mod bins;
pub mod cloud_shadow;
pub mod exact_shadow;
pub mod fill;
pub mod fit;
pub mod form;
pub mod light;
pub mod mesh;
pub mod project;
pub mod shade;
pub mod shadow;
pub mod snow_cover;
pub mod triangle;

use crate::cuts::BENCH;
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::settings::{Quality, RasterSettings, samples_per_axis};
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::F;
use crate::texture::Texture;
use crate::view::View;
use bins::{Bins, NOTHING, PLAIN};
use cloud_shadow::CloudShadow;
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use fill::{CENTER, Sample, Visible, fill};
use glam::{Affine3A, Vec3};
use light::{Haze, Light, ShadowLookup};
use mesh::Mesh;
use project::Projection;
use shade::{Context, Queue, collect, flush};
use shadow::{DepthMap, Key, ShadowViews};
use snow_cover::SnowCover;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use triangle::{SUB, SetupMesh, TriangleSetup};

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
        let mut body = Body { mesh, place, bound: (Vec3::ZERO, 0.0) };
        body.put(place);
        body
    }

    /// Takes it to another place.
    pub fn put(&mut self, place: Affine3A) {
        let (center, radius) = self.mesh.bound();
        let scale = place.matrix3.x_axis.length();
        (self.bound, self.place) = ((place.transform_point3(center), radius * scale), place);
    }
}

/// Equal are bodies of one mesh in one place.
impl PartialEq for Body {
    fn eq(&self, other: &Body) -> bool {
        Arc::ptr_eq(&self.mesh, &other.mesh) && self.place == other.place
    }
}

/// All that the rasterizer draws.
#[derive(Clone)]
pub struct World {
    /// The surfaces: those after the first 16,384 are left out.
    pub bodies: Vec<Body>,
    /// The textures that paints name: at most 15.
    pub textures: Vec<Texture>,
    /// The lights.
    pub lights: Vec<Light>,
    /// What suns shine through, beside the surfaces.
    pub veil: Option<CloudShadow>,
    /// Snow that lies there.
    pub snow: Option<SnowCover>,
    /// Light from all around: on a wall, and what is added towards the zenith and taken off towards the ground.
    pub ambient: [Vec3; 2],
    /// The haze before what is far, and the sky at the horizon that gloss mirrors.
    pub haze: Haze,
    /// The sky straight above, for gloss.
    pub zenith: Vec3,
    /// Is light squeezed by `1 - exp(-light)`, as on film? Haze and zenith are taken to be so already.
    /// Always, in a build without the bench scenes.
    pub film: bool,
    /// What is behind all, if the raster is to fill it; never, in a build without the bench scenes.
    pub background: Option<Vec3>,
}

/// The bodies in one raster.
pub struct Raster {
    setup: TriangleSetup,
    /// Number of the first body that is drawn.
    from: usize,
    /// One for each body.
    pieces: Vec<SetupMesh>,
    bins: Bins,
}

/// A world seen by a camera, as a layer of a picture: the first one.
pub struct RasterLayer {
    world: World,
    view: View,
    size: [u32; 2],
    quality: RasterSettings,
    /// The camera's, then those of lights that have no map from an earlier frame.
    rasters: Vec<Raster>,
    /// What each light sees; last, what snow falls on.
    sights: Vec<ShadowLookup>,
}

impl RasterLayer {
    /// Prepares a picture of `width` x `height` pixels.
    pub fn new(world: World, view: View, width: usize, height: usize, quality: Quality) -> RasterLayer {
        let size = [width as u32, height as u32];
        RasterLayer { world, view, size, quality: quality.raster, rasters: Vec::new(), sights: Vec::new() }
    }

    /// Draws a tile; returns the number of fragments.
    #[inline(always)]
    fn draw_in<S: Simd>(&self, simd: S, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
        let RasterLayer { world, view, rasters, sights, quality, .. } = self;
        let grid = samples_per_axis(quality.grid) as u32;
        let count = if grid > 1 { 1 } else { quality.coverage };
        let Scratch { planes, queues } = scratch;
        let planes = &mut planes[..count];
        let ids = rasters[0].bins.of(tile.x / Tile::SIZE, tile.y / Tile::SIZE);
        tile.clear();
        tile.coverage.fill(0.0);
        tile.inv_depth.fill(0.0);
        let share = 1.0 / (grid * grid * count as u32) as f32;
        let context = Context { world, sights, rasters, view, share };
        let mut fragments = 0;
        if !ids.is_empty() {
            for pass in 0..grid * grid {
                for (k, (visible, place)) in planes.iter_mut().enumerate() {
                    *place = match grid {
                        1 => spread(k as u32, count as u32),
                        _ => cell([pass % grid, pass / grid], grid),
                    };
                    visible.clear(0.0);
                    fill(simd, &rasters[0].pieces, ids, tile.x as i32, tile.y as i32, *place, visible);
                }
                fragments += collect(simd, &context, planes, queues, tile);
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
fn spread(k: u32, n: u32) -> Sample {
    let multiplier = if n == 4 { 2 } else { 5 };
    cell([k, multiplier * (k + 1) % (n + 1) - 1], n)
}

/// The middle of a cell in a grid of `n` x `n`.
fn cell(at: [u32; 2], n: u32) -> Sample {
    at.map(|at| ((2 * at + 1) * (SUB as u32 / 2) / n) as i32)
}

impl Visible {
    /// To be cleared: what is not used takes no memory.
    fn new() -> Visible {
        Visible { inv_depth: Box::new([0.0; Tile::AREA]), id: Box::new([0; Tile::AREA]) }
    }

    /// Nothing is visible, at that nearness.
    fn clear(&mut self, inv_depth: f32) {
        self.inv_depth.fill(inv_depth);
        self.id.fill(NOTHING);
    }
}

/// Memory that a tile needs.
struct Scratch {
    /// What is visible at each sample, and where that lies in a pixel.
    planes: Vec<(Visible, Sample)>,
    /// By texture.
    queues: Vec<Queue>,
}

impl Scratch {
    fn new() -> Scratch {
        Scratch {
            planes: (0..16).map(|_| (Visible::new(), CENTER)).collect(),
            queues: vec![Queue::EMPTY; PLAIN as usize + 1],
        }
    }
}

/// Memory that tiles leave to the next ones, as much as threads have needed at a time.
static SPARE: Mutex<Vec<Scratch>> = Mutex::new(Vec::new());

fn spare() -> MutexGuard<'static, Vec<Scratch>> {
    SPARE.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Layer for RasterLayer {
    fn prepare(&mut self, workers: &Workers, _cache: &Cache) {
        let RasterLayer { world, rasters, sights, .. } = self;
        let bodies = &world.bodies;
        add(rasters, &Projection::of_view(&self.view, self.size), false, true, 0, bodies.len());
        let mut missing = Vec::new();
        let snow = world.snow.iter().map(|snow| &snow.from);
        for (slot, light) in world.lights.iter().chain(snow).enumerate() {
            let mut sight = ShadowLookup { map: None, first: rasters.len() };
            // A lamp that reaches nothing in the picture is never asked what it sees.
            if let Some(&ShadowViews { ref views, back_faces, traced, from, .. }) = light.plan()
                && light.counts(&rasters[0].setup.projection)
            {
                let mut key = Key { slot, views: views.clone(), back_faces, casters: Vec::new() };
                for body in bodies.iter().skip(from) {
                    if light.reaches(body.bound.0, body.bound.1) {
                        key.casters.push(body.clone());
                    }
                }
                let traced = BENCH && traced;
                // What is traced has no map, though another frame may have kept one of the same views.
                let kept = if traced { Err(DepthMap::default()) } else { shadow::recall(&key) };
                match kept {
                    Ok(map) => sight.map = Some(map),
                    Err(map) => {
                        for view in views {
                            add(rasters, view, back_faces, false, from, bodies.len());
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
        for Raster { setup, from, pieces, .. } in rasters.iter_mut() {
            for (piece, body) in pieces.iter_mut().zip(bodies).skip(*from) {
                if !setup.projection.misses(body.bound.0, body.bound.1) {
                    jobs.push((&*setup, piece, body));
                }
            }
        }
        workers.each(jobs.iter_mut(), |(setup, piece, body)| **piece = setup.piece(&body.mesh, &body.place));
        workers.each(rasters.iter_mut(), |raster| {
            raster.bins = Bins::new(&raster.pieces, raster.setup.projection.size);
        });
        while let Some((key, mut map)) = missing.pop() {
            let sight = &mut sights[key.slot];
            map.resize(key.views[0].size[0] as usize, key.views.len());
            draw_map(workers, &mut map, &rasters[sight.first..]);
            sight.map = Some(shadow::keep(key, map));
        }
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let mut scratch = spare().pop().unwrap_or_else(Scratch::new);
        let samples = dispatch!(level, simd => self.draw_in(simd, tile, &mut scratch));
        spare().push(scratch);
        Stats { samples }
    }
}

/// Adds a raster, still empty, for that many bodies, of which those before `from` are left out.
fn add(rasters: &mut Vec<Raster>, projection: &Projection, back_faces: bool, shaded: bool, from: usize, bodies: usize) {
    let setup = TriangleSetup { projection: *projection, back_faces, shaded };
    let pieces = (0..bodies).map(|_| SetupMesh::default()).collect();
    rasters.push(Raster { setup, from, pieces, bins: Bins::default() });
}

/// Draws the depths of triangles, a row of tiles at a time.
fn draw_map(workers: &Workers, map: &mut DepthMap, rasters: &[Raster]) {
    let (size, level) = (map.size, workers.level());
    workers.each(map.bands().enumerate(), |(index, texels)| {
        // In 32 bits, as division of more takes several times the code.
        let (index, bands) = (index as u32, (size / Tile::SIZE) as u32);
        let (Raster { pieces, bins, .. }, band) = (&rasters[(index / bands) as usize], (index % bands) as usize);
        let mut visible = Visible::new();
        for x in (0..size).step_by(Tile::SIZE) {
            let ids = bins.of(x / Tile::SIZE, band);
            visible.clear(shadow::NOTHING);
            let y = (band * Tile::SIZE) as i32;
            dispatch!(level, simd => fill(simd, pieces, ids, x as i32, y, CENTER, &mut visible));
            for (from, to) in visible.inv_depth.chunks(Tile::SIZE).zip(texels.chunks_mut(size)) {
                to[x..][..Tile::SIZE].copy_from_slice(from);
            }
        }
    });
}
