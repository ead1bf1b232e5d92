//! Rays through the voxels of one cloud, a vector of rays at a time.

use super::voxels::Voxels;
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;
use std::f32::consts::LOG2_E;
use std::sync::Arc;

/// A cube of voxels in the world.
#[derive(Clone)]
pub struct Cloud {
    /// Density and light.
    pub voxels: Arc<Voxels>,
    /// The cube's middle, metres.
    pub centre: Vec3,
    /// Half of the cube's edge, metres.
    pub size: f32,
    /// Extinction of the greatest density, per half of the cube's edge.
    pub extinction: f32,
}

/// What lights a cloud. Colours are linear light.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Light from everywhere, at the cube's bottom and at its top.
    pub ambient: [Vec3; 2],
    /// Unit direction to the sun.
    pub towards: Vec3,
    /// The sun's light.
    pub sun: Vec3,
    /// Shares of it that are scattered everywhere, and most of it forwards: by the sixth power of the cosine.
    pub phase: [f32; 2],
}

/// What rays meet in a cloud, apart from its light's colours.
pub struct Passage<S: Simd> {
    /// The share that is hidden; of that what is lit from above, as the height in the cube has it; and by the sun, of 255.
    pub light: F<S>,
    /// See there.
    pub upper: F<S>,
    /// See there.
    pub lit: F<S>,
    /// The share that comes through.
    pub transmittance: F<S>,
}

impl<S: Simd> Passage<S> {
    /// Premultiplied light towards where rays along unit directions `d` come from, and the transmittance.
    #[inline(always)]
    pub fn shine(self, simd: S, look: &Look, d: V3<S>) -> (V3<S>, F<S>) {
        let [low, high] = look.ambient;
        let c = d.dot1(look.towards).max(0.0);
        let c2 = c * c;
        let phase = c2 * c2 * c2 * look.phase[1] + look.phase[0];
        let color = V3::splat(simd, low) * Lane(self.light)
            + V3::splat(simd, high - low) * Lane(self.upper)
            + V3::splat(simd, look.sun * (1.0 / 255.0)) * Lane(self.lit * phase);
        (color, self.transmittance)
    }
}

/// What rays from `eye` along unit directions `d` meet of a cloud, nothing beyond `limit` metres. The way through the cube
/// is cut into `steps`, whose middles stand for them, as far as more than `opaque` comes through.
///
/// Beer and Lambert: `1 - exp(-extinction density length)` of a step is what it hides.
#[simd]
pub fn march<S: Simd>(
    simd: S,
    cloud: &Cloud,
    eye: Vec3,
    d: V3<S>,
    limit: F<S>,
    [steps, opaque]: [f32; 2],
) -> Passage<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let q = (eye - cloud.centre) / cloud.size;
    let [x0, x1] = slab(simd, q.x, d.x);
    let [y0, y1] = slab(simd, q.y, d.y);
    let [z0, z1] = slab(simd, q.z, d.z);
    let entry = x0.max(y0).max(z0).max(zero);
    let exit = x1.min(y1).min(z1).min(limit * (1.0 / cloud.size));
    let (mut light, mut height, mut lit, mut depth, mut transmittance) = (zero, zero, zero, zero, one);
    let length = (exit - entry) * (1.0 / steps);
    let missed = length.simd_le(zero);
    if missed.all_true() {
        return Passage { light: zero, upper: zero, lit: zero, transmittance: one };
    }
    let mut step = missed.select(F::<S>::splat(simd, steps), zero);
    let most = (cloud.voxels.edge() - 1) as u32 as f32;
    let half = cloud.voxels.edge() as u32 as f32 * 0.5;
    // Voxels that one step crosses at most, along an axis.
    let stride = length * half * d.x.abs().max(d.y.abs()).max(d.z.abs());
    let reach = one / missed.select(one, stride);
    let thickness = length * (-cloud.extinction * LOG2_E / 255.0);
    while step.simd_lt(steps).any_true() {
        let way = missed.select(zero, entry + (step + 0.5) * length);
        let p = d * Lane(way);
        let voxel = |p: F<S>, q: f32| ((p + q) * half + (half - 0.5)).max(0.0).min(most);
        let u = V3 { x: voxel(p.x, q.x), y: voxel(p.y, q.y), z: voxel(p.z, q.z) };
        let leap = cloud.voxels.leap(simd, u);
        if leap.simd_eq(zero).any_true() {
            let [density, sunlit] = cloud.voxels.look_up(simd, u);
            // From the depth so far, since 1 - exp(-x) of a thin step would be all rounding.
            depth += step.simd_lt(steps).select(density * thickness, zero);
            let passes = math::exp2(simd, depth);
            let hides = transmittance - passes;
            light += hides;
            height += hides * p.y;
            lit += hides * sunlit;
            transmittance = passes;
        }
        step += (leap * reach).floor().max(one);
        step = transmittance.simd_lt(opaque).select(F::<S>::splat(simd, steps), step);
    }
    let upper = (height + light * q.y) * 0.5 + light * 0.5;
    Passage { light, upper, lit, transmittance }
}

/// Where rays enter and leave the space between -1 and 1 along an axis.
#[inline(always)]
fn slab<S: Simd>(simd: S, q: f32, d: F<S>) -> [F<S>; 2] {
    // What runs along the slab is in it or is not; a ray on the very face would be 0 / 0, or 0 times infinity.
    let least = F::<S>::splat(simd, 1e-20);
    let inverse = F::<S>::splat(simd, 1.0) / d.abs().simd_lt(least).select(least, d);
    let (a, b) = (inverse * (-1.0 - q), inverse * (1.0 - q));
    [a.min(b), a.max(b)]
}
