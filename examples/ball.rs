//! A glass ball by recursive ray tracing [Whitted80].
//!
//! A ray from the eye is tried against every body. Where it meets glass, it splits into a reflected and a refracted ray,
//! whose shares follow from Fresnel's law; a polished surface sends one mirrored ray on. Each hit asks every light, by
//! rays of its own, whether something is in the way. Textures are solid: noise is evaluated at the point that was hit.

use glam::{Vec3A, vec3a};
use paprsek::frame::{Frame, FrameSpec, Picture, Renderer, Scene, encode::Transfer};
use paprsek::settings::Quality;
use paprsek::texture::{Palette, Pattern, Texture};
use paprsek::trace::{Background, Glow, Light, Material, Object, Shape, TraceLayer, World};
use paprsek::view::Camera;

fn picture(spec: &FrameSpec) -> Picture {
    let sun = vec3a(-0.7, 0.5, -0.5).normalize();
    let ball = |x, z, radius, material| Object::new(Shape::Sphere { center: vec3a(x, radius, z), radius }, material);
    let veins = Palette::Mix(vec3a(0.02, 0.10, 0.13), vec3a(0.55, 0.75, 0.70));
    let marble = Texture::new(Pattern::Marble { warp: 7.0, scale: 3.0, octaves: 5 }, veins, 3.0);
    let checks = Texture::new(Pattern::Checker, Palette::Mix(vec3a(0.04, 0.045, 0.06), vec3a(0.62, 0.58, 0.52)), 1.0);
    let red = Texture::plain(vec3a(0.55, 0.06, 0.04));
    let polished = |texture| Material::matte(texture).polished(0.05, 0.5, 80.0).lacquered(0.8);
    let glass = ball(0.0, 0.0, 1.0, Material::glass(1.5, vec3a(0.97, 0.99, 0.98))).without_shadow();
    let floor = Object::new(Shape::Plane { normal: Vec3A::Y, offset: 0.0 }, polished(checks)).without_shadow();
    let objects = vec![glass, ball(-2.1, -1.9, 0.8, polished(marble)), ball(1.9, -1.6, 0.65, polished(red)), floor];
    let lights = vec![Light::directional(sun, vec3a(1.3, 1.0, 0.7)).with_radius(0.03)];
    let glow = Glow { direction: sun, color: vec3a(1.0, 0.55, 0.25), squarings: 3 };
    let background = Background { glow, ..Background::gradient(vec3a(0.75, 0.62, 0.55), vec3a(0.08, 0.16, 0.38)) };
    let world = World { objects, lights, ambient: vec3a(0.10, 0.13, 0.19), background, max_level: 8 };
    let camera = Camera::look_at(vec3a(0.6, 1.35, 5.2), vec3a(0.0, 0.85, 0.0), 38f32.to_radians(), 0.0);
    let layer = TraceLayer::new(world, &spec.view(camera), &spec.quality.trace);
    Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scene = Scene { name: "ball", about: "a glass ball", duration: 1.0, picture, ..Scene::EMPTY };
    let mut frame = Frame::new(1280, 720);
    Renderer::new(0)?.render(&scene, 0.0, &Quality::REFERENCE, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/ball.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
