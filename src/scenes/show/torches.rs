//! The scene `torches`, a part of the show: fires in the ruin on the hill, on a night in spring. A ring of them before
//! the altar, bowls, torches on the walls, a beacon in the tower, and outside the moon over the lake.
//!
//! The subject of thesis D: particles that live and die by closed forms of time, and a flickering point light per fire,
//! whose falloff is the thesis's. All lights are applied in one pass, each with a cube of depth maps.

use super::valley::{self, HOUR, LATITUDE, LONGITUDE};
use crate::cuts;
use crate::frame::{FrameSpec, Parameter, Picture, Scene};
use crate::particles::flicker::flicker;
use crate::particles::{Emitter, Fire, Flame, Lens, ParticleLayer};
use crate::raster::{Body, Light, Mesh, form};
use crate::scenes::models::paint::{self, PAINTS};
use crate::sky::time::days;
use crate::timeline::{self, Key};
use crate::view::{Camera, View};
use glam::{Affine3A, Mat3A, Vec2, Vec3A, vec3a};
use std::sync::{Arc, Mutex};

/// The scene.
pub const TORCHES: Scene = Scene {
    name: "torches",
    about: "fires in a ruin under the moon",
    duration: LENGTH,
    parameters: &[RADIUS, PARTICLES, LIFE, EAST, SOUTH, LIGHTS, REACH, STEADY, BEAT, DATE, START, LATITUDE, LONGITUDE],
    picture,
}
.part();

const RADIUS: Parameter = Parameter::new("radius", "1", (0.1, 4.0), 1.0, "radius of each emitter, times what it is");
const PARTICLES: Parameter =
    Parameter::new("particles", "count", (0.0, 20_000.0), 1800.0, "flames of a fire; sparks are a 75th of that");
const LIFE: Parameter = Parameter::new("life", "1", (0.2, 5.0), 1.0, "life of each particle, times what it is");
const EAST: Parameter =
    Parameter::new("wind-east", "m/s", (-10.0, 10.0), 0.0, "wind that carries the particles towards the east");
const SOUTH: Parameter =
    Parameter::new("wind-south", "m/s", (-10.0, 10.0), 0.0, "wind that carries the particles towards the south");
const LIGHTS: Parameter = Parameter::new(
    "lights",
    "count",
    (0.0, FIRES.len() as f64),
    FIRES.len() as f64,
    "fires that light the ruin, in the order of the table",
);
const REACH: Parameter =
    Parameter::new("reach", "m", (0.5, 50.0), 5.0, "distance that the light of a fire of size 1 reaches");
const STEADY: Parameter =
    Parameter::new("steady", "1", (0.0, 1.0), 0.4, "the least light of a fire as it flickers, of the most");
const BEAT: Parameter =
    Parameter::new("beat", "1", (0.0, 2.0), 0.5, "how much brighter fires are at a note of the bass, of their light");
const DATE: Parameter =
    Parameter::new("date", "days", (1.0, 731.0), 448.0, "the day's number, counted from 1 January 2026");
const START: Parameter = Parameter::new("hour", "h", (0.0, 24.0), 0.5, "time of day, UT + 1");

/// The length of the scene, seconds.
pub const LENGTH: f64 = 30.0;

/// The time of the scene, days since J2000: 0:30 Central European Time. The moon, a day past full, stands in the south.
pub const NIGHT: f64 = days(2027, 3, 24) + (0.5 - 1.0) * HOUR;

/// A fire: where it is, metres; the inner and the outer radius of the ring that burns, metres; and its size. A torch
/// has the size 1/2.
const fn fire([x, y, z]: [f32; 3], [inner, outer]: [f32; 2], size: f32) -> [f32; 6] {
    [x, y, z, inner, outer, size]
}

/// The fires. What is narrower than 0.2 m is a torch.
pub const FIRES: [[f32; 6]; 7] = [
    // A ring.
    fire([0.0, 9.625, -0.5], [1.125, 1.25], 1.5),
    // Bowls, the first on the altar.
    fire([0.0, 10.875, -4.0], [0.0, 0.25], 0.75),
    fire([1.75, 10.75, 2.75], [0.0, 0.25], 1.0),
    fire([10.0, 9.5, 7.0], [0.0, 0.5], 2.0),
    // Torches.
    fire([-2.75, 12.0, -2.0], [0.0, 0.125], 0.5),
    fire([-2.75, 12.0, 1.625], [0.0, 0.125], 0.5),
    // The beacon in the tower.
    fire([-5.25, 17.0, 4.5], [0.0, 0.375], 1.0),
];

/// What is under a fire, in tenths of its radius: a bowl on a staff.
#[rustfmt::skip]
const BOWL: form::Rings = form::Rings {
    rows: &[[-45, 0, 2, 2, 0], [-14, 0, 3, 3, 0], [-10, 0, 9, 9, 0], [1, 0, 12, 12, 0], [1, 0, 10, 10, 0], [-3, 0, 0, 0, 0]],
    sides: 8,
    half: false,
    swell: 0.0,
    taper: 0.0,
};

/// A key of the camera: seconds since the start of the shot; eye and target, metres; the vertical field of view,
/// degrees.
const fn key(time: f32, [x, y, z]: [f32; 3], [tx, ty, tz]: [f32; 3], fov: f32) -> Key<8> {
    [time, x, y, z, tx, ty, tz, fov]
}

/// The shots, by the second at which each starts.
pub static SHOTS: &[(f64, [Key<8>; 3])] = &[
    // Along the torches.
    (
        0.0,
        [
            key(0.0, [-1.25, 11.75, 3.5], [-2.75, 12.25, 1.5], 45.0),
            key(2.5, [-1.0, 12.0, 2.5], [-2.75, 12.0, 0.0], 50.0),
            key(5.0, [-0.5, 12.25, 1.5], [-2.5, 11.75, -3.0], 55.0),
        ],
    ),
    // Past the pillars.
    (
        5.0,
        [
            key(0.0, [6.0, 10.5, -4.5], [1.0, 11.25, 1.5], 60.0),
            key(3.0, [5.75, 10.5, 0.0], [0.0, 11.25, 0.5], 60.0),
            key(6.0, [6.0, 10.75, 4.5], [0.0, 11.25, -1.0], 60.0),
        ],
    ),
    // Up the nave.
    (
        11.0,
        [
            key(0.0, [0.5, 11.75, 5.0], [0.0, 11.25, -4.0], 56.0),
            key(2.5, [0.0, 11.25, 4.0], [0.0, 11.0, -4.0], 58.0),
            key(5.0, [-1.5, 10.5, 2.5], [0.25, 11.0, -4.0], 60.0),
        ],
    ),
    // From behind the altar, to the moon.
    (
        16.0,
        [
            key(0.0, [-0.5, 10.75, -7.75], [0.75, 13.0, 2.0], 60.0),
            key(3.5, [-0.25, 11.0, -7.0], [1.0, 13.5, 2.0], 62.0),
            key(6.0, [0.0, 11.5, -6.0], [1.5, 14.75, 2.0], 66.0),
        ],
    ),
    // Out to the hill, and up to the moon.
    (
        22.0,
        [
            key(0.0, [3.0, 14.0, -22.0], [1.0, 15.0, 2.0], 56.0),
            key(3.0, [5.0, 16.5, -30.0], [2.0, 18.0, 2.0], 54.0),
            key(8.0, [8.0, 17.0, -32.0], [16.125, 33.5, 2.0], 4.0),
        ],
    ),
];

/// The bowls, staffs and torches that fires burn in.
fn bowls() -> Body {
    static BOWLS: Mutex<Option<Body>> = Mutex::new(None);
    let mut bowls = BOWLS.lock().unwrap();
    let make = || {
        let mut mesh = Mesh::painted(&PAINTS);
        for [x, y, z, inner, outer, _] in FIRES {
            let mut size = Mat3A::IDENTITY;
            // Torches lean out of the walls, towards the middle of the nave.
            if outer < 0.2 {
                size.y_axis.x = -0.18 * x;
            }
            if inner == 0.0 {
                mesh.rings(&BOWL, &(size * (0.1 * outer)), vec3a(x, y, z), paint::BARK);
            }
        }
        Body::new(Arc::new(mesh), Affine3A::IDENTITY)
    };
    bowls.get_or_insert_with(make).clone()
}

/// The light of fire `number`. Bodies before number `from` cast no shadow of it.
fn light(spec: &FrameSpec, number: u32, from: u32) -> Light {
    let [x, y, z, _, _, scale] = FIRES[number as usize];
    let root = scale.sqrt();
    // It comes from where the fire flares.
    let [a, b, c] = [1, 2, 3].map(|k| flicker(4 * number + k, spec.time, -1.0));
    let position = vec3a(x, y + 0.3 * scale, z) + vec3a(a, b, c) * (0.2 * scale);
    // The bass of the score has a note every two seconds, which fires answer within a fifth.
    let since = (spec.time * 0.5).rem_euclid(1.0) as f32;
    let left = (1.0 - since) * (1.0 - since);
    let flare = 1.0 + spec.get(&BEAT) as f32 * (since * 10.0).min(1.0) * left * left;
    let color = vec3a(12.0, 4.0, 0.75) * (root * flare * flicker(4 * number, spec.time, spec.get(&STEADY) as f32));
    // The thesis has 1 / (1 + 0.0004 D + 0.000028 D^2), where a unit of the game is taken as half a centimetre.
    let traced = cuts::TRACED_SHADOWS && spec.quality.raster.shadow_map == 0;
    valley::point(position, color, Vec2::new(0.08, 1.12), spec.get(&REACH) as f32 * root, [384, from], traced)
}

/// Flames and sparks of a bowl.
static FLAMES: [Flame; 2] = [
    Flame {
        life: [0.6, 0.7],
        ring: [0.0, 0.0],
        narrows: 0.7,
        leans: 0.12,
        cone: 0.3,
        speed: [0.4, 0.5],
        slows: 0.5,
        lift: 0.7,
        radius: [0.11, 0.03],
        light: [vec3a(0.02, 0.0105, 0.003), vec3a(0.012, 0.002, 0.0003)],
    },
    Flame {
        life: [0.8, 1.2],
        ring: [0.0, 0.0],
        narrows: 0.0,
        leans: 0.2,
        cone: 0.9,
        speed: [0.5, 1.0],
        slows: 0.2,
        lift: 0.4,
        radius: [0.008, 0.005],
        light: [vec3a(0.25, 0.12, 0.04), vec3a(0.2, 0.05, 0.01)],
    },
];

/// The fires themselves.
fn flames(spec: &FrameSpec, view: &View) -> ParticleLayer {
    let count = spec.get(&PARTICLES) as f32;
    let mut flames = Vec::new();
    for (number, [x, y, z, inner, outer, scale]) in FIRES.into_iter().enumerate() {
        for (flame, count) in FLAMES.iter().zip([count, count / 75.0]) {
            let mut fire = Fire {
                flame: *flame,
                place: vec3a(x, y, z),
                scale,
                time: spec.time,
                seed: number as u32,
                first: 0,
                count,
                weight: 1.0,
                wind: vec3a(spec.get(&EAST) as f32, 0.0, spec.get(&SOUTH) as f32),
                lens: Lens { radius: [0.7, f32::MAX], near: [0.25, 0.5], ..Lens::SHARP },
            };
            fire.flame.ring = [inner / scale, outer / scale];
            if inner > 0.0 {
                fire.flame.narrows = 0.1;
            }
            if cuts::PARAMETERS {
                fire.flame.ring = fire.flame.ring.map(|radius| radius * spec.get(&RADIUS) as f32);
                fire.flame.life = fire.flame.life.map(|life| life * spec.get(&LIFE));
            }
            flames.push(Emitter::Fire(fire));
        }
    }
    ParticleLayer::new(flames, view, &spec.quality.particles)
}

fn picture(spec: &FrameSpec) -> Picture {
    let (keys, since) = timeline::cut(SHOTS, LENGTH, spec.time);
    let [_, x, y, z, tx, ty, tz, fov] = timeline::sample(keys, since);
    let view = spec.view(Camera::look_at(vec3a(x, y, z), vec3a(tx, ty, tz), fov.to_radians(), 0.0));
    let mut dome = valley::sky(spec, valley::date(spec, &DATE) + (spec.get(&START) - 1.0) * HOUR);
    // The eye has adapted to the fires.
    dome.exposure *= 0.6;
    let mut world = valley::world(&dome, valley::season(2).1, Mat3A::IDENTITY, Vec3A::ZERO, 0.0);
    // The chapel and what it holds cast shadows of the fires' light, the land does not. There is no aeroplane.
    let from = world.bodies.len() - 3;
    world.bodies.truncate(from + 1);
    world.bodies.push(bowls());
    let moon = &mut world.lights[0];
    // Silver, as moonlight seems beside fires.
    moon.color *= vec3a(0.9, 1.1, 1.5);
    moon.shadow = valley::cascades(spec, view.camera(), dome.lighting().direction, &[10.0, 45.0, 240.0]);
    for number in 0..spec.get(&LIGHTS) as u32 {
        world.lights.push(light(spec, number, from as u32));
    }
    let flames = flames(spec, &view);
    let mut picture = valley::show(spec, dome, world, view, None);
    picture.layers.push(Box::new(flames));
    picture
}
