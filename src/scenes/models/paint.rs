//! The paints of the land and of what stands on it, and their places in [`PAINTS`], by which models name them.

use crate::raster::Paint;
use glam::{Vec3A, vec3a};

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

/// The paints of everything but the aeroplane: an albedo, and the number of the texture that it is multiplied by.
pub static PAINTS: [Paint; 14] = [
    solid(MEADOW, 0),
    solid(Vec3A::ONE, 1),
    solid(vec3a(0.11, 0.075, 0.05), 2),
    solid(vec3a(0.03, 0.065, 0.028), 3),
    solid(vec3a(0.1, 0.135, 0.025), 6),
    solid(vec3a(0.11, 0.075, 0.05), 2),
    solid(vec3a(0.04, 0.075, 0.025), 3),
    solid(vec3a(0.14, 0.125, 0.022), 6),
    solid(vec3a(0.11, 0.075, 0.05), 2),
    solid(vec3a(0.026, 0.055, 0.034), 3),
    solid(vec3a(0.07, 0.12, 0.03), 6),
    solid(vec3a(0.36, 0.32, 0.26), 4),
    solid(vec3a(0.26, 0.1, 0.06), 5),
    Paint { albedo: vec3a(0.02, 0.05, 0.07), texture: Some(7), gloss: 1.0 },
];

/// Grass in summer.
const MEADOW: Vec3A = vec3a(0.115, 0.165, 0.035);

const fn solid(albedo: Vec3A, texture: u8) -> Paint {
    Paint { albedo, texture: Some(texture), gloss: 0.0 }
}
