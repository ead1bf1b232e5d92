//! Clouds from a formula: puffs on a flat base, warped and eroded by noise.

use super::voxels::Voxels;
use crate::noise::octaves_block;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::hash::rnd;
use crate::simd::lanes::F;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3, vec3};
use std::f32::consts::TAU;

/// What grows in a cube from -1 to 1.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Rings of puffs: how many, then in hundredths the ring's radius, the puffs' height and radius, each the least and
    /// what chance adds to it.
    rings: &'static [[i8; 7]],
    /// Height below which nothing is, hundredths.
    base: i8,
    /// Height over width of all puffs, hundredths.
    flat: i8,
}

impl Kind {
    /// Fair weather: a dome on a flat base.
    pub const CUMULUS: Kind =
        Kind { rings: &[[8, 30, 16, -34, 22, 22, 13], [1, 0, 0, -4, 0, 50, 12]], base: -46, flat: 100 };
    /// A tower of domes.
    pub const CONGESTUS: Kind = Kind {
        rings: &[[8, 26, 16, -62, 16, 20, 10], [5, 12, 14, -30, 30, 24, 12], [3, 6, 14, 20, 30, 20, 14]],
        base: -80,
        flat: 100,
    };
    /// A layer of small flakes.
    pub const ALTOCUMULUS: Kind = Kind {
        rings: &[[15, 66, 16, 0, 10, 10, 12], [12, 40, 16, 0, 10, 12, 12], [7, 15, 16, 0, 10, 14, 12]],
        base: -40,
        flat: 60,
    };
    /// A sheet.
    pub const STRATUS: Kind =
        Kind { rings: &[[12, 52, 10, -12, 24, 26, 12], [6, 20, 20, -8, 24, 34, 12]], base: -30, flat: 35 };

    /// The cloud of that kind and seed, `edge` points along an edge: a multiple of 4.
    ///
    /// The scenes to compare renderers by specify it, down to the numbers: `cumulus` in `tests/cloud/oracle.rs`.
    #[simd]
    pub fn grow<S: Simd>(simd: S, kind: &Kind, seed: u32, edge: usize) -> Voxels {
        let o = 17.3 * (seed + 1) as f32;
        let mut puffs: Vec<(Vec3, f32)> = Vec::new();
        for ring in kind.rings {
            for i in 0..ring[0] {
                let number = 800 + 16 * seed + puffs.len() as u32;
                let draw = |k: usize, j: u32| (ring[k] as f32 + ring[k + 1] as f32 * rnd(1, number, j)) * 0.01;
                let (sin, cos) = (TAU * (i as f32 / ring[0] as f32 + 0.1 * rnd(1, number, 0))).sin_cos();
                let way = draw(1, 1);
                puffs.push((vec3(way * cos, draw(3, 2), way * sin), draw(5, 3)));
            }
        }
        let scale = 2.0 / edge as u32 as f32;
        let squash = 100.0 / kind.flat as f32;
        let mut density = vec![0; edge * edge * edge];
        let (mut ground, mut base) = ([[9.0; BLOCK]; 2], [0.0; BLOCK]);
        for (block, density) in density.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            let [mut x, mut y, mut z] = [[0.0; BLOCK]; 3];
            let mut inside = [0.0; BLOCK];
            for i in 0..BLOCK {
                let at = block * BLOCK + i;
                let place = [at % edge, at / edge % edge, at / (edge * edge)];
                [x[i], y[i], z[i]] = place.map(|i| (i as u32 as f32 + 0.5) * scale - 1.0);
                inside[i] = if place.iter().any(|i| *i == 0 || *i == edge - 1) { 0.0 } else { 255.0 };
            }
            let mut warped = [x, y, z];
            for (warped, a) in warped.iter_mut().zip([0.0, 31.7, 63.1]) {
                let warp = sample(simd, [&x, &y, &z], Vec3::splat(1.6), vec3(o + a, a, -a), 2);
                for i in 0..BLOCK {
                    warped[i] += warp[i] * 0.22;
                }
            }
            let mut distance = [0.0; BLOCK];
            let mut some = false;
            for i in 0..BLOCK / F::<S>::LEN {
                let [x, y, z]: [F<S>; 3] =
                    [load(simd, &warped[0], i), load(simd, &warped[1], i), load(simd, &warped[2], i)];
                let mut near = F::<S>::splat(simd, 9.0);
                for (centre, radius) in &puffs {
                    let (x, y, z) = (x - centre.x, (y - centre.y) * squash, z - centre.z);
                    near = near.min((x * x + y * y + z * z).sqrt() - *radius);
                }
                // Erosion adds no more than this.
                some |= near.simd_lt(0.42 * 0.815).any_true();
                store(near + 0.42 * 0.16, &mut distance, i);
            }
            if !some {
                continue;
            }
            let (mut frequency, mut amplitude) = (3.0, -0.42);
            let [u, v, w] = &warped;
            for _ in 0..4 {
                // One octave is half of a noise.
                let billow = sample(simd, [u, v, w], Vec3::splat(frequency), vec3(o, 0.0, 0.0), 1);
                for i in 0..BLOCK {
                    distance[i] += billow[i].abs() * amplitude;
                }
                (frequency, amplitude) = (frequency * 2.03, amplitude * 0.5);
            }
            // Blocks above one another have the same.
            if ground != [x, z] {
                ground = [x, z];
                base = sample(simd, [&x, &y, &z], vec3(3.0, 0.0, 3.0), vec3(o, 0.0, 0.0), 4);
            }
            for (i, density) in density.iter_mut().enumerate() {
                let base = (y[i] * 10.0 + base[i] - kind.base as f32 * 0.1).clamp(0.0, 1.0);
                *density = ((distance[i] * (-1.0 / 0.12)).clamp(0.0, 1.0) * base * inside[i] + 0.5) as u8;
            }
        }
        Voxels::new(edge, density)
    }
}

/// [`fbm`](crate::noise::fbm) of 64 points times `scale` and moved by `offset`.
#[simd]
fn sample<S: Simd>(simd: S, p: [&[f32; BLOCK]; 3], scale: Vec3, offset: Vec3, octaves: u32) -> [f32; BLOCK] {
    let mut q = [[0.0; BLOCK]; 3];
    for (axis, q) in q.iter_mut().enumerate() {
        for i in 0..BLOCK / F::<S>::LEN {
            store(load::<S, F<S>>(simd, p[axis], i) * scale[axis] + offset[axis], q, i);
        }
    }
    let mut out = [0.0; BLOCK];
    octaves_block(simd, [&q[0], &q[1], &q[2]], octaves, false, None, &mut out);
    out
}
