//! The chapel on the hill, half a ruin: an open arcade, rafters without tiles, a bell tower, broken walls.
//!
//! Some 60 boxes, a gable, a spire and four pillars, all flat-shaded: its walls stand around the origin, the altar to
//! the north, the door to the south. Noise moves the corners by some centimetres, so that no edge looks drawn with a
//! ruler.

use super::build::{PAINT, build, op};
use super::paint::{BARK, PAINTS, ROOF, STONE};
use crate::raster::Mesh;
use crate::raster::form::{Rings, SQUARE};
use crate::scenes::script::{COUNT, Script, Word, instruction, script};
use glam::Vec3A;

/// What the chapel is built of.
const PIECES: &[u8] = script! {
    PAINT = (STONE);
    ground();
    // The west wall: sill, four piers, what is left of the lintel.
    ..block([-3.5, 0.5, 0.0], [0.4, 1.5, 6.0]);
    ..block([-3.5, 3.0, -5.4], [0.4, 1.5, 0.6]);
    ..block([-3.5, 3.0, -2.0], [0.4, 1.5, 0.9]);
    ..block([-3.5, 3.0, 1.6], [0.4, 1.5, 0.9]);
    ..block([-3.5, 3.0, 5.2], [0.4, 1.5, 0.8]);
    ..block([-3.5, 4.4, 2.0], [0.4, 0.4, 4.0]);
    // Over the arcade.
    ..block([3.5, 3.9, 0.0], [0.4, 0.3, 6.0]);
    ..block([3.5, 3.1, -5.6], [0.3, 1.0, 0.4]);
    ..block([3.5, 3.1, -1.9], [0.3, 1.0, 0.4]);
    ..block([3.5, 3.1, 1.8], [0.3, 1.0, 0.4]);
    ..block([3.5, 3.1, 5.5], [0.3, 1.0, 0.4]);
    // The south front beside and above the door.
    ..block([-2.2, 1.6, 5.8], [1.3, 2.6, 0.4]);
    ..block([2.2, 1.6, 5.8], [1.3, 2.6, 0.4]);
    ..block([0.0, 3.7, 5.8], [3.5, 0.7, 0.4]);
    // The north front, broken.
    ..block([-2.4, 1.8, -5.8], [1.5, 3.4, 0.4]);
    ..block([2.4, 0.8, -5.8], [1.5, 2.0, 0.4]);
    ..block([3.0, 2.4, -5.8], [0.9, 1.0, 0.4]);
    // The tower: its foot, four piers.
    ..block([-5.2, 3.0, 4.6], [1.8, 4.0, 1.8]);
    ..block([-6.5, 8.0, 3.3], [0.5, 1.2, 0.5]);
    ..block([-3.9, 8.0, 3.3], [0.5, 1.2, 0.5]);
    ..block([-6.5, 8.0, 5.9], [0.5, 1.2, 0.5]);
    ..block([-3.9, 8.0, 5.9], [0.5, 1.2, 0.5]);
    ..block([-5.2, 9.4, 4.6], [1.9, 0.2, 1.9]);
    // Steps, a stone table, blocks that fell.
    ..block([0.0, -0.1, 6.6], [1.4, 0.3, 0.5]);
    ..block([0.0, 0.4, -4.0], [1.2, 0.6, 0.6]);
    ..block([4.8, 0.2, -5.2], [0.5, 0.4, 0.7]);
    ..block([5.8, 0.1, -3.0], [0.6, 0.4, 0.4]);
    ..block([4.4, 0.2, -7.6], [0.4, 0.3, 0.6]);
    // The south gable, the spire, the pillars of the arcade.
    ..piece([0.0, 4.4, 5.8], GABLE);
    ..piece([-5.2, 9.6, 4.6], SPIRE);
    ..piece([3.5, 0.0, -5.6], PILLAR);
    ..piece([3.5, 0.0, -1.9], PILLAR);
    ..piece([3.5, 0.0, 1.8], PILLAR);
    ..piece([3.5, 0.0, 5.5], PILLAR);
    // Round arches of five stones each: the arcade's, and that of the door.
    repeat(5.0) {
        rotate(0.0, COUNT * -0.625 + -0.325, 1.65);
        ..block([3.5, 2.1, -3.8], [0.4, 0.7, 0.2]);
        ..block([3.5, 2.1, 0.0], [0.4, 0.7, 0.2]);
        ..block([3.5, 2.1, 3.7], [0.4, 0.7, 0.2]);
        rotate(1.575, COUNT * -0.625 + -0.325, 1.05);
        ..block([0.0, 2.1, 5.8], [0.4, 0.5, 0.2]);
    }
    // A low wall around the yard, with gaps.
    repeat(20.0) {
        rotate(COUNT * 0.25 + 0.9, 0.0, 16.95);
        ground();
        ..block([0.0, 0.2, 0.0], [1.8, 0.5, 0.2]);
    }
    // The roof: rafters, and sheets of tiles to the south. The ridge.
    PAINT = (BARK);
    rotate(1.575, 0.75, 0.0);
    ground();
    repeat(6.0) { body(2.0, 5.7, COUNT * -2.1 + 5.2, 0.1, 0.1, 2.9, BLOCK); }
    PAINT = (ROOF);
    ..block([2.0, 6.0, 4.3], [1.3, 0.1, 3.0]);
    rotate(1.575, -0.75, 0.0);
    ..block([-2.0, 6.0, 2.3], [3.3, 0.1, 3.0]);
    PAINT = (BARK);
    repeat(6.0) { body(-2.0, 5.7, COUNT * -2.1 + 5.2, 0.1, 0.1, 2.9, BLOCK); }
    rotate(0.0, 0.0, 0.0);
    ..block([0.0, 7.6, 0.1], [0.2, 0.1, 5.6]);
    end();
};

/// A box around `middle`, by half of its edges; metres.
const fn block([x, y, z]: [Word; 3], [a, b, c]: [Word; 3]) -> [Word; 8] {
    [x, y, z, a, b, c, BLOCK, instruction(op::body)]
}

/// Another body, as it is in [`BODIES`], with its foot at a place; metres.
const fn piece([x, y, z]: [Word; 3], body: Word) -> [Word; 8] {
    [x, y, z, 1.0, 1.0, 1.0, body, instruction(op::body)]
}

const fn square(rows: &'static [[i8; 5]]) -> Rings {
    Rings { rows, sides: 4, half: false, swell: SQUARE, taper: 0.0 }
}

// The number of each body in [`BODIES`].
const BLOCK: Word = 0.0;
const GABLE: Word = 1.0;
const SPIRE: Word = 2.0;
const PILLAR: Word = 3.0;

/// A cube of two metres; a gable, a spire with the roof's paint, and a pillar, in decimetres.
static BODIES: [Rings; 4] = [
    square(&[[-10, 10, 0, 10, 0], [-10, 0, 10, 10, 0], [10, 0, 10, 10, 0], [10, 10, 0, 10, 0]]),
    square(&[[0, 4, 0, 35, 0], [0, 0, 4, 35, 0], [32, 0, 4, 1, 0], [32, 4, 0, 1, 0]]),
    square(&[[0, 21, 0, 21, 0x11], [0, 0, 21, 21, 0x11], [31, 0, 0, 0, 0]]),
    Rings {
        rows: &[[-10, 0, 4, 4, 0], [2, 0, 4, 4, 0], [3, 0, 3, 3, 0], [18, 0, 3, 3, 0], [21, 0, 5, 5, 0]],
        sides: 8,
        half: false,
        swell: 0.0,
        taper: 0.0,
    },
];

/// The chapel where it stands, flat-shaded.
pub fn chapel() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    build(&mut mesh, &mut Script::new(PIECES, [0.0; 2]), &BODIES, Vec3A::ZERO, 1.0, 0);
    mesh.weather(0, 0.06, 0.7);
    mesh
}
