//! The second part of the intro: days on a hill by a lake, from dawn to the stars, through the year.

use crate::cuts;
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Scene};
use crate::frame::{Layer, Picture};
use crate::raster::{Bias, Body, Haze, Light, RasterLayer, ShadowViews, World, fit};
use crate::scenes::models::{chapel, land, mustang, tree};
use crate::scenes::script::{
    ADD, CLOUDS, LAYERS, MUL, PICK, Script, VARIABLES, Word, get, kind, operations, script, set, texture,
};
use crate::sky::dome::{Dome, Sky};
use crate::sky::layer::SkyLayer;
use crate::sky::place::Place;
use crate::texture::Texture;
use crate::timeline::{self, ease};
use crate::view::Camera;
use crate::view::View;
use glam::{Affine3A, Mat3, Vec2, Vec3, vec3};
use std::f32::consts::TAU;
use std::sync::{Arc, Mutex};

/// The part.
pub const DAY: Scene = Scene {
    name: "day",
    about: "a hill by a lake: four days, one of each season",
    duration: 4.0 * LENGTH,
    parameters: &[],
    picture,
}
.part();

/// Seconds that a day takes, from four in the morning to four in the morning.
pub const LENGTH: f64 = 60.0;

/// A day's 24th part.
const HOUR: f64 = 1.0 / 24.0;

/// What day it is at `time` seconds, and how many of its hours have passed.
pub fn clock(time: f64) -> (usize, f64) {
    let day = (time / LENGTH).floor();
    (day as usize % 4, 4.0 + (time - day * LENGTH) * (24.0 / LENGTH))
}

/// The hour at which the camera leaps to where the moon stands over the lake.
pub const LEAP: f32 = 22.0;

operations! {
    /// The camera's keys, nine numbers each: the hour; eye, target, vertical field of view in degrees; the last one is
    /// free. In tens.
    CAMERA = 40;
    /// Days from 2026-06-25 on, in twenties.
    DATE = 41;
    /// The land's next texture, as `texture` takes it.
    TEXTURE = 42;
    /// The last word.
    END = 43;
}

/// The course of days. The last keys are to the south, where the moon stands over the lake.
#[rustfmt::skip]
const PLAN: &[u8] = script![
    [
        0.4, -3.6, 1.35, 1.4, 0.0, 1.85, -0.2, 5.4, 0.0,
        0.8, -2.4, 1.7, -3.4, 0.0, 1.7, 0.0, 5.4, 0.0,
        1.2, 0.0, 1.9, -4.7, 0.0, 1.6, 0.0, 5.4, 0.0,
        1.4, 3.8, 1.9, -2.8, 0.0, 1.65, 0.0, 5.4, 0.0,
        1.8, 3.3, 1.35, 3.9, 0.0, 1.8, -0.4, 5.4, 0.0,
        -0.02, 0.005, MUL, 0.1 * LEAP, ADD, 2.4, 1.4, 4.4, -0.3, 1.9, 0.0, 5.4, 0.0,
        0.1 * LEAP, -0.4, 1.55, -4.6, -0.6, 1.95, 0.0, 5.4, 0.0,
        2.8, 1.4, 1.65, -4.5, -0.4, 2.0, 0.0, 5.4, 0.0, CAMERA,
    ],
    [
        // The date, what colours of meadows and of leaves are multiplied by, the share of the land that is white:
        // 2026-06-25, 2026-09-19, 2026-12-22 and 2027-03-10.
        0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0,
        4.3, 1.39, 0.85, 1.285, 2.2, 0.8, 0.3, 0.0,
        9.0, 6.085, 4.365, 22.285, 0.6, 0.35, 0.7, 1.0,
        12.9, 1.045, 0.91, 0.855, 1.0, 1.1, 0.8, 0.15,
        get(0), 8.0, PICK, set(4), set(13), set(12), set(11), set(10), set(9), set(8), DATE,
        // Of meadows and leaves, and of land and rocks, what is white, and what is not.
        get(4), 0.7, MUL, set(5), get(5), -1.0, MUL, 1.0, ADD, set(6),
        get(4), 0.5, MUL, set(7), get(7), -1.0, MUL, 1.0, ADD, set(4), get(7), 0.6, MUL, set(7),
    ],
    // Grass.
    white(-0.5, 8), white(0.0, 9), white(0.2, 10), white(2.5, 8), white(2.0, 9), white(1.8, 10),
    [0.09, 6.0, CLOUDS as Word, TEXTURE],
    // Heights: grass, land, rock, snow. The sine rises from -50 m to 1250 m.
    [get(8), 0.115, MUL, get(9), 0.165, MUL, get(10), 0.035, MUL], pale(0.045), pale(0.075), pale(0.025),
    [0.04, 0.06, MUL, 2.5, LAYERS as Word, 0.7], pale(0.2), pale(0.185), pale(0.17), [0.8, 0.83, 0.88, 6.0, TEXTURE],
    // Bark, needles, masonry, tiles, leaves. These vary about 1.
    kind(CLOUDS, [0.3; 3], [1.7; 3], 3.0, 3.0), [TEXTURE],
    kind(CLOUDS, [-0.8, -0.5, -0.2], [2.8, 2.5, 2.2], 1.2, 4.0), [TEXTURE],
    kind(CLOUDS, [0.2, 0.2, 0.25], [1.8, 1.8, 1.75], 0.9, 4.0), [TEXTURE],
    kind(LAYERS, [0.6; 3], [0.865; 3], 14.0, 5.0), [6.0, 1.135, 1.135, 1.135, 1.4, 1.4, 1.4, 0.0, TEXTURE],
    white(-0.8, 11), white(-0.5, 12), white(-0.2, 13), white(2.8, 11), white(2.5, 12), white(2.2, 13),
    [1.2, 4.0, CLOUDS as Word, TEXTURE, END],
];

/// A colour's share of meadows or leaves: what is white, and what that is multiplied by.
const fn white(color: Word, by: u8) -> [Word; 7] {
    [color, get(6), MUL, get(5), ADD, get(by), MUL]
}

/// A colour's share of land or rocks.
const fn pale(color: Word) -> [Word; 5] {
    [color, get(4), MUL, get(7), ADD]
}

/// The bodies: the land, the woods, the lake, the chapel; last the aeroplane and its propeller, which move.
fn bodies() -> Vec<Body> {
    static BODIES: Mutex<Vec<Body>> = Mutex::new(Vec::new());
    let mut bodies = BODIES.lock().unwrap();
    if bodies.is_empty() {
        let mut meshes = land::ground();
        meshes.append(&mut tree::woods(&tree::trees()));
        meshes.extend([land::lake(), chapel::chapel()]);
        if !cfg!(without = "aeroplane") {
            meshes.extend([mustang::airframe(), mustang::propeller()]);
        }
        for mesh in meshes {
            bodies.push(Body::new(Arc::new(mesh), Affine3A::IDENTITY));
        }
    }
    bodies.clone()
}

/// What the plan has for a day: the camera at an hour, the date and the textures.
pub(in crate::scenes) fn plan(day: usize, hour: f64) -> ([f32; 9], f32, Vec<Texture>) {
    let mut plan = Script::new(PLAN, [day as u32 as f32, 0.0]);
    let (mut key, mut date, mut textures) = ([0.0; 9], 0.0, Vec::new());
    loop {
        match plan.next() {
            byte::CAMERA => key = timeline::sample(plan.stack().as_chunks().0, 0.1 * hour),
            byte::DATE => date = 20.0 * plan.numbers[VARIABLES],
            byte::TEXTURE => {
                let numbers = plan.numbers[VARIABLES..].first_chunk().unwrap();
                textures.push(texture(numbers, &Mat3::IDENTITY, Vec3::ZERO));
            }
            _ => return (key, date, textures),
        }
    }
}

/// The sky of a day, from J2000.
#[inline(never)]
pub(in crate::scenes) fn sky(spec: &FrameSpec, day: f64) -> Dome {
    Dome::new(Sky::new(day, &Place::PLZEN), &spec.quality.sky)
}

/// The picture of a world under a sky, with what is between.
#[inline(never)]
pub(in crate::scenes) fn show(
    spec: &FrameSpec,
    dome: Dome,
    world: World,
    view: View,
    between: Option<Box<dyn Layer>>,
) -> Picture {
    let sky = SkyLayer::new(dome.with_shimmer(spec.time), &view, &spec.quality.sky).behind();
    let mut layers: Vec<Box<dyn Layer>> = vec![Box::new(RasterLayer::new(world, &view, &spec.quality.raster))];
    layers.extend(between);
    layers.push(Box::new(sky));
    Picture { layers, transfer: Transfer::Srgb }
}

/// The land under a sky at `time` seconds, with the aeroplane there; its light has no shadows yet.
#[inline(never)]
pub(in crate::scenes) fn world(dome: &Dome, textures: Vec<Texture>, turn: Mat3, place: Vec3, time: f64) -> World {
    let now = dome.lighting();
    let mut bodies = bodies();
    // Turns a second, five.
    let turns = 5.0 * time;
    let spin = turn * Mat3::from_rotation_z((turns - turns.floor()) as f32 * TAU);
    let aeroplane = bodies.len() - 2;
    for (body, turn) in bodies[aeroplane..].iter_mut().zip([turn, spin]) {
        body.put(Affine3A::from_mat3_translation(turn, place));
    }
    // The sky glows where the sun is or was, also while the moon lights the land.
    let sun = level(dome.sky.sun);
    let [glow, haze] = [sun, level(-sun)].map(|d| dome.radiance(d));
    let image = now.color * ease(0.0, 0.04, now.direction.y as f64) * 3.0;
    World {
        textures,
        lights: vec![Light::sun(now.direction, now.color)],
        ambient: [(now.sky + now.ground) * 0.5, (now.sky - now.ground) * 0.5],
        haze: Haze {
            color: haze,
            density: 1.0 / 9000.0,
            glow: (sun, (glow - haze).max(Vec3::ZERO)),
            image: (level(now.direction), image),
        },
        zenith: dome.radiance(Vec3::Y),
        film: true,
        ..World::new(bodies)
    }
}

/// Just above the horizon, below that direction.
#[inline(never)]
fn level(d: Vec3) -> Vec3 {
    vec3(d.x, 0.05, d.z).normalize()
}

/// Somebody lights a lamp in the chapel when it gets `dark`, 0 to 1.
#[inline(never)]
pub(in crate::scenes) fn lamp(world: &mut World, dark: f32) {
    if dark > 0.0 {
        let color = vec3(3.2, 1.5, 0.5) * dark;
        world.lights.push(point(vec3(0.0, 14.5, 1.0), color, Vec2::new(0.05, 0.06), 30.0, [512, 0], false));
    }
}

/// A lamp with a cube of maps, `texels` along an edge, in which bodies from number `from` on cast shadows.
#[inline(never)]
pub(in crate::scenes) fn point(
    position: Vec3,
    color: Vec3,
    falloff: Vec2,
    reach: f32,
    [texels, from]: [u32; 2],
    traced: bool,
) -> Light {
    let bias = Bias { constant: 0.02, slope: 2.0, normal: 0.0 };
    let shadow = ShadowViews::new(fit::cube(position, texels), bias);
    let shadow = ShadowViews { traced, first_caster: from as usize, ..shadow };
    Light::lamp(position, color, falloff, reach).with_shadow(shadow)
}

/// What the sun or the moon sees, `towards` it, of what a camera sees: up to each of `ends`, metres, in a map.
#[inline(never)]
pub(in crate::scenes) fn cascades(
    spec: &FrameSpec,
    camera: &Camera,
    towards: Vec3,
    ends: &[f32],
) -> Option<ShadowViews> {
    let aspect = spec.width as u32 as f32 / spec.height as u32 as f32;
    let size = if spec.quality.raster.shadow_map == 0 { 1024 } else { spec.quality.raster.shadow_map };
    // The curve of docs/report/shadows.md has its knee here.
    let bias = Bias { constant: 0.02, slope: 3.0, normal: 0.5 };
    let shadow = ShadowViews::new(fit::cascades(camera, aspect, towards, ends, size), bias);
    Some(ShadowViews { traced: cuts::TRACED_SHADOWS && spec.quality.raster.shadow_map == 0, ..shadow })
}

fn picture(spec: &FrameSpec) -> Picture {
    let (day, hour) = clock(spec.time);
    let (key, date, textures) = plan(day, hour);
    let [_, x, y, z, tx, ty, tz, fov, _] = key.map(|n| 10.0 * n);
    let camera = Camera::look_at(vec3(x, y, z), vec3(tx, ty, tz), fov.to_radians(), 0.0);
    let camera = spec.camera(camera);
    // Days from J2000, Central European Time.
    let midnight = 9671.5 - HOUR + date as f64;
    let dome = sky(spec, midnight + hour * HOUR);
    let now = dome.lighting();
    // Over the hill in some seconds, again and again.
    let flights = spec.time / 15.0;
    let way = (flights - flights.floor() - 0.5) as f32 * 900.0;
    let turn = Mat3::from_rotation_y(-1.0) * Mat3::from_rotation_z(0.25);
    let place = turn * vec3(0.0, 0.0, -way) + vec3(-4.0, 38.0, -20.0);
    let mut world = world(&dome, textures, turn, place, spec.time);
    world.lights[0].shadow = cascades(spec, &camera, now.direction, &[40.0, 160.0, 900.0, 6000.0]);
    lamp(&mut world, ease(-0.02, 0.1, -dome.sky.sun.y as f64));
    show(spec, dome, world, View::new(camera, spec.width, spec.height), None)
}
