//! A sky full of clouds, placed by a hash and carried by the wind.

use super::march::Cloud;
use super::voxels::Voxels;
use crate::hash::rnd;
use glam::{Vec2, Vec3, vec3};
use std::sync::Arc;

/// Clouds of one height.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Tells this field's chance from another's.
    pub seed: u32,
    /// Metres from a cloud to the next, about.
    pub spacing: f32,
    /// Share of the places where one is.
    pub share: f32,
    /// Height of the cubes' middles for the smallest, metres, and how much higher the largest are.
    pub height: f32,
    /// Half the edge of a cube, metres: the least, and what chance adds.
    pub size: [f32; 2],
    /// Metres in which clouds come out of nothing.
    pub range: f32,
    /// As in [`Cloud`].
    pub extinction: f32,
}

impl Field {
    /// The clouds around `eye` after the wind has carried all of them by `drift` metres.
    pub fn around(&self, eye: Vec3, drift: Vec2, shapes: &[Arc<Voxels>]) -> Vec<Cloud> {
        let mut clouds = Vec::new();
        let reach = (self.range / self.spacing).ceil() as i32;
        let middle = ((Vec2::new(eye.x, eye.z) - drift) / self.spacing).floor();
        for j in -reach..=reach {
            for i in -reach..=reach {
                let place = [middle.x as i32 + i, middle.y as i32 + j];
                let number = (place[0] & 0x3ff) as u32 | ((place[1] & 0x3ff) as u32) << 10;
                let r = |k: u32| rnd(self.seed, number, k);
                if r(0) >= self.share {
                    continue;
                }
                let size = self.size[0] + self.size[1] * r(1) * r(1);
                let at = |axis: usize| (place[axis] as f32 + 0.2 + 0.6 * r(2 + axis as u32)) * self.spacing;
                let centre = vec3(at(0) + drift.x, self.height + 0.45 * size, at(1) + drift.y);
                // By distance over the ground, so that none comes or goes as the eye climbs.
                let away = Vec2::new(centre.x - eye.x, centre.z - eye.z).length() / self.range;
                let extinction = self.extinction * (5.0 - 5.0 * away).clamp(0.0, 1.0);
                if extinction > 0.0 {
                    let shape = (r(4) * shapes.len() as f32) as usize;
                    clouds.push(Cloud { voxels: shapes[shape].clone(), centre, size, extinction });
                }
            }
        }
        clouds
    }
}
