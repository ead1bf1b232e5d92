//! The scene `snowfall`, a part of the show: a walk to the chapel at the end of November. It begins to snow, and it
//! gets dark.
//!
//! Two fields of flakes around the eye, as in thesis C, a near one of crystals and a far one of tufts; fog that
//! thickens with the shower; and snow that settles on what the sky sees.

use super::valley;
use crate::angle;
use crate::cuts;
use crate::effects::{Fog, FogLayer};
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Layer, Parameter, Picture, Scene};
use crate::particles::{Calm, Emitter, Flakes, Lens, ParticleLayer, Snow};
use crate::raster::{Bias, Haze, Light, Projection, RasterLayer, ShadowViews, SnowCover};
use crate::scenes::flakes;
use crate::scenes::models::{land, tuft};
use crate::sky::time::days;
use crate::timeline::{self, Key, ease};
use crate::vector::unit;
use crate::view::Camera;
use glam::{DVec3, Mat3A, Vec2, Vec3A, dvec3, vec2, vec3a};

/// The scene.
pub const SNOWFALL: Scene = Scene {
    name: "snowfall",
    about: "a walk through the first snow, into the dusk",
    duration: LENGTH,
    parameters: &[HEIGHT, NEAR_RADIUS, FAR_RADIUS, NEAR_COUNT, FAR_COUNT, EAST, SOUTH, FALL, SHARE, SIZE],
    picture,
}
.part();

const HEIGHT: Parameter = flakes::height(16.0, "height of the near field; the far one is 2.5 times as high");
const NEAR_RADIUS: Parameter = flakes::radius("near-radius", 15.0, "radius of the near field around the eye");
const FAR_RADIUS: Parameter = flakes::radius("far-radius", 50.0, "radius of the far field around the eye");
const NEAR_COUNT: Parameter = flakes::count("near-count", 120_000.0, "flakes of the near field, seen or not");
const FAR_COUNT: Parameter = flakes::count("far-count", 160_000.0, "tufts of the far field, seen or not");
const EAST: Parameter = flakes::wind("wind-east", 0.9, "wind towards the east; gusts take it to 0.5 to 2.7 times that");
const SOUTH: Parameter = flakes::wind("wind-south", -0.45, "wind towards the south, with the same gusts");
const FALL: Parameter = flakes::fall(0.8);
const SHARE: Parameter = flakes::share("how thickly it snows, of what the weather would have");
const SIZE: Parameter = flakes::size(0.009);

/// The length of the scene, seconds.
pub const LENGTH: f64 = 32.0;

/// The walk: seconds; x and z, metres; heading, radians from north towards east; how far up the eye looks, radians.
#[rustfmt::skip]
static WALK: [Key<5>; 6] = [
    [0.0, -40.0, 79.5, 0.1, 0.0],
    [5.0, -37.5, 71.0, 0.35, 0.03],
    [9.0, -35.0, 63.5, 0.95, 0.25],
    [12.0, -33.5, 58.5, 1.0, 0.3],
    [18.0, -31.0, 49.5, 0.55, 0.05],
    [32.0, -9.0, 17.0, 0.7, 0.12],
];

/// The near field: flakes around the eye.
const NEAR: Flakes = Flakes {
    seed: 3,
    count: 120_000,
    extent: vec3a(30.0, 16.0, 30.0),
    reach: 15.0,
    opacity: 0.9,
    fall: [0.8, 0.6],
    sway: [0.1, 0.25],
    pace: [0.8, 0.8],
    radius: [0.009, 0.016],
    by: 3,
    lens: Lens { radius: [1.0, 64.0], near: [0.3, 0.8], aperture: 0.012, focus: 1.6, crystals: true, ..Lens::SHARP },
};
/// Both fields. The far one has larger tufts.
static FIELDS: [Flakes; 2] = [
    NEAR,
    Flakes {
        seed: 4,
        count: 160_000,
        extent: vec3a(100.0, 40.0, 100.0),
        reach: 50.0,
        radius: [0.03, 0.03],
        lens: Lens { near: [8.0, 16.0], ..NEAR.lens },
        ..NEAR
    },
];

/// The state of the air.
#[derive(Clone, Copy, Debug)]
pub struct Weather {
    /// Share of the flakes that are in the air, 0 to 1.
    pub snow: f32,
    /// Speed of the wind along x and z, metres per second.
    pub wind: Vec2,
    /// How far it has carried the flakes since the start, metres.
    pub drift: DVec3,
}

/// The weather at `time` seconds: it begins to snow, in showers, and gusts come with them.
pub fn weather(time: f64) -> Weather {
    weather_in([EAST.default, SOUTH.default], time)
}

/// The same in another wind, metres per second to the east and to the south.
fn weather_in([east, south]: [f64; 2], time: f64) -> Weather {
    let snow = ease(1.0, 12.0, time) * (1.0 - 0.6 * ease(18.0, 29.0, time)) * (0.8 - 0.2 * (0.7 * time).cos() as f32);
    // The way of a gust is the integral of its speed.
    let (sin, cos) = (0.7 * time).sin_cos();
    let way = 1.6 * time - 1.1 / 0.7 * sin;
    let speed = 1.6 - 1.1 * cos as f32;
    let wind = Vec2::new(east as f32, south as f32) * speed;
    Weather { snow, wind, drift: DVec3::new(east, 0.0, south) * way }
}

/// The fields as the parameters say.
fn altered(spec: &FrameSpec) -> [Flakes; 2] {
    let [near, far] = &FIELDS;
    let (height, faster, larger) = (spec.get(&HEIGHT), spec.get(&FALL) / FALL.default, spec.get(&SIZE) / SIZE.default);
    [
        flakes::altered(near, height, spec.get(&NEAR_RADIUS), spec.get(&NEAR_COUNT), faster, larger),
        flakes::altered(far, 2.5 * height, spec.get(&FAR_RADIUS), spec.get(&FAR_COUNT), faster, larger),
    ]
}

fn picture(spec: &FrameSpec) -> Picture {
    let [_, x, z, heading, pitch] = timeline::sample(&WALK, spec.time);
    // A step is 0.85 m.
    let step = 0.025 * angle::sin(7.4 * z);
    let eye = vec3a(x, land::height(x, z) + 1.7 + step, z);
    let (sin, cos) = angle::sin_cos(heading);
    let camera = Camera::look_at(eye, eye + vec3a(sin, angle::tan(pitch), -cos), 0.82, 0.0);
    let view = spec.view(camera);
    // The land in autumn's colours. Clouds hide the sky of that day, and its light is replaced below.
    let dome = valley::sky(spec, days(2026, 11, 28));
    let textures = valley::season(1).1;
    let mut world = valley::world(&dome, textures, Mat3A::IDENTITY, Vec3A::ZERO, 0.0);
    tuft::sink(&mut world.bodies, view.camera().eye);
    // Without the aeroplane and its propeller.
    world.bodies.truncate(world.bodies.len() - 2);
    // What is left of the daylight turns blue.
    let dusk = ease(0.0, LENGTH, spec.time);
    let sky = vec3a(1.0, 1.04, 1.1) * (dvec3(2.5, 2.1, 1.6) * -f64::from(dusk)).exp().as_vec3a();
    let amount = 0.04 * (spec.time - 2.0).clamp(0.0, 25.0) as f32;
    // What the ground reflects: more as it whitens.
    let ground = 0.15 + 0.65 * amount;
    // Flakes come from where the wind blows. What stands above shelters the ground softly, so a coarse map will do.
    let towards = unit(vec3a(-0.3, 1.0, 0.15));
    let views = vec![Projection::parallel(towards, vec3a(-15.0, 0.0, 40.0), 512.0, 512)];
    let shelter = ShadowViews { first_caster: valley::FIRST_CASTER, ..ShadowViews::new(views, Bias::SHOW) };
    let fall = Light::sun(towards, Vec3A::ONE).with_shadow(shelter);
    if !cfg!(without = "snow-cover") {
        // Whoever has lit the lamp came this way.
        let track = [vec2(-36.0, 58.0), vec2(-4.0, 9.0)];
        world.snow = Some(SnowCover { amount, fall, sky: sky * 0.6, track });
    }
    world.lights.clear();
    world.ambient = [sky * (0.25 + 0.2 * ground), sky * (0.15 - 0.2 * ground)];
    valley::lamp(&mut world, ease(20.0, 26.0, spec.time));
    let air = Vec3A::ONE - (sky * (0.35 * dusk - 0.8)).as_dvec3().exp().as_vec3a();
    world.haze = Haze::even(air, 0.0);
    world.zenith = air * 1.2;
    let weather = weather_in([spec.get(&EAST), spec.get(&SOUTH)], spec.time);
    let snow = weather.snow * spec.get(&SHARE) as f32;
    let density = 8e-4 + 8e-3 * snow;
    let fog = FogLayer::new(Fog { light: air, density, end: 1e5 }, &view);
    let mut fields = Vec::new();
    let altered = cuts::PARAMETERS.then(|| altered(spec));
    for flakes in altered.as_ref().unwrap_or(&FIELDS) {
        let mut field = Snow::new(flakes, spec.time, view.camera().eye.as_dvec3(), weather.drift, snow);
        field.calm = Calm { wind: weather.wind, height: 1.7, depth: 1.5 };
        fields.push(Emitter::Snow(field));
    }
    let flakes = ParticleLayer::new(fields, &view, &spec.quality.particles).colored((air * 1.7 + 0.04).min(Vec3A::ONE));
    let drawn = RasterLayer::new(world, &view, &spec.quality.raster);
    let mut layers: Vec<Box<dyn Layer>> = vec![Box::new(drawn)];
    if !cfg!(without = "fog") {
        layers.push(Box::new(fog));
    }
    layers.push(Box::new(flakes));
    Picture { layers, transfer: Transfer::Srgb }
}
