//! A snowman of traced balls in falling snow.
//!
//! No flake is stored: where flake number n is now follows from n and the time alone, by a hash [Reeves83], so any frame can be
//! drawn without those before it. Flakes fall, sway, and are wrapped into a box around the eye. Each becomes a soft disc, a
//! streak where it falls close by, and what stands nearer hides it by its depth.

use glam::{Vec3, dvec3, vec3};
use paprsek::effects::{Fog, FogLayer};
use paprsek::frame::encode::Transfer;
use paprsek::frame::{Frame, Picture, Renderer};
use paprsek::particles::{Flakes, Lens, ParticleLayer, Snow};
use paprsek::settings::Quality;
use paprsek::texture::{Palette, Pattern, Texture};
use paprsek::trace::{Background, Light, Material, Object, Shape, TraceLayer, World};
use paprsek::view::Camera;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(12.0, &Quality::REFERENCE, (1280, 720));
    let packed =
        Texture::new(Pattern::Clouds { octaves: 4 }, Palette::Mix(vec3(0.62, 0.66, 0.74), vec3(0.98, 0.98, 1.0)), 2.5);
    let ball = |center: Vec3, radius, material| Object::new(Shape::Sphere { center, radius }, material);
    let (snow, coal) = (Material::matte(packed), Material::plain(Vec3::splat(0.015)).shiny(0.4, 30.0));
    let mut objects = vec![Object::new(Shape::Plane { normal: Vec3::Y, offset: 0.0 }, snow).without_shadow()];
    objects.extend([(0.55, 0.75), (1.62, 0.55), (2.45, 0.38)].map(|(y, radius)| ball(vec3(0.0, y, 0.0), radius, snow)));
    objects.extend(
        [(-0.13, 2.55), (0.13, 2.55), (0.0, 1.85), (0.0, 1.6)]
            .map(|(x, y)| ball(vec3(x, y, if y > 2.0 { 0.34 } else { 0.53 }), 0.05, coal)),
    );
    objects.extend([0, 1, 2, 3, 4].map(|k| {
        ball(
            vec3(0.03 * k as f32, 2.44, 0.38 + 0.07 * k as f32),
            0.07 - 0.011 * k as f32,
            Material::plain(vec3(0.8, 0.2, 0.02)),
        )
    }));
    let dusk = vec3(0.20, 0.26, 0.40);
    let lights = vec![
        Light::point(vec3(3.5, 3.2, 3.0), vec3(1.1, 0.72, 0.38)).with_radius(0.3),
        Light::directional(vec3(-0.5, 0.8, -0.2).normalize(), dusk * 0.6).with_radius(0.4),
    ];
    let world = World {
        objects,
        lights,
        ambient: dusk * 0.7,
        background: Background::gradient(dusk, dusk * 0.4),
        ..World::EMPTY
    };
    let camera = Camera::look_at(vec3(1.2, 1.5, 6.2), vec3(0.6, 1.45, 0.0), 34f32.to_radians(), 0.0);
    let view = spec.view(camera);
    let lens =
        Lens { radius: [1.0, 40.0], near: [0.4, 1.0], aperture: 0.012, focus: 6.0, crystals: true, ..Lens::SHARP };
    let flakes = Flakes {
        seed: 3,
        count: 90_000,
        extent: vec3(30.0, 16.0, 30.0),
        reach: 15.0,
        opacity: 0.9,
        fall: [0.8, 0.6],
        sway: [0.1, 0.25],
        pace: [0.8, 0.8],
        radius: [0.009, 0.016],
        by: 3,
        lens,
    };
    let flakes = Snow::new(&flakes, spec.time, camera.eye.as_dvec3(), dvec3(0.8, 0.0, 0.35) * spec.time, 1.0);
    let fog = FogLayer::new(Fog { light: dusk, density: 0.03, end: 1e5 }, &view);
    let solids = TraceLayer::new(world, &view, &spec.quality.trace);
    let flakes = ParticleLayer::new([flakes], &view, &spec.quality.particles).colored(vec3(0.75, 0.78, 0.85));
    let picture = Picture { layers: vec![Box::new(solids), Box::new(fog), Box::new(flakes)], transfer: Transfer::Srgb };
    renderer.draw(picture, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/snow.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
