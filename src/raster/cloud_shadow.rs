//! What the sun shines through on its way to the surfaces, and has no edges: a coarse map of the light that is left.

use crate::simd::lanes::{F, V3};
use fearless_simd::prelude::*;
use glam::Vec2;

/// The light that is left, by where its rays meet the height 0.
#[derive(Clone, Debug)]
pub struct CloudShadow {
    /// Shares, [`Self::SIDE`] in a row along x, rows along z.
    pub passes: Vec<f32>,
    /// x and z of the first, metres.
    pub corner: Vec2,
    /// Metres from one to the next.
    pub texel: f32,
    /// How far a ray goes along x and z while it falls by a metre, against the sign.
    pub slope: Vec2,
}

impl CloudShadow {
    /// Texels along an edge.
    pub const SIDE: usize = 128;

    /// The share that comes to points: between texels it is bilinear, and beyond the edge as there.
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, p: V3<S>) -> F<S> {
        let (zero, most) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, CloudShadow::SIDE as u32 as f32 - 1.01));
        let x = ((p.x - p.y * self.slope.x - self.corner.x) * (1.0 / self.texel)).max(zero).min(most);
        let z = ((p.z - p.y * self.slope.y - self.corner.y) * (1.0 / self.texel)).max(zero).min(most);
        let lanes = F::<S>::LEN;
        let [mut columns, mut rows] = [[0.0; 16]; 2];
        x.store_slice(&mut columns[..lanes]);
        z.store_slice(&mut rows[..lanes]);
        for (x, z) in columns[..lanes].iter_mut().zip(&rows) {
            let (column, row) = (*x as u32, *z as u32);
            let texels = &self.passes[column as usize + row as usize * CloudShadow::SIDE..][..CloudShadow::SIDE + 2];
            let (u, v) = (*x - column as f32, *z - row as f32);
            let near = texels[0] + (texels[1] - texels[0]) * u;
            let far = texels[CloudShadow::SIDE] + (texels[CloudShadow::SIDE + 1] - texels[CloudShadow::SIDE]) * u;
            *x = near + (far - near) * v;
        }
        F::<S>::from_slice(simd, &columns[..lanes])
    }
}
