//! What the sun shines through on its way to the surfaces, and has no edges: a coarse map of the light that is left.

use crate::lanes::{F, U, V3};
use fearless_simd::prelude::*;
use glam::Vec2;

/// The light that is left, by where its rays meet the height 0.
#[derive(Clone, Debug)]
pub struct Veil {
    /// Shares, [`Self::SIDE`] in a row along x, rows along z.
    pub passes: Vec<f32>,
    /// x and z of the first, metres.
    pub corner: Vec2,
    /// Metres from one to the next.
    pub texel: f32,
    /// How far a ray goes along x and z while it falls by a metre, against the sign.
    pub slope: Vec2,
}

impl Veil {
    /// Texels along an edge.
    pub const SIDE: usize = 128;

    /// The share that comes to points: between texels it is bilinear, and beyond the edge as there.
    #[inline(always)]
    pub fn at<S: Simd>(&self, simd: S, p: V3<S>) -> F<S> {
        let (zero, most) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, Veil::SIDE as u32 as f32 - 1.01));
        let x = ((p.x - p.y * self.slope.x - self.corner.x) * (1.0 / self.texel)).max(zero).min(most);
        let z = ((p.z - p.y * self.slope.y - self.corner.y) * (1.0 / self.texel)).max(zero).min(most);
        let (column, row) = (x.floor(), z.floor());
        let lanes = F::<S>::LEN;
        let mut at = [0; 16];
        (column + row * Veil::SIDE as u32 as f32).to_int::<U<S>>().store_slice(&mut at[..lanes]);
        let mut corners = [[0.0; 16]; 4];
        for (lane, at) in at[..lanes].iter().enumerate() {
            for (corner, step) in corners.iter_mut().zip([0, 1, Veil::SIDE, Veil::SIDE + 1]) {
                corner[lane] = self.passes[*at as usize + step];
            }
        }
        let [a, b, c, d] = [0, 1, 2, 3].map(
            #[inline(always)]
            |k: usize| F::<S>::from_slice(simd, &corners[k][..lanes]),
        );
        let (x, z) = (x - column, z - row);
        let (near, far) = (a + (b - a) * x, c + (d - c) * x);
        near + (far - near) * z
    }
}
