//! Shadow depth maps: what a light sees, looked up from what the eye sees.
//!
//! L. Williams, "Casting curved shadows on curved surfaces", 1978; percentage-closer filtering after W. Reeves,
//! D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", 1987.

use super::Body;
use super::mesh::Mesh;
use super::project::Projection;
use crate::lanes::{F, M};
use fearless_simd::f32x4;
use fearless_simd::prelude::*;
use glam::Affine3A;
use std::sync::{Arc, Mutex, PoisonError};

/// How a lookup keeps a lit surface from shadowing itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bias {
    /// Metres towards the light.
    pub constant: f32,
    /// Texels along the light, for a surface at 45 degrees to it; in proportion to the slope, up to 4 times.
    pub slope: f32,
    /// Texels along the normal, for a surface that the light grazes; in proportion to the sine.
    pub normal: f32,
}

impl Bias {
    /// That share of it.
    pub fn times(self, share: f32) -> Bias {
        Bias { constant: self.constant * share, slope: self.slope * share, normal: self.normal * share }
    }
}

/// What a light is to see.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Parallel projections from the finest to the coarsest, or the six faces of a cube; of one square size.
    pub views: Vec<Projection>,
    /// Against self-shadowing.
    pub bias: Bias,
    /// Are the faces that look away from the light drawn, instead of those that look at it?
    pub back_faces: bool,
    /// Are shadows traced, without a map? The views then only sort triangles, and the bias is a part of what it says.
    pub traced: bool,
    /// Are the borders of the 3x3 texels weighted by how much of them is met? Else each counts alike.
    pub smooth: bool,
}

/// Texels around a map that repeat its outermost.
pub const PAD: usize = 2;
/// Nearness of nothing: any light passes.
pub const NOTHING: f32 = f32::MIN;

/// The depths of a plan's views.
#[derive(Default)]
pub struct DepthMap {
    /// Texels along an edge.
    pub size: usize,
    /// Nearness, view by view, row by row, each with its border.
    texels: Vec<f32>,
}

impl DepthMap {
    /// Makes room for that many views; what was there may stay.
    pub fn resize(&mut self, size: usize, views: usize) {
        self.size = size;
        self.texels.resize(views * (size + 2 * PAD) * (size + 2 * PAD), 0.0);
    }

    /// Texels from row to row.
    pub fn stride(&self) -> usize {
        self.size + 2 * PAD
    }

    /// The views cut into bands of `rows` rows: the view's index, the band's, and a texel after the other with the border.
    pub fn bands(&mut self, rows: usize) -> impl Iterator<Item = (usize, usize, &mut [f32])> {
        let stride = self.stride();
        let inner = PAD * stride..(PAD + self.size) * stride;
        self.texels.chunks_mut((stride * stride).max(1)).enumerate().flat_map(move |(view, texels)| {
            let bands = texels[inner.clone()].chunks_mut(rows * stride).enumerate();
            bands.map(move |(band, texels)| (view, band, texels))
        })
    }

    /// Repeats the outermost texels around the maps.
    pub fn close(&mut self) {
        let (stride, size) = (self.stride(), self.size);
        for texels in self.texels.chunks_mut((stride * stride).max(1)) {
            for row in texels[PAD * stride..(PAD + size) * stride].chunks_mut(stride) {
                let (first, last) = (row[PAD], row[PAD + size - 1]);
                row[..PAD].fill(first);
                row[PAD + size..].fill(last);
            }
            for edge in 0..PAD {
                texels.copy_within(PAD * stride..(PAD + 1) * stride, edge * stride);
                texels.copy_within((PAD + size - 1) * stride..(PAD + size) * stride, (PAD + size + edge) * stride);
            }
        }
    }

    /// Nearness at a texel of a view.
    pub fn at(&self, view: usize, x: usize, y: usize) -> f32 {
        self.texels[(view * self.stride() + y + PAD) * self.stride() + x + PAD]
    }

    /// Share of the light, 0 to 1, at texel coordinates (`x`, `y`) of each lane's `view`, for points of that nearness.
    /// Lanes that are not `wanted` get what they get.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)] // Where to look, and how.
    pub fn light<S: Simd>(
        &self,
        simd: S,
        view: F<S>,
        x: F<S>,
        y: F<S>,
        near: F<S>,
        smooth: bool,
        wanted: M<S>,
    ) -> F<S> {
        let stride = self.stride();
        let last = self.size as u32 as f32 - 1.0;
        let shift = if smooth { 0.5 } else { 0.0 };
        let (x, y) = ((x - shift).max(-shift).min(last), (y - shift).max(-shift).min(last));
        let (column, row) = (x.floor(), y.floor());
        // The first of the texels around: one to the left and above.
        let line = view * stride as u32 as f32 + row + (PAD as f32 - 1.0);
        let first = line.to_int::<S::i32s>() * stride as i32 + column.to_int::<S::i32s>() + (PAD as i32 - 1);
        let beyond = self.texels.len() - 3 * stride - 4;
        let first = first.bitcast::<S::u32s>().min(S::u32s::splat(simd, beyond as u32));
        let (mut places, mut nears, mut sums) = ([0u32; 16], [0f32; 16], [0f32; 16]);
        let (mut fx, mut fy) = ([0f32; 16], [0f32; 16]);
        let lanes = F::<S>::LEN;
        first.store_slice(&mut places[..lanes]);
        near.store_slice(&mut nears[..lanes]);
        if smooth {
            (x - column).store_slice(&mut fx[..lanes]);
            (y - row).store_slice(&mut fy[..lanes]);
        }
        let mut todo = wanted.to_bitmask();
        while todo != 0 {
            let lane = todo.trailing_zeros() as usize & 15;
            todo &= todo - 1;
            let near = f32x4::splat(simd, nears[lane]);
            let texels = &self.texels[places[lane] as usize..][..3 * stride + 4];
            sums[lane] = if smooth {
                let (fx, fy) = (fx[lane], fy[lane]);
                let nothing = f32x4::splat(simd, 0.0);
                let weight = f32x4::from_slice(simd, &[1.0 - fx, 1.0, 1.0, fx]);
                let a = f32x4::from_slice(simd, &texels[..4]).simd_le(near).select(weight, nothing);
                let b = f32x4::from_slice(simd, &texels[stride..][..4]).simd_le(near).select(weight, nothing);
                let c = f32x4::from_slice(simd, &texels[2 * stride..][..4]).simd_le(near).select(weight, nothing);
                let d = f32x4::from_slice(simd, &texels[3 * stride..][..4]).simd_le(near).select(weight, nothing);
                let mut sum = [0.0; 4];
                (a * (1.0 - fy) + b + c + d * fy).store_slice(&mut sum);
                (sum[0] + sum[1]) + (sum[2] + sum[3])
            } else {
                let a = f32x4::from_slice(simd, &texels[..4]).simd_le(near).to_bitmask();
                let b = f32x4::from_slice(simd, &texels[stride..][..4]).simd_le(near).to_bitmask();
                let c = f32x4::from_slice(simd, &texels[2 * stride..][..4]).simd_le(near).to_bitmask();
                ((a & 7) | (b & 7) << 3 | (c & 7) << 6).count_ones() as f32
            };
        }
        let sum = F::<S>::from_slice(simd, &sums[..lanes]);
        sum * (1.0 / 9.0)
    }
}

/// What a depth map shows: maps of equal keys are equal.
#[derive(Clone)]
pub struct Key {
    /// The light's place in the world's list: each place keeps one map.
    slot: usize,
    /// What it sees.
    pub plan: Plan,
    /// What stands there. Meshes are held, so that none can come to lie where another was.
    casters: Vec<(Arc<Mesh>, Affine3A)>,
}

impl Key {
    /// Of the light in that place of the world's list.
    pub fn new(slot: usize, plan: &Plan, bodies: &[Body]) -> Key {
        let casters = bodies.iter().filter(|body| body.casts_shadow);
        Key { slot, plan: plan.clone(), casters: casters.map(|body| (body.mesh.clone(), body.place)).collect() }
    }

    fn equals(&self, other: &Key) -> bool {
        let pairs = || self.casters.iter().zip(&other.casters);
        self.plan == other.plan
            && self.casters.len() == other.casters.len()
            && pairs().all(|(a, b)| Arc::ptr_eq(&a.0, &b.0) && a.1 == b.1)
    }
}

/// A map from an earlier frame.
pub enum Kept {
    /// It shows what is wanted.
    Same(Arc<DepthMap>),
    /// It does not: memory to draw the map of that key into.
    Other(DepthMap, Key),
}

/// The latest map of each light. A map that is the same again is not drawn again: the frame is, either way.
static MAPS: Mutex<Vec<(Key, Arc<DepthMap>)>> = Mutex::new(Vec::new());

/// What there is of an earlier frame for a light.
pub fn recall(key: Key) -> Kept {
    let mut maps = MAPS.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(at) = maps.iter().position(|(kept, _)| kept.slot == key.slot) else {
        return Kept::Other(DepthMap::default(), key);
    };
    if maps[at].0.equals(&key) {
        return Kept::Same(maps[at].1.clone());
    }
    // Another frame may still be looking at it.
    let (_, map) = maps.swap_remove(at);
    Kept::Other(Arc::try_unwrap(map).unwrap_or_default(), key)
}

/// Keeps a map for later frames.
pub fn keep(key: Key, map: DepthMap) -> Arc<DepthMap> {
    let map = Arc::new(map);
    MAPS.lock().unwrap_or_else(PoisonError::into_inner).push((key, map.clone()));
    map
}
