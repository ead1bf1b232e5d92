//! An aeroplane, the North American P-51D Mustang of thesis B: 9.8 m long and 11.3 m wide, its nose along -z.
//!
//! Its right half is eight kinds of lofted bodies, each a row of cross sections between two ends: fuselage, canopy,
//! radiator scoop, wing, stabiliser, fin, and boxes for exhausts and guns. The left half is the mirror image, and
//! normals are averaged over faces, so that the skin is smooth. The propeller is a mesh of its own, since it turns.

use super::build::{build, op};
use crate::raster::form::{Rings, SQUARE};
use crate::raster::{Mesh, Paint};
use crate::scenes::script::{COUNT, Script, Word, script, variable};
use glam::{Vec3A, vec3a};

/// Bare metal, olive drab, the canopy's glass, yellow, white and black. Rows name them by hexadecimal digits.
pub static PAINTS: [Paint; 6] = [
    plain(0.4, 0.41, 0.43),
    plain(0.07, 0.075, 0.04),
    plain(0.025, 0.035, 0.045),
    plain(0.75, 0.45, 0.02),
    plain(0.72, 0.72, 0.7),
    plain(0.02, 0.02, 0.022),
];

const fn plain(red: f32, green: f32, blue: f32) -> Paint {
    Paint { albedo: vec3a(red, green, blue), texture: None, gloss: 0.0 }
}

/// The fuselage from tail to nose: units of 5 cm along, of 1 cm across.
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

/// The canopy, in the fuselage's units.
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

/// The radiator's scoop under the cockpit, in the fuselage's units.
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

/// The right wing from root to tip: units of 5 cm along, 1.25 cm from the leading to the trailing edge, 4 mm in
/// thickness.
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

/// The right half of the stabiliser, in the wing's units.
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

/// The fin from its foot to its top: units of 2 cm along, otherwise the wing's.
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

/// A blade of the propeller from hub to tip: units of 2 cm along, of 1 cm across.
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

/// A black box, from -1 to 1 along each axis.
const STICK: Rings = Rings {
    rows: &[[-1, 1, 0, 1, 0x55], [-1, 0, 1, 1, 0x55], [1, 0, 1, 1, 0x55], [1, 1, 0, 1, 0]],
    sides: 4,
    half: false,
    swell: SQUARE,
    taper: 0.0,
};

static BODIES: [Rings; 8] = [FUSELAGE, CANOPY, SCOOP, WING, STABILISER, FIN, STICK, BLADE];

// The number of each body in [`BODIES`].
const HULL: Word = 0.0;
const HOOD: Word = 1.0;
const RADIATOR: Word = 2.0;
const HALF_WING: Word = 3.0;
const TAILPLANE: Word = 4.0;
const RUDDER: Word = 5.0;
const BOX: Word = 6.0;
const PROPELLER: Word = 7.0;

/// The right half of the airframe, decimetres. A body's axes are its rows, its thickness and its width; each matrix
/// turns them into right, up and back.
const PARTS: &[u8] = script! {
    // Along -z.
    turn(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0);
    body(0.0, 0.0, 0.0, 1.0, 5.0, 1.0, HULL);
    body(0.0, 0.0, 0.0, 1.0, 5.0, 1.0, HOOD);
    body(0.0, 0.0, 0.0, 1.0, 5.0, 1.0, RADIATOR);
    // To the right; the wing's five degrees of dihedral are a shear.
    turn(0.0, -1.0, 0.0, 1.0, 0.35 * 0.25, 0.0, 0.0, 0.0, 1.0);
    body(0.0, -5.2, 0.0, 0.4, 5.0, 1.25, HALF_WING);
    turn(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    body(0.0, 4.2, 5.0 * 10.0, 0.4, 5.0, 1.25, TAILPLANE);
    // Up.
    turn(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    body(0.0, 0.0, 5.0 * 10.0, 0.4, 2.0, 1.25, RUDDER);
    // The exhausts, and three guns.
    body(4.2, 1.4, -18.5, 5.0, 4.0, 5.0 * 10.0, BOX);
    body(20.0, -3.5, -10.0, 2.5, 2.5, 20.0, BOX);
    body(22.0, -3.5, -10.0, 2.5, 2.5, 20.0, BOX);
    body(24.0, -3.5, -10.0, 2.5, 2.5, 20.0, BOX);
    end();
};

/// The aeroplane without its propeller: about 2,000 triangles, smooth. The origin is the centre of mass, on the thrust
/// line.
pub fn airframe() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    build(&mut mesh, &mut Script::new(PARTS, [0.0; 2]), &BODIES, Vec3A::ZERO, 0.1, 0);
    mesh.mirror();
    mesh.smooth();
    mesh
}

/// Four blades, decimetres, with a pitch of 35 degrees, whose cosine is 0.82 and whose sine 0.57. The matrix has twice
/// the blade's direction in its middle column.
const BLADES: &[u8] = script! {
    repeat(4.0) {
        ANGLE = (COUNT * 1.57);
        COS = (cos(ANGLE));
        SIN = (sin(ANGLE));
        turn(COS * 0.57, SIN * -0.57, -0.82, SIN * 2.0, COS * 2.0, 0.0, COS * 0.82, SIN * -0.82, 0.57);
        body(0.0, 0.0, -3.15 * 10.0, 1.0, 1.0, 1.0, PROPELLER);
    }
    end();
};
const COS: Word = variable(4);
const ANGLE: Word = variable(5);
const SIN: Word = variable(5);

/// The propeller: four blades around the z axis, about which they turn. Flat-shaded.
pub fn propeller() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    build(&mut mesh, &mut Script::new(BLADES, [0.0; 2]), &BODIES, Vec3A::ZERO, 0.1, 0);
    mesh
}
