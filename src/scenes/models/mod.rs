//! Models from formulas and small tables: each function returns its surfaces, the same at every call.

pub mod chapel;
pub mod land;
pub mod mustang;
pub mod tree;

use super::script::{Script, VARIABLES, operations};
use crate::raster::form::Rings;
use crate::raster::{Mesh, Paint};
use crate::simd::hash::rnd;
use glam::{Mat3, Vec3, vec3};

/// What the paints of the land and all that stands on it are named by, their place in [`PAINTS`].
pub mod paint {
    /// Meadow.
    pub const GRASS: u16 = 0;
    /// The land farther away: meadows, woods, rock and snow by height.
    pub const HEIGHTS: u16 = 1;
    /// Trunks and rafters; then two others, each with its fir and its broadleaf.
    pub const BARK: u16 = 2;
    /// Masonry.
    pub const STONE: u16 = 11;
    /// Tiles.
    pub const ROOF: u16 = 12;
    /// The lake.
    pub const WATER: u16 = 13;
}

/// The paints of everything but the aeroplane.
pub static PAINTS: [Paint; 14] = [
    solid(MEADOW, 0),
    solid(Vec3::ONE, 1),
    solid(vec3(0.11, 0.075, 0.05), 2),
    solid(vec3(0.03, 0.065, 0.028), 3),
    solid(vec3(0.1, 0.135, 0.025), 6),
    solid(vec3(0.11, 0.075, 0.05), 2),
    solid(vec3(0.04, 0.075, 0.025), 3),
    solid(vec3(0.14, 0.125, 0.022), 6),
    solid(vec3(0.11, 0.075, 0.05), 2),
    solid(vec3(0.026, 0.055, 0.034), 3),
    solid(vec3(0.07, 0.12, 0.03), 6),
    solid(vec3(0.36, 0.32, 0.26), 4),
    solid(vec3(0.26, 0.1, 0.06), 5),
    Paint { albedo: vec3(0.02, 0.05, 0.07), texture: None, gloss: 1.0 },
];

/// Grass in summer.
const MEADOW: Vec3 = vec3(0.115, 0.165, 0.035);

const fn solid(albedo: Vec3, texture: u8) -> Paint {
    Paint { albedo, texture: Some(texture), gloss: 0.0 }
}

operations! {
    /// Columns of a matrix that the next bodies are multiplied by.
    TURN = 40;
    /// Or they are turned around x, then y, by two angles, y first, and moved along what is z then.
    ROTATE = 41;
    /// Their foot is on the ground where they have moved to.
    GROUND = 42;
    /// Variable 4 becomes a random number of a number.
    RANDOM = 43;
    /// A body in the paint of variable 0: where, units; how large, tenths of units; its index.
    BODY = 44;
    /// The last word.
    END = 45;
}

/// Stream of random numbers.
const STREAM: u32 = 5;

/// Adds what a script builds of `bodies` on a `foot`: `unit` metres are its unit, `seed` is what its random numbers come
/// from.
#[inline(never)]
fn build(mesh: &mut Mesh, script: &mut Script, bodies: &[Rings], mut foot: Vec3, unit: f32, seed: u32) {
    let (mut turn, mut out) = (Mat3::IDENTITY, Vec3::ZERO);
    loop {
        let operation = script.next();
        let n: &[f32; 9] = script.numbers[VARIABLES..].first_chunk().unwrap();
        match operation {
            byte::TURN => turn = Mat3::from_cols_array(n),
            byte::ROTATE => {
                turn = Mat3::from_rotation_y(n[0]) * Mat3::from_rotation_x(n[1]);
                out = turn.z_axis * n[2];
            }
            byte::GROUND => foot.y = land::height(out.x, out.z),
            byte::RANDOM => script.numbers[4] = rnd(STREAM, seed, n[0] as u32),
            byte::BODY => {
                let [x, y, z, a, b, c, index, ..] = *n;
                let size = turn * Mat3::from_diagonal(vec3(a, b, c) * (0.1 * unit));
                let at = foot + (vec3(x, y, z) + out) * unit;
                mesh.rings(&bodies[index as usize], &size, at, script.numbers[0] as u16);
            }
            _ => return,
        }
    }
}
