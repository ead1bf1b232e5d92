//! What clouds leave of the sun's light for each other and for the ground.

use super::march::Cloud;
use crate::block::{BLOCK, load, store};
use crate::lanes::{F, V3};
use crate::math::exp2;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec2, Vec3, vec3};

/// A ball that hides what the cloud in a cube hides, halves of the cube's edge.
const RADIUS: f32 = 0.62;

/// The share of the light from the direction `towards` that comes to points.
///
/// Each cloud is a ball whose optical depth falls from its middle to its edge with the square of the distance. It counts
/// as far as it is before a point by half its cube's edge, so no cloud shades itself, and none begins to with a jump.
#[inline(always)]
pub fn passes<S: Simd>(simd: S, clouds: &[Cloud], towards: Vec3, p: V3<S>) -> F<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let mut depth = zero;
    for Cloud { centre, size, extinction, .. } in clouds {
        let way = p.sub1(*centre);
        let along = -way.dot1(towards);
        let across = way.dot(way) - along * along;
        let inside = (one - across * (1.0 / (RADIUS * size * (RADIUS * size)))).max(zero);
        depth += inside * (along * (1.0 / size)).max(zero).min(one) * *extinction;
    }
    exp2(simd, depth * -0.2)
}

/// The shares of `side` x `side` points at height 0, a multiple of 64, that are `texel` metres apart from `corner` on.
#[simd]
pub fn map<S: Simd>(simd: S, clouds: &[Cloud], towards: Vec3, corner: Vec2, texel: f32, side: usize) -> Vec<f32> {
    let mut shares = vec![0.0; side * side];
    let mut x = [0.0; BLOCK];
    for (number, block) in shares.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
        let at = number * BLOCK;
        for (i, x) in x.iter_mut().enumerate() {
            *x = corner.x + (at % side + i) as u32 as f32 * texel;
        }
        let z = corner.y + (at / side) as u32 as f32 * texel;
        for i in 0..BLOCK / F::<S>::LEN {
            let mut p = V3::splat(simd, vec3(0.0, 0.0, z));
            p.x = load(simd, &x, i);
            store(passes(simd, clouds, towards, p), block, i);
        }
    }
    shares
}

/// The share that comes to a cloud's middle.
#[simd]
pub fn share<S: Simd>(simd: S, clouds: &[Cloud], towards: Vec3, p: Vec3) -> f32 {
    passes(simd, clouds, towards, V3::splat(simd, p))[0]
}
