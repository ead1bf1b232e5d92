//! The bench scenes `snow` and `fire`, as specified for every renderer that is compared.
//!
//! After theses C and D. The parameters' defaults are the specification.

use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Layer, Parameter, Picture, Scene, Stats, Tile};
use crate::particles::{Emitter, Fire, Flakes, Flame, Lens, ParticleLayer, Snow};
use crate::scenes::flakes;
use crate::settings::Quality;
use crate::view::{Camera, View};
use fearless_simd::Level;
use glam::{DVec3, Vec3A, dvec3, vec3a};

/// Flakes, of which 200,000 may be seen at a time.
pub const SNOW: Scene = Scene {
    name: "snow",
    about: "bench: 200,000 flakes of snow",
    duration: 20.0,
    parameters: &[HEIGHT, RADIUS, COUNT, EAST, SOUTH, FALL, SHARE, SIZE],
    picture: snow,
};

const HEIGHT: Parameter = flakes::height(16.0, "height of the field");
const RADIUS: Parameter = flakes::radius("radius", 15.0, "radius of the field around the eye");
const COUNT: Parameter = flakes::count("count", 254_648.0, "flakes of the field, seen or not");
const EAST: Parameter = flakes::wind("wind-east", 0.8, "wind towards the east");
const SOUTH: Parameter = flakes::wind("wind-south", 0.35, "wind towards the south");
const FALL: Parameter = flakes::fall(0.9);
const SHARE: Parameter = flakes::share("share of the flakes that is there");
const SIZE: Parameter = flakes::size(0.008);

/// Five torches of 2,000 sprites.
pub const FIRE: Scene = Scene {
    name: "fire",
    about: "bench: five torches of 2,000 sprites",
    duration: 20.0,
    parameters: &[TORCHES, EMITTER, SPRITES, LIFE, FIRE_EAST, FIRE_SOUTH],
    picture: fire,
};

const TORCHES: Parameter = Parameter::new("torches", "count", (0.0, 32.0), 5.0, "torches in a ring");
const EMITTER: Parameter =
    Parameter::new("radius", "m", (0.0, 1.0), 0.14, "radius of the disc that particles start from");
const SPRITES: Parameter = Parameter::new("particles", "count", (0.0, 100_000.0), 2000.0, "particles of each torch");
const LIFE: Parameter = Parameter::new(
    "life",
    "s",
    (0.1, 10.0),
    0.8,
    "life of the shortest-lived; the spread of the others scales with it",
);
const FIRE_EAST: Parameter =
    Parameter::new("wind-east", "m/s", (-10.0, 10.0), 0.0, "wind that carries the particles towards the east");
const FIRE_SOUTH: Parameter =
    Parameter::new("wind-south", "m/s", (-10.0, 10.0), 0.0, "wind that carries the particles towards the south");

/// The flakes, as specified.
pub const FLAKES: Flakes = Flakes {
    seed: 3,
    count: 254_648,
    extent: vec3a(30.0, 16.0, 30.0),
    reach: 15.0,
    opacity: 0.85,
    fall: [0.9, 0.7],
    sway: [0.15, 0.25],
    pace: [0.8, 0.8],
    radius: [0.008, 0.010],
    by: 7,
    lens: Lens { radius: [1.0, 24.0], near: [0.25, 1.0], ..Lens::SHARP },
};

/// The torches' flames, as specified.
pub const FLAME: Flame = Flame {
    life: [0.8, 0.7],
    ring: [0.0, 0.14],
    narrows: 0.0,
    leans: 0.0,
    cone: 0.35,
    speed: [0.9, 0.7],
    slows: 0.25,
    lift: 0.55,
    radius: [0.15, 0.035],
    light: [vec3a(1.0 * 0.008, 0.62 * 0.008, 0.20 * 0.008), vec3a(0.80 * 0.008, 0.10 * 0.008, 0.02 * 0.008)],
};

/// Flakes of a field at `time` seconds, in the wind that is specified, around an eye that walks as specified but is
/// moved by `beside` metres.
pub fn flakes(flakes: &Flakes, time: f64, beside: Vec3A) -> Snow {
    blown(flakes, time, beside, [EAST.default, SOUTH.default], 1.0)
}

/// The same in another wind, metres per second to the east and to the south, with a share of the flakes.
fn blown(flakes: &Flakes, time: f64, beside: Vec3A, [east, south]: [f64; 2], share: f32) -> Snow {
    let eye = dvec3(1.5 * time, 1.7, -2.0 * time) + beside.as_dvec3();
    Snow::new(flakes, time, eye, dvec3(east * time, 0.0, south * time), share)
}

fn snow(spec: &FrameSpec) -> Picture {
    let [faster, larger] = [&FALL, &SIZE].map(|parameter| spec.get(parameter) / parameter.default);
    let (height, radius, count) = (spec.get(&HEIGHT), spec.get(&RADIUS), spec.get(&COUNT));
    let field = flakes::altered(&FLAKES, height, radius, count, faster, larger);
    over(spec, SNOW_SKY, snowfall(spec, &field))
}

/// Flakes of a field before the camera that the scene specifies.
pub fn snowfall(spec: &FrameSpec, of: &Flakes) -> ParticleLayer {
    let t = spec.time;
    let way = dvec3((0.3 * t).sin(), 0.08 * (0.5 * t).sin(), (0.3 * t).cos());
    // The eye is the origin, since far from it there are no fractions of metres.
    let camera = spec.camera(Camera::look_at(Vec3A::ZERO, way.as_vec3a(), 50f32.to_radians(), 0.0));
    let view = View::new(camera, spec.width, spec.height);
    let wind = [spec.get(&EAST), spec.get(&SOUTH)];
    let snow = blown(of, t, camera.eye, wind, spec.get(&SHARE) as f32);
    ParticleLayer::new(vec![snow.into()], &view, &spec.quality.particles).colored(vec3a(0.95, 0.97, 1.0))
}

/// The torches at `time` seconds, as specified.
pub fn fires(time: f64) -> Vec<Fire> {
    ring(time, TORCHES.default, SPRITES.default, FLAME, Vec3A::ZERO)
}

/// A ring of `torches` of `sprites` particles each.
fn ring(time: f64, torches: f64, sprites: f64, flame: Flame, wind: Vec3A) -> Vec<Fire> {
    let torch = |j: u32| {
        let angle = 1.25663706 * (TORCHES.default / torches) * j as f64;
        Fire {
            flame,
            place: dvec3(3.0 * angle.cos(), 1.2, 3.0 * angle.sin()).as_vec3a(),
            scale: 1.0,
            time,
            seed: 4,
            first: sprites as u32 * j,
            count: sprites as f32,
            weight: 1.0,
            wind,
            lens: Lens::SHARP,
        }
    };
    (0..torches as u32).map(torch).collect()
}

fn fire(spec: &FrameSpec) -> Picture {
    let longer = spec.get(&LIFE) / LIFE.default;
    let flame = Flame { life: FLAME.life.map(|life| life * longer), ring: [0.0, spec.get(&EMITTER) as f32], ..FLAME };
    let wind = vec3a(spec.get(&FIRE_EAST) as f32, 0.0, spec.get(&FIRE_SOUTH) as f32);
    let torches = ring(spec.time, spec.get(&TORCHES), spec.get(&SPRITES), flame, wind);
    let a = 0.3 * spec.time;
    let eye = dvec3(7.0 * a.sin(), 2.2, 7.0 * a.cos());
    let way = DVec3::Y * 1.8 - eye;
    let camera = spec.camera(Camera::look_at(eye.as_vec3a(), (eye + way).as_vec3a(), 50f32.to_radians(), 0.0));
    let view = View::new(camera, spec.width, spec.height);
    // All particles that are specified, whatever the quality.
    let particles =
        ParticleLayer::new(torches.into_iter().map(Emitter::Fire).collect(), &view, &Quality::EXACT.particles);
    over(spec, FIRE_SKY, particles)
}

/// The light behind the flakes, at the bottom of the picture and at the top.
pub const SNOW_SKY: [Vec3A; 2] = [vec3a(0.58, 0.63, 0.70), vec3a(0.16, 0.20, 0.30)];
/// The light behind the torches, likewise.
pub const FIRE_SKY: [Vec3A; 2] = [vec3a(0.05, 0.05, 0.07), vec3a(0.01, 0.015, 0.05)];

/// Particles over a light that changes from the bottom of the picture to the top.
pub fn over(spec: &FrameSpec, [bottom, top]: [Vec3A; 2], particles: ParticleLayer) -> Picture {
    let behind = Gradient { bottom, top, height: spec.height as u32 as f32 };
    let layers: Vec<Box<dyn Layer>> = vec![Box::new(behind), Box::new(particles.without_solids())];
    Picture { layers, transfer: Transfer::Linear }
}

/// Light that changes from row to row.
struct Gradient {
    bottom: Vec3A,
    top: Vec3A,
    /// Rows of the picture.
    height: f32,
}

impl Layer for Gradient {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        for row in 0..tile.height {
            let up = (self.height - 0.5 - (tile.y + row) as u32 as f32) / self.height;
            let light = self.bottom + (self.top - self.bottom) * up;
            for (plane, light) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().zip(light.to_array()) {
                plane[row * Tile::SIZE..][..tile.width].fill(light);
            }
        }
        Stats::default()
    }
}
