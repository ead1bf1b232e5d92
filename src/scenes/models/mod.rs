//! Models from formulas and small tables. Each function returns its meshes, the same at every call.
//!
//! | module | what it is | made of |
//! |---|---|---|
//! | [`land`] | a valley with a lake, mountains around it | a height field of noise on rings around the middle |
//! | [`tree`] | firs and broadleaves, and where they stand | bodies of rings, moved by noise |
//! | [`chapel`] | half a ruin on the hill | boxes, a gable, a spire, pillars |
//! | [`mustang`] | a P-51D | cross sections along fuselage, wing and tail, mirrored |
//!
//! A body is a stack of rings ([`Body`](crate::raster::form::Body)); how bodies are put together is written as a
//! [script](super::script), which [`build`] runs.

pub mod chapel;
pub mod land;
pub mod mustang;
pub mod tree;

use super::script::{Script, VARIABLES, Word, operations, variable};
use crate::raster::form::Body;
use crate::raster::mesh::{Mesh, Paint};
use crate::simd::hash::rnd;
use glam::{Mat3, Vec3, vec3};

/// The places in [`PAINTS`] of the paints that models name.
pub mod paint {
    /// Meadow.
    pub const GRASS: u16 = 0;
    /// The land farther away: meadows, woods, rock and snow by height.
    pub const HEIGHTS: u16 = 1;
    /// The first of three shades of bark, for trunks and rafters. Each is followed by its fir's and its broadleaf's green.
    pub const BARK: u16 = 2;
    /// Masonry.
    pub const STONE: u16 = 11;
    /// Tiles.
    pub const ROOF: u16 = 12;
    /// The lake.
    pub const WATER: u16 = 13;
}

/// The paints of everything but the aeroplane: an albedo, and the number of the texture that it is multiplied by.
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
    /// The columns of a matrix that turns and scales the next bodies.
    turn = 40;
    /// `rotate(y, x, out)`: instead, the next bodies are turned around x and then around y, and stand `out` units away along
    /// their own z axis.
    rotate = 41;
    /// The foot of the next bodies is on the ground where they stand.
    ground = 42;
    /// `random(number)`: [`CHANCE`] becomes that random number of the model, from 0 to 1.
    random = 43;
    /// `body(x, y, z, a, b, c, index)`: a body in the paint [`PAINT`], at a place in units, scaled along its axes by tenths of
    /// a unit.
    body = 44;
    /// The last operation.
    end = 45;
}

/// The number of the paint of the next bodies.
const PAINT: Word = variable(0);
/// The last random number.
const CHANCE: Word = variable(4);
const CHANCE_AT: usize = 4;

/// The stream of random numbers that models draw from.
const STREAM: u32 = 5;

/// Adds to a mesh what a script builds of `bodies` on a `foot`, metres. A unit of the script is `unit` metres; random numbers
/// are those of `seed`.
#[inline(never)]
fn build(mesh: &mut Mesh, script: &mut Script, bodies: &[Body], mut foot: Vec3, unit: f32, seed: u32) {
    let (mut turn, mut out) = (Mat3::IDENTITY, Vec3::ZERO);
    loop {
        let operation = script.next();
        let n: &[f32; 9] = script.numbers[VARIABLES..].first_chunk().unwrap();
        match operation {
            op::turn => turn = Mat3::from_cols_array(n),
            op::rotate => {
                turn = Mat3::from_rotation_y(n[0]) * Mat3::from_rotation_x(n[1]);
                out = turn.z_axis * n[2];
            }
            op::ground => foot.y = land::height(out.x, out.z),
            op::random => script.numbers[CHANCE_AT] = rnd(STREAM, seed, n[0] as u32),
            op::body => {
                let [x, y, z, a, b, c, index, ..] = *n;
                let size = turn * Mat3::from_diagonal(vec3(a, b, c) * (0.1 * unit));
                let at = foot + (vec3(x, y, z) + out) * unit;
                mesh.body(&bodies[index as usize], &size, at, script.numbers[0] as u16);
            }
            _ => return,
        }
    }
}
