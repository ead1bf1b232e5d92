//! The shadows of clouds: what they leave of the sun's light for each other and for the ground.
//!
//! For its shadow a cloud is approximated by a ball whose optical depth falls from the centre to the edge with the
//! square of the distance. Shadows of clouds are soft and far away, so neither the shape nor the voxels matter; there
//! is no reference for them.

use super::world::Cloud;
use crate::simd::lanes::{F, V3};
use crate::simd::level;
use crate::simd::math::exp2;
use fearless_simd::{dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::Vec3A;

/// Radius of the ball that casts a cloud's shadow, halves of the cube's edge.
const RADIUS: f32 = 0.62;

/// The shares of the light from the direction of the unit vector `towards` that reach points.
///
/// A cloud counts fully where it is nearer to the sun than a point by half of its cube's edge or more, and less and
/// less down to 0. So no cloud shades itself, and none begins to with a jump.
#[inline(never)] // Called from several places and never in a loop; inlined, its dispatch would be there as often.
pub fn shares(clouds: &[Cloud], towards: Vec3A, points: &[Vec3A]) -> Vec<f32> {
    dispatch!(level::best(), simd => shares_in(simd, clouds, towards, points))
}

#[simd]
fn shares_in<S: Simd>(simd: S, clouds: &[Cloud], towards: Vec3A, points: &[Vec3A]) -> Vec<f32> {
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
