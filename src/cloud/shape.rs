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
use glam::{Vec3A, vec3a};
use std::f32::consts::TAU;

/// A kind of cloud, in a cube from -1 to 1.
#[derive(Clone, Copy, Debug)]
pub struct CloudKind {
    /// Rings of puffs. Each is the number of puffs, then in hundredths the radius of the ring, the height of a puff and
    /// its radius, each as the least and what chance adds at most.
    rings: &'static [[i8; 7]],
    /// Height of the base, below which nothing is, hundredths.
    base: i8,
    /// Distance inside of the surface over which density rises from 0 to 255. Less than two voxels show as steps.
    rise: f32,
}

/// Edge of a block of points.
const SIDE: usize = 4;

/// How far noise moves points.
const WARP: f32 = 0.22;

/// How much octaves of billows take from a distance, and what is added to it, so that the surface stays where it is in
/// the mean.
const EROSION: f32 = 0.42;
const SHIFT: f32 = EROSION * 0.16;

impl CloudKind {
    /// A fair-weather cloud: a dome on a flat base.
    pub const CUMULUS: CloudKind =
        CloudKind { rings: &[[8, 30, 16, -34, 22, 22, 13], [1, 0, 0, -4, 0, 50, 12]], base: -46, rise: 0.12 };
    /// A tower of domes.
    pub const CONGESTUS: CloudKind = CloudKind {
        rings: &[[8, 26, 16, -62, 16, 20, 10], [5, 12, 14, -30, 30, 24, 12], [3, 6, 14, 20, 30, 20, 14]],
        base: -80,
        rise: 0.12,
    };

    /// The same kind with another distance over which density rises: less than 0.12 looks crisper from close by, and wants
    /// more voxels.
    pub const fn with_rise(self, rise: f32) -> CloudKind {
        CloudKind { rise, ..self }
    }

    /// The cloud of a kind and a seed, `edge` points along an edge: a multiple of 4.
    ///
    /// Points are taken in blocks of 4^3, many of which are wholly outside, and these in columns, whose base is the same:
    ///
    /// ```text
    /// for each column, for each block of it that is not below all bases:
    ///     warped = point + WARP * noise(point)
    ///     distance = to the nearest puff from the warped point, + SHIFT
    ///     skip the block where erosion could not bring any point inside
    ///     distance -= EROSION * four octaves of |noise(warped)|
    ///     base = height over the base, which noise makes uneven
    ///     density = clamp(-distance / rise) * clamp(base), and 0 at the faces of the cube
    /// ```
    #[simd]
    pub fn grow<S: Simd>(simd: S, kind: &CloudKind, seed: u32, edge: usize) -> Voxels {
        let o = 17.3 * (seed + 1) as f32;
        let puffs = kind.puffs(seed);
        let lowest = kind.base as f32 * 0.1;
        let mut density = vec![0; edge * edge * edge];
        let across = edge / SIDE;
        for column in 0..across * across {
            let (x, z) = (column % across * SIDE, column / across * SIDE);
            let mut base = None;
            for y in (0..edge).step_by(SIDE) {
                let (mut at, mut inside, mut numbers) = ([[0.0; BLOCK]; 3], [0.0; BLOCK], [0; BLOCK]);
                points([x, y, z], edge, &mut at, &mut inside, &mut numbers);
                let [px, py, pz] = &at;
                // Four octaves of noise come to less than 1.
                if py[BLOCK - 1] * 10.0 + 1.0 < lowest {
                    continue;
                }
                let mut warped = at;
                warp(simd, [px, py, pz], o, &mut warped);
                let mut distance = [0.0; BLOCK];
                if !erode(simd, &warped, &puffs, o, &mut distance) {
                    continue;
                }
                let base =
                    base.get_or_insert_with(|| fbm(simd, [px, py, pz], vec3a(3.0, 0.0, 3.0), vec3a(o, 0.0, 0.0), 4));
                for i in 0..BLOCK {
                    let base = (py[i] * 10.0 + base[i] - lowest).clamp(0.0, 1.0);
                    density[numbers[i]] =
                        ((distance[i] * (-1.0 / kind.rise)).clamp(0.0, 1.0) * base * inside[i] + 0.5) as u8;
                }
            }
        }
        Voxels::new(edge, density)
    }

    /// Centres and radii of the puffs of a seed.
    #[inline(always)]
    fn puffs(&self, seed: u32) -> Vec<(Vec3A, f32)> {
        let mut puffs: Vec<(Vec3A, f32)> = Vec::new();
        for ring in self.rings {
            for i in 0..ring[0] {
                let number = 800 + 16 * seed + puffs.len() as u32;
                let draw = |k: usize, j: u32| (ring[k] as f32 + ring[k + 1] as f32 * rnd(1, number, j)) * 0.01;
                let (sin, cos) = angle::sin_cos(TAU * (i as f32 / ring[0] as f32 + 0.1 * rnd(1, number, 0)));
                let way = draw(1, 1);
                puffs.push((vec3a(way * cos, draw(3, 2), way * sin), draw(5, 3)));
            }
        }
        puffs
    }
}

// The steps write into the caller's blocks: as results these would be copied, 0.2 kB packed.

/// The points of a block that begins at voxel `first`, in Morton's order, in which neighbours mostly lie in one cell of
/// noise; 255 for those that are not in a face of the cube, and their voxels' numbers.
#[inline(always)]
fn points(first: [usize; 3], edge: usize, at: &mut Block3, inside: &mut [f32; BLOCK], numbers: &mut [usize; BLOCK]) {
    let scale = 2.0 / to_f32(edge);
    for i in 0..BLOCK {
        let mut stride = 1;
        inside[i] = 255.0;
        for (axis, at) in at.iter_mut().enumerate() {
            let bits = i >> axis;
            let place = first[axis] + (bits & 1 | bits >> 2 & 2);
            at[i] = (to_f32(place) + 0.5) * scale - 1.0;
            if place == 0 || place == edge - 1 {
                inside[i] = 0.0;
            }
            numbers[i] += place * stride;
            stride *= edge;
        }
    }
}

/// Moves copies of points by noise, of its own along each axis.
#[inline(always)]
fn warp<S: Simd>(simd: S, points: [&[f32; BLOCK]; 3], o: f32, warped: &mut Block3) {
    for (warped, a) in warped.iter_mut().zip([0.0, 31.7, 63.1]) {
        let warp = fbm(simd, points, Vec3A::splat(1.6), vec3a(o + a, a, -a), 2);
        for i in 0..BLOCK {
            warped[i] += warp[i] * WARP;
        }
    }
}

/// Distances of points to the eroded puffs, below 0 inside. False where all points are outside; the distances are not
/// complete then.
#[inline(always)]
fn erode<S: Simd>(simd: S, warped: &Block3, puffs: &[(Vec3A, f32)], o: f32, distance: &mut [f32; BLOCK]) -> bool {
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
        let billow = fbm(simd, [u, v, w], Vec3A::splat(frequency), vec3a(o, 0.0, 0.0), 1);
        for i in 0..BLOCK {
            distance[i] += billow[i].abs() * amplitude;
        }
        (frequency, amplitude) = (frequency * 2.03, amplitude * 0.5);
    }
    true
}

/// [`fbm`](crate::noise::fbm) at the points of a block times `scale` and moved by `offset`.
#[simd]
fn fbm<S: Simd>(simd: S, p: [&[f32; BLOCK]; 3], scale: Vec3A, offset: Vec3A, octaves: u32) -> [f32; BLOCK] {
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
