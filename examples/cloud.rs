//! A cumulus in the evening, as voxels.
//!
//! A formula of puffs and noise fills a cube with density. One sweep through it finds how much of the sun's light comes to
//! each voxel; rays from the eye then step through it and gather the light that is scattered towards them [Kajiya84].
//! Beer's law says how much is left of the sky behind, which is computed from the date, and lights the cloud as well.

use fearless_simd::dispatch;
use glam::vec3;
use paprsek::cloud::{Cloud, CloudKind, CloudLayer, CloudLight, sunlight};
use paprsek::frame::{Frame, Layer, Picture, Renderer, encode::Transfer};
use paprsek::raster::{RasterLayer, World};
use paprsek::settings::Quality;
use paprsek::sky::{Dome, Place, Sky, SkyLayer, time};
use paprsek::view::Camera;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(0.0, &Quality::REFERENCE, (1280, 720));
    let sky = Sky::new(time::days(2026, 6, 21) + 18.2 / 24.0, &Place::PLZEN);
    let dome = Dome::new(sky, &spec.quality.sky);
    let (now, level, extinction) = (dome.lighting(), renderer.level(), 30.0);
    let mut voxels = dispatch!(level, simd => CloudKind::grow(simd, &CloudKind::CONGESTUS, 5, 128));
    dispatch!(level, simd => sunlight::bake(simd, &mut voxels, now.direction, extinction));
    let cloud = Cloud { voxels: voxels.into(), centre: vec3(0.0, 1100.0, 0.0), size: 900.0, extinction };
    let ambient = [now.ground * 0.5 + now.sky * 0.4, now.sky * 0.85];
    let light = CloudLight { ambient, towards: now.direction, sun: now.color * 0.75, phase: [0.8, 0.8] };
    let camera = Camera::look_at(vec3(600.0, 250.0, 2900.0), vec3(0.0, 950.0, 0.0), 40f32.to_radians(), 0.0);
    let view = spec.view(camera);
    let layers: Vec<Box<dyn Layer>> = vec![
        Box::new(RasterLayer::new(World::new(Vec::new()), &view, &spec.quality.raster)),
        Box::new(CloudLayer::new(vec![cloud], light, &view, &spec.quality.cloud).in_air(30e3, |d| dome.radiance(d))),
        Box::new(SkyLayer::new(dome, &view, &spec.quality.sky).behind()),
    ];
    renderer.draw(Picture { layers, transfer: Transfer::Srgb }, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/cloud.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
