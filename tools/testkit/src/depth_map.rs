//! Lookups of a depth map in f64, and lookups to ask the kernel by.

use super::random::Random;
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use paprsek::raster::depth_map::{DepthMap, MapPoints};
use paprsek::simd::lanes::F;

/// A map of two views of random depths, `size` texels wide, and the depths.
pub fn random_map(random: &mut Random, size: usize) -> (DepthMap, [Vec<f32>; 2]) {
    let depths = [0, 1].map(|_| (0..size * size).map(|_| random.unit() as f32).collect::<Vec<_>>());
    (DepthMap::of(size, &depths), depths)
}

/// A point in a map of `size` texels, texels: by the case at a whole or half texel, or beyond the map.
pub fn place(random: &mut Random, case: usize, size: usize) -> [f32; 2] {
    [0, 1].map(|_| match case % 4 {
        0 => random.range(0.0, size as f64 + 1.0).floor() as f32,
        1 => random.range(0.0, size as f64).floor() as f32 + 0.5,
        2 => random.range(-3.0, size as f64 + 3.0) as f32,
        _ => random.range(0.0, size as f64) as f32,
    })
}

/// Share of the light at a point: with `smooth` of the square of 3x3 texels around it, else of the 3x3 texels around its
/// own; along the border and beyond, of the nearest such square within the map.
pub fn truth(depths: &[f32], size: usize, [x, y]: [f64; 2], near: f32, smooth: bool) -> f64 {
    let rim = if smooth { 1.5 } else { 1.0 };
    // The last texel in the middle of three begins two before the end.
    let limit = |v: f64| v.clamp(rim, size as f64 - if smooth { rim } else { 2.0 });
    let (x, y) = (limit(x), limit(y));
    let weight = |i: usize, v: f64| {
        if smooth {
            ((i as f64 + 1.0).min(v + 1.5) - (i as f64).max(v - 1.5)).max(0.0)
        } else {
            ((i as f64 - v.floor()).abs() <= 1.0) as u32 as f64
        }
    };
    // Texels farther away weigh nothing.
    let texels = |v: f64| (v as usize).saturating_sub(3)..(v as usize + 4).min(size);
    let mut sum = 0.0;
    for (i, j) in texels(y).flat_map(|j| texels(x).map(move |i| (i, j))) {
        sum += weight(i, x) * weight(j, y) * (depths[j * size + i] <= near) as u32 as f64;
    }
    sum / 9.0
}

/// What the kernel finds there.
pub fn lit(level: Level, map: &DepthMap, view: usize, at: [f32; 2], near: f32, smooth: bool) -> f32 {
    #[inline(always)]
    fn look<S: Simd>(simd: S, map: &DepthMap, view: f32, at: [f32; 2], near: f32, smooth: bool) -> f32 {
        let splat = |v: f32| F::<S>::splat(simd, v);
        let (x, y, inv_depth, slope) = (splat(at[0]), splat(at[1]), splat(near), splat(0.0));
        let points = MapPoints { view: splat(view), x, y, inv_depth, slope, inside: splat(0.0).simd_eq(0.0) };
        map.lit(simd, &points, smooth)[0]
    }
    dispatch!(level, simd => look(simd, map, view as f32, at, near, smooth))
}
