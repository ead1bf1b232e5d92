//! The densities of clouds, from a formula: balls on a flat base, warped and eroded by noise.
//!
//! A cloud is the inside of a distance field. At its core are puffs, balls in rings around the axis of the cube. The
//! distance to the nearest is taken at a point that noise has moved (domain warping), and octaves of the absolute value
//! of noise are taken from it, which puts billows on the surface. Density rises over a short distance inside of the
//! surface and ends at a flat base, as rising air condenses at one height.
//!
//! The bench scenes specify [`CloudKind::CUMULUS`] down to the numbers; the reference is `cumulus` in
//! `tools/testkit/src/voxels.rs`.

use super::voxels::Voxels;
use crate::angle;
use crate::noise::octaves_block;
use crate::simd::block::{BLOCK, Block3, load, store};
use crate::simd::hash::rnd;
use crate::simd::lanes::F;
use crate::simd::math::to_f32;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3, vec3};
use std::f32::consts::TAU;

/// A kind of cloud, in a cube from -1 to 1.
#[derive(Clone, Copy, Debug)]
pub struct CloudKind {
    /// Rings of puffs. Each is the number of puffs, then in hundredths the radius of the ring, the height of a puff and
    /// its radius, each as the least and what chance adds at most.
    rings: &'static [[i8; 7]],
    /// Height of the base, below which nothing is, hundredths.
    base: i8,
}

/// How far noise moves points.
const WARP: f32 = 0.22;

/// How much octaves of billows take from a distance, and what is added to it, so that the surface stays where it is in
/// the mean.
const EROSION: f32 = 0.42;
const SHIFT: f32 = EROSION * 0.16;

/// Distance inside of the surface over which density rises from 0 to 255.
const EDGE: f32 = 0.12;

impl CloudKind {
    /// A fair-weather cloud: a dome on a flat base.
    pub const CUMULUS: CloudKind =
        CloudKind { rings: &[[8, 30, 16, -34, 22, 22, 13], [1, 0, 0, -4, 0, 50, 12]], base: -46 };
    /// A tower of domes.
    pub const CONGESTUS: CloudKind = CloudKind {
        rings: &[[8, 26, 16, -62, 16, 20, 10], [5, 12, 14, -30, 30, 24, 12], [3, 6, 14, 20, 30, 20, 14]],
        base: -80,
    };

    /// The cloud of a kind and a seed, `edge` points along an edge: a multiple of 4.
    ///
    /// Points are taken in blocks, in the order in which voxels are stored:
    ///
    /// ```text
    /// for each block:
    ///     warped = point + WARP * noise(point)
    ///     distance = to the nearest puff from the warped point, + SHIFT
    ///     skip the block where erosion could not bring any point inside
    ///     distance -= EROSION * four octaves of |noise(warped)|
    ///     base = height over the base, which noise makes uneven
    ///     density = clamp(-distance / EDGE) * clamp(base), and 0 at the faces of the cube
    /// ```
    #[simd]
    pub fn grow<S: Simd>(simd: S, kind: &CloudKind, seed: u32, edge: usize) -> Voxels {
        let o = 17.3 * (seed + 1) as f32;
        let puffs = kind.puffs(seed);
        let mut density = vec![0; edge * edge * edge];
        let (mut ground, mut base) = ([[9.0; BLOCK]; 2], [0.0; BLOCK]);
        for (block, density) in density.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            let ([mut x, mut y, mut z], mut inside) = ([[0.0; BLOCK]; 3], [0.0; BLOCK]);
            points(block, edge, [&mut x, &mut y, &mut z], &mut inside);
            let mut warped = [x, y, z];
            warp(simd, [&x, &y, &z], o, &mut warped);
            let mut distance = [0.0; BLOCK];
            if !erode(simd, &warped, &puffs, o, &mut distance) {
                continue;
            }
            // Blocks above one another have the same base.
            if ground != [x, z] {
                ground = [x, z];
                base = fbm(simd, [&x, &y, &z], vec3(3.0, 0.0, 3.0), vec3(o, 0.0, 0.0), 4);
            }
            for (i, density) in density.iter_mut().enumerate() {
                let base = (y[i] * 10.0 + base[i] - kind.base as f32 * 0.1).clamp(0.0, 1.0);
                *density = ((distance[i] * (-1.0 / EDGE)).clamp(0.0, 1.0) * base * inside[i] + 0.5) as u8;
            }
        }
        Voxels::new(edge, density)
    }

    /// Centres and radii of the puffs of a seed.
    #[inline(always)]
    fn puffs(&self, seed: u32) -> Vec<(Vec3, f32)> {
        let mut puffs: Vec<(Vec3, f32)> = Vec::new();
        for ring in self.rings {
            for i in 0..ring[0] {
                let number = 800 + 16 * seed + puffs.len() as u32;
                let draw = |k: usize, j: u32| (ring[k] as f32 + ring[k + 1] as f32 * rnd(1, number, j)) * 0.01;
                let (sin, cos) = angle::sin_cos(TAU * (i as f32 / ring[0] as f32 + 0.1 * rnd(1, number, 0)));
                let way = draw(1, 1);
                puffs.push((vec3(way * cos, draw(3, 2), way * sin), draw(5, 3)));
            }
        }
        puffs
    }
}

// The steps write into the caller's blocks: as results these would be copied, 0.2 kB packed.

/// The points of a block, and the greatest density of each: 255, or 0 at the faces of the cube.
#[inline(always)]
fn points(block: usize, edge: usize, [x, y, z]: [&mut [f32; BLOCK]; 3], inside: &mut [f32; BLOCK]) {
    let scale = 2.0 / to_f32(edge);
    for i in 0..BLOCK {
        let at = block * BLOCK + i;
        let place = [at % edge, at / edge % edge, at / (edge * edge)];
        [x[i], y[i], z[i]] = place.map(|i| (to_f32(i) + 0.5) * scale - 1.0);
        inside[i] = if place.iter().any(|i| *i == 0 || *i == edge - 1) { 0.0 } else { 255.0 };
    }
}

/// Moves copies of points by noise, of its own along each axis.
#[inline(always)]
fn warp<S: Simd>(simd: S, points: [&[f32; BLOCK]; 3], o: f32, warped: &mut Block3) {
    for (warped, a) in warped.iter_mut().zip([0.0, 31.7, 63.1]) {
        let warp = fbm(simd, points, Vec3::splat(1.6), vec3(o + a, a, -a), 2);
        for i in 0..BLOCK {
            warped[i] += warp[i] * WARP;
        }
    }
}

/// Distances of points to the eroded puffs, below 0 inside. False where all points are outside; the distances are not
/// complete then.
#[inline(always)]
fn erode<S: Simd>(simd: S, warped: &Block3, puffs: &[(Vec3, f32)], o: f32, distance: &mut [f32; BLOCK]) -> bool {
    let mut some = false;
    for i in 0..BLOCK / F::<S>::LEN {
        let [x, y, z]: [F<S>; 3] = [load(simd, &warped[0], i), load(simd, &warped[1], i), load(simd, &warped[2], i)];
        let mut near = F::<S>::splat(simd, 9.0);
        for (centre, radius) in puffs {
            let (x, y, z) = (x - centre.x, y - centre.y, z - centre.z);
            near = near.min((x * x + y * y + z * z).sqrt() - *radius);
        }
        // Four octaves of billows, less the shift, come to at most 0.815 of the erosion.
        some |= near.simd_lt(EROSION * 0.815).any_true();
        store(near + SHIFT, distance, i);
    }
    if !some {
        return false;
    }
    let (mut frequency, mut amplitude) = (3.0, -EROSION);
    let [u, v, w] = warped;
    for _ in 0..4 {
        // One octave is half of a noise.
        let billow = fbm(simd, [u, v, w], Vec3::splat(frequency), vec3(o, 0.0, 0.0), 1);
        for i in 0..BLOCK {
            distance[i] += billow[i].abs() * amplitude;
        }
        (frequency, amplitude) = (frequency * 2.03, amplitude * 0.5);
    }
    true
}

/// [`fbm`](crate::noise::fbm) at the points of a block times `scale` and moved by `offset`.
#[simd]
fn fbm<S: Simd>(simd: S, p: [&[f32; BLOCK]; 3], scale: Vec3, offset: Vec3, octaves: u32) -> [f32; BLOCK] {
    let mut q = [[0.0; BLOCK]; 3];
    for (axis, q) in q.iter_mut().enumerate() {
        for i in 0..BLOCK / F::<S>::LEN {
            store(load::<S, F<S>>(simd, p[axis], i) * scale[axis] + offset[axis], q, i);
        }
    }
    let mut out = [0.0; BLOCK];
    octaves_block(simd, [&q[0], &q[1], &q[2]], octaves, false, BLOCK, None, &mut out);
    out
}
