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
use bins::{Bins, NOTHING};
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use fill::{CENTER, Sample, Visible, fill};
use glam::{Affine3A, Vec3};
use light::{Haze, Light, Lit};
use mesh::Mesh;
use project::Projection;
use shade::{Context, Fragments, Samples};
use shadow::{DepthMap, Key};
use std::sync::{Arc, Mutex, PoisonError};
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
    lights: Vec<Lit>,
}

impl Drawn {
    /// Prepares a picture of `width` x `height` pixels.
    pub fn new(world: World, view: View, width: usize, height: usize, quality: Quality) -> Drawn {
        let size = [width as u32, height as u32];
        Drawn { world, view, size, quality, rasters: Vec::new(), lights: Vec::new() }
    }

    /// Draws a tile; returns the number of fragments.
    #[inline(always)]
    fn draw_in<S: Simd>(&self, simd: S, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
        let Drawn { world, view, rasters, lights, quality, .. } = self;
        let context = Context { world, lights, rasters, view };
        let count = if quality.grid > 1 { 1 } else { quality.coverage };
        scratch.visible.resize_with(count.max(scratch.visible.len()), Visible::new);
        let visible = &mut scratch.visible[..count];
        let ids = rasters[0].bins.of(tile.x / Tile::SIZE, tile.y / Tile::SIZE);
        tile.clear();
        tile.coverage.fill(0.0);
        tile.closeness.fill(0.0);
        let share = 1.0 / (quality.grid * quality.grid * count) as u32 as f32;
        let mut fragments = 0;
        if !ids.is_empty() {
            for pass in 0..quality.grid * quality.grid {
                let mut samples = [CENTER; 16];
                for (k, (plane, sample)) in visible.iter_mut().zip(&mut samples).enumerate() {
                    *sample = match quality.grid {
                        1 => spread(k, count),
                        grid => [pass % grid, pass / grid].map(|n| ((2 * n + 1) * SUB as usize / (2 * grid)) as i32),
                    };
                    plane.clear(0.0);
                    fill(simd, &rasters[0].pieces, ids, tile.x as i32, tile.y as i32, *sample, plane);
                }
                let samples = Samples { visible, places: &samples[..count], share };
                fragments += scratch.fragments.collect(simd, &context, &samples, tile);
            }
            scratch.fragments.finish(simd, &context, tile);
        }
        if let Some(color) = world.background {
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
    let multiplier = [1, 2, 2, 5][n.ilog2().min(3) as usize];
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
    fragments: Fragments,
}

/// Memory that tiles leave to the next ones, as much as threads have needed at a time.
static SPARE: Mutex<Vec<Scratch>> = Mutex::new(Vec::new());

fn with_scratch<T>(work: impl FnOnce(&mut Scratch) -> T) -> T {
    let take = || SPARE.lock().unwrap_or_else(PoisonError::into_inner).pop();
    let mut scratch = take().unwrap_or_default();
    let done = work(&mut scratch);
    SPARE.lock().unwrap_or_else(PoisonError::into_inner).push(scratch);
    done
}

impl Layer for Drawn {
    fn prepare(&mut self, crew: &Crew) {
        let Drawn { world, rasters, lights, .. } = self;
        let raster = |projection, back_faces, shaded| Raster {
            setup: Setup { projection, back_faces, shaded },
            pieces: world.bodies.iter().map(|_| Piece::default()).collect(),
            bins: Bins::default(),
        };
        rasters.push(raster(Projection::of_view(&self.view, self.size), false, true));
        let mut missing = Vec::new();
        for (slot, light) in world.lights.iter().enumerate() {
            let mut lit = Lit::new(light.clone(), rasters.len());
            if let Some(plan) = &lit.light.shadow {
                let casters = world.bodies.iter().filter(|body| lit.reaches(body.bound.0, body.bound.1)).cloned();
                let key = Key { slot, plan: plan.clone(), casters: casters.collect() };
                match shadow::recall(&key) {
                    Ok(map) => lit.map = Some(map),
                    Err(map) => {
                        rasters.extend(plan.views.iter().map(|view| raster(*view, plan.back_faces, false)));
                        if !plan.traced {
                            missing.push((key, map));
                        }
                    }
                }
            }
            lights.push(lit);
        }
        let jobs = rasters.iter_mut().flat_map(|Raster { setup, pieces, .. }| {
            let setup = &*setup;
            pieces.iter_mut().zip(&world.bodies).map(move |(piece, body)| (setup, piece, body))
        });
        crew.each(jobs, |(setup, piece, body)| {
            if !setup.projection.misses(body.bound.0, body.bound.1) {
                *piece = setup.piece(&body.mesh, &body.place);
            }
        });
        crew.each(rasters.iter_mut(), |raster| {
            raster.bins = Bins::new(&raster.pieces, raster.setup.projection.size);
        });
        for (key, mut map) in missing {
            let lit = &mut lights[key.slot];
            map.resize(key.plan.views[0].size[0] as usize, key.plan.views.len());
            draw_map(crew, &mut map, &rasters[lit.first..]);
            lit.map = Some(shadow::keep(key, map));
        }
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let samples = with_scratch(|scratch| dispatch!(level, simd => self.draw_in(simd, tile, scratch)));
        Stats { samples }
    }
}

/// Draws the depths of triangles, a row of tiles at a time.
fn draw_map(crew: &Crew, map: &mut DepthMap, rasters: &[Raster]) {
    let (size, level) = (map.size, crew.level());
    crew.each(map.bands().enumerate(), |(index, texels)| {
        let (view, band) = (index * Tile::SIZE / size, index % (size / Tile::SIZE));
        let Raster { pieces, bins, .. } = &rasters[view];
        with_scratch(|scratch| {
            scratch.visible.resize_with(scratch.visible.len().max(1), Visible::new);
            let visible = &mut scratch.visible[0];
            for x in (0..size).step_by(Tile::SIZE) {
                let ids = bins.of(x / Tile::SIZE, band);
                visible.clear(shadow::NOTHING);
                let y = (band * Tile::SIZE) as i32;
                dispatch!(level, simd => fill(simd, pieces, ids, x as i32, y, CENTER, visible));
                for (from, to) in visible.nearness.chunks(Tile::SIZE).zip(texels.chunks_mut(size)) {
                    to[x..][..Tile::SIZE].copy_from_slice(from);
                }
            }
        });
    });
}
