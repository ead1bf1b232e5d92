//! What clouds leave of the sun's light for each other and for the ground.

use super::march::Cloud;
use crate::simd::lanes::{F, V3};
use crate::simd::level;
use crate::simd::math::exp2;
use fearless_simd::{dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3;

/// A ball that hides what the cloud in a cube hides, halves of the cube's edge.
const RADIUS: f32 = 0.62;

/// The shares of the light from the direction `towards` that come to points.
///
/// Each cloud is a ball whose optical depth falls from its middle to its edge with the square of the distance. It counts
/// as far as it is before a point by half its cube's edge, so no cloud shades itself, and none begins to with a jump.
#[inline(never)]
pub fn shares(clouds: &[Cloud], towards: Vec3, points: &[Vec3]) -> Vec<f32> {
    dispatch!(level::best(), simd => shares_in(simd, clouds, towards, points))
}

#[simd]
fn shares_in<S: Simd>(simd: S, clouds: &[Cloud], towards: Vec3, points: &[Vec3]) -> Vec<f32> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let lanes = F::<S>::LEN;
    let mut shares = vec![0.0; points.len()];
    for (points, shares) in points.chunks(lanes).zip(shares.chunks_mut(lanes)) {
        let mut axes = [[0.0; 16]; 3];
        for (lane, point) in points.iter().enumerate() {
            [axes[0][lane], axes[1][lane], axes[2][lane]] = point.to_array();
        }
        let lane = |axis: usize| F::<S>::from_slice(simd, &axes[axis][..lanes]);
        let p = V3::<S> { x: lane(0), y: lane(1), z: lane(2) };
        let mut depth = zero;
        for Cloud { centre, size, extinction, .. } in clouds {
            let way = p.sub1(*centre);
            let along = -way.dot1(towards);
            let across = way.dot(way) - along * along;
            let inside = (one - across * (1.0 / (RADIUS * size * (RADIUS * size)))).max(zero);
            depth += inside * (along * (1.0 / size)).max(zero).min(one) * *extinction;
        }
        exp2(simd, depth * -0.2).store_slice(&mut axes[0][..lanes]);
        shares.copy_from_slice(&axes[0][..shares.len()]);
    }
    shares
}
