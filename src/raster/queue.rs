//! Fragments that wait to be shaded, by texture, until there are enough for a block.
//!
//! A fragment is the part of one pixel that shows one triangle, whatever the number of its samples. Blocks of one texture
//! keep all lanes busy with the same code.

use super::id::Id;
use super::visible::SubPixel;
use crate::simd::block::{BLOCK, Block3};

/// Where light falls: [`POINTS`], [`LIFTED`] points and [`NORMALS`].
pub type Places = [Block3; 3];
/// Points, metres.
pub const POINTS: usize = 0;
/// The same on the smooth surface that the normals describe, where shadows are looked up: Lambert's cosine falls off with
/// these normals, so faces of a coarse mesh must not lie in their own shadow `[Hanika21]`. A traced point is hidden if both
/// its places are.
pub const LIFTED: usize = 1;
/// Unit normals.
pub const NORMALS: usize = 2;

/// Fragments of one texture, and the surfaces that they show once these are known.
#[derive(Clone)]
pub struct FragmentQueue {
    /// Number of fragments. A block at a time is shaded; the second one has room for the rest of a vector.
    pub count: usize,
    /// For each fragment its pixel, and where in the pixel it is sampled: see [`fragment`].
    pub(super) place: [[u32; BLOCK]; 2],
    /// The triangle that it shows.
    pub(super) id: [[Id; BLOCK]; 2],
    // The rest is filled while a block is shaded. Here, and not on the stack, it need not be cleared.
    /// Where light falls on it.
    pub(super) places: Places,
    /// Diffuse reflectance, linear.
    pub(super) albedo: Block3,
    /// Light on the surface; finally light that reaches the pixel.
    pub(super) light: Block3,
    /// Size of the pixel on the surface, metres.
    pub(super) footprint: [f32; BLOCK],
    /// Share of the sky that is mirrored at grazing incidence.
    pub(super) gloss: [f32; BLOCK],
    /// 1 / distance along the view axis.
    pub(super) inv_depth: [f32; BLOCK],
    /// Share of the pixel that the fragment covers.
    pub(super) weight: [f32; BLOCK],
    /// Where light falls on some of the fragments, and the light there.
    pub(super) some: (Places, Block3),
}

impl FragmentQueue {
    /// A queue without fragments.
    pub const EMPTY: FragmentQueue = FragmentQueue {
        count: 0,
        place: [[0; BLOCK]; 2],
        id: [[0; BLOCK]; 2],
        places: [[[0.0; BLOCK]; 3]; 3],
        albedo: [[0.0; BLOCK]; 3],
        light: [[0.0; BLOCK]; 3],
        footprint: [0.0; BLOCK],
        gloss: [0.0; BLOCK],
        inv_depth: [0.0; BLOCK],
        weight: [0.0; BLOCK],
        some: ([[[0.0; BLOCK]; 3]; 3], [[0.0; BLOCK]; 3]),
    };
}

/// The place of a fragment of pixel 0, to which the pixel's index in the tile is added. It holds, from the lowest bit on,
/// 12 bits for the pixel, 8 bits each for x and y of the point in the pixel where it is sampled, in steps of 1/256, and 4
/// bits for the number of its samples less one. That point is the mean of its samples, whose sum is `sum`.
#[inline(always)]
pub fn fragment(samples: i32, [x, y]: SubPixel) -> u32 {
    // Without a sign, which would be looked at before each division.
    let (samples, x, y) = (samples as u32, x as u32, y as u32);
    (samples - 1) << 28 | (y / samples) << 20 | (x / samples) << 12
}
