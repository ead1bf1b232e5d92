//! A triangle on a raster: edge functions, and planes of what is interpolated over it.

use super::mesh::Paint;
use glam::Vec4;

/// Steps per pixel of the grid that corners are snapped to, along x and along y.
pub const SUB: i32 = 256;

/// A triangle that faces the eye, on the raster.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// The edge functions `a x + b y + c` as (a, b, c), not negative inside, of coordinates in steps of 1 / [`SUB`] pixel.
    pub edges: [(i32, i32, i64); 3],
    /// The pixels that may have a sample inside: first and last column, first and last row, all inclusive.
    pub bound: [i32; 4],
    /// The point where the planes have the value [`Triangle::at`], pixels.
    pub anchor: [f32; 2],
    /// At the anchor, the components of the normal in the world over w, and `inv_depth`. The normal is 0 where nothing
    /// is shaded.
    pub at: Vec4,
    /// The change of [`Triangle::at`] per pixel along x and along y.
    pub by: [Vec4; 2],
    /// `inv_depth` of the farthest and of the nearest corner. The plane is clamped to it, since on slivers it leaves it.
    pub range: [f32; 2],
    /// How far the smooth surface that the normals describe lies above its face in the mean, metres: 0 or more, and 0
    /// where nothing is shaded or the face is flat.
    pub bulge: f32,
    /// What the triangle is painted with.
    pub paint: Paint,
    /// The number of its face in the mesh; 0 in the 64 kB build, where nothing asks for it.
    pub face: u32,
}

impl Triangle {
    /// `inv_depth` at a point of the raster, pixels.
    pub fn inv_depth(&self, x: f32, y: f32) -> f32 {
        let inv_depth = self.at.w + self.by[0].w * (x - self.anchor[0]) + self.by[1].w * (y - self.anchor[1]);
        inv_depth.clamp(self.range[0], self.range[1])
    }
}
