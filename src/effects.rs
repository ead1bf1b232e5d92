//! Fog: what is far fades into one light, by Beer and Lambert's law.

use crate::frame::{Layer, Stats, Tile};
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, STEPS, float};
use crate::simd::math::exp2;
use crate::view::View;
use fearless_simd::{Level, dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3;
use std::f32::consts::LOG2_E;

/// Fog over all that was drawn before it, the sky too.
pub struct Fog {
    /// Who looks.
    pub view: View,
    /// Its light, as it is shown.
    pub light: Vec3,
    /// Share that it takes a metre.
    pub density: f32,
    /// Metres from the eye to where it ends, before the sky and before whatever is farther.
    pub end: f32,
}

impl Layer for Fog {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        dispatch!(level, simd => cover(simd, self, tile));
        Stats::default()
    }
}

/// Mixes the fog's light into a tile: at its density 0 no bit changes.
///
/// A pixel on an edge shows the sky, too, by what solids leave of it.
#[simd]
fn cover<S: Simd>(simd: S, fog: &Fog, tile: &mut Tile) {
    let lanes = F::<S>::LEN;
    let (end, one) = (F::<S>::splat(simd, fog.end), F::<S>::splat(simd, 1.0));
    let steps = float(simd, S::u32s::from_slice(simd, &STEPS[..lanes]));
    let loss = -fog.density * LOG2_E;
    let sky = exp2(simd, end * loss);
    for row in 0..tile.height {
        let y = F::<S>::splat(simd, (tile.y + row) as u32 as f32 + 0.5);
        let mut i = 0;
        while i < BLOCK / lanes {
            let ray = fog.view.rays(simd, steps + ((tile.x + i * lanes) as u32 as f32 + 0.5), y);
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
