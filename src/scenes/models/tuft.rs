//! Tufts of grass on the hill, where the eye comes close to the ground.

use super::build::STREAM;
use super::land::height;
use super::paint::{GRASS, PAINTS};
use crate::angle;
use crate::raster::Mesh;
use crate::raster::form::Rings;
use crate::simd::hash::rnd;
use glam::{Vec3, vec3};
use std::f32::consts::TAU;

/// A blade of unit height: a triangle with two sides.
const BLADE: Rings =
    Rings { rows: &[[0, 0, 4, 0, 0], [100, 0, 0, 0, 0]], sides: 2, half: false, swell: 0.0, taper: 0.0 };

/// Patches along each axis, and the width of one, metres.
const PATCHES: u32 = 9;
const WIDTH: f32 = 18.0;
/// The number of patches.
pub const COUNT: u32 = PATCHES * PATCHES;
/// Tufts of a patch, and blades of a tuft.
const TUFTS: u32 = 40;
const BLADES: u32 = 5;

/// The tufts in square patches around the middle, which are culled one by one.
pub fn tufts() -> Vec<Mesh> {
    let mut patches = Vec::new();
    for patch in 0..COUNT {
        let mut mesh = Mesh::painted(&PAINTS);
        for tuft in patch * TUFTS..(patch + 1) * TUFTS {
            let place = |cell: u32, k| (cell as f32 - 0.5 * PATCHES as f32 + rnd(STREAM, tuft, k)) * WIDTH;
            let (x, z) = (place(patch % PATCHES, 5), place(patch / PATCHES, 6));
            let foot = vec3(x, height(x, z), z);
            for blade in 0..BLADES {
                let chance = rnd(STREAM, tuft * BLADES + blade, 7);
                let turn = angle::turn_y(TAU * chance) * angle::turn_x(chance);
                mesh.rings(&BLADE, &(turn * (0.006 - 0.003 * chance)), foot, GRASS);
                // Nearly as bright as the ground, and steep enough to stay out of the snow.
                mesh.normals.resize(mesh.points.len(), turn.z_axis + Vec3::Y * 0.7);
            }
        }
        patches.push(mesh);
    }
    patches
}
