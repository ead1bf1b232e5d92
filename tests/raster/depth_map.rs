//! Lookups of a depth map against the area of the lit texels around a point.

use fearless_simd::{Simd, dispatch, prelude::*};
use paprsek::raster::depth_map::{DepthMap, MapPoints};
use paprsek::simd::lanes::F;
use testkit::random::Random;

/// Two views of random depths.
fn map(random: &mut Random, size: usize) -> (DepthMap, [Vec<f32>; 2]) {
    let depths = [0, 1].map(|_| (0..size * size).map(|_| random.unit() as f32).collect::<Vec<_>>());
    let map = DepthMap::of(size, &depths);
    (map, depths)
}

/// Share of the light at a point: with `smooth` of the square of 3x3 texels around it, else of the 3x3 texels around its
/// own; along the border and beyond, of the nearest such square within the map.
fn truth(depths: &[f32], size: usize, [x, y]: [f64; 2], near: f32, smooth: bool) -> f64 {
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
    let mut sum = 0.0;
    for j in 0..size {
        for i in 0..size {
            sum += weight(i, x) * weight(j, y) * (depths[j * size + i] <= near) as u32 as f64;
        }
    }
    sum / 9.0
}

#[test]
fn a_lookup_is_the_lit_share_of_the_texels_around() {
    #[inline(always)]
    fn look<S: Simd>(simd: S, map: &DepthMap, view: f32, at: [f32; 2], near: f32, smooth: bool) -> f32 {
        let splat = |v: f32| F::<S>::splat(simd, v);
        let all = splat(0.0).simd_eq(0.0);
        let points = MapPoints {
            view: splat(view),
            x: splat(at[0]),
            y: splat(at[1]),
            inv_depth: splat(near),
            slope: splat(0.0),
            inside: all,
        };
        map.lit(simd, &points, smooth)[0]
    }
    let mut random = Random(1);
    for size in [64, 128] {
        let (map, depths) = map(&mut random, size);
        for case in 0..600 {
            let mut place = || match case % 4 {
                // Whole and half texels, and beyond the map.
                0 => random.range(0.0, size as f64 + 1.0).floor() as f32,
                1 => random.range(0.0, size as f64).floor() as f32 + 0.5,
                2 => random.range(-3.0, size as f64 + 3.0) as f32,
                _ => random.range(0.0, size as f64) as f32,
            };
            let (at, view) = ([place(), place()], case % 2);
            // Now and then as near as a texel.
            let near = if case % 5 == 0 { depths[view][case % (size * size)] } else { random.unit() as f32 };
            for smooth in [false, true] {
                let truth = truth(&depths[view], size, at.map(f64::from), near, smooth);
                for (name, level) in testkit::levels() {
                    let found = dispatch!(level, simd => look(simd, &map, view as f32, at, near, smooth));
                    // Sums of sixteen weights, each rounded where the place is.
                    let slack = if smooth { 1e-6 * (1.0 + size as f64) } else { 1e-7 };
                    let right = (found as f64 - truth).abs() <= slack;
                    assert!(right, "{name}, {size}, {smooth}: {found} instead of {truth} at {at:?}");
                }
            }
        }
    }
}
