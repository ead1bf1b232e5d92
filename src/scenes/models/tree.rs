//! Firs and broadleaves, and where they stand.
//!
//! A fir is one body of rings whose skirts overlap; a broadleaf is a stem and eight balls of leaves at random angles.
//! Far away each is a single body of some twenty triangles. Noise moves the points, so that no two trees are alike.
//! They stand where a hash and the noise of [`wooded`] say, more densely near the middle of the valley.

use super::build::{CHANCE, STREAM, build, op};
use super::land::{self, height, wooded};
use super::paint::{self, PAINTS};
use crate::angle;
use crate::raster::Mesh;
use crate::raster::form::Rings;
use crate::scenes::script::{Script, Word, fragment, script, variable, words};
use crate::simd::hash::rnd;
use glam::{Vec3A, vec3a};
use std::f32::consts::TAU;

/// A tree of the woods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree {
    /// The foot, on the ground, metres.
    pub foot: Vec3A,
    /// Height, metres.
    pub height: f32,
    /// The number of the tree, from which its random numbers come.
    pub seed: u32,
    /// Whether it is a fir, not a broadleaf.
    pub fir: bool,
}

// Paints, counted from the bark of the tree's kind, in both hexadecimal digits of a row.
const BARK: i8 = 0;
const FIR: i8 = 0x11;
const LEAF: i8 = 0x22;

/// A round body in hundredths of the tree's height.
const fn round(rows: &'static [[i8; 5]], sides: u8) -> Rings {
    Rings { rows, sides, half: false, swell: 0.0, taper: 0.0 }
}

const FIR_TREE: Rings = round(
    &[
        [-5, 0, 3, 3, BARK],
        [14, 0, 2, 2, FIR],
        [7, 0, 23, 23, FIR],
        [7, 0, 23, 23, FIR],
        [33, 0, 10, 10, FIR],
        [28, 0, 19, 19, FIR],
        [28, 0, 19, 19, FIR],
        [52, 0, 8, 8, FIR],
        [47, 0, 15, 15, FIR],
        [47, 0, 15, 15, FIR],
        [74, 0, 4, 4, FIR],
        [68, 0, 9, 9, FIR],
        [68, 0, 9, 9, FIR],
        [104, 0, 0, 0, FIR],
    ],
    7,
);
const FAR_FIR: Rings = round(
    &[
        [14, 0, 0, 0, FIR],
        [8, 0, 22, 22, FIR],
        [8, 0, 22, 22, FIR],
        [50, 0, 8, 8, FIR],
        [45, 0, 14, 14, FIR],
        [45, 0, 14, 14, FIR],
        [100, 0, 0, 0, FIR],
    ],
    4,
);
const TRUNK: Rings = round(&[[-5, 0, 5, 5, BARK], [20, 0, 3, 3, BARK], [60, 0, 2, 2, BARK]], 5);
/// In hundredths of the crown's radius.
const CROWN: Rings = round(
    &[
        [-90, 0, 0, 0, LEAF],
        [-60, 0, 80, 80, LEAF],
        [0, 0, 100, 100, LEAF],
        [60, 0, 80, 80, LEAF],
        [100, 0, 0, 0, LEAF],
    ],
    7,
);
const FAR_CROWN: Rings =
    round(&[[-127, 0, 8, 8, BARK], [-60, 0, 60, 60, LEAF], [40, 0, 80, 80, LEAF], [100, 0, 0, 0, LEAF]], 5);

static BODIES: [Rings; 5] = [FIR_TREE, FAR_FIR, FAR_CROWN, TRUNK, CROWN];

// The number of each body in [`BODIES`].
const WHOLE_FIR: Word = 0.0;
const DISTANT_FIR: Word = 1.0;
const DISTANT_CROWN: Word = 2.0;
const STEM: Word = 3.0;
const LEAVES: Word = 4.0;

/// Radius of a crown at random, in tree heights.
const RADIUS: Word = variable(5);

/// A broadleaf and a fir close by, a broadleaf and a fir far away. The unit is the tree's height.
static KINDS: [&[u8]; 4] = [
    script! {
        ..part(3.0, 0.0, 0.0); body(0.0, 0.0, 0.0, 0.1, 0.1, 0.1, STEM);
        RADIUS = (0.18 * 0.1);
        ..part(4.0, 0.0, 0.9); ..crown(1.5);
        ..part(5.0, 2.0 * THIRD, 1.0); ..crown(1.6);
        ..part(6.0, THIRD, 0.9); ..crown(1.75);
        ..part(7.0, 0.0, 0.8); ..crown(2.1);
        ..part(8.0, THIRD, 0.9); ..crown(2.2);
        ..part(9.0, 2.0 * THIRD, 0.75); ..crown(2.4);
        ..part(10.0, THIRD, 0.5); ..crown(2.8);
        ..part(11.0, 0.0, 0.2); ..crown(2.9);
        end();
    },
    script! { ..part(0.0, 0.0, 0.0); body(0.0, 0.0, 0.0, 0.1, 0.1, 0.1, WHOLE_FIR); end(); },
    script! { ..part(2.0, 2.0 * THIRD, 0.0); body(0.0, 1.22 * 0.45, 0.0, 0.045, 0.045, 0.045, DISTANT_CROWN); end(); },
    script! { ..part(1.0, THIRD, 0.0); body(0.0, 0.0, 0.0, 0.1, 0.1, 0.1, DISTANT_FIR); end(); },
];

/// A third of a turn, radians.
const THIRD: Word = 2.095;

/// The next body is turned by an angle and by random number `number`, and stands `out` radii of a crown away from the
/// stem.
const fn part(number: Word, angle: Word, out: Word) -> [Word; 10] {
    fragment! {
        random(number);
        rotate(CHANCE + angle, 0.0, out * 0.26);
    }
}

/// A ball of leaves, `up` radii above the ground.
const fn crown(up: Word) -> [Word; 10] {
    words!(0.0, up * 0.26, 0.0, RADIUS, RADIUS, RADIUS, LEAVES; op::body)
}

/// Adds a tree to a mesh: in full, or of some twenty triangles where it is `far` away.
pub fn grow(mesh: &mut Mesh, tree: &Tree, far: bool) {
    let first = mesh.points.len();
    let bark = paint::BARK + tree.seed as u16 % 3 * 3;
    let mut script = Script::new(KINDS[tree.fir as usize + 2 * far as usize], [bark as f32, 0.0]);
    build(mesh, &mut script, &BODIES, tree.foot, tree.height, tree.seed);
    mesh.weather(first, 0.08 * tree.height, 4.0 / tree.height);
}

/// The direction in which tree `seed` stands from the middle, turns from east by south.
fn around(seed: u32) -> f32 {
    rnd(STREAM, seed, 0)
}

/// The trees around the middle of the valley: in groves, and a few alone.
pub fn trees() -> Vec<Tree> {
    /// Places that are tried.
    const TRIED: u32 = 4500;
    let mut trees = Vec::new();
    for seed in 0..TRIED {
        let [b, c, d, e] = [1, 2, 3, 4].map(|k| rnd(STREAM, seed, k));
        // Denser near the middle, where they count.
        let (sin, cos) = angle::sin_cos(TAU * around(seed));
        let r = 24.0 + 700.0 * b * b.sqrt();
        let (x, z) = (r * cos, r * sin);
        let y = height(x, z);
        let wanted = wooded(x, z) > 0.1 * c || d < 0.008;
        if wanted && y > land::WATER + 1.0 {
            // Firs on the heights.
            let fir = e < 0.45 + 0.02 * y;
            trees.push(Tree {
                foot: vec3a(x, y, z),
                height: if fir { 9.0 + 8.0 * c } else { 7.0 + 4.0 * c },
                seed,
                fir,
            });
        }
    }
    trees
}

/// The woods as patches around the middle, flat-shaded: eight sectors of near trees, then eight of far ones.
pub fn woods(trees: &[Tree]) -> Vec<Mesh> {
    const SECTORS: u32 = 8;
    let mut patches = Vec::new();
    for i in 0..2 * SECTORS {
        let mut mesh = Mesh::painted(&PAINTS);
        for tree in trees {
            let far = tree.foot.length_squared() > 140.0 * 140.0;
            let sector = (SECTORS as f32 * around(tree.seed)) as u32;
            if sector + SECTORS * far as u32 == i {
                grow(&mut mesh, tree, far);
            }
        }
        mesh.smooth();
        patches.push(mesh);
    }
    patches
}
