//! A chapel on the hill, half a ruin: an open arcade, rafters without tiles, a bell tower, broken walls.

use super::land::height;
use super::{PAINTS, paint};
use crate::raster::form::{Body, SQUARE};
use crate::raster::mesh::Mesh;
use glam::{Mat3, Vec3, vec3};

/// Blocks of masonry: middle and half sizes, decimetres.
const BLOCKS: &[[i8; 6]] = &[
    // The west wall: sill, four piers, what is left of the lintel.
    [-35, 5, 0, 4, 15, 60],
    [-35, 30, -54, 4, 15, 6],
    [-35, 30, -20, 4, 15, 9],
    [-35, 30, 16, 4, 15, 9],
    [-35, 30, 52, 4, 15, 8],
    [-35, 44, 20, 4, 4, 40],
    // The south front beside and above the door.
    [-23, 16, 58, 12, 26, 4],
    [23, 16, 58, 12, 26, 4],
    [0, 38, 58, 35, 6, 4],
    // The north front, broken.
    [-24, 18, -58, 15, 34, 4],
    [24, 8, -58, 15, 20, 4],
    [30, 24, -58, 9, 10, 4],
    // The tower: its foot, four piers.
    [-52, 30, 46, 18, 40, 18],
    [-65, 80, 33, 5, 12, 5],
    [-39, 80, 33, 5, 12, 5],
    [-65, 80, 59, 5, 12, 5],
    [-39, 80, 59, 5, 12, 5],
    [-52, 94, 46, 19, 2, 19],
    // Steps, a stone table, blocks that fell.
    [0, -1, 66, 14, 3, 5],
    [0, 4, -40, 12, 6, 6],
    [48, 2, -52, 5, 4, 7],
    [58, 1, -30, 6, 4, 4],
    [44, 2, -76, 4, 3, 6],
];

const fn square(rows: &'static [[i8; 5]]) -> Body {
    Body { rows, sides: 4, half: false, swell: SQUARE, taper: 0.0 }
}

const WALL: i8 = (paint::STONE | paint::STONE << 4) as u8 as i8;
const TILES: i8 = (paint::ROOF | paint::ROOF << 4) as u8 as i8;

/// The south gable; reach is across the chapel.
const GABLE: Body = square(&[[44, 0, 0, 0, WALL], [44, 0, 35, 4, WALL], [76, 0, 1, 4, WALL], [76, 0, 0, 0, WALL]]);
const SPIRE: Body = square(&[[96, 0, 0, 0, TILES], [96, 0, 21, 21, TILES], [127, 0, 0, 0, TILES]]);
const PILLAR: Body = Body {
    rows: &[[-10, 0, 4, 4, WALL], [2, 0, 4, 4, WALL], [3, 0, 3, 3, WALL], [18, 0, 3, 3, WALL], [21, 0, 5, 5, WALL]],
    sides: 8,
    half: false,
    swell: 0.0,
    taper: 0.0,
};

/// The chapel, where it stands: flat.
pub fn chapel() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    let foot = Vec3::Y * height(0.0, 0.0);
    let place = |x: f32, y: f32, z: f32| foot + vec3(x, y, z);
    let scale = |x: f32, y: f32, z: f32| Mat3::from_diagonal(vec3(x, y, z));
    for block in BLOCKS {
        let [x, y, z, a, b, c] = block.map(|i| i as f32 * 0.1);
        mesh.block(&scale(a, b, c), place(x, y, z), paint::STONE);
    }
    // The east side: three arches on pillars. The door.
    let across = Mat3::from_cols(Vec3::NEG_Z, Vec3::Y, Vec3::X);
    for i in 0..4 {
        let z = 3.7 * i as f32 - 5.6;
        mesh.body(&PILLAR, &scale(0.1, 0.1, 0.1), place(3.5, 0.0, z));
        if i < 3 {
            mesh.arch(&(across * scale(1.48, 1.48, 0.35)), place(3.5, 2.1, z + 1.85), paint::STONE);
        }
    }
    mesh.arch(&scale(0.92, 0.92, 0.4), place(0.0, 2.1, 5.8), paint::STONE);
    mesh.body(&GABLE, &(Mat3::from_cols(Vec3::NEG_Z, Vec3::Y, Vec3::X) * 0.1), place(0.0, 0.0, 5.8));
    mesh.body(&SPIRE, &scale(0.1, 0.1, 0.1), place(-5.2, 0.0, 4.6));
    mesh.weather(0, 0.06, 0.7);
    // The roof: tiles on the south half of the west side, rafters elsewhere.
    for side in [-1.0, 1.0] {
        let slope = vec3(-side * 2.1, 1.95, 0.0);
        let over = vec3(side * 0.07, 0.075, 0.0);
        for i in 0..6 {
            let half = Mat3::from_cols(slope, Vec3::Z * 0.1, slope.cross(Vec3::Z).normalize() * 0.12);
            mesh.block(&half, place(side * 1.95, 5.7, 5.2 - 2.1 * i as f32), paint::BARK);
        }
        let long = if side < 0.0 { 3.2 } else { 1.4 };
        let half = Mat3::from_cols(slope * 1.06, Vec3::Z * long, slope.cross(Vec3::Z).normalize() * 0.06);
        mesh.block(&half, place(side * 1.95, 5.85, 5.6 - long) + over, paint::ROOF);
    }
    // The ridge.
    mesh.block(&scale(0.12, 0.12, 5.6), place(0.0, 7.6, 0.1), paint::BARK);
    // A low wall around the yard, as high as the ground, with gaps.
    for i in 0..20u32 {
        let (sin, cos) = (0.9 + 0.25 * i as f32).sin_cos();
        let (x, z) = (17.0 * sin, 17.0 * cos);
        let along = vec3(cos, (height(x + cos, z - sin) - height(x - cos, z + sin)) * 0.5, -sin);
        let high = 0.25 + 0.2 * ((i * 5) % 7) as f32 / 7.0;
        let half = Mat3::from_cols(along * (1.5 + high), Vec3::Y * high, vec3(sin, 0.0, cos) * 0.22);
        mesh.block(&half, vec3(x, height(x, z) + high - 0.2, z), paint::STONE);
    }
    mesh
}
