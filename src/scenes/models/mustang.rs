//! An aeroplane: the North American P-51D Mustang, 9.8 m long and 11.3 m wide, its nose along -z.

use super::{BODY, END, TURN, build};
use crate::raster::form::{Rings, SQUARE};
use crate::raster::{Mesh, Paint};
use crate::scenes::script::{AGAIN, COS, COUNT, MUL, REPEAT, SIN, Script, get, script, set};
use glam::{Vec3, vec3};

/// Bare metal, olive drab, the canopy, yellow, white, black.
pub static PAINTS: [Paint; 6] = [
    plain(0.4, 0.41, 0.43),
    plain(0.07, 0.075, 0.04),
    plain(0.025, 0.035, 0.045),
    plain(0.75, 0.45, 0.02),
    plain(0.72, 0.72, 0.7),
    plain(0.02, 0.02, 0.022),
];

const fn plain(red: f32, green: f32, blue: f32) -> Paint {
    Paint { albedo: vec3(red, green, blue), texture: None, gloss: 0.0 }
}

/// From the tail to the nose: 5 cm along, 1 cm across.
const FUSELAGE: Rings = Rings {
    rows: &[
        [-120, 20, 0, 0, 0],
        [-119, 20, 13, 4, 0],
        [-108, 15, 25, 13, 0],
        [-94, 10, 35, 22, 0],
        [-82, 5, 43, 30, 0x44],
        [-74, 1, 48, 34, 0x55],
        [-66, -1, 52, 37, 0x44],
        [-58, -3, 56, 40, 0x55],
        [-50, -4, 60, 42, 0x44],
        [-42, -5, 62, 44, 0],
        [-32, -5, 64, 46, 0],
        [-16, -6, 66, 47, 0],
        [0, -6, 67, 47, 0],
        [10, -7, 66, 47, 0x10],
        [24, -9, 63, 46, 0x10],
        [40, -10, 58, 45, 0x13],
        [52, -9, 52, 42, 0x33],
        [58, -7, 46, 39, 0x33],
        [60, -6, 42, 37, 0x55],
        [60, -6, 42, 37, 0x55],
        [60, 0, 34, 34, 0x33],
        [60, 0, 34, 34, 0x33],
        [64, 0, 29, 29, 0x33],
        [68, 0, 21, 21, 0x33],
        [71, 0, 10, 10, 0x33],
        [72, 0, 0, 0, 0],
    ],
    sides: 10,
    half: true,
    swell: 0.15,
    taper: 0.08,
};

/// As the fuselage.
const CANOPY: Rings = Rings {
    rows: &[
        [-40, 50, 0, 0, 0x22],
        [-34, 50, 18, 13, 0x22],
        [-26, 50, 34, 24, 0x22],
        [-18, 50, 46, 31, 0x22],
        [-10, 50, 52, 34, 0x22],
        [-3, 50, 51, 34, 0x22],
        [1, 50, 46, 33, 0],
        [3, 50, 43, 32, 0x22],
        [11, 50, 12, 22, 0],
        [14, 50, 0, 0, 0],
    ],
    sides: 6,
    half: true,
    swell: 0.1,
    taper: 0.1,
};

/// As the fuselage: the radiator's, under the cockpit.
const SCOOP: Rings = Rings {
    rows: &[
        [-92, -18, 0, 0, 0],
        [-76, -36, 20, 14, 0],
        [-62, -53, 26, 23, 0],
        [-48, -66, 32, 29, 0],
        [-32, -77, 34, 33, 0],
        [-20, -82, 33, 33, 0],
        [-12, -82, 30, 31, 0],
        [-12, -82, 30, 31, 0x55],
        [-10, -84, 0, 0, 0],
    ],
    sides: 6,
    half: true,
    swell: 0.35,
    taper: 0.0,
};

/// From the root to the tip: 5 cm along, 1.25 cm from the leading to the trailing edge, 4 mm across.
const WING: Rings = Rings {
    rows: &[
        [6, 11, 0, 0, 0],
        [6, 11, 115, 50, 0],
        [18, 17, 97, 46, 0],
        [38, 13, 87, 40, 0x44],
        [46, 11, 83, 37, 0x55],
        [54, 9, 79, 34, 0x44],
        [62, 7, 75, 31, 0x55],
        [70, 5, 72, 28, 0x44],
        [78, 4, 68, 26, 0],
        [104, -2, 55, 18, 0],
        [111, -3, 50, 14, 0],
        [113, -3, 38, 5, 0],
        [113, -3, 0, 0, 0],
    ],
    sides: 14,
    half: false,
    swell: 0.0,
    taper: 0.6,
};

/// As the wing.
const STABILISER: Rings = Rings {
    rows: &[
        [2, -4, 0, 0, 0],
        [2, -4, 48, 14, 0],
        [38, 5, 30, 10, 0],
        [40, 6, 27, 7, 0],
        [40, 6, 27, 7, 0],
        [40, 6, 0, 0, 0],
    ],
    sides: 10,
    half: false,
    swell: 0.0,
    taper: 0.6,
};

/// From its foot to its top: 2 cm along, the rest as the wing.
const FIN: Rings = Rings {
    rows: &[
        [5, 33, 0, 0, 0],
        [5, 33, 57, 12, 0],
        [20, -19, 117, 9, 0],
        [20, -19, 117, 9, 0],
        [31, 15, 83, 12, 0],
        [40, 31, 67, 11, 0],
        [60, 43, 51, 9, 0],
        [75, 49, 37, 7, 0],
        [82, 52, 24, 4, 0],
        [85, 52, 0, 0, 0],
    ],
    sides: 6,
    half: true,
    swell: 0.0,
    taper: 0.6,
};

/// From the hub to the tip: 2 cm along, 1 cm wide.
const BLADE: Rings = Rings {
    rows: &[
        [12, 0, 0, 0, 0x55],
        [12, 0, 6, 4, 0x55],
        [30, 0, 15, 3, 0x55],
        [60, 0, 17, 2, 0x55],
        [76, 0, 14, 1, 0x33],
        [85, 0, 0, 0, 0],
    ],
    sides: 6,
    half: false,
    swell: 0.0,
    taper: 0.0,
};

/// A black box.
const STICK: Rings = Rings {
    rows: &[[-1, 1, 0, 1, 0x55], [-1, 0, 1, 1, 0x55], [1, 0, 1, 1, 0x55], [1, 1, 0, 1, 0]],
    sides: 4,
    half: false,
    swell: SQUARE,
    taper: 0.0,
};

static BODIES: [Rings; 8] = [FUSELAGE, CANOPY, SCOOP, WING, STABILISER, FIN, STICK, BLADE];

/// Decimetres.
#[rustfmt::skip]
const PARTS: &[u8] = script![
    [1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0, TURN],
    [0.0, 0.0, 0.0, 1.0, 5.0, 1.0, 0.0, BODY],
    [0.0, 0.0, 0.0, 1.0, 5.0, 1.0, 1.0, BODY],
    [0.0, 0.0, 0.0, 1.0, 5.0, 1.0, 2.0, BODY],
    // Five degrees of dihedral are a shear.
    [0.0, -1.0, 0.0, 1.0, 0.35, 0.25, MUL, 0.0, 0.0, 0.0, 1.0, TURN],
    [0.0, -5.2, 0.0, 0.4, 5.0, 1.25, 3.0, BODY],
    [0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, TURN],
    [0.0, 4.2, 5.0, 10.0, MUL, 0.4, 5.0, 1.25, 4.0, BODY],
    [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, TURN],
    [0.0, 0.0, 5.0, 10.0, MUL, 0.4, 2.0, 1.25, 5.0, BODY],
    // The exhausts, and three guns.
    [4.2, 1.4, -18.5, 5.0, 4.0, 5.0, 10.0, MUL, 6.0, BODY],
    [20.0, -3.5, -10.0, 2.5, 2.5, 20.0, 6.0, BODY],
    [22.0, -3.5, -10.0, 2.5, 2.5, 20.0, 6.0, BODY],
    [24.0, -3.5, -10.0, 2.5, 2.5, 20.0, 6.0, BODY, END],
];

/// All but the propeller: smooth, about 2,000 triangles. The origin is the centre of mass, on the thrust line.
pub fn airframe() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    build(&mut mesh, &mut Script::new(PARTS, [0.0; 2]), &BODIES, Vec3::ZERO, 0.1, 0);
    mesh.mirror();
    mesh.smooth();
    mesh
}

/// Decimetres. Blades with a pitch of 35 degrees.
#[rustfmt::skip]
const BLADES: &[u8] = script![
    [4.0, REPEAT, COUNT, 1.57, MUL, set(5), get(5), COS, set(4), get(5), SIN, set(5)],
    [get(4), 0.57, MUL, get(5), -0.57, MUL, -0.82, get(5), 2.0, MUL, get(4), 2.0, MUL, 0.0],
    [get(4), 0.82, MUL, get(5), -0.82, MUL, 0.57, TURN],
    [0.0, 0.0, -3.15, 10.0, MUL, 1.0, 1.0, 1.0, 7.0, BODY, AGAIN, END],
];

/// Four blades around the z axis, where they turn, flat.
pub fn propeller() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    build(&mut mesh, &mut Script::new(BLADES, [0.0; 2]), &BODIES, Vec3::ZERO, 0.1, 0);
    mesh
}
