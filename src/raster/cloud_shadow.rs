//! Shadows of clouds on surfaces: a coarse map of the sunlight that is left, which has no edges.
//!
//! The map lies in the plane y = 0; a point looks up the place where its ray from the sun meets that plane. Whoever fills
//! the map knows what casts the shadows. The rasterizer does not.

use crate::simd::lanes::{F, V3};
use crate::simd::math::to_f32;
use fearless_simd::prelude::*;
use glam::Vec2;

/// Sunlight that is left, by where its rays meet the plane y = 0.
#[derive(Clone, Debug)]
pub struct CloudShadow {
    /// Shares of the light, 0 to 1: [`CloudShadow::SIDE`] rows along z, of as many texels along x.
    pub passes: Vec<f32>,
    /// x and z of the first texel, metres.
    pub corner: Vec2,
    /// Distance of neighbouring texels, metres.
    pub texel: f32,
    /// Metres along x and z that a ray to the sun goes per metre that it rises.
    pub slope: Vec2,
}

impl CloudShadow {
    /// Number of texels along an edge of the map.
    pub const SIDE: usize = 128;

    /// The share of the sunlight that reaches points: interpolated between texels; beyond the map, that of its edge.
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, p: V3<S>) -> F<S> {
        let (zero, most) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, to_f32(CloudShadow::SIDE) - 1.01));
        let x = ((p.x - p.y * self.slope.x - self.corner.x) * (1.0 / self.texel)).max(zero).min(most);
        let z = ((p.z - p.y * self.slope.y - self.corner.y) * (1.0 / self.texel)).max(zero).min(most);
        let lanes = F::<S>::LEN;
        let [mut columns, mut rows] = [[0.0; 16]; 2];
        x.store_slice(&mut columns[..lanes]);
        z.store_slice(&mut rows[..lanes]);
        for (x, z) in columns[..lanes].iter_mut().zip(&rows) {
            *x = self.bilinear(*x, *z);
        }
        F::<S>::from_slice(simd, &columns[..lanes])
    }

    /// The map at texel coordinates from 0 up to, but not including, the last texel.
    #[inline(always)]
    fn bilinear(&self, x: f32, z: f32) -> f32 {
        let (column, row) = (x as i32, z as i32);
        let texels = &self.passes[column as usize + row as usize * CloudShadow::SIDE..][..CloudShadow::SIDE + 2];
        let (u, v) = (x - column as f32, z - row as f32);
        let near = texels[0] + (texels[1] - texels[0]) * u;
        let far = texels[CloudShadow::SIDE] + (texels[CloudShadow::SIDE + 1] - texels[CloudShadow::SIDE]) * u;
        near + (far - near) * v
    }
}
