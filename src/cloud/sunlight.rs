//! The light of the sun that reaches each voxel of a cloud, for all voxels in one sweep.
//!
//! Light that is computed once per cloud and not once per ray is the first of the two passes of `[Kajiya84]`. Voxels
//! are taken in layers across the axis that the sun is nearest to, beginning with the layer that it meets first. The
//! optical depth of a voxel is what the layer before it has where the ray to the sun crosses it, interpolated
//! bilinearly, and the voxel's own. So the cost is a few operations per voxel, however long the way to the sun is.
//!
//! Two approximations: bilinear lookups in each layer blur the light a little sideways (`tests/cloud/light.rs` bounds
//! the error against rays in `f64`), and light that is scattered more than once is stood for by a second, slower decay:
//! `0.7 exp(-q / 2) + 0.3 exp(-0.06 q)` of an optical depth q, two terms of the sum of octaves of `[Wrenninge13]`.

use super::voxels::Voxels;
use crate::simd::lanes::{F, STEPS, U, float};
use crate::simd::math::{exp2, to_f32};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3A;
use std::f32::consts::LOG2_E;

/// Writes the sunlight of all voxels within the [bounds](Voxels::bounds), for a sun in the direction of the unit vector
/// `towards` and a cloud whose greatest density has that extinction coefficient, per half of the cube's edge.
#[simd]
pub fn bake<S: Simd>(simd: S, voxels: &mut Voxels, towards: Vec3A, extinction: f32) {
    let (n, lanes) = (voxels.edge(), F::<S>::LEN);
    let (strides, way) = ([1, n, n * n], towards.to_array());
    // Layers lie across the main axis. The ray to the sun goes `du`, `dv` voxels sideways from one to the next.
    let main = towards.abs().max_position();
    let (u, v) = ((main + 1) % 3, (main + 2) % 3);
    let slope = 1.0 / way[main].abs();
    // A sun from nowhere must not lead out of a layer.
    let [du, dv] = [u, v].map(|axis| (way[axis] * slope).clamp(-1.0, 1.0));
    // Half of the optical depth of one layer, per step of density.
    let half = extinction * slope / to_f32(255 * n);
    // Layers with a margin in which nothing is: one row and column before their own, and two after.
    let width = n + 20;
    let mut before = vec![0.0; width * (n + 3)];
    let mut after = before.clone();
    // Densities of a layer, in whose place comes their light. Row by row, a vector would be read from words just written, and
    // wait until they are in memory.
    let mut values = vec![0; width * n];
    let [column, row] = [du, dv].map(|step| (step.floor() + 1.0) as i32 as usize);
    let steps = float(simd, U::<S>::from_slice(simd, &STEPS[..lanes]));
    // Light that enters the bounds has met nothing before, and nothing in them is behind what has left them.
    let (layers, along, across) = (voxels.extent(main), voxels.extent(u), voxels.extent(v));
    for step in 0..layers.len() {
        let layer = strides[main] * if way[main] > 0.0 { layers.end - 1 - step } else { layers.start + step };
        let point = |i: usize, j: usize| layer + i * strides[u] + j * strides[v];
        for j in across.clone() {
            for i in along.clone() {
                values[j * width + i] = voxels.density()[point(i, j)] as u32;
            }
        }
        for j in across.clone() {
            let share = to_f32(j) + dv - (to_f32(j) + dv.floor());
            for i in along.clone().step_by(lanes) {
                let place = steps + to_f32(i);
                let aside = place + du - (place + du.floor());
                let at = (j + row) * width + i + column;
                let (a, b): (F<S>, F<S>) = (take(simd, &before, at), take(simd, &before, at + 1));
                let (c, d): (F<S>, F<S>) = (take(simd, &before, at + width), take(simd, &before, at + width + 1));
                let (a, b) = (a + (b - a) * aside, c + (d - c) * aside);
                let own = float(simd, U::<S>::from_slice(simd, &values[j * width + i..][..lanes]));
                let depth = a + (b - a) * share + own * (2.0 * half);
                let inside = place.simd_lt(to_f32(along.end));
                let kept = inside.select(depth, F::<S>::splat(simd, 0.0));
                kept.store_slice(&mut after[(j + 1) * width + i + 1..][..lanes]);
                // As far as the centre of the voxel.
                let q = (depth - own * half) * LOG2_E;
                let light = exp2(simd, q * -0.5) * (0.7 * 255.0) + exp2(simd, q * -0.06) * (0.3 * 255.0);
                (light + 0.5).to_int::<S::i32s>().bitcast::<U<S>>().store_slice(&mut values[j * width + i..][..lanes]);
            }
            for i in along.clone() {
                voxels.put_light(point(i, j), values[j * width + i] as u8);
            }
        }
        std::mem::swap(&mut before, &mut after);
    }
}

/// The vector that begins at a place of a row.
#[inline(always)]
fn take<S: Simd>(simd: S, row: &[f32], at: usize) -> F<S> {
    F::<S>::from_slice(simd, &row[at..at + F::<S>::LEN])
}
