//! A sky full of clouds, placed by a hash and carried by the wind.
//!
//! Space over the ground is a lattice of squares that moves with the wind, and the hash of a square's number says
//! whether a cloud is in it, where, how large and of which shape. So a field has no end and no state: the clouds of an
//! instant follow from the time and the eye alone.

use super::voxels::Voxels;
use super::world::Cloud;
use crate::angle;
use crate::simd::hash::rnd;
use crate::simd::math::to_f32;
use glam::{Vec2, Vec3A, vec3a};
use std::sync::Arc;

/// The clouds of one height.
#[derive(Clone, Copy, Debug)]
pub struct CloudField {
    /// The stream of random numbers: fields of different seeds have different clouds.
    pub seed: u32,
    /// Edge of a square, metres: about the distance from a cloud to the next.
    pub spacing: f32,
    /// Share of the squares that hold a cloud, 0 to 1.
    pub share: f32,
    /// Height of the cubes' centres, metres, to which 0.45 of a cube's `size` is added.
    pub height: f32,
    /// Half of the edge of a cube, metres: the least, and the most that chance adds.
    pub size: [f32; 2],
    /// Distance over the ground from the eye at which clouds come out of nothing, metres.
    pub range: f32,
    /// As in [`Cloud`].
    pub extinction: f32,
}

impl CloudField {
    /// How far the wind has carried the field at `time` seconds, metres along x and z.
    ///
    /// The wind grows with the root of the height and comes in gusts: along x it blows at `8 + 2 cos(t / 3)` metres per
    /// second at 500 m, and the drift is the integral of that.
    pub fn drift(&self, time: f32) -> Vec2 {
        let strength = (self.height * 0.002).sqrt();
        Vec2::new(8.0 * time + 6.0 * angle::sin(time / 3.0), 4.0 * time) * strength
    }

    /// The clouds around `eye` at `time` seconds, each of one of `shapes`.
    pub fn around(&self, eye: Vec3A, time: f32, shapes: &[Arc<Voxels>]) -> Vec<Cloud> {
        let mut clouds = Vec::new();
        let drift = self.drift(time);
        let reach = (self.range / self.spacing).ceil() as i32;
        let middle = ((Vec2::new(eye.x, eye.z) - drift) / self.spacing).floor();
        for j in -reach..reach + 1 {
            for i in -reach..reach + 1 {
                let place = [middle.x as i32 + i, middle.y as i32 + j];
                let number = (place[0] & 0x3ff) as u32 | ((place[1] & 0x3ff) as u32) << 10;
                let r = |k: u32| rnd(self.seed, number, k);
                if r(0) >= self.share {
                    continue;
                }
                // Each cloud swells and shrinks in its own time.
                let swell = 1.0 + 0.06 * angle::sin(0.15 * time + 40.0 * r(5));
                let size = (self.size[0] + self.size[1] * r(1) * r(1)) * swell;
                let at = |axis: usize| (place[axis] as f32 + 0.2 + 0.6 * r(2 + axis as u32)) * self.spacing;
                let centre = vec3a(at(0) + drift.x, self.height + 0.45 * size, at(1) + drift.y);
                // By the distance over the ground, so that no cloud comes or goes as the eye climbs.
                let away = Vec2::new(centre.x - eye.x, centre.z - eye.z).length() / self.range;
                let extinction = self.extinction * (5.0 - 5.0 * away).clamp(0.0, 1.0);
                if extinction > 0.0 {
                    let shape = (r(4) * to_f32(shapes.len())) as i32 as usize;
                    clouds.push(Cloud { voxels: shapes[shape].clone(), centre, size, extinction });
                }
            }
        }
        clouds
    }
}
