//! The set of the bench scenes `shadow` and `shadow-cube`, as specified for every renderer that is compared.
//!
//! 9984 triangles: a smooth field of snow from noise, 64 boxes and 64 pines at random places; and how the eye and the
//! two lights move.

use crate::angle;
use crate::noise::{fbm, noise};
use crate::raster::form::Rings;
use crate::raster::{Face, Mesh, Paint};
use crate::simd::hash::rnd;
use glam::{DVec3, Mat3A, Vec3A, dvec3, vec3a};
use std::f64::consts::TAU;

/// Height of the ground at a place, metres. It is computed in f64 but for the noise, whose own error is below 4e-7.
pub fn height(x: f64, z: f64) -> f64 {
    let rolling = fbm(dvec3(0.055 * x + 3.7, 0.5, 0.055 * z + 8.1).as_vec3a(), 4);
    2.2 * rolling as f64 + 0.35 * noise(dvec3(0.31 * x, 2.5, 0.31 * z).as_vec3a()) as f64
}

/// Where the camera is at `time` seconds; it looks at (0, 0.5, 0).
pub fn eye(time: f64) -> DVec3 {
    let (sin, cos) = (0.2 * time).sin_cos();
    dvec3(21.0 * sin, 8.0, 21.0 * cos)
}

/// The direction to the sun at `time` seconds, as specified.
pub fn sun(time: f64) -> DVec3 {
    sun_at(0.15 * time, 0.62)
}

/// The direction to a sun by its azimuth, radians from east towards south, and the tangent of its altitude.
pub fn sun_at(azimuth: f64, slope: f64) -> DVec3 {
    let (sin, cos) = azimuth.sin_cos();
    dvec3(cos, slope, sin).normalize()
}

/// Where the torch is at `time` seconds, as specified.
pub fn torch(time: f64) -> DVec3 {
    torch_at(0.5 * time, 5.0, 2.6)
}

/// Where a torch is by its azimuth, radians from east towards south, its distance from the middle, and its height above
/// the ground, metres.
pub fn torch_at(azimuth: f64, radius: f64, above: f64) -> DVec3 {
    let (sin, cos) = azimuth.sin_cos();
    let (x, z) = (radius * cos, radius * sin);
    dvec3(x, height(x, z) + above, z)
}

/// The set: four smooth strips of ground from south to north, the boxes, and four groves of pines, flat.
pub fn meshes() -> Vec<Mesh> {
    let mut meshes: Vec<Mesh> = (0..4).rev().map(|i| ground(12 * i)).collect();
    let mut boxes = Mesh::default();
    for i in 0..64 {
        add_box(&mut boxes, i);
    }
    meshes.push(boxes);
    for grove in 4..8 {
        let mut pines = Mesh::default();
        for i in 16 * grove..16 * grove + 16 {
            add_pine(&mut pines, i);
        }
        meshes.push(pines);
    }
    meshes
}

/// The strip of 12 rows of cells whose northern border is row `first` of points.
fn ground(first: i32) -> Mesh {
    const STEP: f64 = 0.05;
    let mut mesh = Mesh::painted(&[paint(0.82, 0.85, 0.90)]);
    // From south to north, so that cells are halved between their south-western and north-eastern corners.
    for j in (first..=first + 12).rev() {
        for i in 0..=48 {
            let (x, z) = ((i - 24) as f64, (j - 24) as f64);
            let slope = |dx: f64, dz: f64| height(x - dx, z - dz) - height(x + dx, z + dz);
            mesh.points.push(dvec3(x, height(x, z), z).as_vec3a());
            mesh.normals.push(dvec3(slope(STEP, 0.0), 2.0 * STEP, slope(0.0, STEP)).normalize().as_vec3a());
        }
    }
    mesh.loft(0, 49, 0, &[]);
    mesh
}

fn paint(red: f32, green: f32, blue: f32) -> Paint {
    Paint { albedo: vec3a(red, green, blue), texture: None, gloss: 0.0 }
}

/// Random number `k` of object `i`.
fn random(i: u32, k: u32) -> f32 {
    rnd(2, i, k)
}

/// The place on the ground where object `i` stands.
fn place(i: u32) -> Vec3A {
    let [x, z] = [0, 1].map(|k| 44.0 * (random(i, k) as f64 - 0.5));
    dvec3(x, height(x, z), z).as_vec3a()
}

/// The turn of object `i` about y.
fn turn(i: u32) -> Mat3A {
    angle::turn_y((TAU * random(i, 5) as f64) as f32)
}

/// Adds box `i`. Its sides are halved along the diagonals that the specification says, which [`Mesh::block`] does not
/// do.
fn add_box(mesh: &mut Mesh, i: u32) {
    let half = vec3a(0.3 + 0.6 * random(i, 2), 0.3 + 1.1 * random(i, 3), 0.3 + 0.6 * random(i, 4));
    let middle = place(i) + Vec3A::Y * (half.y - 0.2);
    let (first, kind, turn) = (mesh.points.len() as u16, mesh.paints.len() as u16, turn(i));
    for k in 0..8 {
        let side = |bit: u32| if k & bit == 0 { -1.0 } else { 1.0 };
        mesh.points.push(middle + turn * (half * vec3a(side(1), side(2), side(4))));
    }
    for k in 0..6 {
        // Both directions across the axis, in the order that turns the side outwards.
        let (axis, up) = (k / 2, k & 1);
        let (u, v) = (1 << ((axis + 2 - up) % 3), 1 << ((axis + 1 + up) % 3));
        let w = first + (up << axis);
        for corners in [[w, w + u, w + u + v], [w, w + u + v, w + v]] {
            mesh.faces.push(Face { corners, paint: kind });
        }
    }
    mesh.paints.push(paint(0.42 + 0.2 * random(i, 6), 0.30, 0.22));
}

const fn round(rows: &'static [[i8; 5]], sides: u8) -> Rings {
    Rings { rows, sides, half: false, swell: 0.0, taper: 0.0 }
}

/// The bodies of a pine and their units, metres: the trunk, in fiftieths, and three cones, in twentieths.
const PINE: [(f32, Rings); 4] = [
    (0.02, round(&[[-15, 0, 7, 7, 0], [35, 0, 7, 7, 0]], 6)),
    (0.05, round(&[[12, 0, 0, 0, 0x11], [12, 0, 20, 20, 0x11], [38, 0, 0, 0, 0x11]], 10)),
    (0.05, round(&[[27, 0, 0, 0, 0x11], [27, 0, 16, 16, 0x11], [52, 0, 0, 0, 0x11]], 10)),
    (0.05, round(&[[42, 0, 0, 0, 0x11], [42, 0, 11, 11, 0x11], [66, 0, 0, 0, 0x11]], 10)),
];

fn add_pine(mesh: &mut Mesh, i: u32) {
    let first = mesh.paints.len() as u16;
    for (scale, body) in &PINE {
        mesh.rings(body, &(turn(i) * (scale * (0.7 + 0.9 * random(i, 2)))), place(i), first);
    }
    mesh.paints.push(paint(0.25, 0.16, 0.10));
    mesh.paints.push(paint(0.10, 0.26 + 0.12 * random(i, 6), 0.13));
}
