//! The rasterizer: triangles, shadow depth maps, several lights.
//!
//! One flow: [`mesh`] (what there is) -> [`triangle`] (clipped and snapped, in the camera's raster and in each light's) ->
//! [`bins`] (by tile) -> [`fill`] (which triangle each pixel shows; in a light's raster that is all, a [`shadow`] map) ->
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
use light::{Haze, Light, Lit, Seen};
use mesh::Mesh;
use project::Projection;
use shade::{Context, Fragments, Samples};
use shadow::{DepthMap, Kept, Key};
use std::sync::{Arc, Mutex, PoisonError};
use traced::Casters;
use triangle::{Piece, SUB, Setup};

/// A mesh in the world.
#[derive(Clone)]
pub struct Body {
    /// Its surface: at most 8,192 faces.
    pub mesh: Arc<Mesh>,
    /// From its own space to the world: turned, moved, scaled alike in all directions.
    pub place: Affine3A,
    /// Does it stop light?
    pub casts_shadow: bool,
}

/// All that the rasterizer draws.
#[derive(Clone)]
pub struct World {
    /// The surfaces.
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
    /// What is behind all, if the raster is to fill it.
    pub background: Option<Vec3>,
}

/// A world seen by a camera, as a layer of a picture: the first one.
pub struct Drawn {
    world: World,
    view: View,
    size: [u32; 2],
    quality: Quality,
    pieces: Vec<Piece>,
    bins: Bins,
    lights: Vec<Lit>,
}

impl Drawn {
    /// Prepares a picture of `width` x `height` pixels.
    pub fn new(world: World, view: View, width: usize, height: usize, quality: Quality) -> Drawn {
        let size = [width as u32, height as u32];
        Drawn { world, view, size, quality, pieces: Vec::new(), bins: Bins::default(), lights: Vec::new() }
    }

    /// Draws a tile; returns the number of fragments.
    #[inline(always)]
    fn draw_in<S: Simd>(&self, simd: S, tile: &mut Tile, scratch: &mut Scratch) -> u64 {
        let Drawn { world, view, pieces, bins, lights, quality, .. } = self;
        let context = Context { world, lights, pieces, view };
        let count = if quality.grid > 1 { 1 } else { quality.coverage };
        scratch.visible.resize_with(count.max(scratch.visible.len()), Visible::new);
        let visible = &mut scratch.visible[..count];
        let ids = bins.of(tile.x / Tile::SIZE, tile.y / Tile::SIZE);
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
                    fill(simd, pieces, ids, tile.x as i32, tile.y as i32, *sample, plane);
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
        let lights = self.world.lights.iter().enumerate();
        let kept: Vec<_> = lights
            .map(|(slot, light)| Some(shadow::recall(Key::new(slot, light.shadow.as_ref()?, &self.world.bodies))))
            .collect();
        // The camera's raster first, then those of the lights whose maps have changed.
        let mut rasters = vec![(Projection::of_view(&self.view, self.size), false, true)];
        for kept in kept.iter().flatten() {
            if let Kept::Other(_, Key { plan, .. }) = kept {
                rasters.extend(plan.views.iter().map(|view| (*view, plan.back_faces, false)));
            }
        }
        let mut jobs = Vec::new();
        for (index, (projection, _, shaded)) in rasters.iter().enumerate() {
            for body in self.world.bodies.iter().filter(|body| *shaded || body.casts_shadow) {
                let (center, radius) = body.mesh.bound();
                let scale = body.place.matrix3.x_axis.length();
                if !projection.misses(body.place.transform_point3(center), radius * scale) {
                    jobs.push((index, body, Piece::default()));
                }
            }
        }
        crew.each(jobs.iter_mut(), |(raster, body, piece)| {
            let (projection, back_faces, shaded) = &rasters[*raster];
            let setup = Setup { projection, back_faces: *back_faces, shaded: *shaded };
            *piece = setup.piece(&body.mesh, &body.place);
        });
        let mut binned: Vec<(Vec<Piece>, Bins)> = Vec::new();
        binned.resize_with(rasters.len(), Default::default);
        for (raster, _, piece) in jobs {
            binned[raster].0.push(piece);
        }
        crew.each(binned.iter_mut().zip(&rasters), |((pieces, bins), (projection, _, _))| {
            *bins = Bins::new(pieces, projection.size);
        });
        let mut rest = binned.into_iter();
        (self.pieces, self.bins) = rest.next().unwrap_or_default();
        self.lights.clear();
        for (light, kept) in self.world.lights.iter().zip(kept) {
            let seen = kept.map(|kept| match kept {
                Kept::Same(map) => Seen::Mapped(map),
                Kept::Other(mut map, key) => {
                    let plan = &key.plan;
                    let views: Vec<_> = rest.by_ref().take(plan.views.len()).collect();
                    if plan.traced {
                        return Seen::Traced(Casters { views });
                    }
                    map.resize(plan.views[0].size[0] as usize, views.len());
                    draw_map(crew, &mut map, &views);
                    Seen::Mapped(shadow::keep(key, map))
                }
            });
            self.lights.push(Lit::new(light.clone(), seen));
        }
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let samples = with_scratch(|scratch| dispatch!(level, simd => self.draw_in(simd, tile, scratch)));
        Stats { samples }
    }
}

/// Draws the depths of binned triangles, a band of tiles at a time.
fn draw_map(crew: &Crew, map: &mut DepthMap, views: &[(Vec<Piece>, Bins)]) {
    let (size, level, stride) = (map.size, crew.level(), map.stride());
    let bands = map.bands(Tile::SIZE);
    crew.each(bands, |(view, band, texels)| {
        let (pieces, bins) = &views[view];
        with_scratch(|scratch| {
            if scratch.visible.is_empty() {
                scratch.visible.push(Visible::new());
            }
            let visible = &mut scratch.visible[0];
            for column in 0..size.div_ceil(Tile::SIZE) {
                let ids = bins.of(column, band);
                let (x, y) = (column * Tile::SIZE, band * Tile::SIZE);
                visible.clear(shadow::NOTHING);
                dispatch!(level, simd => fill(simd, pieces, ids, x as i32, y as i32, CENTER, visible));
                let width = Tile::SIZE.min(size - x);
                for (row, texels) in texels.chunks_mut(stride).enumerate() {
                    let from = &visible.nearness[row * Tile::SIZE..][..width];
                    texels[shadow::PAD + x..][..width].copy_from_slice(from);
                }
            }
        });
    });
    map.close();
}
