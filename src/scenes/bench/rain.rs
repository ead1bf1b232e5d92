//! The scene `rain`: a shower over the valley in autumn.
//!
//! Thesis C leaves rain open, since its drops are sprites that lie down where one looks up. Here drops are the flakes'
//! own code: what they cover while the shutter is open is drawn as a streak, which is right in every direction of view.

use crate::angle;
use crate::frame::{FrameSpec, Parameter, Picture, Scene};
use crate::particles::{Flakes, Lens, ParticleLayer, Snow};
use crate::scenes::flakes;
use crate::scenes::show::valley::{self, HOUR, LATITUDE, LONGITUDE};
use crate::timeline::ease;
use crate::view::Camera;
use glam::{DVec3, Mat3A, Vec3A, vec3a};

/// The scene.
pub const RAIN: Scene = Scene {
    name: "rain",
    about: "a shower in autumn, looking ahead and up",
    duration: 20.0,
    parameters: &[HEIGHT, RADIUS, COUNT, EAST, SOUTH, FALL, SHARE, SIZE, SHUTTER, DATE, START, LATITUDE, LONGITUDE],
    picture,
};

const HEIGHT: Parameter = flakes::height(16.0, "height of the field");
const RADIUS: Parameter = flakes::radius("radius", 15.0, "radius of the field around the eye");
const COUNT: Parameter = flakes::count("count", 120_000.0, "drops of the field, seen or not");
const EAST: Parameter = flakes::wind("wind-east", 1.8, "wind towards the east, in gusts");
const SOUTH: Parameter = flakes::wind("wind-south", 0.9, "wind towards the south");
const FALL: Parameter = flakes::fall(6.0);
const SHARE: Parameter = flakes::share("how hard it rains, of what the shower would");
const SIZE: Parameter = flakes::size(0.004);
const SHUTTER: Parameter = Parameter::new(
    "shutter",
    "s",
    (0.0, 0.1),
    0.012,
    "time that the shutter is open: drops are as long as their way in it",
);
const DATE: Parameter = Parameter::new("date", "days", (1.0, 366.0), 262.0, "the day's number in the year 2026");
const START: Parameter = Parameter::new("hour", "h", (0.0, 24.0), 10.0, "time of day, UT + 1");

const DROPS: Flakes = Flakes {
    seed: 6,
    count: 120_000,
    extent: vec3a(30.0, 16.0, 30.0),
    reach: 15.0,
    opacity: 1.0,
    fall: [6.0, 3.0],
    sway: [0.0, 0.0],
    pace: [0.0, 0.0],
    radius: [0.004, 0.005],
    by: 3,
    lens: Lens { radius: [0.6, 4.0], near: [0.3, 1.5], streaks: true, ..Lens::SHARP },
};

fn picture(spec: &FrameSpec) -> Picture {
    let t = spec.time;
    // Ahead, then up to the zenith and back.
    let up = ease(4.0, 9.0, t) * (1.0 - ease(14.0, 19.0, t));
    let (sin, cos) = angle::sin_cos(1.55 * up);
    let eye = vec3a(14.0, 12.0, 34.0 - 0.8 * t as f32);
    let view = spec.view(Camera::look_at(eye, eye + vec3a(-0.35 * cos, sin, -cos), 1.0, 0.0));
    let dome = valley::sky(spec, valley::date(spec, &DATE) + (spec.get(&START) - 1.0) * HOUR);
    let mut world = valley::world(&dome, valley::season(1).1, Mat3A::IDENTITY, Vec3A::new(0.0, -900.0, 0.0), t);
    let sky = dome.lighting().sky;
    world.lights.clear();
    let wind = vec3a(spec.get(&EAST) as f32, 0.0, spec.get(&SOUTH) as f32);
    // In gusts, from drizzle to a shower and back.
    let way = wind.as_dvec3() * t + DVec3::X * (1.5 * (t / 1.5).sin());
    let share = (0.3 + 0.7 * ease(0.0, 6.0, t)) * spec.get(&SHARE) as f32;
    let [faster, larger] = [&FALL, &SIZE].map(|parameter| spec.get(parameter) / parameter.default);
    let (height, radius, count) = (spec.get(&HEIGHT), spec.get(&RADIUS), spec.get(&COUNT));
    let drops = flakes::altered(&DROPS, height, radius, count, faster, larger);
    let mut rain = Snow::new(&drops, t, view.camera().eye.as_dvec3(), way, share);
    rain.streak = (wind - Vec3A::Y * drops.fall[0] as f32) * (0.5 * spec.get(&SHUTTER) as f32);
    let rain = ParticleLayer::new(vec![rain.into()], &view, &spec.quality.particles).colored(sky * 1.6);
    let mut picture = valley::show(spec, dome, world, view, None);
    picture.layers.push(Box::new(rain));
    picture
}
