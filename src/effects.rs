//! What changes a whole picture after its layers are drawn: fog, and the fade to black.

use crate::frame::{Layer, Stats, Tile};
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, STEPS, float};
use crate::simd::math::{exp2, to_f32};
use crate::view::View;
use fearless_simd::{Level, dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3A;
use std::f32::consts::LOG2_E;

/// Fog of one density everywhere. By the law of Beer and Lambert a share `exp(-density way)` of the light comes
/// through, and the rest is the light of the fog.
#[derive(Clone, Copy, Debug)]
pub struct Fog {
    /// Its light, linear, where it hides everything.
    pub light: Vec3A,
    /// Extinction coefficient, per metre.
    pub density: f32,
    /// Distance from the eye at which it ends, metres: before the sky, and before whatever is farther.
    pub end: f32,
}

/// Fog over all layers before it, the sky too. The reference is the formula in `f64` (`tests/frame/fog.rs`).
pub struct FogLayer {
    fog: Fog,
    view: View,
}

impl FogLayer {
    /// The layer of fog before the eye of a view.
    pub fn new(fog: Fog, view: &View) -> FogLayer {
        FogLayer { fog, view: *view }
    }
}

impl Layer for FogLayer {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        dispatch!(level, simd => cover(simd, &self.fog, &self.view, tile));
        Stats::default()
    }
}

/// Mixes the light of the fog into a tile. At a density of 0 no bit changes.
///
/// A pixel on an edge shows the sky, too: the share that solids leave of it is as far away as the end of the fog.
#[simd]
fn cover<S: Simd>(simd: S, fog: &Fog, view: &View, tile: &mut Tile) {
    let lanes = F::<S>::LEN;
    let (end, one) = (F::<S>::splat(simd, fog.end), F::<S>::splat(simd, 1.0));
    let steps = float(simd, S::u32s::from_slice(simd, &STEPS[..lanes]));
    let loss = -fog.density * LOG2_E;
    let sky = exp2(simd, end * loss);
    for row in 0..tile.height {
        let y = F::<S>::splat(simd, to_f32(tile.y + row) + 0.5);
        let mut i = 0;
        while i < BLOCK / lanes {
            let ray = view.rays(simd, steps + (to_f32(tile.x + i * lanes) + 0.5), y);
            let length = ray.dot(ray).sqrt();
            let near: F<S> = load(simd, &tile.inv_depth.as_chunks::<BLOCK>().0[row], i);
            let covered: F<S> = load(simd, &tile.coverage.as_chunks::<BLOCK>().0[row], i);
            // The share of the light that comes through.
            let solid = exp2(simd, (length / near.max(1e-9)).min(end) * loss);
            let clear = sky + (solid - sky) * covered;
            let planes = [&mut tile.red, &mut tile.green, &mut tile.blue];
            for (channel, plane) in planes.into_iter().enumerate() {
                let plane = &mut plane.as_chunks_mut::<BLOCK>().0[row];
                let light = fog.light[channel];
                store(load::<S, F<S>>(simd, plane, i) * clear + (one - clear) * light, plane, i);
            }
            i += 1;
        }
    }
}

/// The picture so far, darker: the share that is left of its linear light.
pub struct Fade(pub f32);

impl Layer for Fade {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        for plane in [&mut tile.red, &mut tile.green, &mut tile.blue] {
            for light in plane.iter_mut() {
                *light *= self.0;
            }
        }
        Stats::default()
    }
}
