//! The bench scenes `shadow` and `shadow-cube`, as specified for every renderer that is compared.

use super::shadow_set;
use crate::frame::Picture;
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Scene};
use crate::raster::{Bias, Body, Haze, Light, Projection, ShadowViews, World, fit};
use crate::scenes::drawn;
use crate::view::Camera;
use glam::{Affine3A, Vec2, Vec3, vec3};
use std::sync::{Arc, OnceLock};

/// Under the sun.
pub const SHADOW: Scene = Scene {
    name: "shadow",
    about: "bench: boxes and pines under the sun, one depth map",
    duration: 20.0,
    parameters: &[],
    picture: sun,
};
/// By torch light.
pub const SHADOW_CUBE: Scene = Scene {
    name: "shadow-cube",
    about: "bench: the same by a torch, a cube of depth maps",
    duration: 20.0,
    parameters: &[],
    picture: torch,
};

/// Texels along an edge of the sun's map and of a face of the torch's.
const SIZES: [u32; 2] = [1024, 512];

fn sun(spec: &FrameSpec) -> Picture {
    let towards = shadow_set::sun(spec.time).as_vec3();
    const WIDTH: f32 = 72.0;
    let views = vec![Projection::parallel(towards, Vec3::ZERO, WIDTH, SIZES[0])];
    // In texels, of which the specification says metres.
    let bias = Bias { constant: 0.03, slope: 0.15 * SIZES[0] as f32 / WIDTH, normal: 0.0 };
    let shadow = ShadowViews { smooth: false, ..ShadowViews::new(views, bias) };
    let light = Light::sun(towards, vec3(1.05, 0.92, 0.74)).with_shadow(shadow);
    picture(spec, light, vec3(0.20, 0.27, 0.40), vec3(0.42, 0.55, 0.72))
}

fn torch(spec: &FrameSpec) -> Picture {
    let position = shadow_set::torch(spec.time).as_vec3();
    let bias = Bias { constant: 0.03, slope: 2.12, normal: 0.0 };
    let shadow = ShadowViews { smooth: false, ..ShadowViews::new(fit::cube(position, SIZES[1]), bias) };
    let light = Light::lamp(position, vec3(2.6, 1.35, 0.5), Vec2::new(0.0, 0.06), f32::INFINITY).with_shadow(shadow);
    picture(spec, light, vec3(0.020, 0.028, 0.055), vec3(0.010, 0.014, 0.030))
}

/// The set under one light.
fn picture(spec: &FrameSpec, light: Light, ambient: Vec3, fog: Vec3) -> Picture {
    static BODIES: OnceLock<Vec<Body>> = OnceLock::new();
    let camera = Camera::look_at(shadow_set::eye(spec.time).as_vec3(), vec3(0.0, 0.5, 0.0), 50f32.to_radians(), 0.0);
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

/// The set's bodies, as many at a time as one thread draws.
fn bodies() -> Vec<Body> {
    let body = |mesh| Body::new(Arc::new(mesh), Affine3A::IDENTITY);
    shadow_set::meshes().into_iter().map(body).collect()
}
