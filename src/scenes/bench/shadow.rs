//! The bench scenes `shadow` and `shadow-cube`, as specified for every renderer that is compared.
//!
//! Shadows by depth maps, after thesis E. The parameters' defaults are the specification.

use super::shadow_set;
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Parameter, Picture, Scene};
use crate::raster::{Bias, Body, Haze, Light, Projection, ShadowViews, World, fit};
use crate::scenes::single::drawn;
use crate::view::Camera;
use glam::{Affine3A, Vec2, Vec3A, vec3a};
use std::sync::{Arc, OnceLock};

/// Under the sun.
pub const SHADOW: Scene = Scene {
    name: "shadow",
    about: "bench: boxes and pines under the sun, one depth map",
    duration: 20.0,
    parameters: &[SPEED, SLOPE, TEXELS],
    picture: sun,
};
/// By torch light.
pub const SHADOW_CUBE: Scene = Scene {
    name: "shadow-cube",
    about: "bench: the same by a torch, a cube of depth maps",
    duration: 20.0,
    parameters: &[TORCH_SPEED, RADIUS, ABOVE, FALLOFF, FACE_TEXELS],
    picture: torch,
};

const SPEED: Parameter = Parameter::new("speed", "rad/s", (-10.0, 10.0), 0.15, "speed at which the sun goes round");
const SLOPE: Parameter = Parameter::new("slope", "1", (0.05, 20.0), 0.62, "tangent of the sun's altitude");
const TEXELS: Parameter = Parameter::new(
    "texels",
    "count",
    (64.0, 4096.0),
    1024.0,
    "texels along an edge of the depth map, rounded up to a multiple of 64",
);
const TORCH_SPEED: Parameter =
    Parameter::new("speed", "rad/s", (-10.0, 10.0), 0.5, "speed at which the torch goes round");
const RADIUS: Parameter = Parameter::new("radius", "m", (0.0, 24.0), 5.0, "radius of the torch's circle");
const ABOVE: Parameter = Parameter::new("height", "m", (0.5, 20.0), 2.6, "height of the torch above the ground");
const FALLOFF: Parameter = Parameter::new(
    "falloff",
    "1/m2",
    (0.001, 1.0),
    0.06,
    "how fast its light fades: 1 / (1 + falloff D^2) at D metres",
);
const FACE_TEXELS: Parameter = Parameter::new(
    "texels",
    "count",
    (64.0, 2048.0),
    512.0,
    "texels along an edge of each of the six depth maps, rounded up to a multiple of 64",
);

fn sun(spec: &FrameSpec) -> Picture {
    let towards = shadow_set::sun_at(spec.get(&SPEED) * spec.time, spec.get(&SLOPE)).as_vec3a();
    let texels = (spec.get(&TEXELS) as u32).next_multiple_of(64);
    const WIDTH: f32 = 72.0;
    let views = vec![Projection::parallel(towards, Vec3A::ZERO, WIDTH, texels)];
    // In texels; the specification has metres.
    let bias = Bias { constant: 0.03, slope: 0.15 * texels as f32 / WIDTH, normal: 0.0 };
    let shadow = ShadowViews { smooth: false, ..ShadowViews::new(views, bias) };
    let light = Light::sun(towards, vec3a(1.05, 0.92, 0.74)).with_shadow(shadow);
    picture(spec, light, vec3a(0.20, 0.27, 0.40), vec3a(0.42, 0.55, 0.72))
}

fn torch(spec: &FrameSpec) -> Picture {
    let position =
        shadow_set::torch_at(spec.get(&TORCH_SPEED) * spec.time, spec.get(&RADIUS), spec.get(&ABOVE)).as_vec3a();
    let texels = (spec.get(&FACE_TEXELS) as u32).next_multiple_of(64);
    let bias = Bias { constant: 0.03, slope: 2.12, normal: 0.0 };
    let shadow = ShadowViews { smooth: false, ..ShadowViews::new(fit::cube(position, texels), bias) };
    let falloff = Vec2::new(0.0, spec.get(&FALLOFF) as f32);
    let light = Light::lamp(position, vec3a(2.6, 1.35, 0.5), falloff, f32::INFINITY).with_shadow(shadow);
    picture(spec, light, vec3a(0.020, 0.028, 0.055), vec3a(0.010, 0.014, 0.030))
}

/// The set under one light.
fn picture(spec: &FrameSpec, light: Light, ambient: Vec3A, fog: Vec3A) -> Picture {
    static BODIES: OnceLock<Vec<Body>> = OnceLock::new();
    let camera = Camera::look_at(shadow_set::eye(spec.time).as_vec3a(), vec3a(0.0, 0.5, 0.0), 50f32.to_radians(), 0.0);
    let world = World {
        lights: vec![light],
        ambient: [ambient * 0.6, ambient * 0.4],
        haze: Haze::even(fog, 0.012),
        zenith: fog,
        background: Some(fog),
        ..World::new(BODIES.get_or_init(bodies).clone())
    };
    drawn(spec, world, camera, Transfer::Gamma22)
}

/// The bodies of the set, one per mesh.
fn bodies() -> Vec<Body> {
    let body = |mesh| Body::new(Arc::new(mesh), Affine3A::IDENTITY);
    shadow_set::meshes().into_iter().map(body).collect()
}
