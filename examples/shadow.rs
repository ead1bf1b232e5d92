//! A ring of stones at sunrise, drawn as triangles with shadow maps.
//!
//! First the scene is drawn as the sun sees it, which keeps the depth of what the light meets first [Williams78]. A point in
//! view is lit if nothing in that map is nearer to the sun. Four maps share the view, the finest for what is close to the
//! eye; nine texels are weighted around each lookup, so that the edges of shadows are smooth [Reeves87].

use glam::{Affine3A, Mat3, Vec3, vec3};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::raster::{Bias, Body, Haze, Light, Mesh, Paint, RasterLayer, ShadowViews, World, fit};
use paprsek::settings::Quality;
use paprsek::view::Camera;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(0.0, &Quality::REFERENCE, (1280, 720));
    let paint = |albedo| Paint { albedo, texture: None, gloss: 0.0 };
    let mut mesh = Mesh::painted(&[paint(vec3(0.30, 0.36, 0.12)), paint(vec3(0.52, 0.47, 0.42))]);
    mesh.block(&Mat3::from_diagonal(vec3(400.0, 1.0, 400.0)), Vec3::NEG_Y, 0);
    let first = mesh.points.len();
    for i in 0..24 {
        let turn = Mat3::from_rotation_y(i as f32 / 24.0 * std::f32::consts::TAU);
        let (half, y) = if i % 2 == 0 { (vec3(0.9, 2.1, 0.5), 2.1) } else { (vec3(2.6, 0.4, 0.55), 4.6) };
        mesh.block(&(turn * Mat3::from_diagonal(half)), turn * vec3(0.0, y, 10.0), 1);
    }
    mesh.weather(first, 0.25, 0.7);
    let sun = vec3(-0.55, 0.22, -0.8).normalize();
    let camera = Camera::look_at(vec3(3.0, 2.4, 21.0), vec3(-0.5, 2.3, 0.0), 42f32.to_radians(), 0.0);
    let maps = fit::cascades(&camera, 16.0 / 9.0, sun, &[14.0, 24.0, 45.0, 400.0], 2048);
    let shadow = ShadowViews::new(maps, Bias { constant: 0.02, slope: 1.0, normal: 1.0 });
    let world = World {
        lights: vec![Light::sun(sun, vec3(2.6, 1.7, 0.95)).with_shadow(shadow)],
        ambient: [vec3(0.20, 0.24, 0.36), vec3(0.06, 0.08, 0.14)],
        haze: Haze { glow: (sun, vec3(0.45, 0.2, 0.02)), ..Haze::even(vec3(0.5, 0.45, 0.45), 0.012) },
        film: true,
        background: Some(vec3(0.5, 0.45, 0.45)),
        ..World::new(vec![Body::new(mesh.into(), Affine3A::IDENTITY)])
    };
    let layer = RasterLayer::new(world, &spec.view(camera), &spec.quality.raster);
    renderer.draw(Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/shadow.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
