//! Models from formulas and small tables: each function returns its surfaces, the same at every call.

pub mod chapel;
pub mod land;
pub mod mustang;
pub mod tree;

use crate::raster::mesh::Paint;
use crate::texture::{Palette, Pattern, Texture};
use glam::{Mat3, Vec3, vec3};

/// What the paints of the land and all that stands on it are named by, their place in [`PAINTS`].
pub mod paint {
    /// Meadow.
    pub const GRASS: u16 = 0;
    /// Steep slopes and summits.
    pub const ROCK: u16 = 1;
    /// Trunks and rafters.
    pub const BARK: u16 = 2;
    /// Firs; the next two are others.
    pub const FIR: u16 = 3;
    /// Broadleaves; the next two are others.
    pub const LEAF: u16 = 6;
    /// Masonry.
    pub const STONE: u16 = 9;
    /// Tiles.
    pub const ROOF: u16 = 10;
    /// Far summits.
    pub const SNOW: u16 = 11;
    /// Woods too far for trees.
    pub const WOOD: u16 = 12;
    /// The lake.
    pub const WATER: u16 = 13;
}

/// The paints of everything but the aeroplane.
pub const PAINTS: [Paint; 14] = [
    solid(0.115, 0.165, 0.035, 0),
    solid(0.2, 0.185, 0.165, 1),
    solid(0.11, 0.075, 0.05, 2),
    solid(0.03, 0.065, 0.028, 3),
    solid(0.04, 0.075, 0.025, 3),
    solid(0.026, 0.055, 0.034, 3),
    solid(0.1, 0.135, 0.025, 3),
    solid(0.14, 0.125, 0.022, 3),
    solid(0.07, 0.12, 0.03, 3),
    solid(0.36, 0.32, 0.26, 4),
    solid(0.26, 0.1, 0.06, 5),
    Paint { albedo: vec3(0.78, 0.82, 0.88), texture: None },
    solid(0.035, 0.062, 0.022, 3),
    Paint { albedo: vec3(0.02, 0.05, 0.07), texture: None },
];

/// The textures that they name: grass, rock, bark, leaves, masonry, tiles. Each varies about 1.
pub const TEXTURES: [Texture; 6] = [
    clouds(vec3(0.1, 0.35, 0.5), vec3(1.9, 1.65, 1.5), 0.07, 5),
    layers(vec3(0.7, 0.65, 0.65), vec3(1.2, 1.2, 1.15), vec3(0.0, 0.09, 0.0)),
    clouds(vec3(0.3, 0.3, 0.3), vec3(1.7, 1.7, 1.7), 3.0, 3),
    clouds(vec3(0.1, 0.3, 0.4), vec3(1.9, 1.7, 1.6), 0.8, 4),
    clouds(vec3(0.2, 0.2, 0.25), vec3(1.8, 1.8, 1.75), 0.9, 4),
    layers(vec3(0.6, 0.6, 0.6), vec3(1.4, 1.4, 1.4), vec3(0.0, 14.0, 0.0)),
];

const fn solid(red: f32, green: f32, blue: f32, texture: u8) -> Paint {
    Paint { albedo: vec3(red, green, blue), texture: Some(texture) }
}

const fn clouds(dark: Vec3, light: Vec3, scale: f32, octaves: u32) -> Texture {
    Texture::new(Pattern::Clouds { octaves }, Palette::Mix(dark, light), scale)
}

/// Folded layers across `axis`, whose length is radians a metre.
const fn layers(dark: Vec3, light: Vec3, axis: Vec3) -> Texture {
    let Vec3 { x, y, z } = axis;
    let turn = Mat3::from_cols(vec3(x, y, z), vec3(y, z, x), vec3(z, x, y));
    let pattern = Pattern::Marble { warp: 5.0, scale: 6.0, octaves: 3 };
    Texture { pattern, palette: Palette::Mix(dark, light), turn, origin: Vec3::ZERO }
}
