//! What the sun lights of a cloud, for all voxels in one sweep.

use super::voxels::Voxels;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::F;
use crate::simd::math::exp2;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;
use std::f32::consts::LOG2_E;

/// Writes the sunlight of every voxel, for a sun in the unit direction `towards` and a cloud of that extinction.
///
/// Layer after layer away from the sun, each from the one before, so that the cost does not grow with the way to the sun.
/// Light that is scattered again is stood for by a second, slower decay: 0.7 exp(-q / 2) + 0.3 exp(-0.06 q) of an optical
/// depth q (Wrenninge et al., "Oz: the great and volumetric", 2013, has sums of such octaves).
#[simd]
pub fn bake<S: Simd>(simd: S, voxels: &mut Voxels, towards: Vec3, extinction: f32) {
    let n = voxels.edge();
    let (strides, way) = ([1, n, n * n], towards.to_array());
    // The axis that the sun is nearest to: layers are across it, and `du`, `dv` voxels from one to the next.
    let main = towards.abs().max_position();
    let (u, v) = ((main + 1) % 3, (main + 2) % 3);
    let slope = 1.0 / way[main].abs();
    let (du, dv) = (way[u] * slope, way[v] * slope);
    // Half of what a layer of the greatest density hides.
    let half = extinction * slope / (255 * n as u32) as f32;
    let mut depths = vec![0.0; n * n * n];
    for step in 0..n {
        let layer = strides[main] * if way[main] > 0.0 { n - 1 - step } else { step };
        let before = if way[main] > 0.0 { layer + strides[main] } else { layer.wrapping_sub(strides[main]) };
        for j in 0..n {
            for i in 0..n {
                let (x, y) = (i as u32 as f32 + du, j as u32 as f32 + dv);
                let (fx, fy) = (x - x.floor(), y - y.floor());
                // Nothing is in the way outside of the cube: what is below 0 becomes too much.
                let depth = |i: i32, j: i32| {
                    let (i, j) = (i as usize, j as usize);
                    if step > 0 && i < n && j < n { depths[before + i * strides[u] + j * strides[v]] } else { 0.0 }
                };
                let (x, y) = (x.floor() as i32, y.floor() as i32);
                let (a, b) = (depth(x, y), depth(x, y + 1));
                let (a, b) = (a + (depth(x + 1, y) - a) * fx, b + (depth(x + 1, y + 1) - b) * fx);
                let at = layer + i * strides[u] + j * strides[v];
                depths[at] = a + (b - a) * fy + voxels.density[at] as f32 * (2.0 * half);
            }
        }
    }
    let blocks = depths.as_chunks::<BLOCK>().0.iter().zip(voxels.density.as_chunks::<BLOCK>().0);
    for ((depths, densities), out) in blocks.zip(voxels.light.as_chunks_mut::<BLOCK>().0) {
        let mut light = [0.0; BLOCK];
        for (light, density) in light.iter_mut().zip(densities) {
            *light = *density as f32 * half;
        }
        for i in 0..BLOCK / F::<S>::LEN {
            // As far as the voxel's middle.
            let q = (load::<S, F<S>>(simd, depths, i) - load::<S, F<S>>(simd, &light, i)) * LOG2_E;
            store(exp2(simd, q * -0.5) * (0.7 * 255.0) + exp2(simd, q * -0.06) * (0.3 * 255.0), &mut light, i);
        }
        for (light, out) in light.iter().zip(out) {
            *out = (*light + 0.5) as u8;
        }
    }
    voxels.pack();
}
