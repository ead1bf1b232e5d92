//! An imposter: a picture that stands for a cloud as long as the eye is near the place that it was made for
//! `[Clouds10]`.
//!
//! It holds what rays meet in the cloud, not the colours of the light, so a sun that only changes its colour needs no
//! new one. It lies in a plane across the way to its eye, and rays look it up where they cross that plane.

use super::voxels::{Voxels, bilinear};
use crate::frame::Tile;
use crate::settings::CloudSettings;
use crate::simd::lanes::{F, U, V3};
use crate::simd::math::to_f32;
use crate::view::{Camera, View};
use fearless_simd::prelude::*;
use glam::Vec3A;
use std::sync::Arc;

/// Where the plane of an imposter is: the share of the way from the cloud's centre to the nearest point that it may
/// reach.
pub(super) const PLANE: f32 = 0.5;

/// All that an imposter depends on. Lengths are in halves of the edge of the cloud's cube.
#[derive(Clone)]
pub(super) struct ImposterPlan {
    pub voxels: Arc<Voxels>,
    pub extinction: f32,
    pub settings: CloudSettings,
    /// The place that it is made for, from the cloud's centre.
    pub eye: Vec3A,
    /// Texels along an edge.
    pub edge: usize,
}

impl ImposterPlan {
    /// Whether both plans give the same imposter.
    pub fn is(&self, o: &ImposterPlan) -> bool {
        Arc::ptr_eq(&self.voxels, &o.voxels)
            && (self.extinction, self.settings, self.eye, self.edge) == (o.extinction, o.settings, o.eye, o.edge)
    }
}

/// A square picture of a cloud, seen from its plan's eye.
pub(super) struct Imposter {
    pub plan: ImposterPlan,
    camera: Camera,
    /// Unit vector towards the plan's eye, and the distance of the plane from the cloud's centre along it.
    towards: Vec3A,
    plane: f32,
    /// Along rows and columns, scaled so that products with places in the plane are texels.
    right: Vec3A,
    down: Vec3A,
    /// The number of the frame that it was drawn for.
    #[cfg(feature = "full")]
    pub born: u32,
    /// For each texel: transmittance, light from above and light of the sun, each as a word of the bytes of four
    /// texels, as in [`Voxels`].
    cells: Vec<[u32; 3]>,
}

impl Imposter {
    /// An imposter that is still to be drawn: tiles of texels are drawn for [`Imposter::view`] and handed to
    /// [`Imposter::pack`].
    pub fn new(plan: ImposterPlan) -> Imposter {
        let (way, reach, edge) = (plan.eye.length(), plan.voxels.reach(), plan.edge);
        let towards = plan.eye / way;
        // With a margin of a texel in which nothing is.
        let wide = reach / (way * way - reach * reach).sqrt() * to_f32(edge) / to_f32(edge - 2);
        let camera = Camera::look_at(plan.eye, Vec3A::ZERO, 2.0 * f64::from(wide).atan() as f32, 0.0);
        let plane = PLANE * reach;
        let texel = to_f32(edge) * 0.5 / (wide * wide * (way - plane));
        let [right, down] = [camera.right * texel, camera.up * -texel];
        Imposter {
            plan,
            camera,
            towards,
            plane,
            right,
            down,
            #[cfg(feature = "full")]
            born: 0,
            cells: Vec::new(),
        }
    }

    /// The view that it is drawn for.
    pub fn view(&self) -> View {
        View::new(self.camera, self.plan.edge, self.plan.edge)
    }

    /// The number of texels in the tiles that it is drawn in.
    pub fn area(&self) -> usize {
        self.plan.edge.next_multiple_of(Tile::SIZE).pow(2)
    }

    /// Makes what lookups read from `texels`: transmittance, light from above and light of the sun, of 255. Those of a
    /// tile come one after another.
    pub fn pack(&mut self, texels: &[[u8; 4]]) {
        let n = self.plan.edge;
        let texel = |x: usize, y: usize| {
            let tile = x / Tile::SIZE + y / Tile::SIZE * n.div_ceil(Tile::SIZE);
            texels[tile * Tile::AREA + x % Tile::SIZE + y % Tile::SIZE * Tile::SIZE]
        };
        self.cells.resize(n * n, [0; 3]);
        for (index, cell) in self.cells.iter_mut().enumerate() {
            let (x, y) = (index % n, index / n);
            let (right, below) = ((x + 1).min(n - 1), (y + 1).min(n - 1));
            let at = [texel(x, y), texel(right, y), texel(x, below), texel(right, below)];
            *cell = [0, 1, 2].map(|k| u32::from_le_bytes(at.map(|texel| texel[k])));
        }
    }

    /// Where rays from `q` along `d` cross the plane: column and row in texels, from 0 to [`Imposter::most`] inside.
    #[inline(always)]
    pub fn cross<S: Simd>(&self, simd: S, q: Vec3A, d: V3<S>) -> [F<S>; 2] {
        let n = to_f32(self.plan.edge);
        let way = F::<S>::splat(simd, self.plane - q.dot(self.towards)) / d.dot1(self.towards);
        [
            d.dot1(self.right) * way + (q.dot(self.right) + n * 0.5 - 0.5),
            d.dot1(self.down) * way + (q.dot(self.down) + n * 0.5 - 0.5),
        ]
    }

    /// The last column and row.
    #[inline(always)]
    pub fn most(&self) -> f32 {
        to_f32(self.plan.edge) - 1.0
    }

    /// Transmittance, light from above and light of the sun, of 255, at a column and a row.
    #[inline(always)]
    pub fn look_up<S: Simd>(&self, simd: S, [x, y]: [F<S>; 2]) -> [F<S>; 3] {
        let (x, y) = (x.max(0.0).min(self.most()), y.max(0.0).min(self.most()));
        let (left, top) = (x.floor(), y.floor());
        let (fx, fy) = (x - left, y - top);
        let lanes = F::<S>::LEN;
        let mut at = [0; 16];
        (left + top * to_f32(self.plan.edge)).to_int::<U<S>>().store_slice(&mut at[..lanes]);
        let mut words = [[0; 16]; 3];
        for (lane, at) in at[..lanes].iter().enumerate() {
            let cell = self.cells[*at as usize];
            words[0][lane] = cell[0];
            words[1][lane] = cell[1];
            words[2][lane] = cell[2];
        }
        let mut values = [F::<S>::splat(simd, 0.0); 3];
        let mut k = 0;
        while k < 3 {
            values[k] = bilinear(simd, U::<S>::from_slice(simd, &words[k][..lanes]), fx, fy);
            k += 1;
        }
        values
    }
}
