//! Tufts of grass on the hill, where the eye comes close to the ground.

use super::build::STREAM;
use super::land::height;
use super::paint::{GRASS, PAINTS};
use crate::angle;
use crate::raster::form::Rings;
use crate::raster::{Body, Mesh};
use crate::simd::hash::rnd;
use glam::{Affine3A, Vec2, Vec3, Vec3A, Vec3Swizzles as _, uvec2, vec2, vec3a};
use std::f32::consts::TAU;

/// A blade of unit height: a triangle with two sides.
const BLADE: Rings =
    Rings { rows: &[[0, 0, 4, 0, 0], [100, 0, 0, 0, 0]], sides: 2, half: false, swell: 0.0, taper: 0.0 };

/// Patches along each axis, and the width of one, metres.
const PATCHES: u32 = 13;
const WIDTH: f32 = 12.0;
/// The number of patches.
pub const COUNT: usize = (PATCHES * PATCHES) as usize;
/// Tufts of a patch, and blades of a tuft.
const TUFTS: u32 = 26;
const BLADES: u32 = 5;

/// A place in a patch, metres; its middle is at 1/2.
fn place(patch: u32, x: f32, z: f32) -> Vec2 {
    (uvec2(patch % PATCHES, patch / PATCHES).as_vec2() + vec2(x, z) - 0.5 * PATCHES as f32) * WIDTH
}

/// The tufts in square patches around the middle.
pub fn tufts() -> Vec<Mesh> {
    let mut patches = Vec::new();
    for patch in 0..COUNT as u32 {
        let mut mesh = Mesh::painted(&PAINTS);
        for tuft in patch * TUFTS..(patch + 1) * TUFTS {
            let Vec2 { x, y: z } = place(patch, rnd(STREAM, tuft, 5), rnd(STREAM, tuft, 6));
            let foot = vec3a(x, height(x, z), z);
            for blade in 0..BLADES {
                let chance = rnd(STREAM, tuft * BLADES + blade, 7);
                let turn = angle::turn_y(TAU * chance) * angle::turn_x(chance);
                mesh.rings(&BLADE, &(turn * (0.006 - 0.003 * chance)), foot, GRASS);
                // Nearly as bright as the ground, and steep enough to stay out of the snow.
                mesh.normals.resize(mesh.points.len(), turn.z_axis + Vec3A::Y * 0.7);
            }
        }
        patches.push(mesh);
    }
    patches
}

/// Lets patches sink into the ground with their distance from the eye, by a metre at 25 m: from there on blades would be
/// finer than pixels, which four samples show as noise. The farther ones sink out of sight, where they cost nothing.
pub fn sink(patches: &mut [Body], eye: Vec3A) {
    for (patch, body) in patches[..COUNT].iter_mut().enumerate() {
        let near = place(patch as u32, 0.5, 0.5).distance_squared(eye.xz()) * (1.0 / 650.0);
        body.put(Affine3A::from_translation(Vec3::Y * -(near * near * (near * near))));
    }
}
