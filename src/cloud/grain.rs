//! Detail below a voxel: billows from a small table of noise.
//!
//! Voxels of some metres are soft from close by. What is finer comes from one table for all clouds, three octaves of
//! turbulence `[Perlin02]` on a lattice of less than half a voxel, so that a lookup costs what one of a cloud's own voxels does,
//! whatever the octaves. Beyond its faces the table is mirrored.

use super::voxels::Voxels;
use crate::noise::octaves;
use crate::simd::lanes::{F, V3};
use crate::simd::math::{WHOLE, to_f32};
use fearless_simd::prelude::*;
use glam::Vec3A;

/// Points along an edge of the table.
const EDGE: usize = 32;

/// Points of the table per voxel of a cloud, and per wavelength of the longest octave.
const FINER: f32 = 2.4;
const WAVE: f32 = 9.0;

/// The table.
pub fn table() -> Voxels {
    let point = |at: usize| {
        let p = Vec3A::from([at % EDGE, at / EDGE % EDGE, at / (EDGE * EDGE)].map(to_f32));
        let mut sum = 0.0;
        for (zoom, share) in [(1.0, 560.0), (2.1, 280.0), (4.3, 140.0)] {
            sum += octaves(p * (zoom / WAVE) + zoom, 1, true) * share;
        }
        sum.min(255.0) as u8
    };
    Voxels::new(EDGE, (0..EDGE * EDGE * EDGE).map(point).collect())
}

/// How much detail adds to the density, of its distance to none and to all.
const GRAIN: f32 = 3.0;

/// What detail adds at points `u` of a cloud, in its voxels, of what it may: from -0.8 to 1.2 times [`GRAIN`], and 0 in
/// the mean.
#[inline(always)]
pub(super) fn grain<S: Simd>(simd: S, table: &Voxels, u: V3<S>) -> F<S> {
    let most = (EDGE - 1) as f32;
    // There and back through the table in a turn.
    let turns = 0.5 * FINER / most;
    let mirrored = |turns: F<S>| (turns - (turns + WHOLE - WHOLE)).abs() * (2.0 * most);
    // Askew, so that neither lattice shows in the other.
    let (ahead, aside) = (0.8 * turns, 0.6 * turns);
    let (x, z) = (u.x * ahead + u.y * aside, u.y * ahead - u.x * aside);
    let place = V3 { x: mirrored(x), y: mirrored(u.z * ahead + x * 0.6), z: mirrored(z) };
    table.look_up(simd, place)[0] * (2.0 * GRAIN / Voxels::FULL) - 0.8 * GRAIN
}
