//! The bench scenes `cumulus`, `cumulus-inside` and `sky-of-clouds`, as specified for every renderer that is compared.

use super::cumulus_set as set;
use super::sky_grid::{self as grid, Cells, Field};
use crate::cloud::{CloudLayer, CloudLight};
use crate::frame::encode::Transfer;
use crate::frame::{Cache, FrameSpec, Scene};
use crate::frame::{Layer, Picture, Stats, Tile, Workers};
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::view::Camera;
use crate::view::View;
use fearless_simd::{Level, dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::{Vec3, vec3};

/// Around one cloud.
pub const CUMULUS: Scene = scene("cumulus", "bench: one cloud of voxels from outside", |spec| picture(spec, 0));
/// In it.
pub const CUMULUS_INSIDE: Scene =
    scene("cumulus-inside", "bench: the same cloud, thinner, from inside", |spec| picture(spec, 1));
/// Under a hundred.
pub const SKY_OF_CLOUDS: Scene = scene("sky-of-clouds", "bench: a hundred clouds of voxels", |spec| picture(spec, 2));

const fn scene(name: &'static str, about: &'static str, picture: fn(&FrameSpec) -> Picture) -> Scene {
    Scene { name, about, duration: 20.0, parameters: &[], picture }
}

/// The sky at the horizon, and what haze looks like.
const HAZE: Vec3 = vec3(0.76, 0.85, 0.94);

fn picture(spec: &FrameSpec, variant: usize) -> Picture {
    let (eye, way) = set::camera(variant, spec.time);
    let camera = Camera::look_at(eye.as_vec3(), (eye + way).as_vec3(), 50f32.to_radians(), 0.0);
    let view = View::new(spec.camera(camera), spec.width, spec.height);
    let light = CloudLight {
        ambient: [vec3(0.22, 0.27, 0.36), vec3(0.36, 0.42, 0.51)],
        towards: set::sun(),
        sun: vec3(0.86, 0.78, 0.68),
        phase: [0.85, 0.5],
    };
    let q = &spec.quality;
    // `fast` takes the steps that are specified, and ends rays where it says; `exact` is the limit of both.
    let clouds = CloudLayer::new(set::clouds(variant), light, &view, &q.cloud).in_air(1400.0, |_| HAZE);
    let cells = Cells { size: if q.cloud.cell > 1 { 8 } else { 1 }, grid: q.cloud.grid };
    Picture {
        layers: vec![Box::new(Cumuli { clouds, background: Background { view, cells } })],
        transfer: Transfer::Linear,
    }
}

/// What is behind the clouds.
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
        let end = V3::select(above, V3::splat(simd, vec3(0.16, 0.36, 0.70)), V3::splat(simd, vec3(0.33, 0.43, 0.36)));
        let haze = V3::splat(simd, HAZE);
        let c = d.dot1(set::sun()).max(zero);
        let c2 = c * c;
        let c4 = c2 * c2;
        let c8 = c4 * c4;
        let disc = ((c - 0.9998) * (1.0 / 0.00012)).max(zero).min(one);
        let disc = disc * disc * (F::<S>::splat(simd, 3.0) - disc * 2.0);
        haze + (end - haze) * Lane(share)
            + V3::splat(simd, vec3(1.0, 0.8, 0.5)) * Lane(c8 * c8 * c8 * 0.25 + disc * 0.8)
    }
}

/// Clouds and what is behind them.
struct Cumuli {
    clouds: CloudLayer,
    background: Background,
}

impl Layer for Cumuli {
    fn prepare(&mut self, workers: &Workers, _cache: &Cache) {
        self.clouds.prepare(workers, _cache);
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        tile.solids_matter = true;
        tile.clear();
        self.clouds.draw(level, tile);
        dispatch!(level, simd => behind(simd, &self.background, tile));
        Stats::default()
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
                // What is compared blends into a picture of 8 bits, which ends at 1.
                let light = load::<S, F<S>>(simd, back, i).min(1.0) * left;
                store(light + load::<S, F<S>>(simd, row, i), row, i);
            }
        }
    }
}
