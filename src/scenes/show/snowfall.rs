//! A walk to the chapel of `day` at the end of November: it begins to snow, and it gets dark.

use super::day;
use crate::effects::{Fog, FogLayer};
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Scene};
use crate::frame::{Layer, Picture};
use crate::particles::{Calm, Emitter, Flakes, Lens, ParticleLayer, Snow};
use crate::raster::{Bias, Haze, Light, Projection, RasterLayer, ShadowViews, SnowCover};
use crate::scenes::models::land;
use crate::timeline::{self, Key, ease};
use crate::view::Camera;
use crate::view::View;
use glam::{DVec3, Mat3, Vec2, Vec3, vec3};

/// The scene.
pub const SNOWFALL: Scene = Scene {
    name: "snowfall",
    about: "a walk through the first snow, into the dusk",
    duration: LENGTH,
    parameters: &[],
    picture,
}
.part();

/// Seconds that it takes.
pub const LENGTH: f64 = 32.0;

/// The walk: seconds; where, metres; heading, radians from north to east; how far up one looks, radians.
#[rustfmt::skip]
static WALK: [Key<5>; 6] = [
    [0.0, -40.0, 79.5, 0.1, 0.0],
    [5.0, -37.5, 71.0, 0.35, 0.03],
    [9.0, -35.0, 63.5, 0.95, 0.25],
    [12.0, -33.5, 58.5, 1.0, 0.3],
    [18.0, -31.0, 49.5, 0.55, 0.05],
    [32.0, -23.0, 27.0, 0.66, 0.16],
];

/// Flakes around the eye,
const NEAR: Flakes = Flakes {
    seed: 3,
    count: 120_000,
    extent: vec3(30.0, 16.0, 30.0),
    reach: 15.0,
    opacity: 0.9,
    fall: [0.8, 0.6],
    sway: [0.1, 0.25],
    pace: [0.8, 0.8],
    radius: [0.009, 0.016],
    by: 3,
    lens: Lens { radius: [1.0, 64.0], near: [0.3, 0.8], aperture: 0.012, focus: 1.6, crystals: true, ..Lens::SHARP },
};
/// and larger tufts farther off.
static FIELDS: [Flakes; 2] = [
    NEAR,
    Flakes {
        seed: 4,
        count: 160_000,
        extent: vec3(100.0, 40.0, 100.0),
        reach: 50.0,
        radius: [0.03, 0.03],
        lens: Lens { near: [8.0, 16.0], ..NEAR.lens },
        ..NEAR
    },
];

/// What the air does.
#[derive(Clone, Copy, Debug)]
pub struct Weather {
    /// How thick it snows, 0 to 1.
    pub snow: f32,
    /// How fast the wind blows along x and z, metres a second.
    pub wind: Vec2,
    /// How far it has blown since the start, metres.
    pub drift: DVec3,
}

/// The weather at `time` seconds: it begins to snow, in showers, and gusts come with them.
pub fn weather(time: f64) -> Weather {
    let snow = ease(1.0, 12.0, time) * (1.0 - 0.6 * ease(18.0, 29.0, time)) * (0.8 - 0.2 * (0.7 * time).cos() as f32);
    // A gust's way is what its speed sums up to.
    let (sin, cos) = (0.7 * time).sin_cos();
    let way = 1.6 * time - 1.1 / 0.7 * sin;
    let speed = 1.6 - 1.1 * cos as f32;
    Weather { snow, wind: Vec2::new(0.9, -0.45) * speed, drift: DVec3::new(0.9, 0.0, -0.45) * way }
}

fn picture(spec: &FrameSpec) -> Picture {
    let [_, x, z, heading, pitch] = timeline::sample(&WALK, spec.time);
    // A step is 0.85 m.
    let step = 0.025 * (7.4 * z).sin();
    let eye = vec3(x, land::height(x, z) + 1.7 + step, z);
    let (sin, cos) = heading.sin_cos();
    let camera = Camera::look_at(eye, eye + vec3(sin, pitch.tan(), -cos), 0.82, 0.0);
    let camera = spec.camera(camera);
    // The land on 2026-11-28 in autumn's colours. Clouds hide the sky of that day, and its light is put aside.
    let dome = day::sky(spec, 9827.5);
    let textures = day::plan(1, 0.0).2;
    let mut world = day::world(&dome, textures, Mat3::IDENTITY, Vec3::ZERO, 0.0);
    // No aeroplane flies.
    world.bodies.truncate(world.bodies.len() - 2);
    // What is left of the daylight turns blue.
    let dusk = ease(0.0, LENGTH, spec.time);
    let sky = vec3(1.0, 1.04, 1.1) * (vec3(2.8, 2.45, 1.95) * -dusk).exp();
    let amount = 0.04 * (spec.time - 2.0).clamp(0.0, 25.0) as f32;
    // The ground sends on what it gets, and snow the most.
    let ground = 0.15 + 0.65 * amount;
    // Against the wind. Light of a whole sky has soft shadows, so a coarse map is all that there is to know.
    let towards = vec3(-0.3, 1.0, 0.15).normalize();
    let bias = Bias { constant: 0.05, slope: 1.5, normal: 0.5 };
    let views = vec![Projection::parallel(towards, vec3(-15.0, 0.0, 40.0), 512.0, 512)];
    let fall = Light::sun(towards, Vec3::ONE).with_shadow(ShadowViews::new(views, bias));
    if !cfg!(without = "snow-cover") {
        world.snow = Some(SnowCover { amount, fall, sky: sky * 0.6 });
    }
    world.lights.clear();
    world.ambient = [sky * (0.25 + 0.2 * ground), sky * (0.15 - 0.2 * ground)];
    day::lamp(&mut world, ease(20.0, 26.0, spec.time));
    let air = Vec3::ONE - (sky * (0.35 * dusk - 0.8)).exp();
    world.haze = Haze::even(air, 0.0);
    world.zenith = air * 1.2;
    let view = View::new(camera, spec.width, spec.height);
    let air_moves = weather(spec.time);
    let density = 8e-4 + 8e-3 * air_moves.snow;
    let fog = FogLayer::new(Fog { light: air, density, end: 1e5 }, &view);
    let mut fields = Vec::new();
    for flakes in &FIELDS {
        let mut snow = Snow::new(flakes, spec.time, camera.eye.as_dvec3(), air_moves.drift, air_moves.snow);
        snow.calm = Calm { wind: air_moves.wind, height: 1.7, depth: 1.5 };
        fields.push(Emitter::Snow(snow));
    }
    let flakes = ParticleLayer::new(fields, &view, &spec.quality.particles).colored((air * 1.7 + 0.04).min(Vec3::ONE));
    let drawn = RasterLayer::new(world, &view, &spec.quality.raster);
    let mut layers: Vec<Box<dyn Layer>> = vec![Box::new(drawn)];
    if !cfg!(without = "fog") {
        layers.push(Box::new(fog));
    }
    layers.push(Box::new(flakes));
    Picture { layers, transfer: Transfer::Srgb }
}
