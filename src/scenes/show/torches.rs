//! Fires in the ruin on the hill, in a winter's night: a ring of them before the altar, torches on the walls, and outside
//! the moon over the lake.

use super::day;
use crate::cuts;
use crate::frame::Picture;
use crate::frame::{FrameSpec, Scene};
use crate::particles::flicker::flicker;
use crate::particles::{Emitter, Fire, Flame, Lens, ParticleLayer};
use crate::raster::{Body, Light, Mesh, form};
use crate::scenes::models::{PAINTS, paint};
use crate::timeline::{self, Key};
use crate::view::Camera;
use crate::view::View;
use glam::{Affine3A, Mat3, Vec2, Vec3, vec3};
use std::sync::{Arc, Mutex};

/// The scene.
pub const TORCHES: Scene =
    Scene { name: "torches", about: "fires in a ruin under the moon", duration: LENGTH, parameters: &[], picture }
        .part();

/// Seconds that it takes.
pub const LENGTH: f64 = 30.0;

/// Days from J2000: 2027-03-24, 0:30 Central European Time. The moon, a day past full, stands in the south.
pub const NIGHT: f64 = 9943.5 - 0.5 / 24.0;

/// Fires: where, metres; the inner and the outer radius of the disc that burns, metres; how large the flames are, a
/// torch's are 1/2. A ring; bowls, the first on the altar; torches, which are those below 0.2 m; a beacon in the tower.
#[rustfmt::skip]
pub const FIRES: [[f32; 6]; 7] = [
    [0.0, 9.625, -0.5, 1.125, 1.25, 1.5],
    [0.0, 10.875, -4.0, 0.0, 0.25, 0.75],
    [1.75, 10.75, 2.75, 0.0, 0.25, 1.0],
    [10.0, 9.5, 7.0, 0.0, 0.5, 2.0],
    [-2.75, 12.0, -2.0, 0.0, 0.125, 0.5],
    [-2.75, 12.0, 1.625, 0.0, 0.125, 0.5],
    [-5.25, 17.0, 4.5, 0.0, 0.375, 1.0],
];

/// Under a fire, tenths of its radius: a bowl on a staff.
#[rustfmt::skip]
const BOWL: form::Rings = form::Rings {
    rows: &[[-45, 0, 2, 2, 0], [-14, 0, 3, 3, 0], [-10, 0, 9, 9, 0], [1, 0, 12, 12, 0], [1, 0, 10, 10, 0], [-3, 0, 0, 0, 0]],
    sides: 8,
    half: false,
    swell: 0.0,
    taper: 0.0,
};

/// Shots by the second that each starts, with its keys: seconds since then; eye, target; the vertical field of view,
/// degrees.
#[rustfmt::skip]
pub static SHOTS: &[(f64, [Key<8>; 3])] = &[
    // The hill.
    (0.0, [
        [0.0, 8.0, 17.0, -32.0, 3.5, 18.0, 2.0, 56.0],
        [4.0, 5.0, 16.5, -30.0, 2.0, 17.5, 2.0, 54.0],
        [8.0, 1.0, 15.5, -27.0, 0.5, 17.0, 2.0, 52.0],
    ]),
    // Along the torches.
    (8.0, [
        [0.0, -1.25, 11.75, 3.5, -2.75, 12.25, 1.5, 45.0],
        [2.5, -1.0, 12.0, 2.5, -2.75, 12.0, 0.0, 50.0],
        [5.0, -0.5, 12.25, 1.5, -2.5, 11.75, -3.0, 55.0],
    ]),
    // Past the pillars.
    (13.0, [
        [0.0, 6.0, 10.5, -4.5, 1.0, 11.25, 1.5, 60.0],
        [3.0, 5.75, 10.5, 0.0, 0.0, 11.25, 0.5, 60.0],
        [6.0, 6.0, 10.75, 4.5, 0.0, 11.25, -1.0, 60.0],
    ]),
    // Up the nave.
    (19.0, [
        [0.0, 0.5, 11.75, 5.0, 0.0, 11.25, -4.0, 56.0],
        [2.5, 0.0, 11.25, 4.0, 0.0, 11.0, -4.0, 58.0],
        [5.0, -1.5, 10.5, 2.5, 0.25, 11.0, -4.0, 60.0],
    ]),
    // From behind the altar, to the moon.
    (24.0, [
        [0.0, -0.5, 10.75, -7.75, 0.75, 13.0, 2.0, 60.0],
        [3.5, -0.25, 11.0, -7.0, 1.0, 13.5, 2.0, 62.0],
        [6.0, 0.0, 11.5, -6.0, 1.5, 14.75, 2.0, 66.0],
    ]),
];

/// What fires burn in.
fn bowls() -> Body {
    static BOWLS: Mutex<Option<Body>> = Mutex::new(None);
    let mut bowls = BOWLS.lock().unwrap();
    let make = || {
        let mut mesh = Mesh::painted(&PAINTS);
        for [x, y, z, inner, outer, _] in FIRES {
            let mut size = Mat3::IDENTITY;
            // Torches lean out of walls, to the nave's middle.
            if outer < 0.2 {
                size.y_axis.x = -0.18 * x;
            }
            if inner == 0.0 {
                mesh.rings(&BOWL, &(size * (0.1 * outer)), vec3(x, y, z), paint::BARK);
            }
        }
        Body::new(Arc::new(mesh), Affine3A::IDENTITY)
    };
    bowls.get_or_insert_with(make).clone()
}

/// The light of fire `number`; bodies before number `from` cast no shadow of it.
fn light(spec: &FrameSpec, number: u32, from: u32) -> Light {
    let [x, y, z, _, _, scale] = FIRES[number as usize];
    let root = scale.sqrt();
    // It comes from where it flares.
    let [a, b, c] = [1, 2, 3].map(|k| flicker(4 * number + k, spec.time, -1.0));
    let position = vec3(x, y + 0.3 * scale, z) + vec3(a, b, c) * (0.2 * scale);
    let color = vec3(12.0, 4.0, 0.75) * (root * flicker(4 * number, spec.time, 0.4));
    // 1 / (1 + 0.0004 D + 0.000028 D^2) as in the thesis, if a unit of its game is half a centimetre.
    let traced = cuts::TRACED_SHADOWS && spec.quality.raster.shadow_map == 0;
    day::point(position, color, Vec2::new(0.08, 1.12), 5.0 * root, [128, from], traced)
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
        light: [vec3(0.02, 0.0105, 0.003), vec3(0.012, 0.002, 0.0003)],
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
        light: [vec3(0.25, 0.12, 0.04), vec3(0.2, 0.05, 0.01)],
    },
];

/// What is seen of the fires themselves.
fn flames(spec: &FrameSpec, view: &View) -> ParticleLayer {
    let mut flames = Vec::new();
    for (number, [x, y, z, inner, outer, scale]) in FIRES.into_iter().enumerate() {
        for (flame, count) in FLAMES.iter().zip([1800.0, 24.0]) {
            let mut flame = Flame { ring: [inner / scale, outer / scale], ..*flame };
            if inner > 0.0 {
                flame.narrows = 0.1;
            }
            let fire = Fire {
                flame,
                place: vec3(x, y, z),
                scale,
                time: spec.time,
                seed: number as u32,
                first: 0,
                count,
                weight: 1.0,
                lens: Lens { radius: [0.7, f32::MAX], near: [0.25, 0.5], ..Lens::SHARP },
            };
            flames.push(Emitter::Fire(fire));
        }
    }
    ParticleLayer::new(flames, view, &spec.quality.particles)
}

fn picture(spec: &FrameSpec) -> Picture {
    let (keys, since) = timeline::cut(SHOTS, LENGTH, spec.time);
    let [_, x, y, z, tx, ty, tz, fov] = timeline::sample(keys, since);
    let camera = spec.camera(Camera::look_at(vec3(x, y, z), vec3(tx, ty, tz), fov.to_radians(), 0.0));
    let mut dome = day::sky(spec, NIGHT);
    // Eyes have got used to the fires.
    dome.exposure *= 0.6;
    let mut world = day::world(&dome, day::plan(2, 0.0).2, Mat3::IDENTITY, Vec3::ZERO, 0.0);
    // Of the chapel and what it holds lamps cast shadows, of the land they do not. Nobody flies.
    let from = world.bodies.len() - 3;
    world.bodies.truncate(from + 1);
    world.bodies.push(bowls());
    let moon = &mut world.lights[0];
    // Silver, as beside fires it seems.
    moon.color *= vec3(0.9, 1.1, 1.5);
    moon.shadow = day::cascades(spec, &camera, dome.lighting().direction, &[45.0, 240.0]);
    for number in 0..FIRES.len() as u32 {
        world.lights.push(light(spec, number, from as u32));
    }
    let view = View::new(camera, spec.width, spec.height);
    let flames = flames(spec, &view);
    let mut picture = day::show(spec, dome, world, view, None);
    picture.layers.push(Box::new(flames));
    picture
}
