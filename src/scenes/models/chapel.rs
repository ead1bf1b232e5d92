//! A chapel on the hill, half a ruin: an open arcade, rafters without tiles, a bell tower, broken walls.

use super::{BODY, END, GROUND, PAINTS, ROTATE, build, paint};
use crate::raster::Mesh;
use crate::raster::form::{Rings, SQUARE};
use crate::scenes::script::{ADD, AGAIN, COUNT, MUL, REPEAT, Script, Word, script, set};
use glam::Vec3;

/// Where its middle is and its half size, metres, or for other bodies than the first the scale; which of [`BODIES`].
#[rustfmt::skip]
const PIECES: &[u8] = script![
    [paint::STONE as Word, set(0), GROUND],
    // The west wall: sill, four piers, what is left of the lintel.
    [-3.5, 0.5, 0.0, 0.4, 1.5, 6.0, 0.0, BODY],
    [-3.5, 3.0, -5.4, 0.4, 1.5, 0.6, 0.0, BODY],
    [-3.5, 3.0, -2.0, 0.4, 1.5, 0.9, 0.0, BODY],
    [-3.5, 3.0, 1.6, 0.4, 1.5, 0.9, 0.0, BODY],
    [-3.5, 3.0, 5.2, 0.4, 1.5, 0.8, 0.0, BODY],
    [-3.5, 4.4, 2.0, 0.4, 0.4, 4.0, 0.0, BODY],
    // Over the arcade.
    [3.5, 3.9, 0.0, 0.4, 0.3, 6.0, 0.0, BODY],
    [3.5, 3.1, -5.6, 0.3, 1.0, 0.4, 0.0, BODY],
    [3.5, 3.1, -1.9, 0.3, 1.0, 0.4, 0.0, BODY],
    [3.5, 3.1, 1.8, 0.3, 1.0, 0.4, 0.0, BODY],
    [3.5, 3.1, 5.5, 0.3, 1.0, 0.4, 0.0, BODY],
    // The south front beside and above the door.
    [-2.2, 1.6, 5.8, 1.3, 2.6, 0.4, 0.0, BODY],
    [2.2, 1.6, 5.8, 1.3, 2.6, 0.4, 0.0, BODY],
    [0.0, 3.7, 5.8, 3.5, 0.7, 0.4, 0.0, BODY],
    // The north front, broken.
    [-2.4, 1.8, -5.8, 1.5, 3.4, 0.4, 0.0, BODY],
    [2.4, 0.8, -5.8, 1.5, 2.0, 0.4, 0.0, BODY],
    [3.0, 2.4, -5.8, 0.9, 1.0, 0.4, 0.0, BODY],
    // The tower: its foot, four piers.
    [-5.2, 3.0, 4.6, 1.8, 4.0, 1.8, 0.0, BODY],
    [-6.5, 8.0, 3.3, 0.5, 1.2, 0.5, 0.0, BODY],
    [-3.9, 8.0, 3.3, 0.5, 1.2, 0.5, 0.0, BODY],
    [-6.5, 8.0, 5.9, 0.5, 1.2, 0.5, 0.0, BODY],
    [-3.9, 8.0, 5.9, 0.5, 1.2, 0.5, 0.0, BODY],
    [-5.2, 9.4, 4.6, 1.9, 0.2, 1.9, 0.0, BODY],
    // Steps, a stone table, blocks that fell.
    [0.0, -0.1, 6.6, 1.4, 0.3, 0.5, 0.0, BODY],
    [0.0, 0.4, -4.0, 1.2, 0.6, 0.6, 0.0, BODY],
    [4.8, 0.2, -5.2, 0.5, 0.4, 0.7, 0.0, BODY],
    [5.8, 0.1, -3.0, 0.6, 0.4, 0.4, 0.0, BODY],
    [4.4, 0.2, -7.6, 0.4, 0.3, 0.6, 0.0, BODY],
    // The south gable, the spire, the pillars of the arcade.
    [0.0, 4.4, 5.8, 1.0, 1.0, 1.0, 1.0, BODY],
    [-5.2, 9.6, 4.6, 1.0, 1.0, 1.0, 2.0, BODY],
    [3.5, 0.0, -5.6, 1.0, 1.0, 1.0, 3.0, BODY],
    [3.5, 0.0, -1.9, 1.0, 1.0, 1.0, 3.0, BODY],
    [3.5, 0.0, 1.8, 1.0, 1.0, 1.0, 3.0, BODY],
    [3.5, 0.0, 5.5, 1.0, 1.0, 1.0, 3.0, BODY],
    // Round arches: the arcade's, and that of the door.
    [5.0, REPEAT, 0.0, COUNT, -0.625, MUL, -0.325, ADD, 1.65, ROTATE],
    [3.5, 2.1, -3.8, 0.4, 0.7, 0.2, 0.0, BODY],
    [3.5, 2.1, 0.0, 0.4, 0.7, 0.2, 0.0, BODY],
    [3.5, 2.1, 3.7, 0.4, 0.7, 0.2, 0.0, BODY],
    [1.575, COUNT, -0.625, MUL, -0.325, ADD, 1.05, ROTATE],
    [0.0, 2.1, 5.8, 0.4, 0.5, 0.2, 0.0, BODY, AGAIN],
    // A low wall around the yard, with gaps.
    [20.0, REPEAT, COUNT, 0.25, MUL, 0.9, ADD, 0.0, 16.95, ROTATE, GROUND],
    [0.0, 0.2, 0.0, 1.8, 0.5, 0.2, 0.0, BODY, AGAIN],
    // The roof: rafters and, to the south, two sheets of tiles. The ridge.
    [paint::BARK as Word, set(0), 1.575, 0.75, 0.0, ROTATE, GROUND],
    [6.0, REPEAT, 2.0, 5.7, COUNT, -2.1, MUL, 5.2, ADD, 0.1, 0.1, 2.9, 0.0, BODY, AGAIN],
    [paint::ROOF as Word, set(0), 2.0, 6.0, 4.3, 1.3, 0.1, 3.0, 0.0, BODY],
    [1.575, -0.75, 0.0, ROTATE, -2.0, 6.0, 2.3, 3.3, 0.1, 3.0, 0.0, BODY],
    [paint::BARK as Word, set(0)],
    [6.0, REPEAT, -2.0, 5.7, COUNT, -2.1, MUL, 5.2, ADD, 0.1, 0.1, 2.9, 0.0, BODY, AGAIN],
    [0.0, 0.0, 0.0, ROTATE, 0.0, 7.6, 0.1, 0.2, 0.1, 5.6, 0.0, BODY, END],
];

const fn square(rows: &'static [[i8; 5]]) -> Rings {
    Rings { rows, sides: 4, half: false, swell: SQUARE, taper: 0.0 }
}

/// A block of one metre each way, a gable, the spire, a pillar; the spire has other paint.
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

/// The chapel, where it stands: flat.
pub fn chapel() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    build(&mut mesh, &mut Script::new(PIECES, [0.0; 2]), &BODIES, Vec3::ZERO, 1.0, 0);
    mesh.weather(0, 0.06, 0.7);
    mesh
}
