//! The bench scenes `cumulus`, `cumulus-inside` and `sky-of-clouds`, as specified for every renderer that is compared.
//!
//! Clouds of voxels, after thesis B. The parameters' defaults are the specification.

use super::cumulus_set as set;
use super::sky_grid::{self as grid, Cells, Field};
use crate::cloud::{Cloud, CloudKind, CloudLayer, CloudLight, Voxels};
use crate::frame::cache::keep;
use crate::frame::encode::Transfer;
use crate::frame::inspect::Aspect;
use crate::frame::{Cache, FrameSpec, Layer, Parameter, Picture, Scene, Stats, Tile, Workers};
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::view::Camera;
use crate::view::View;
use fearless_simd::{Level, dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::{Vec3A, dvec3, vec3a};
use std::sync::Arc;

/// Around one cloud.
pub const CUMULUS: Scene = Scene {
    name: "cumulus",
    about: "bench: one cloud of voxels from outside",
    duration: 20.0,
    parameters: &[KIND, SHAPE, HEIGHT, SIZE, THICKNESS, LIGHT],
    picture: |spec| picture(spec, 0, one(spec, &THICKNESS)),
};
/// Inside of it.
pub const CUMULUS_INSIDE: Scene = Scene {
    name: "cumulus-inside",
    about: "bench: the same cloud, thinner, from inside",
    duration: 20.0,
    parameters: &[KIND, SHAPE, HEIGHT, SIZE, THIN, LIGHT],
    picture: |spec| picture(spec, 1, one(spec, &THIN)),
};
/// Under a hundred clouds.
pub const SKY_OF_CLOUDS: Scene = Scene {
    name: "sky-of-clouds",
    about: "bench: a hundred clouds of voxels",
    duration: 20.0,
    parameters: &[KIND, COUNT, SEED, SKY_HEIGHT, THICKNESS, EAST, SOUTH, LIGHT],
    picture: |spec| picture(spec, 2, many(spec)),
};

const KIND: Parameter = Parameter::new("kind", "count", (0.0, 1.0), 0.0, "0 cumulus, 1 congestus");
const SHAPE: Parameter = Parameter::new("seed", "count", (0.0, 1e4), 0.0, "another number, another cloud of that kind");
const HEIGHT: Parameter = Parameter::new("height", "m", (0.0, 200.0), 60.0, "height of the cloud's centre");
const SIZE: Parameter = Parameter::new("size", "m", (5.0, 90.0), 50.0, "half of the edge of the cloud's cube");
const THICKNESS: Parameter =
    Parameter::new("thickness", "1", (1.0, 100.0), 30.0, "optical depth through half of the cube where it is densest");
const THIN: Parameter = Parameter { default: 10.0, ..THICKNESS };
const LIGHT: Parameter =
    Parameter::new("light", "1", (0.0, 4.0), 1.0, "the sun's light on the clouds, times what it is");
const COUNT: Parameter = Parameter::new("number", "count", (0.0, 1000.0), 100.0, "clouds in the sky");
const SEED: Parameter = Parameter::new("seed", "count", (0.0, 1e6), 1.0, "another number, other places and sizes");
const SKY_HEIGHT: Parameter = Parameter::new("height", "m", (60.0, 2000.0), 130.0, "height of the clouds' bases");
const EAST: Parameter =
    Parameter::new("wind-east", "m/s", (-50.0, 50.0), 0.0, "wind that carries the clouds towards the east");
const SOUTH: Parameter =
    Parameter::new("wind-south", "m/s", (-50.0, 50.0), 0.0, "wind that carries the clouds towards the south");

/// The shapes that were grown, by kind and seed.
struct Shapes(Vec<([u32; 2], Arc<Voxels>)>);
keep!(Shapes, Shapes(Vec::new()));

/// A shape of the kind that is asked for.
fn shape(spec: &FrameSpec, seed: u32) -> Arc<Voxels> {
    let kind = spec.get(&KIND) as u32;
    if kind == 0 && seed < set::SHAPE_COUNT as u32 {
        return set::shape(seed as usize);
    }
    let shapes = spec.cache.get::<Shapes>();
    let mut shapes = shapes.lock();
    if let Some((_, voxels)) = shapes.0.iter().find(|shape| shape.0 == [kind, seed]) {
        return voxels.clone();
    }
    let of = [CloudKind::CUMULUS, CloudKind::CONGESTUS][kind as usize];
    let voxels = set::grow(&of, seed);
    // Who turns the knob should not fill the memory.
    if shapes.0.len() == MOST_SHAPES {
        shapes.0.remove(0);
    }
    shapes.0.push(([kind, seed], voxels.clone()));
    voxels
}

/// The shapes that are kept, of 3 MB each.
const MOST_SHAPES: usize = 8;

fn one(spec: &FrameSpec, thickness: &Parameter) -> Vec<Cloud> {
    let [height, size, extinction] = [&HEIGHT, &SIZE, thickness].map(|parameter| spec.get(parameter) as f32);
    set::one(shape(spec, spec.get(&SHAPE) as u32), height, size, extinction)
}

fn many(spec: &FrameSpec) -> Vec<Cloud> {
    let [height, extinction] = [&SKY_HEIGHT, &THICKNESS].map(|parameter| spec.get(parameter) as f32);
    let (count, seed) = (spec.get(&COUNT) as u32, spec.get(&SEED) as u32);
    let mut clouds = set::many(|k| shape(spec, k as u32), count, seed, height, extinction);
    let way = dvec3(spec.get(&EAST), 0.0, spec.get(&SOUTH)) * spec.time;
    for cloud in &mut clouds {
        cloud.centre += way.as_vec3a();
    }
    clouds
}

/// The sky at the horizon, and what haze looks like.
const HAZE: Vec3A = vec3a(0.76, 0.85, 0.94);

fn picture(spec: &FrameSpec, variant: usize, clouds: Vec<Cloud>) -> Picture {
    let (eye, way) = set::camera(variant, spec.time);
    let camera = Camera::look_at(eye.as_vec3a(), (eye + way).as_vec3a(), 50f32.to_radians(), 0.0);
    let view = View::new(spec.camera(camera), spec.width, spec.height);
    let light = CloudLight {
        ambient: [vec3a(0.22, 0.27, 0.36), vec3a(0.36, 0.42, 0.51)],
        towards: set::sun(),
        sun: vec3a(0.86, 0.78, 0.68) * spec.get(&LIGHT) as f32,
        phase: [0.85, 0.5],
    };
    let q = &spec.quality;
    // `fast` takes as many steps as are specified on a way as long as the cube's edge, and ends rays where it says; `exact` is
    // the limit of both.
    let clouds = CloudLayer::new(clouds, light, &view, &q.cloud).in_air(1400.0, |_| HAZE);
    let cells = Cells { size: if q.cloud.cell > 1 { 8 } else { 1 }, grid: q.cloud.grid };
    Picture {
        layers: vec![Box::new(Cumuli { clouds, background: Background { view, cells } })],
        transfer: Transfer::Linear,
    }
}

/// The sky behind the clouds, and the ground.
struct Background {
    view: View,
    cells: Cells,
}

impl Field for Background {
    const HORIZON: bool = true;

    #[inline(always)]
    fn light<S: Simd>(&self, simd: S, d: V3<S>) -> V3<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let above = d.y.simd_ge(0.0);
        let fall = (d.y * -5.0).max(zero).min(one);
        let share = above.select(d.y.max(zero).sqrt(), fall * fall * (F::<S>::splat(simd, 3.0) - fall * 2.0));
        let end = V3::select(above, V3::splat(simd, vec3a(0.16, 0.36, 0.70)), V3::splat(simd, vec3a(0.33, 0.43, 0.36)));
        let haze = V3::splat(simd, HAZE);
        let c = d.dot1(set::sun()).max(zero);
        let c2 = c * c;
        let c4 = c2 * c2;
        let c8 = c4 * c4;
        let disc = ((c - 0.9998) * (1.0 / 0.00012)).max(zero).min(one);
        let disc = disc * disc * (F::<S>::splat(simd, 3.0) - disc * 2.0);
        haze + (end - haze) * Lane(share)
            + V3::splat(simd, vec3a(1.0, 0.8, 0.5)) * Lane(c8 * c8 * c8 * 0.25 + disc * 0.8)
    }
}

/// The clouds over that background.
struct Cumuli {
    clouds: CloudLayer,
    background: Background,
}

impl Layer for Cumuli {
    fn prepare(&mut self, workers: &Workers, cache: &Cache) {
        self.clouds.prepare(workers, cache);
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        tile.solids_matter = true;
        tile.clear();
        self.clouds.draw(level, tile);
        dispatch!(level, simd => behind(simd, &self.background, tile));
        Stats::default()
    }

    fn inspect(&self, aspect: Aspect, level: Level, tile: &mut Tile) -> Option<Vec<f32>> {
        self.clouds.inspect(aspect, level, tile)
    }

    fn explain(&self, level: Level, tile: &Tile, x: usize, y: usize) -> Vec<String> {
        self.clouds.explain(level, tile, x, y)
    }
}

/// Adds the background to what clouds have left.
#[simd]
fn behind<S: Simd>(simd: S, background: &Background, tile: &mut Tile) {
    let mut back = Tile::at(tile.x / Tile::SIZE, tile.y / Tile::SIZE, tile.x + tile.width, tile.y + tile.height);
    grid::fill(simd, background, &background.view, background.cells, &mut back);
    let planes = [(&mut tile.red, &back.red), (&mut tile.green, &back.green), (&mut tile.blue, &back.blue)];
    for (plane, back) in planes {
        let rows = plane.as_chunks_mut::<BLOCK>().0.iter_mut().zip(back.as_chunks::<BLOCK>().0);
        for ((row, back), covered) in rows.zip(tile.coverage.as_chunks::<BLOCK>().0) {
            for i in 0..BLOCK / F::<S>::LEN {
                let left: F<S> = F::<S>::splat(simd, 1.0) - load::<S, F<S>>(simd, covered, i);
                // The renderers that are compared blend into a picture of 8 bits, which ends at 1.
                let light = load::<S, F<S>>(simd, back, i).min(1.0) * left;
                store(light + load::<S, F<S>>(simd, row, i), row, i);
            }
        }
    }
}
