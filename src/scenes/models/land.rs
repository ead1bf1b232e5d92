//! The land: a hill with a chapel in a valley with a lake, woods, and mountains all around.
//!
//! A height field of noise ([`height`]), sampled on rings around the middle. Rings and their points are the farther
//! apart the farther out they are, as only the middle is seen from close by.

use super::paint::{self, PAINTS};
use crate::angle;
use crate::noise::octaves;
use crate::raster::Mesh;
use crate::simd::math::{smooth1, to_f32};
use crate::vector::unit;
use glam::{Mat3A, Vec3A, vec3a};
use std::f32::consts::TAU;

/// Height of the lake, metres.
pub const WATER: f32 = -9.5;

/// Radius of the land, metres.
pub const EDGE: f32 = 6078.0;

/// Height of the ground at a place, metres.
#[inline(never)]
pub fn height(x: f32, z: f32) -> f32 {
    let p = vec3a(x, 0.3, z);
    let r2 = x * x + z * z;
    let r = r2.sqrt();
    // Distance from the valley's winding middle, metres. The valley opens the mountains to the east and to the west.
    let across = z - 0.2 * x - 130.0 - 140.0 * octaves(p * 0.0035, 1, false);
    let valley = |width: f32| 1.0 / (1.0 + across * across / (width * width));
    let hill = 11.0 / (1.0 + r2 / 3600.0);
    // The ground is even where the chapel stands.
    let calm = r2 / (r2 + 3000.0);
    let rolling = octaves(p * 0.003, 4, false) * (30.0 + 0.06 * r) * calm;
    let rise = smooth1((r - 700.0) / 4200.0) * (1.0 - 0.85 * valley(700.0));
    let ridges = 1.0 - 2.2 * octaves(p * 0.00035 + 7.7, 6, true);
    hill + rolling - 13.0 * valley(45.0) + rise * (250.0 + 1000.0 * ridges)
}

/// The normal of the ground at a place, from differences over `reach` metres.
#[inline(never)]
pub fn normal(x: f32, z: f32, reach: f32) -> Vec3A {
    let y = height(x, z);
    unit(vec3a(y - height(x + reach, z), reach, y - height(x, z + reach)))
}

/// How wooded a place is: above 0 woods grow, below -0.2 are the widest meadows.
pub fn wooded(x: f32, z: f32) -> f32 {
    let p = vec3a(x, 9.1, z);
    // No woods around the chapel, and more of them farther away.
    octaves(p * 0.006, 3, false) - 0.03 - 12.0 / (12.0 + p.length())
}

/// The number of rings of points around the middle.
const RINGS: usize = 73;
/// The first ring that is not meadow, 1 km away. From there on no points are merged.
const DETAILED: usize = 40;
/// The number of points of an outer ring.
const ROUND: usize = 256;
/// The number of parts that each ring is cut into, which are culled one by one.
pub const SECTORS: usize = 16;

/// The ground in patches: smooth, about 24,000 triangles.
///
/// The radius of ring i is `(i / 4)^3` metres, so the strips between rings grow from 1 m to 250 m. Inner rings have
/// fewer points: all have 256, but several of them lie in one place, and the triangles between those vanish. So there
/// are no gaps where the number of points changes.
pub fn ground() -> Vec<Mesh> {
    let mut patches = Vec::new();
    for (from, to) in [(0, DETAILED), (DETAILED, 58), (58, RINGS)] {
        for sector in 0..SECTORS {
            patches.push(patch(from, to, sector * ROUND / SECTORS));
        }
    }
    patches
}

/// A sixteenth of the ground from ring `from` to ring `to`, from point `start` on.
fn patch(from: usize, to: usize, start: usize) -> Mesh {
    const COLUMNS: usize = ROUND / SECTORS + 1;
    let mut mesh = Mesh::painted(&PAINTS);
    for ring in from..to + 1 {
        let step = match ring {
            0..12 => 8,
            12..20 => 4,
            20..DETAILED => 2,
            _ => 1,
        };
        let root = to_f32(ring) * 0.25;
        let r = root * root * root;
        // Rows go outwards, so columns go clockwise seen from above, from east by south.
        for k in start..start + COLUMNS {
            let k = k % ROUND / step * step;
            let (sin, cos) = angle::sin_cos(to_f32(k) * (TAU / to_f32(ROUND)));
            let (x, z) = (r * cos, r * sin);
            mesh.points.push(vec3a(x, height(x, z), z));
            mesh.normals.push(normal(x, z, 0.5 + 0.01 * r));
        }
    }
    let kind = if from < DETAILED { paint::GRASS } else { paint::HEIGHTS };
    mesh.loft(0, COLUMNS, kind, &[]);
    mesh
}

/// The lakes: the upper side of a box as wide as the land, flat-shaded.
pub fn lake() -> Mesh {
    let mut mesh = Mesh::painted(&PAINTS);
    mesh.block(&(Mat3A::IDENTITY * EDGE), Vec3A::Y * (WATER - EDGE), paint::WATER);
    mesh
}
