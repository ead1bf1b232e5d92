//! The sky of an evening, computed from the date.
//!
//! Sun and moon stand where they stand over Plzen at that second [Meeus98]. The light of the sky is that of the sun which air,
//! haze and ozone scatter towards the eye, summed along each direction; how much of it gets so far follows from Chapman's
//! function in closed form [Chapman31]. Eyes adapt to the dusk, so the picture has the exposure that an eye would have.

use glam::Vec3A;
use paprsek::frame::{Frame, Picture, Renderer, encode::Transfer};
use paprsek::settings::Quality;
use paprsek::sky::{Dome, Place, Sky, SkyLayer, time};
use paprsek::view::Camera;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (mut renderer, mut frame) = (Renderer::new(0)?, Frame::new(1280, 720));
    let spec = renderer.spec(0.0, &Quality::DEFAULT, (1280, 720));
    // The young moon of the spring, in the west after sunset. Hours are UT.
    let sky = Sky::new(time::days(2026, 4, 19) + 18.8 / 24.0, &Place::PLZEN);
    let dome = Dome::new(sky, &spec.quality.sky).with_sizes(2.0, 5.0);
    let level = (sky.sun.with_y(0.0).normalize() + sky.moon.with_y(0.0).normalize()).normalize();
    let view = spec.view(Camera::look_at(Vec3A::ZERO, level + Vec3A::Y * 0.32, 36f32.to_radians(), 0.0));
    let layer = SkyLayer::new(dome, &view, &spec.quality.sky);
    renderer.draw(Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb }, &mut frame);
    let path = std::env::args().nth(1).unwrap_or("target/sky.png".into());
    Ok(image::save_buffer(path, &frame.to_rgb(), 1280, 720, image::ColorType::Rgb8)?)
}
