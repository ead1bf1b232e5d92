//! Shadow depth maps: what a light sees, looked up from what the eye sees.
//!
//! L. Williams, "Casting curved shadows on curved surfaces", 1978; percentage-closer filtering after W. Reeves,
//! D. Salesin, R. Cook, "Rendering antialiased shadows with depth maps", 1987.

use super::Body;
use super::project::Projection;
use crate::cuts::BENCH;
use crate::frame::Tile;
use crate::simd::lanes::{Bits, F, M};
use fearless_simd::f32x4;
use fearless_simd::prelude::*;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
pub struct ShadowViews {
    /// Parallel projections from the finest to the coarsest, or the six faces of a cube, or none for no shadow. Of one
    /// size, square, a multiple of 64 pixels.
    pub views: Vec<Projection>,
    /// Against self-shadowing.
    pub bias: Bias,
    /// Are the faces that look away from the light drawn, instead of those that look at it?
    pub back_faces: bool,
    /// Are shadows traced, without a map? The views then only sort triangles, and the bias is a part of what it says.
    pub traced: bool,
    /// Number of the world's first body that casts them: those before it, such as the land, do not.
    pub from: usize,
    /// Are the borders of the 3x3 texels weighted by how much of them is met? Else each counts alike,
    /// which a build without the bench scenes leaves out.
    pub smooth: bool,
}

/// Nearness of nothing, -1.7e38: any light passes. Its bytes are all the same, so that a map is cleared by one call.
pub const NOTHING: f32 = f32::from_bits(0xfefe_fefe);
/// Texels after the last row, and one row after the last view, which lookups of whole vectors read and leave out.
const SLACK: usize = 4;

/// The depths of a plan's views.
#[derive(Default)]
pub struct DepthMap {
    /// Texels along an edge: a multiple of a tile's size.
    pub size: usize,
    /// Nearness, view by view, row by row.
    texels: Vec<f32>,
}

impl DepthMap {
    /// Makes room for that many views; what was there may stay. Panics where `size` is no multiple of a tile's.
    pub fn resize(&mut self, size: usize, views: usize) {
        assert!(size.is_multiple_of(Tile::SIZE));
        self.size = size;
        let texels = (views * size + 1) * size + SLACK;
        if self.texels.len() != texels {
            self.texels = vec![0.0; texels];
        }
    }

    /// All views cut into rows of tiles, one view after the other.
    pub fn bands(&mut self) -> impl Iterator<Item = &mut [f32]> {
        // The row after the last view is less than a chunk.
        self.texels.chunks_exact_mut((self.size * Tile::SIZE).max(1))
    }

    /// Nearness at a texel of a view.
    pub fn at(&self, view: usize, x: usize, y: usize) -> f32 {
        self.texels[(view * self.size + y) * self.size + x]
    }

    /// Share of the light, 0 to 1, at texel coordinates (`x`, `y`) of each lane's `view`, for points of that nearness: of
    /// the 3x3 texels around, those that hide nothing. Along the border and beyond, the nearest 3x3 within.
    ///
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
        let (size, lanes) = (self.size, F::<S>::LEN);
        // Smooth, the 3x3 texels are a window that meets 4x4.
        let smooth = smooth || !BENCH;
        let shift = if smooth { 1.5 } else { 1.0 };
        let end = (size - 3) as u32 as f32;
        let zero = F::<S>::splat(simd, 0.0);
        let (x, y) = ((x - shift).max(zero).min(end), (y - shift).max(zero).min(end));
        let (column, row) = (x.floor(), y.floor());
        let line = (view * size as u32 as f32 + row).to_int::<S::i32s>();
        let first = line * size as i32 + column.to_int::<S::i32s>();
        // What is not a number may be anywhere.
        let beyond = self.texels.len() - (3 * size + SLACK);
        let first = first.bitcast::<S::u32s>().min(S::u32s::splat(simd, beyond as u32));
        let (mut places, mut nears, mut sums) = ([0u32; 16], [0f32; 16], [0f32; 16]);
        let (mut fx, mut fy) = ([0f32; 16], [0f32; 16]);
        first.store_slice(&mut places[..lanes]);
        near.store_slice(&mut nears[..lanes]);
        (x - column).store_slice(&mut fx[..lanes]);
        (y - row).store_slice(&mut fy[..lanes]);
        for lane in Bits(wanted.to_bitmask()) {
            let lane = lane & 15;
            let near = f32x4::splat(simd, nears[lane]);
            let texels = &self.texels[places[lane] as usize..][..3 * size + SLACK];
            sums[lane] = if smooth {
                let weight = f32x4::from_slice(simd, &[1.0 - fx[lane], 1.0, 1.0, fx[lane]]);
                let mut sum = f32x4::splat(simd, 0.0);
                let mut k = 0;
                while k < 4 {
                    let row = f32x4::from_slice(simd, &texels[k * size..][..4]);
                    let share = [1.0 - fy[lane], 1.0, 1.0, fy[lane]][k];
                    sum += row.simd_le(near).select(weight * share, f32x4::splat(simd, 0.0));
                    k += 1;
                }
                let mut four = [0.0; 4];
                sum.store_slice(&mut four);
                (four[0] + four[1]) + (four[2] + four[3])
            } else {
                let a = f32x4::from_slice(simd, &texels[..4]).simd_le(near).to_bitmask();
                let b = f32x4::from_slice(simd, &texels[size..][..4]).simd_le(near).to_bitmask();
                let c = f32x4::from_slice(simd, &texels[2 * size..][..4]).simd_le(near).to_bitmask();
                ((a & 7) | (b & 7) << 3 | (c & 7) << 6).count_ones() as f32
            };
        }
        F::<S>::from_slice(simd, &sums[..lanes]) * (1.0 / 9.0)
    }
}

/// What a depth map shows: maps of equal keys are equal.
#[derive(PartialEq)]
pub struct Key {
    /// The light's place in the world's list: each place keeps one map.
    pub slot: usize,
    /// As in its [`ShadowViews`].
    pub views: Vec<Projection>,
    /// As in its [`ShadowViews`].
    pub back_faces: bool,
    /// What stands there. Bodies hold their meshes, so that none can come to lie where another was.
    pub casters: Vec<Body>,
}

/// The latest map of each light. A map that is the same again is not drawn again: the frame is, either way.
static MAPS: Mutex<Vec<(Key, Arc<DepthMap>)>> = Mutex::new(Vec::new());

/// The maps that are kept. Who alters a key has its map drawn again.
pub fn maps() -> MutexGuard<'static, Vec<(Key, Arc<DepthMap>)>> {
    MAPS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The map of that key from an earlier frame; or else memory to draw it into.
pub fn recall(key: &Key) -> Result<Arc<DepthMap>, DepthMap> {
    let mut maps = maps();
    let Some(at) = maps.iter().position(|(kept, _)| kept.slot == key.slot) else { return Err(DepthMap::default()) };
    if maps[at].0 == *key {
        return Ok(maps[at].1.clone());
    }
    // Another frame may still be looking at it.
    Err(Arc::try_unwrap(maps.swap_remove(at).1).unwrap_or_default())
}

/// Keeps a map for later frames.
pub fn keep(key: Key, map: DepthMap) -> Arc<DepthMap> {
    let map = Arc::new(map);
    maps().push((key, map.clone()));
    map
}
