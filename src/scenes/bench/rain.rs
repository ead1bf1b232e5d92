//! Rain over the land of `day`, from the flakes' own code: drops that draw streaks, also for whoever looks up.

use crate::frame::Picture;
use crate::frame::{FrameSpec, Scene};
use crate::particles::{Flakes, Lens, ParticleLayer, Snow};
use crate::scenes::show::day;
use crate::timeline::ease;
use crate::view::Camera;
use crate::view::View;
use glam::{DVec3, Mat3, Vec3, vec3};

/// The scene.
pub const RAIN: Scene =
    Scene { name: "rain", about: "a shower in autumn, looking ahead and up", duration: 20.0, parameters: &[], picture };

const DROPS: Flakes = Flakes {
    seed: 6,
    count: 120_000,
    extent: vec3(30.0, 16.0, 30.0),
    reach: 15.0,
    opacity: 1.0,
    fall: [6.0, 3.0],
    sway: [0.0, 0.0],
    pace: [0.0, 0.0],
    radius: [0.004, 0.005],
    by: 3,
    lens: Lens { radius: [0.6, 4.0], near: [0.3, 1.5], streaks: true, ..Lens::SHARP },
};

/// Seconds that the shutter is open.
const SHUTTER: f32 = 0.012;

fn picture(spec: &FrameSpec) -> Picture {
    let t = spec.time;
    // Ahead, then up to the zenith and back.
    let up = ease(4.0, 9.0, t) * (1.0 - ease(14.0, 19.0, t));
    let (sin, cos) = (1.55 * up).sin_cos();
    let eye = vec3(14.0, 12.0, 34.0 - 0.8 * t as f32);
    let camera = spec.camera(Camera::look_at(eye, eye + vec3(-0.35 * cos, sin, -cos), 1.0, 0.0));
    let view = View::new(camera, spec.width, spec.height);
    let dome = day::sky(spec, 9671.5 + 86.0 + 9.0 / 24.0);
    let mut world = day::world(&dome, day::plan(1, 0.0).2, Mat3::IDENTITY, Vec3::new(0.0, -900.0, 0.0), t);
    let sky = dome.lighting().sky;
    world.lights.clear();
    let wind = vec3(1.8, 0.0, 0.9);
    // In gusts, from drizzle to a shower and back.
    let way = wind.as_dvec3() * t + DVec3::X * (1.5 * (t / 1.5).sin());
    let mut rain = Snow::new(&DROPS, t, camera.eye.as_dvec3(), way, 0.3 + 0.7 * ease(0.0, 6.0, t));
    rain.streak = (wind - Vec3::Y * DROPS.fall[0] as f32) * (0.5 * SHUTTER);
    let rain = ParticleLayer::new([rain], &view, &spec.quality.particles).colored(sky * 1.6);
    let mut picture = day::show(spec, dome, world, view, None);
    picture.layers.push(Box::new(rain));
    picture
}
