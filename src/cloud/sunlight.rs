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
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::F;
use crate::simd::math::{exp2, to_f32};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;
use std::f32::consts::LOG2_E;

/// Writes the sunlight of every voxel, for a sun in the direction of the unit vector `towards` and a cloud whose
/// greatest density has that extinction coefficient, per half of the cube's edge.
#[simd]
pub fn bake<S: Simd>(simd: S, voxels: &mut Voxels, towards: Vec3, extinction: f32) {
    let n = voxels.edge();
    let (strides, way) = ([1, n, n * n], towards.to_array());
    // Layers lie across the main axis. The ray to the sun goes `du`, `dv` voxels sideways from one to the next.
    let main = towards.abs().max_position();
    let (u, v) = ((main + 1) % 3, (main + 2) % 3);
    let slope = 1.0 / way[main].abs();
    let (du, dv) = (way[u] * slope, way[v] * slope);
    // Half of the optical depth of one layer, per step of density.
    let half = extinction * slope / to_f32(255 * n);
    let mut depths = vec![0.0; n * n * n];
    for step in 0..n {
        let layer = strides[main] * if way[main] > 0.0 { n - 1 - step } else { step };
        let before = if way[main] > 0.0 { layer + strides[main] } else { layer.wrapping_sub(strides[main]) };
        for j in 0..n {
            for i in 0..n {
                let (x, y) = (to_f32(i) + du, to_f32(j) + dv);
                let (fx, fy) = (x - x.floor(), y - y.floor());
                // Outside of the cube nothing is in the way. A place below 0 is cast to one beyond `n`.
                let depth = |i: i32, j: i32| {
                    let (i, j) = (i as usize, j as usize);
                    if step > 0 && i < n && j < n { depths[before + i * strides[u] + j * strides[v]] } else { 0.0 }
                };
                let (x, y) = (x.floor() as i32, y.floor() as i32);
                let (a, b) = (depth(x, y), depth(x, y + 1));
                let (a, b) = (a + (depth(x + 1, y) - a) * fx, b + (depth(x + 1, y + 1) - b) * fx);
                let at = layer + i * strides[u] + j * strides[v];
                depths[at] = a + (b - a) * fy + voxels.density()[at] as f32 * (2.0 * half);
            }
        }
    }
    scatter(simd, voxels, &depths, half);
    voxels.pack();
}

/// From the optical depths behind voxels to the light at their centres; `half` is half of a voxel's own optical depth,
/// per step of density.
#[inline(always)]
fn scatter<S: Simd>(simd: S, voxels: &mut Voxels, depths: &[f32], half: f32) {
    let (densities, light) = voxels.density_and_light();
    let blocks = depths.as_chunks::<BLOCK>().0.iter().zip(densities.as_chunks::<BLOCK>().0);
    for ((depths, densities), out) in blocks.zip(light.as_chunks_mut::<BLOCK>().0) {
        let mut light = [0.0; BLOCK];
        for (light, density) in light.iter_mut().zip(densities) {
            *light = *density as f32 * half;
        }
        for i in 0..BLOCK / F::<S>::LEN {
            // As far as the centre of the voxel.
            let q = (load::<S, F<S>>(simd, depths, i) - load::<S, F<S>>(simd, &light, i)) * LOG2_E;
            store(exp2(simd, q * -0.5) * (0.7 * 255.0) + exp2(simd, q * -0.06) * (0.3 * 255.0), &mut light, i);
        }
        for (light, out) in light.iter().zip(out) {
            *out = (*light + 0.5) as u8;
        }
    }
}
