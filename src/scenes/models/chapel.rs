//! A chapel on the hill, half a ruin: an open arcade, rafters without tiles, a bell tower, broken walls.

use super::land::height;
use super::{PAINTS, paint};
use crate::raster::form::{Body, SQUARE};
use crate::raster::mesh::Mesh;
use glam::{Mat3, Vec3, vec3};
use std::f32::consts::PI;

/// Masonry, in decimetres: which of [`BODIES`], where its middle is, and its half size, or for other bodies its scale.
#[rustfmt::skip]
static PIECES: [[i8; 7]; 34] = [
    // The west wall: sill, four piers, what is left of the lintel.
    [0, -35, 5, 0, 4, 15, 60],
    [0, -35, 30, -54, 4, 15, 6],
    [0, -35, 30, -20, 4, 15, 9],
    [0, -35, 30, 16, 4, 15, 9],
    [0, -35, 30, 52, 4, 15, 8],
    [0, -35, 44, 20, 4, 4, 40],
    // Over the arcade.
    [0, 35, 39, 0, 4, 3, 60],
    [0, 35, 31, -56, 3, 10, 4],
    [0, 35, 31, -19, 3, 10, 4],
    [0, 35, 31, 18, 3, 10, 4],
    [0, 35, 31, 55, 3, 10, 4],
    // The south front beside and above the door.
    [0, -22, 16, 58, 13, 26, 4],
    [0, 22, 16, 58, 13, 26, 4],
    [0, 0, 37, 58, 35, 7, 4],
    // The north front, broken.
    [0, -24, 18, -58, 15, 34, 4],
    [0, 24, 8, -58, 15, 20, 4],
    [0, 30, 24, -58, 9, 10, 4],
    // The tower: its foot, four piers.
    [0, -52, 30, 46, 18, 40, 18],
    [0, -65, 80, 33, 5, 12, 5],
    [0, -39, 80, 33, 5, 12, 5],
    [0, -65, 80, 59, 5, 12, 5],
    [0, -39, 80, 59, 5, 12, 5],
    [0, -52, 94, 46, 19, 2, 19],
    // Steps, a stone table, blocks that fell.
    [0, 0, -1, 66, 14, 3, 5],
    [0, 0, 4, -40, 12, 6, 6],
    [0, 48, 2, -52, 5, 4, 7],
    [0, 58, 1, -30, 6, 4, 4],
    [0, 44, 2, -76, 4, 3, 6],
    // The south gable, the spire, the pillars of the arcade.
    [1, 0, 44, 58, 10, 10, 10],
    [2, -52, 96, 46, 10, 10, 10],
    [3, 35, 0, -56, 10, 10, 10],
    [3, 35, 0, -19, 10, 10, 10],
    [3, 35, 0, 18, 10, 10, 10],
    [3, 35, 0, 55, 10, 10, 10],
];

const fn square(rows: &'static [[i8; 5]]) -> Body {
    Body { rows, sides: 4, half: false, swell: SQUARE, taper: 0.0 }
}

/// A block of one metre each way, a gable, the spire, a pillar; the spire has other paint.
static BODIES: [Body; 4] = [
    square(&[[-10, 10, 0, 10, 0], [-10, 0, 10, 10, 0], [10, 0, 10, 10, 0], [10, 10, 0, 10, 0]]),
    square(&[[0, 4, 0, 35, 0], [0, 0, 4, 35, 0], [32, 0, 4, 1, 0], [32, 4, 0, 1, 0]]),
    square(&[[0, 21, 0, 21, 0x11], [0, 0, 21, 21, 0x11], [31, 0, 0, 0, 0]]),
    Body {
        rows: &[[-10, 0, 4, 4, 0], [2, 0, 4, 4, 0], [3, 0, 3, 3, 0], [18, 0, 3, 3, 0], [21, 0, 5, 5, 0]],
        sides: 8,
        half: false,
        swell: 0.0,
        taper: 0.0,
    },
];

/// The chapel, where it stands: flat.
pub fn chapel() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    let foot = Vec3::Y * height(0.0, 0.0);
    for piece in &PIECES {
        let [_, x, y, z, a, b, c] = piece.map(|i| i as f32);
        let scale = Mat3::from_diagonal(vec3(a, b, c) * 0.01);
        mesh.body(&BODIES[piece[0] as usize], &scale, foot + vec3(x, y, z) * 0.1, paint::STONE);
    }
    // Four round arches of five stones: the arcade's, and that of the door.
    for i in 0..20u32 {
        let k = (i / 5) as f32;
        let (middle, radius, along) = if i < 15 {
            (vec3(3.5, 2.1, 3.7 * k - 3.75), 1.48, Vec3::NEG_Z)
        } else {
            (vec3(0.0, 2.1, 5.8), 0.92, Vec3::X)
        };
        let (sin, cos) = (PI / 5.0 * ((i % 5) as f32 + 0.5)).sin_cos();
        let out = (along * cos + Vec3::Y * sin) * radius;
        let wide = along.cross(Vec3::Y) * 0.42;
        let stone = Mat3::from_cols(out * 0.15, wide.cross(out) * 1.2, wide);
        mesh.block(&stone, foot + middle + out * 1.15, paint::STONE);
    }
    mesh.weather(0, 0.06, 0.7);
    // The roof: 12 rafters and, to the south, two sheets of tiles. The ridge.
    for i in 0..15u32 {
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        let k = (i / 2) as f32;
        let slope = vec3(side * -2.1, 1.95, 0.0);
        let (size, middle, kind) = match i {
            0..12 => (vec3(1.0, 0.04, 0.1), vec3(side * 1.95, 5.7, 5.2 - 2.1 * k), paint::BARK),
            12..14 => (vec3(1.06, 0.02, 2.3 - side), vec3(side * 2.02, 5.92, 3.3 + side), paint::ROOF),
            _ => (vec3(0.06, 0.04, 5.6), vec3(0.0, 7.6, 0.1), paint::BARK),
        };
        let half = Mat3::from_cols(slope * size.x, slope.cross(Vec3::NEG_Z) * size.y, Vec3::Z * size.z);
        mesh.block(&half, foot + middle, kind);
    }
    // A low wall around the yard, with gaps.
    for i in 0..20u32 {
        let (sin, cos) = (0.9 + 0.25 * i as f32).sin_cos();
        let (x, z) = (17.0 * sin, 17.0 * cos);
        let high = 0.4 + 0.03 * (i * 5 % 7) as f32;
        let half = Mat3::from_cols(vec3(cos, 0.0, -sin) * (1.3 + high), Vec3::Y * high, vec3(sin, 0.0, cos) * 0.22);
        mesh.block(&half, vec3(x, height(x, z) + 0.2, z), paint::STONE);
    }
    mesh
}
