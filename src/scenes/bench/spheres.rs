//! The bench scenes `spheres`, `spheres-flat` and `spheres-glass`, as specified for every renderer that is compared.
//!
//! Nine spheres on a floor, traced as in thesis A. The parameters' defaults are the specification.

use crate::angle;
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Parameter, Picture, Scene};
use crate::scenes::single::traced;
use crate::texture::{Palette, Pattern, Texture};
use crate::trace::{Background, Light, Material, Object, Shape, World};
use crate::view::Camera;
use glam::{Vec3A, vec3a};
use std::f64::consts::TAU;

/// With noise textures.
pub const SPHERES: Scene = Scene {
    name: "spheres",
    about: "bench: nine spheres, noise textures",
    duration: 20.0,
    parameters: &[BODIES, DEPTH, TEXTURES, GLASS],
    picture: |spec| picture(spec, &DEPTH, &TEXTURES, &GLASS),
};
/// In plain colours.
pub const SPHERES_FLAT: Scene = Scene {
    name: "spheres-flat",
    about: "bench: the same in plain colours",
    duration: 20.0,
    parameters: &[BODIES, DEPTH, TEXTURES_OFF, GLASS],
    picture: |spec| picture(spec, &DEPTH, &TEXTURES_OFF, &GLASS),
};
/// In plain colours, with a ball of glass.
pub const SPHERES_GLASS: Scene = Scene {
    name: "spheres-glass",
    about: "bench: plain colours, the middle one of glass",
    duration: 20.0,
    parameters: &[BODIES, DEPTH_OF_GLASS, TEXTURES_OFF, GLASS_ON],
    picture: |spec| picture(spec, &DEPTH_OF_GLASS, &TEXTURES_OFF, &GLASS_ON),
};

const BODIES: Parameter = Parameter::new("bodies", "count", (0.0, 64.0), 8.0, "small spheres around the large one");
const DEPTH: Parameter =
    Parameter::new("depth", "count", (1.0, 8.0), 4.0, "the most rays in a path; 1 is the eye's alone");
const DEPTH_OF_GLASS: Parameter = Parameter { default: 6.0, ..DEPTH };
const TEXTURES: Parameter =
    Parameter::new("textures", "count", (0.0, 1.0), 1.0, "1 with noise textures, 0 in plain colours");
const TEXTURES_OFF: Parameter = Parameter { default: 0.0, ..TEXTURES };
const GLASS: Parameter =
    Parameter::new("glass", "count", (0.0, 1.0), 0.0, "1 with a ball of glass in the middle, 0 with a mirror");
const GLASS_ON: Parameter = Parameter { default: 1.0, ..GLASS };

fn picture(spec: &FrameSpec, depth: &Parameter, textures: &Parameter, glass: &Parameter) -> Picture {
    let world = World {
        max_level: spec.get(depth) as u32,
        ..ring(spec.time, spec.get(&BODIES) as u32, spec.get(textures) > 0.0, spec.get(glass) > 0.0)
    };
    traced(spec, world, camera(spec.time), Transfer::Gamma22)
}

/// The camera at `time` seconds.
pub fn camera(time: f64) -> Camera {
    let (sin, cos) = (0.3 * time).sin_cos();
    let eye = vec3a(7.0 * sin as f32, 2.5, 7.0 * cos as f32);
    Camera::look_at(eye, vec3a(0.0, 0.8, 0.0), 50f32.to_radians(), 0.0)
}

/// The world at `time` seconds, as specified.
pub fn world(time: f64, textured: bool, glass: bool) -> World {
    ring(time, BODIES.default as u32, textured, glass)
}

/// The same with `count` small spheres.
fn ring(time: f64, count: u32, textured: bool, glass: bool) -> World {
    let mut objects = Vec::new();
    for i in 0..count {
        let a = i as f64 * (TAU / count as f64) + 0.4 * time;
        let center = vec3a(2.6 * a.cos() as f32, (0.85 + 0.25 * (2.0 * a + time).sin()) as f32, 2.6 * a.sin() as f32);
        let hue = Vec3A::splat(i as f32 / count as f32) + vec3a(0.0, 0.33, 0.67);
        let color = Vec3A::splat(0.55) + (hue * std::f32::consts::TAU).map(|x| angle::sin_cos(x).1) * 0.45;
        let albedo = if textured {
            // C (0.6 + 0.4 fbm4(4 P)), and the field is 1/2 + 1/2 fbm.
            Texture::new(Pattern::Clouds { octaves: 4 }, Palette::Mix(color * 0.2, color), 4.0)
        } else {
            Texture::plain(color * 0.6)
        };
        let material = Material::matte(albedo).polished(0.25, 0.5, 48.0);
        objects.push(Object::new(Shape::Sphere { center, radius: 0.55 }, material));
    }
    let middle = if glass {
        Material::glass(1.5, Vec3A::ONE)
    } else {
        Material::plain(Vec3A::splat(0.1)).polished(0.8, 0.8, 64.0)
    };
    let shape = Shape::Sphere { center: vec3a(0.0, 1.1, 0.0), radius: 1.1 };
    objects.push(Object { shape, material: middle, casts_shadow: !glass });
    let floor = if textured {
        let palette = Palette::Mix(vec3a(0.15, 0.17, 0.2), vec3a(0.9, 0.88, 0.8));
        Texture::new(Pattern::Marble { warp: 8.0, scale: 4.0, octaves: 4 }, palette, 4.0)
    } else {
        Texture::plain(vec3a(0.55, 0.54, 0.5))
    };
    let material = Material::matte(floor).polished(0.15, 0.2, 32.0);
    objects.push(Object::new(Shape::Plane { normal: Vec3A::Y, offset: 0.0 }, material).without_shadow());
    World {
        objects,
        lights: vec![
            Light::point(vec3a(4.0, 6.0, 3.0), vec3a(0.9, 0.85, 0.8)),
            Light::point(vec3a(-5.0, 4.0, -2.0), vec3a(0.35, 0.4, 0.5)),
        ],
        ambient: Vec3A::splat(0.08),
        background: Background::gradient(vec3a(0.75, 0.8, 0.9), vec3a(0.2, 0.35, 0.6)),
        max_level: if glass { DEPTH_OF_GLASS.default } else { DEPTH.default } as u32,
    }
}
