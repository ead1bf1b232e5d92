//! A ring of stones at sunrise: triangles, and shadows by depth maps.
//!
//! The scene is first drawn as the sun sees it, which leaves the depth of what light meets first [Williams78]. A point in
//! view is lit where nothing in that map is nearer to the sun. Four maps share the view, the finest for what is close to
//! the eye [Valient08]; nine weighted texels around each lookup make the edges smooth [Reeves87].

use glam::{Affine3A, Mat3A, Vec3A, vec3, vec3a};
use paprsek::frame::{Frame, Picture, Renderer, encode::Transfer};
use paprsek::raster::{Bias, Body, Haze, Light, Mesh, Paint, RasterLayer, ShadowViews, World, fit};
use paprsek::sky::{Dome, Place, Sky, SkyLayer, time};
use paprsek::texture::{Palette, Pattern, Texture};
use paprsek::{settings::Quality, view::Camera};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(0.0, &Quality::DEFAULT, (1280, 720));
    let paints = [vec3a(0.13, 0.17, 0.05), vec3a(0.34, 0.31, 0.28)];
    let mut mesh = Mesh::painted(&paints.map(|albedo| Paint { albedo, texture: Some(0), gloss: 0.0 }));
    mesh.block(&Mat3A::from_diagonal(vec3(900.0, 1.0, 900.0)), Vec3A::NEG_Y, 0);
    for i in 0..24 {
        let turn = Mat3A::from_rotation_y(i as f32 / 24.0 * std::f32::consts::TAU);
        let (half, y) = if i % 2 == 0 { (vec3(0.9, 2.1, 0.5), 2.1) } else { (vec3(2.6, 0.4, 0.55), 4.5) };
        mesh.block(&(turn * Mat3A::from_diagonal(half)), turn * vec3a(0.0, y, 10.0), 1);
    }
    mesh.weather(8, 0.25, 0.7);
    let dome = Dome::new(Sky::new(time::days(2026, 6, 21) + 4.3 / 24.0, &Place::PLZEN), &spec.quality.sky);
    let (now, bodies) = (dome.lighting(), vec![Body::new(mesh.into(), Affine3A::IDENTITY)]);
    let camera = Camera::look_at(vec3a(-21.0, 3.2, 4.0), vec3a(0.0, 2.6, 1.0), 44f32.to_radians(), 0.0);
    let maps = fit::cascades(&camera, 16.0 / 9.0, now.direction, &[16.0, 28.0, 50.0, 400.0], 2048);
    let shadow = ShadowViews::new(maps, Bias { constant: 0.02, slope: 1.0, normal: 1.0 });
    let lights = vec![Light::sun(now.direction, now.color).with_shadow(shadow)];
    let haze = Haze::even(dome.radiance(camera.forward.with_y(0.05).normalize()), 0.004);
    let textures =
        vec![Texture::new(Pattern::Clouds { octaves: 5 }, Palette::Mix(Vec3A::ZERO, Vec3A::splat(2.0)), 4.0)];
    let world = World { lights, ambient: [now.sky * 0.5; 2], haze, textures, film: true, ..World::new(bodies) };
    let stones = RasterLayer::new(world, &spec.view(camera), &spec.quality.raster);
    let sky = SkyLayer::new(dome, &spec.view(camera), &spec.quality.sky).behind();
    renderer.draw(Picture { layers: vec![Box::new(stones), Box::new(sky)], transfer: Transfer::Srgb }, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/shadow.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
