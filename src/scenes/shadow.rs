//! The bench scenes `shadow` and `shadow-cube`, as specified for every renderer that is compared.

use super::{Scene, Shot};
use crate::camera::Camera;
use crate::color::Transfer;
use crate::raster::light::{Haze, Light, Source};
use crate::raster::project::Projection;
use crate::raster::shadow::{Bias, Plan};
use crate::raster::{Body, World};
use crate::tile::Picture;
use glam::{Affine3A, DVec3, Vec2, Vec3, vec3};
use std::sync::{Arc, OnceLock};

/// Under the sun.
pub const SHADOW: Scene =
    Scene { name: "shadow", about: "bench: boxes and pines under the sun, one depth map", duration: 20.0, picture: sun };
/// By torch light.
pub const SHADOW_CUBE: Scene = Scene {
    name: "shadow-cube",
    about: "bench: the same by a torch, a cube of depth maps",
    duration: 20.0,
    picture: torch,
};

/// Texels along an edge of the sun's map and of a face of the torch's.
const SIZES: [u32; 2] = [1024, 512];

fn sun(shot: &Shot) -> Picture {
    let a = 0.15 * shot.time;
    let towards = DVec3::new(a.cos(), 0.62, a.sin()).normalize().as_vec3();
    const WIDTH: f32 = 72.0;
    let plan = Plan {
        views: vec![Projection::parallel(towards, Vec3::ZERO, WIDTH, SIZES[0])],
        // In texels, of which the specification says metres.
        bias: Bias { constant: 0.03, slope: 0.15 * SIZES[0] as f32 / WIDTH, normal: 0.0 },
        back_faces: false,
        smooth: false,
    };
    let light = Light { source: Source::Sun(towards), color: vec3(1.05, 0.92, 0.74), shadow: Some(plan) };
    picture(shot, light, vec3(0.20, 0.27, 0.40), vec3(0.42, 0.55, 0.72))
}

fn torch(shot: &Shot) -> Picture {
    let (sin, cos) = (0.5 * shot.time).sin_cos();
    let (x, z) = (5.0 * cos, 5.0 * sin);
    let position = vec3(x as f32, height(x, z) as f32 + 2.6, z as f32);
    let plan = Plan {
        views: (0..6).map(|face| Projection::face(face, position, SIZES[1])).collect(),
        bias: Bias { constant: 0.03, slope: 2.12, normal: 0.0 },
        back_faces: false,
        smooth: false,
    };
    let source = Source::Lamp { position, falloff: Vec2::new(0.0, 0.06), reach: f32::INFINITY };
    let light = Light { source, color: vec3(2.6, 1.35, 0.5), shadow: Some(plan) };
    picture(shot, light, vec3(0.020, 0.028, 0.055), vec3(0.010, 0.014, 0.030))
}

/// The set under one light.
fn picture(shot: &Shot, light: Light, ambient: Vec3, fog: Vec3) -> Picture {
    static BODIES: OnceLock<Vec<Body>> = OnceLock::new();
    let (sin, cos) = (0.2 * shot.time).sin_cos();
    let eye = vec3(21.0 * sin as f32, 8.0, 21.0 * cos as f32);
    let camera = Camera::look_at(eye, vec3(0.0, 0.5, 0.0), 50f32.to_radians(), 0.0);
    let world = World {
        bodies: BODIES.get_or_init(set).clone(),
        textures: Vec::new(),
        lights: vec![light],
        ambient: [ambient * 0.6, ambient * 0.4],
        haze: Haze { color: fog, density: 0.012, glow: (Vec3::Y, Vec3::ZERO) },
        background: Some(fog),
    };
    shot.drawn(world, camera, Transfer::Gamma22)
}
fn height(_x: f64, _z: f64) -> f64 { 0.0 }
fn set() -> Vec<Body> {
    use crate::raster::mesh::{Face, Mesh, Paint};
    let bytes = std::fs::read("/tmp/mesh.bin").unwrap();
    let f: Vec<f32> = bytes.chunks(4).map(|c| f32::from_le_bytes(c.try_into().unwrap())).collect();
    let tris: Vec<&[f32]> = f.chunks(27).collect();
    tris.chunks(600).map(|tris| {
        let mut m = Mesh::default();
        for t in tris {
            let base = m.points.len() as u16;
            for v in t.chunks(9) { m.points.push(vec3(v[0], v[1], v[2])); m.normals.push(vec3(v[3], v[4], v[5])); }
            m.faces.push(Face { corners: [base, base + 1, base + 2], paint: m.paints.len() as u16 });
            m.paints.push(Paint { albedo: vec3(t[6], t[7], t[8]), texture: None });
        }
        Body { mesh: Arc::new(m), place: Affine3A::IDENTITY, casts_shadow: true }
    }).collect()
}
