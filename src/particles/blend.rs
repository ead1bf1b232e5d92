//! Sprites into a tile: first into planes of their own, then over what is there.
//!
//! The planes are the share of the light behind that passes, and the light that is added. Flakes need only the first
//! and sparks only the others, so a sprite costs one or three sums per pixel.

use super::crystal;
use super::sprite::{LIGHT, PASSES, Sprite};
use crate::frame::Tile;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::F;
use crate::simd::math::{exp2, to_f32};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3A;
use std::f32::consts::LOG2_E;

/// The middles of the first pixels of a row.
const HALVES: [f32; 16] = [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5];

/// Draws a sprite into a tile's planes from number `first` on. With `solids` it is hidden by what is in front of it,
/// softly over its radius, so that no edge shows where it stands in a solid.
#[simd]
pub fn draw<S: Simd>(
    simd: S,
    sprite: &Sprite,
    tile: &Tile,
    solids: bool,
    planes: &mut [[f32; Tile::AREA]],
    first: usize,
) {
    let lanes = F::<S>::LEN;
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let [left, right] = range(sprite.at[0], sprite.reach[0], tile.x);
    let [top, bottom] = range(sprite.at[1], sprite.reach[1], tile.y);
    let [a, b, c, d] = sprite.axes;
    for row in top..bottom {
        let y = to_f32(tile.y + row) + 0.5 - sprite.at[1];
        let (by, dy) = (b * y, d * y);
        let mut column = left & lanes.wrapping_neg();
        while column < right {
            // All of it is exact but for the last difference, wherever vectors and tiles begin.
            let x = F::<S>::from_slice(simd, &HALVES[..lanes]) + to_f32(tile.x + column) - sprite.at[0];
            let (u, v) = (x * a + by, x * c + dy);
            let rest = (one - (u * u + v * v)).max(zero);
            let mut weight = rest * rest;
            if sprite.crystal > crystal::LEAST && !cfg!(without = "crystals") {
                weight = crystal::weight(simd, u, v, sprite.crystal);
            }
            let at = row * Tile::SIZE + column;
            if solids {
                let inv_depth = F::<S>::from_slice(simd, &tile.inv_depth[at..at + lanes]);
                weight *= ((one / inv_depth - sprite.depth) * sprite.edge).max(zero).min(one);
            }
            let leaves = one - weight * sprite.alpha;
            for (plane, ink) in planes.iter_mut().zip(&sprite.ink[first..]) {
                let plane = &mut plane[at..at + lanes];
                (F::<S>::from_slice(simd, plane) * leaves + weight * *ink).store_slice(plane);
            }
            column += lanes;
        }
    }
}

/// The pixels of a tile whose middles lie within `reach` of `at` along an axis: the first, and the one after the last.
/// The tile's first pixel is number `corner` of the picture.
#[inline(always)]
fn range(at: f32, reach: f32, corner: usize) -> [usize; 2] {
    let from = at - to_f32(corner) + 0.5;
    // A cast to `u32` makes 0 of what is below 0.
    let end = (from + reach).min(Tile::SIZE as f32) as u32;
    [(from - reach) as u32 as usize, end as usize]
}

/// Puts planes over the light of a tile: `color` takes the place of what does not pass. Of added light x the share
/// `1 - exp(-exposure x)` is seen, as on film, and it bleaches what is behind.
#[simd]
pub fn blend<S: Simd>(simd: S, planes: &[[f32; Tile::AREA]], color: Vec3A, exposure: f32, tile: &mut Tile) {
    let one = F::<S>::splat(simd, 1.0);
    let passes = planes[PASSES].as_chunks::<BLOCK>().0;
    for (k, plane) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().enumerate() {
        let color = color[k];
        for (row, light) in plane.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            let mut i = 0;
            while i < BLOCK / F::<S>::LEN {
                let behind: F<S> = load(simd, light, i);
                let mut seen = (behind - color) * load::<S, F<S>>(simd, &passes[row], i) + color;
                if let Some(plane) = planes.get(LIGHT + k) {
                    let added: F<S> = load(simd, &plane.as_chunks::<BLOCK>().0[row], i);
                    seen = one - (one - seen) * exp2(simd, added * (-exposure * LOG2_E));
                }
                store(seen, light, i);
                i += 1;
            }
        }
    }
}
