//! Cumulus clouds in the evening, as voxels.
//!
//! A formula of puffs and noise fills a cube with density. One sweep through it finds how much of the sun's light comes to
//! each voxel; rays from the eye then step through it and gather the light that is scattered towards them [Kajiya84].
//! Beer's law says how much is left of the sky behind, which is computed from the date, and lights the clouds as well.

use fearless_simd::dispatch;
use glam::{Mat3A, Vec3A};
use paprsek::cloud::{CloudField, CloudKind, CloudLayer, CloudLight, sunlight};
use paprsek::frame::{Frame, Layer, Picture, Renderer, encode::Transfer};
use paprsek::raster::{RasterLayer, World};
use paprsek::sky::{Dome, Place, Sky, SkyLayer, time};
use paprsek::{settings::Quality, view::Camera};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(0.0, &Quality::DEFAULT, (1280, 720));
    let dome = Dome::new(Sky::new(time::days(2026, 6, 21) + 18.2 / 24.0, &Place::PLZEN), &spec.quality.sky);
    let (now, level, extinction) = (dome.lighting(), renderer.level(), 30.0);
    let shapes = [0, 1, 2, 3].map(|seed| {
        let mut voxels = dispatch!(level, simd => CloudKind::grow(simd, &CloudKind::CUMULUS, seed, 128));
        dispatch!(level, simd => sunlight::bake(simd, &mut voxels, now.direction, extinction));
        voxels.into()
    });
    let (size, eye) = ([400.0, 500.0], Vec3A::Y * 700.0);
    let field = CloudField { seed: 7, spacing: 1500.0, share: 0.5, height: 900.0, size, range: 20e3, extinction };
    let clouds = field.around(eye, 0.0, &shapes);
    let ambient = [now.ground * 0.5 + now.sky * 0.4, now.sky * 0.85];
    let light = CloudLight { ambient, towards: now.direction, sun: now.color * 0.75, phase: [0.8, 0.8] };
    let ahead = Mat3A::from_rotation_y(-0.9) * now.direction.with_y(0.0) + Vec3A::Y * 0.29;
    let view = spec.view(Camera::look_at(eye, eye + ahead, 46f32.to_radians(), 0.0));
    let seen = CloudLayer::new(clouds.clone(), light, &view, &spec.quality.cloud).shaded_by(&clouds);
    let ground = Box::new(RasterLayer::new(World::new(Vec::new()), &view, &spec.quality.raster));
    let sky = Box::new(SkyLayer::new(dome, &view, &spec.quality.sky).behind());
    let layers: Vec<Box<dyn Layer>> = vec![ground, Box::new(seen.in_air(9e3, |d| dome.radiance(d))), sky];
    renderer.draw(Picture { layers, transfer: Transfer::Srgb }, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/cloud.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
