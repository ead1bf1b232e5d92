//! A chapel on the hill, half a ruin: an open arcade, rafters without tiles, a bell tower, broken walls.

use super::land::height;
use super::{PAINTS, paint};
use crate::raster::form::{Body, SQUARE};
use crate::raster::mesh::Mesh;
use glam::{Mat3, Vec3, vec3};

/// In decimetres: which of [`BODIES`], and 4 times which of [`RUNS`]; where the middle is, and the half size, or for
/// other bodies than the first the scale.
#[rustfmt::skip]
static PIECES: [[i8; 7]; 44] = [
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
    // Round arches: the arcade's, and that of the door.
    [4, 35, 21, -38, 4, 7, 2],
    [4, 35, 21, 0, 4, 7, 2],
    [4, 35, 21, 37, 4, 7, 2],
    [8, 0, 21, 58, 4, 5, 2],
    // The roof: rafters and, to the south, two sheets of tiles. The ridge.
    [12, 20, 57, 52, 1, 1, 29],
    [16, -20, 57, 52, 1, 1, 29],
    [20, 20, 60, 43, 13, 1, 30],
    [24, -20, 60, 23, 33, 1, 30],
    [28, 0, 76, 1, 2, 1, 56],
    // A low wall around the yard, with gaps.
    [32, 0, 2, 0, 18, 5, 2],
];

/// Pieces in a row: how many; around y and then x the first one's turn and the step to the next, in fortieths of a
/// radian; how far out the turn takes them, 15 cm; the step along z, decimetres; paint.
#[rustfmt::skip]
static RUNS: [[i8; 8]; 9] = [
    [1, 0, 0, 0, 0, 0, 0, paint::STONE as i8],
    [5, 0, 0, -13, -25, 11, 0, paint::STONE as i8],
    [5, 63, 0, -13, -25, 7, 0, paint::STONE as i8],
    [6, 63, 0, 30, 0, 0, -21, paint::BARK as i8],
    [6, 63, 0, -30, 0, 0, -21, paint::BARK as i8],
    [1, 63, 0, 30, 0, 0, 0, paint::ROOF as i8],
    [1, 63, 0, -30, 0, 0, 0, paint::ROOF as i8],
    [1, 0, 0, 0, 0, 0, 0, paint::BARK as i8],
    [20, 36, 10, 0, 0, 113, 0, paint::STONE as i8],
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
    for piece in &PIECES {
        let [kind, x, y, z, a, b, c] = piece.map(|i| i as f32);
        let run = &RUNS[piece[0] as usize / 4];
        let [_, yaw, yaws, pitch, pitches, out, step, _] = run.map(|i| i as f32);
        for k in 0..run[0] {
            let k = k as f32;
            let angle = |from: f32, step: f32| (from + step * k) * 0.025;
            let turn = Mat3::from_rotation_y(angle(yaw, yaws)) * Mat3::from_rotation_x(angle(pitch, pitches));
            let out = turn * Vec3::Z * (out * 0.15);
            let at = vec3(x, y, z + step * k) * 0.1 + out + Vec3::Y * height(out.x, out.z);
            let turn = turn * Mat3::from_diagonal(vec3(a, b, c) * 0.01);
            mesh.body(&BODIES[kind as usize % 4], &turn, at, run[7] as u16);
        }
    }
    mesh.weather(0, 0.06, 0.7);
    mesh
}
