//! The light of many lights on a block of fragments, computed at some and interpolated where it is even.
//!
//! Along a row of pixels that show one triangle, light changes little from one to the next: normals are those of a plane,
//! and shadows have edges of three texels. So it is computed at both ends of runs of three, and between them only where
//! these disagree. The reference is a [`threshold`](crate::settings::RasterSettings::threshold) of 0.

use super::context::ShadeContext;
use super::lighting::shine;
use super::queue::{FragmentQueue, POINTS};
use crate::frame::Tile;
use crate::simd::block::{BLOCK, Block3};
use crate::simd::lanes::{Bits, F, V3};
use fearless_simd::prelude::*;
use glam::Vec3A;

/// Steps from one end of a run to the other, where the next run begins. Of five, seven and nine none is faster by more than
/// 2 %, and shadows as narrow as that, which pass between both ends, become ladders.
const RUN: usize = 3;
/// The fragments within the run that begins at fragment 0.
const WITHIN: u64 = (1 << RUN) - 2;

/// The light of fewer lights is computed sooner than runs are found. All of the world's count, not those that meet a block:
/// these depend on how many lanes a vector has, and a frame must not.
const MANY: usize = 3;

/// Adds what the world's lights give to a queue's fragments, without albedo.
///
/// ```text
/// find runs: both ends in a row, with nothing but one triangle between
/// light all fragments but those within runs
/// interpolate within each run whose ends have nearly the same light
/// light those within the others
/// ```
#[inline(always)]
pub fn illuminate<S: Simd>(simd: S, context: &ShadeContext, queue: &mut FragmentQueue) {
    let ShadeContext { world, lookups, threshold, .. } = *context;
    let (low, high) = bounds(simd, &queue.places[POINTS]);
    let (pixels, ids) = (&queue.place[0], &queue.id[0]);
    let (mut runs, mut wanted) = (0, u64::MAX);
    for a in (0..BLOCK - RUN).step_by(RUN) {
        let b = a + RUN;
        let row = pixels[b].wrapping_sub(pixels[a]) == RUN as u32 && pixels[a] as usize % Tile::SIZE + RUN < Tile::SIZE;
        if world.lights.len() >= MANY && row && ids[a..=b].iter().all(|id| *id == ids[a]) {
            runs |= 1 << a;
            wanted &= !(WITHIN << a);
        }
    }
    while wanted != 0 {
        let all = wanted == u64::MAX;
        let (places, light) = &mut queue.some;
        let mut count = BLOCK;
        if !all {
            count = 0;
            *light = [[0.0; BLOCK]; 3];
            for i in Bits(wanted) {
                for (some, all) in places.as_flattened_mut().iter_mut().zip(queue.places.as_flattened()) {
                    some[count] = all[i];
                }
                count += 1;
            }
        }
        for lit in world.lights.iter().zip(lookups) {
            if lit.0.meets(simd, low, high) {
                let (places, out) = if all { (&queue.places, &mut queue.light) } else { (&*places, &mut *light) };
                shine(simd, context, lit, places, count, out);
            }
        }
        if !all {
            for (from, i) in Bits(wanted).enumerate() {
                for (some, all) in light.iter().zip(&mut queue.light) {
                    all[i] += some[from];
                }
            }
        }
        wanted = 0;
        for a in Bits(runs) {
            let b = a + RUN;
            if queue.light.iter().all(|light| (light[a] - light[b]).abs() < threshold * (light[a] + light[b])) {
                for light in &mut queue.light {
                    let step = (light[b] - light[a]) * (1.0 / RUN as f32);
                    for i in a + 1..b {
                        light[i] = light[i - 1] + step;
                    }
                }
            } else {
                wanted |= WITHIN << a;
            }
        }
        runs = 0;
    }
}

/// Boxes around the points of a block, one per lane.
#[inline(always)]
fn bounds<S: Simd>(simd: S, points: &Block3) -> (V3<S>, V3<S>) {
    let (mut low, mut high) = (V3::splat(simd, Vec3A::INFINITY), V3::splat(simd, Vec3A::NEG_INFINITY));
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let p = V3::load(simd, points, i);
        low = V3 { x: low.x.min(p.x), y: low.y.min(p.y), z: low.z.min(p.z) };
        high = V3 { x: high.x.max(p.x), y: high.y.max(p.y), z: high.z.max(p.z) };
        i += 1;
    }
    (low, high)
}
