//! Density and light of a cloud in a cube of voxels.

use crate::simd::lanes::{F, U, V3};
use fearless_simd::prelude::*;
use glam::Vec3;

/// Cells along an edge of a block, for which one leap is known.
const LEAP: usize = 4;

/// Density and sunlight at the points of a cubic lattice, trilinear between them and as at the edge beyond it.
#[derive(Clone)]
pub struct Voxels {
    /// Points along an edge: a multiple of 4.
    edge: usize,
    /// Density, x fastest, then y: 255 is the extinction that the cloud is drawn with.
    pub density: Vec<u8>,
    /// What is lit by the sun, of 255.
    pub light: Vec<u8>,
    /// The bytes of four points, from one on along x, then y: density and light. A lookup takes two of these.
    cells: Vec<[u32; 2]>,
    /// How far around a block of cells nothing is, cells.
    leaps: Vec<u8>,
    /// From the cube's middle to the farthest point where something is, halves of the edge.
    reach: f32,
}

impl Voxels {
    /// Voxels without light from `edge^3` densities; `light` may then be written, and [`Self::pack`] called.
    pub fn new(edge: usize, density: Vec<u8>) -> Voxels {
        let light = vec![255; density.len()];
        let mut voxels = Voxels { edge, density, light, cells: Vec::new(), leaps: Vec::new(), reach: 0.0 };
        voxels.measure();
        voxels.pack();
        voxels
    }

    /// Points along an edge.
    pub fn edge(&self) -> usize {
        self.edge
    }

    /// From the cube's middle to the farthest point where something is, halves of the edge.
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// Makes what lookups read, after density or light have changed.
    pub fn pack(&mut self) {
        let n = self.edge;
        self.cells.clear();
        // One layer more than there are, since every lookup reads two.
        for row in 0..n * (n + 1) {
            let (j, l) = (row % n, (row / n).min(n - 1));
            let (this, next) = ((j + n * l) * n, ((j + 1).min(n - 1) + n * l) * n);
            for i in 0..n {
                let k = (i + 1).min(n - 1);
                // Not by `map`: the optimizer, asked for size, calls a function for each.
                let cell = |bytes: &[u8]| {
                    u32::from_le_bytes([bytes[this + i], bytes[this + k], bytes[next + i], bytes[next + k]])
                };
                self.cells.push([cell(&self.density), cell(&self.light)]);
            }
        }
    }

    /// Finds how far around each block of cells nothing is.
    fn measure(&mut self) {
        let n = self.edge / LEAP;
        let mut full = vec![false; n * n * n];
        for (index, density) in self.density.iter().enumerate() {
            if *density > 0 {
                let place = [index % self.edge, index / self.edge % self.edge, index / (self.edge * self.edge)];
                let half = self.edge as u32 as f32 * 0.5;
                // Between points it ends at the next one, where nothing is.
                let at = Vec3::from(place.map(|i| i as u32 as f32 + 0.5 - half));
                self.reach = self.reach.max((at.length() + 1.0) / half);
                // A point belongs to the cells before it, too.
                for corner in 0..8 {
                    let [x, y, z] = [0, 1, 2].map(|axis| place[axis].saturating_sub(corner >> axis & 1) / LEAP);
                    full[x + n * (y + n * z)] = true;
                }
            }
        }
        self.leaps = vec![0; full.len()];
        for _ in 0..7 {
            // One ring wider, an axis at a time. What runs over an edge comes in at the other one, and makes leaps shorter.
            for stride in [1, n, n * n] {
                let before = full.clone();
                for (at, full) in full.iter_mut().enumerate() {
                    *full |= before[(at + stride) % before.len()] | before[(at + before.len() - stride) % before.len()];
                }
            }
            for (leap, full) in self.leaps.iter_mut().zip(&full) {
                *leap += if *full { 0 } else { LEAP as u8 };
            }
        }
    }

    /// How many cells away from `u` nothing is, at least, along any axis.
    #[inline(always)]
    pub fn leap<S: Simd>(&self, simd: S, u: V3<S>) -> F<S> {
        let n = (self.edge / LEAP) as u32 as f32;
        let block = |u: F<S>| (u * (1.0 / LEAP as f32)).floor();
        let index = block(u.x) + (block(u.y) + block(u.z) * n) * n;
        let mut at = [0; 16];
        index.to_int::<U<S>>().store_slice(&mut at[..F::<S>::LEN]);
        for at in &mut at[..F::<S>::LEN] {
            *at = self.leaps[*at as usize] as u32;
        }
        U::<S>::from_slice(simd, &at[..F::<S>::LEN]).to_float()
    }

    /// Density and light at points `u`, both of 255; coordinates count points and lie from 0 to `edge - 1`.
    #[inline(always)]
    pub fn look_up<S: Simd>(&self, simd: S, u: V3<S>) -> [F<S>; 2] {
        let lanes = F::<S>::LEN;
        let n = self.edge as u32 as f32;
        let base = V3::<S> { x: u.x.floor(), y: u.y.floor(), z: u.z.floor() };
        let f = u - base;
        let mut at = [0; 16];
        (base.x + (base.y + base.z * n) * n).to_int::<U<S>>().store_slice(&mut at[..lanes]);
        let mut words = [[0; 16]; 4];
        for (lane, at) in at[..lanes].iter().enumerate() {
            let at = *at as usize;
            let (near, far) = (self.cells[at], self.cells[at + self.edge * self.edge]);
            words[0][lane] = near[0];
            words[1][lane] = near[1];
            words[2][lane] = far[0];
            words[3][lane] = far[1];
        }
        let near = [0, 1].map(|k| U::<S>::from_slice(simd, &words[k][..lanes]));
        let far = [2, 3].map(|k| U::<S>::from_slice(simd, &words[k][..lanes]));
        [0, 1].map(
            #[inline(always)]
            |k| {
                let (a, b) = (square::<S>(near[k], f.x, f.y), square::<S>(far[k], f.x, f.y));
                a + (b - a) * f.z
            },
        )
    }
}

/// Four bytes, interpolated.
#[inline(always)]
pub fn square<S: Simd>(word: U<S>, x: F<S>, y: F<S>) -> F<S> {
    let a = (word & 255).to_float::<F<S>>();
    let b = (word >> 8 & 255).to_float::<F<S>>();
    let c = (word >> 16 & 255).to_float::<F<S>>();
    let d = (word >> 24).to_float::<F<S>>();
    let (a, c) = (a + (b - a) * x, c + (d - c) * x);
    a + (c - a) * y
}
