//! A cumulus in the evening, as voxels.
//!
//! A formula of puffs and noise fills a cube with density. One sweep through the cube finds how much of the sun's light comes
//! to each voxel [Kajiya84]; rays from the eye then step through it, gather the light that each voxel scatters towards them,
//! and let through what Beer's law leaves of the sky behind. The sky is computed, and lights the cloud as well.

use fearless_simd::dispatch;
use glam::{Vec3, vec3};
use paprsek::cloud::{Cloud, CloudKind, CloudLayer, CloudLight, sunlight};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::raster::{self, RasterLayer};
use paprsek::settings::Quality;
use paprsek::sky::{Dome, Place, Sky, SkyLayer, time};
use paprsek::view::Camera;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(0.0, &Quality::REFERENCE, (1280, 720));
    let dome = Dome::new(Sky::new(time::days(2026, 6, 21) + 17.9 / 24.0, &Place::PLZEN), &spec.quality.sky);
    let light = dome.lighting();
    let (level, extinction) = (renderer.level(), 30.0);
    let mut voxels = dispatch!(level, simd => CloudKind::grow(simd, &CloudKind::CONGESTUS, 5, 128));
    dispatch!(level, simd => sunlight::bake(simd, &mut voxels, light.direction, extinction));
    let cloud = Cloud { voxels: voxels.into(), centre: vec3(0.0, 1100.0, 0.0), size: 900.0, extinction };
    let light = CloudLight {
        ambient: [light.ground * 0.5 + light.sky * 0.4, light.sky * 0.85],
        towards: light.direction,
        sun: light.color * 0.75,
        phase: [0.8, 0.8],
    };
    let view = spec.view(Camera::look_at(vec3(600.0, 250.0, 2900.0), vec3(0.0, 900.0, 0.0), 40f32.to_radians(), 0.0));
    let clouds = CloudLayer::new(vec![cloud], light, &view, &spec.quality.cloud).in_air(30e3, |d| dome.radiance(d));
    let ground = RasterLayer::new(raster::World::new(Vec::new()), &view, &spec.quality.raster);
    let sky = SkyLayer::new(dome, &view, &spec.quality.sky).behind();
    renderer.draw(
        Picture { layers: vec![Box::new(ground), Box::new(clouds), Box::new(sky)], transfer: Transfer::Srgb },
        &mut frame,
    );
    let path = std::env::args().nth(1).unwrap_or("target/cloud.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
