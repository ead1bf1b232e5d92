//! Models from formulas and small tables: each function returns its surfaces, the same at every call.

pub mod chapel;
pub mod land;
pub mod mustang;
pub mod tree;

use super::script::{Script, VARIABLES, operations};
use crate::hash::rnd;
use crate::raster::form::Body;
use crate::raster::mesh::{Mesh, Paint};
use crate::texture::{Palette, Pattern, Texture};
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
    solid(vec3(0.1, 0.135, 0.025), 3),
    solid(vec3(0.11, 0.075, 0.05), 2),
    solid(vec3(0.04, 0.075, 0.025), 3),
    solid(vec3(0.14, 0.125, 0.022), 3),
    solid(vec3(0.11, 0.075, 0.05), 2),
    solid(vec3(0.026, 0.055, 0.034), 3),
    solid(vec3(0.07, 0.12, 0.03), 3),
    solid(vec3(0.36, 0.32, 0.26), 4),
    solid(vec3(0.26, 0.1, 0.06), 5),
    Paint { albedo: vec3(0.02, 0.05, 0.07), texture: None, gloss: 1.0 },
];

/// Grass in summer.
pub const MEADOW: Vec3 = vec3(0.115, 0.165, 0.035);

/// The textures that they name: grass, heights, bark, needles, masonry, tiles, leaves. All but the second vary about 1.
pub static TEXTURES: [Texture; 7] = [
    clouds(vec3(-0.5, 0.0, 0.2), vec3(2.5, 2.0, 1.8), 0.09, 6),
    // The sine rises from -50 m to 1250 m.
    layers(
        Palette::Ramp([MEADOW, vec3(0.045, 0.075, 0.025), vec3(0.2, 0.185, 0.17), vec3(0.8, 0.83, 0.88)]),
        0.0024,
        2.5,
        0.7,
        600.0,
    ),
    clouds(vec3(0.3, 0.3, 0.3), vec3(1.7, 1.7, 1.7), 3.0, 3),
    clouds(vec3(-0.8, -0.5, -0.2), vec3(2.8, 2.5, 2.2), 1.2, 4),
    clouds(vec3(0.2, 0.2, 0.25), vec3(1.8, 1.8, 1.75), 0.9, 4),
    layers(Palette::Mix(vec3(0.6, 0.6, 0.6), vec3(1.4, 1.4, 1.4)), 14.0, 5.0, 6.0, 0.0),
    clouds(vec3(-0.8, -0.5, -0.2), vec3(2.8, 2.5, 2.2), 1.2, 4),
];

const fn solid(albedo: Vec3, texture: u8) -> Paint {
    Paint { albedo, texture: Some(texture), gloss: 0.0 }
}

const fn clouds(dark: Vec3, light: Vec3, scale: f32, octaves: u32) -> Texture {
    Texture::new(Pattern::Clouds { octaves }, Palette::Mix(dark, light), scale)
}

/// Layers one above the other, `steep` radians a metre, bent by `warp` radians, in the middle of one at `middle` metres.
const fn layers(palette: Palette, steep: f32, warp: f32, scale: f32, middle: f32) -> Texture {
    let turn = Mat3::from_cols(vec3(0.0, steep, 0.0), vec3(steep, 0.0, 0.0), vec3(0.0, 0.0, steep));
    let pattern = Pattern::Marble { warp, scale, octaves: 5 };
    Texture { pattern, palette, turn, origin: vec3(0.0, middle, 0.0) }
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
fn build(mesh: &mut Mesh, script: &mut Script, bodies: &[Body], mut foot: Vec3, unit: f32, seed: u32) {
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
                mesh.body(&bodies[index as usize], &size, at, script.numbers[0] as u16);
            }
            _ => return,
        }
    }
}
