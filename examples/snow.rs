//! A snowman of traced balls in falling snow.
//!
//! No flake is stored: where flake number n is follows from n and the time alone, by a hash, so any frame can be drawn
//! without those before it. Flakes fall and sway, and are wrapped into a box around the eye. Each becomes a soft disc,
//! or a crystal close by [Reeves83]; what stands nearer to the eye hides it by its depth.

use glam::{Vec3A, dvec3, vec3a};
use paprsek::frame::{Frame, Picture, Renderer, encode::Transfer};
use paprsek::particles::{Flakes, Lens, ParticleLayer, Snow};
use paprsek::scenes::bench::particles::FLAKES;
use paprsek::settings::Quality;
use paprsek::trace::{Background, Light, Material, Object, Shape, TraceLayer, World};
use paprsek::view::Camera;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(12.0, &Quality::REFERENCE, (1280, 720));
    let ball = |x, y, z, radius, material| Object::new(Shape::Sphere { center: vec3a(x, y, z), radius }, material);
    let [white, coal, carrot] =
        [vec3a(0.85, 0.87, 0.9), Vec3A::splat(0.02), vec3a(0.8, 0.25, 0.03)].map(Material::plain);
    let mut objects = vec![Object::new(Shape::Plane { normal: Vec3A::Y, offset: 0.0 }, white).without_shadow()];
    objects.extend([(0.6, 0.75), (1.6, 0.55), (2.4, 0.38)].map(|(y, radius)| ball(0.0, y, 0.0, radius, white)));
    objects.extend([-0.13, 0.13].map(|x| ball(x, 2.52, 0.33, 0.05, coal)));
    objects.extend([1.4, 1.65, 1.85].map(|y| ball(0.0, y, 0.53, 0.05, coal)));
    objects.extend([0.0, 1.0, 2.0, 3.0].map(|k| ball(0.03 * k, 2.4, 0.38 + 0.07 * k, 0.07 - 0.014 * k, carrot)));
    let lamp = Light::point(vec3a(-3.0, 3.4, 3.0), vec3a(1.0, 0.66, 0.36)).with_radius(0.3);
    let dusk = vec3a(0.20, 0.26, 0.40);
    let (lights, background) = (vec![lamp], Background::gradient(dusk, dusk * 0.4));
    let world = World { objects, lights, ambient: dusk * 0.95, background, ..World::EMPTY };
    let camera = Camera::look_at(vec3a(1.2, 1.5, 6.2), vec3a(0.8, 1.45, 0.0), 34f32.to_radians(), 0.0);
    let lens = Lens { aperture: 0.012, focus: 6.0, crystals: true, ..FLAKES.lens };
    let flakes = Flakes { radius: [0.009, 0.016], lens, ..FLAKES };
    let flakes = Snow::new(&flakes, spec.time, camera.eye.as_dvec3(), dvec3(9.6, 0.0, 4.2), 0.5);
    let solids = TraceLayer::new(world, &spec.view(camera), &spec.quality.trace);
    let flakes =
        ParticleLayer::new(vec![flakes.into()], &spec.view(camera), &spec.quality.particles).colored(dusk * 2.2);
    renderer.draw(Picture { layers: vec![Box::new(solids), Box::new(flakes)], transfer: Transfer::Srgb }, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/snow.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
