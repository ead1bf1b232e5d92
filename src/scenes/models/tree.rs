//! Firs and broadleaves, and where they stand.

use super::land::{self, height, wooded};
use super::{BODY, END, PAINTS, RANDOM, ROTATE, STREAM, build, paint};
use crate::raster::Mesh;
use crate::raster::form::Rings;
use crate::scenes::script::{ADD, MUL, Script, Word, get, script, set};
use crate::simd::hash::rnd;
use glam::{Vec3, vec3};
use std::f32::consts::TAU;

/// A tree of the woods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree {
    /// Its foot, on the ground.
    pub foot: Vec3,
    /// Metres high.
    pub height: f32,
    /// What it differs by from others.
    pub seed: u32,
    /// A fir, or else a broadleaf.
    pub fir: bool,
}

// From the bark of its kind.
const BARK: i8 = 0;
const FIR: i8 = 0x11;
const LEAF: i8 = 0x22;

/// Around, hundredths of the height.
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
/// Hundredths of its radius.
const CROWN: Rings = round(
    &[
        [-90, 0, 0, 0, LEAF],
        [-60, 0, 70, 70, LEAF],
        [10, 0, 100, 100, LEAF],
        [70, 0, 66, 66, LEAF],
        [100, 0, 0, 0, LEAF],
    ],
    7,
);
const FAR_CROWN: Rings =
    round(&[[-127, 0, 8, 8, BARK], [-60, 0, 60, 60, LEAF], [40, 0, 80, 80, LEAF], [100, 0, 0, 0, LEAF]], 5);

static BODIES: [Rings; 5] = [FIR_TREE, FAR_FIR, FAR_CROWN, TRUNK, CROWN];

/// Broadleaves and firs, near and far. The unit is the tree's height.
#[rustfmt::skip]
static KINDS: [&[u8]; 4] = [
    script![
        part(3.0, 0.0, 0.0), [0.0, 0.0, 0.0, 0.1, 0.1, 0.1, 3.0, BODY, 0.26, 0.1, MUL, set(5)],
        part(4.0, 2.095, 0.77), crown(1.76),
        part(5.0, 4.19, 0.77), crown(2.1),
        part(6.0, 0.0, 0.77), crown(2.44),
        part(7.0, 2.095, 0.15), crown(2.8), [END],
    ],
    script![part(0.0, 0.0, 0.0), [0.0, 0.0, 0.0, 0.1, 0.1, 0.1, 0.0, BODY, END]],
    script![part(2.0, 4.19, 0.0), [0.0, 1.22, 0.45, MUL, 0.0, 0.045, 0.045, 0.045, 2.0, BODY, END]],
    script![part(1.0, 2.095, 0.0), [0.0, 0.0, 0.0, 0.1, 0.1, 0.1, 1.0, BODY, END]],
];

/// Turned by a random number and an angle more; so many radii of a crown away.
#[rustfmt::skip]
const fn part(number: Word, angle: Word, out: Word) -> [Word; 10] {
    [number, RANDOM, get(4), angle, ADD, 0.0, out, 0.26, MUL, ROTATE]
}

/// So many radii above the ground.
#[rustfmt::skip]
const fn crown(up: Word) -> [Word; 10] {
    [0.0, up, 0.26, MUL, 0.0, get(5), get(5), get(5), 4.0, BODY]
}

/// Adds a tree; `far` is one of 20 triangles or so.
pub fn grow(mesh: &mut Mesh, tree: &Tree, far: bool) {
    let first = mesh.points.len();
    let bark = paint::BARK + tree.seed as u16 % 3 * 3;
    let mut script = Script::new(KINDS[tree.fir as usize + 2 * far as usize], [bark as f32, 0.0]);
    build(mesh, &mut script, &BODIES, tree.foot, tree.height, tree.seed);
    mesh.weather(first, 0.08 * tree.height, 4.0 / tree.height);
}

/// In which direction tree `seed` stands, turns from east by south.
fn around(seed: u32) -> f32 {
    rnd(STREAM, seed, 0)
}

/// The trees around the middle: in groves, and a few alone.
pub fn trees() -> Vec<Tree> {
    const TRIED: u32 = 4500;
    let mut trees = Vec::new();
    for seed in 0..TRIED {
        let [b, c, d, e] = [1, 2, 3, 4].map(|k| rnd(STREAM, seed, k));
        // Denser near the middle, where they count.
        let (sin, cos) = (TAU * around(seed)).sin_cos();
        let r = 24.0 + 700.0 * b * b.sqrt();
        let (x, z) = (r * cos, r * sin);
        let y = height(x, z);
        let wanted = wooded(x, z) > 0.1 * c || d < 0.008;
        if wanted && y > land::WATER + 1.0 {
            // Firs on the heights.
            let fir = e < 0.45 + 0.02 * y;
            trees.push(Tree {
                foot: vec3(x, y, z),
                height: if fir { 9.0 + 8.0 * c } else { 7.0 + 4.0 * c },
                seed,
                fir,
            });
        }
    }
    trees
}

/// The woods in patches around the middle, flat: near trees, then far ones.
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
