//! The first part of the intro: a ray of light finds a ball of glass, and they see a day out together.
//!
//! Five shots, each with its own set, its own light and one camera move.

use super::{Scene, Shot};
use crate::camera::Camera;
use crate::color::Transfer;
use crate::texture::{Palette, Pattern, Texture};
use crate::tile::Picture;
use crate::timeline::{self, Key, ease};
use crate::trace::shape::Shape;
use crate::trace::world::{Light, Material, Object, Sky, Source, World};
use glam::{Mat3, Vec3, vec3};

/// The part.
pub const LUMEN: Scene =
    Scene { name: "lumen", about: "a ray of light: glass, marble, wood, mirrors", duration: END, picture };

/// Seconds that the part takes.
const END: f64 = 56.0;

/// A set at an instant, and the camera's keys.
#[derive(Clone, Copy, Debug)]
pub struct Take {
    /// The world, by seconds since the shot's start and the last number of the keys.
    set: fn(f32, f32) -> World,
    /// Seconds since the shot's start; eye, target, vertical field of view in degrees, and a number for the set.
    camera: &'static [Key<9>],
}

/// The shots, by the second that each starts.
pub const CUTS: &[(f64, Take)] = &[
    (0.0, Take { set: door, camera: DOOR }),
    (11.0, Take { set: table, camera: TABLE }),
    (21.0, Take { set: columns, camera: COLUMNS }),
    (33.0, Take { set: dance, camera: DANCE }),
    (45.0, Take { set: sunset, camera: SUNSET }),
];

fn picture(shot: &Shot) -> Picture {
    let (world, camera) = stage(shot.time);
    shot.traced(world, camera, Transfer::Srgb)
}

/// What is seen at `time` seconds, and from where.
pub fn stage(time: f64) -> (World, Camera) {
    let (take, time) = timeline::cut(CUTS, END, time);
    let [_, x, y, z, tx, ty, tz, fov, number] = timeline::sample(take.camera, time);
    let camera = Camera::look_at(vec3(x, y, z), vec3(tx, ty, tz), fov.to_radians(), 0.0);
    ((take.set)(time as f32, number), camera)
}

// Dawn: two doors open, and the first ray falls across a dark hall. The number is half of the gap between them, metres.

const DOOR: &[Key<9>] = &[
    [0.0, 2.7, 0.8, 9.6, 0.3, 1.7, 0.0, 42.0, 0.08],
    [5.25, 2.1, 0.9, 8.9, 0.3, 1.7, 0.0, 42.0, 0.5],
    [11.0, 0.7, 1.2, 7.4, 0.3, 1.7, 0.0, 40.0, 1.6],
];

fn door(_: f32, gap: f32) -> World {
    const STONE: Texture = marble(vec3(0.06, 0.06, 0.06), vec3(0.3, 0.29, 0.27), 0.9);
    const WALL: Material = matt(STONE);
    const FLOOR: Material = stone_floor(STONE, 0.4);
    const LAMP: Material = Material::matt(Texture::plain(vec3(25.0, 16.0, 5.0)));
    const LEAF: Texture = rings(vec3(0.03, 0.014, 0.008), vec3(0.16, 0.075, 0.03), 3.0, 0.2);
    let sun = vec3(-0.1, 0.14, -1.0).normalize();
    let mut set = Set::default();
    set.floor(&FLOOR);
    set.ball(vec3(1.75, 0.75, 3.6), 0.75, &GLASS);
    set.backdrop(Shape::Sphere { center: sun * 300.0, radius: 8.0 }, &LAMP);
    set.block(vec3(0.0, 6.5, 6.0), vec3(9.0, 1.0, 9.0), &WALL);
    set.block(vec3(0.0, 3.0, 15.0), vec3(9.0, 5.0, 1.0), &WALL);
    for side in [-1.0, 1.0] {
        let leaf = vec3(side * (gap + 4.0), 2.8, 0.0);
        let wood = LEAF.on(leaf - vec3(side * 1.5, 0.0, 1.0), Mat3::IDENTITY);
        set.block(leaf, vec3(4.0, 2.9, 0.25), &matt(wood));
        set.block(vec3(side * 7.0, 3.0, 7.0), vec3(1.0, 4.0, 9.0), &WALL);
        for z in [2.2, 5.6] {
            set.column(vec3(side * 3.7, 0.0, z), 5.6, 0.42, &WALL);
        }
    }
    set.sunlight(sun, vec3(5.0, 2.8, 1.1));
    set.lamp(vec3(-2.0, 4.6, 10.0), vec3(0.1, 0.15, 0.26), 0.0);
    let sky = [vec3(0.5, 0.27, 0.2), vec3(0.1, 0.2, 0.45), sun, vec3(0.45, 0.32, 0.12)];
    set.world(vec3(0.06, 0.085, 0.15), &sky, 24.0, 6)
}

// Morning: a table, close, through the ball.

const TABLE: &[Key<9>] = &[
    [0.0, 1.9, 1.15, 3.3, 0.25, 0.95, 0.0, 38.0, 0.0],
    [5.0, 0.5, 1.0, 3.5, 0.35, 0.95, 0.0, 38.0, 0.0],
    [10.0, -1.1, 1.25, 3.4, 0.1, 0.95, 0.0, 38.0, 0.0],
];

fn table(time: f32, _: f32) -> World {
    const GRAIN: Texture = rings(vec3(0.1, 0.04, 0.015), vec3(0.34, 0.17, 0.065), 2.5, 1.0);
    let along = Mat3::from_cols(vec3(0.0, 0.2, 0.0), Vec3::X, Vec3::Z);
    let top = matt(GRAIN.on(vec3(0.0, -1.1, 0.4), along)).polished(0.05, 0.3, 40.0);
    let mut set = Set::default();
    set.block(vec3(0.0, -0.2, -1.0), vec3(7.0, 0.2, 5.6), &top);
    set.ball(vec3(-0.4, 1.0, 0.0), 1.0, &GLASS);
    for i in 0..7 {
        let k = i as u32 as f32;
        let foot = vec3(1.6 * k - 4.6, 0.0, -5.4);
        set.marbled(i, foot, 2.1 + 1.2 * (k * 0.7 + 0.5 * time).sin(), 0.45, 0.3 * k);
    }
    const ROLLING: [(Texture, [f32; 4]); 3] =
        [(RED, [0.42, -1.5, -3.6, 0.75]), (GREEN, [0.55, -3.7, 3.6, -0.6]), (WHITE, [0.3, 1.1, 3.0, -0.25])];
    for (texture, [radius, z, start, speed]) in ROLLING {
        // As far as it has rolled along x it has turned.
        let way = start + speed * time;
        let center = vec3(way, radius, z);
        let skin = matt(texture.on(center, Mat3::from_rotation_z(way / radius))).polished(0.12, 0.5, 60.0);
        set.ball(center, radius, &skin);
    }
    set.sunlight(vec3(-0.75, 0.5, 0.1).normalize(), vec3(1.15, 0.95, 0.7));
    let sky = [vec3(0.2, 0.36, 0.4), vec3(0.02, 0.06, 0.12), vec3(-0.5, 0.3, -0.8).normalize(), vec3(0.5, 0.4, 0.2)];
    set.world(vec3(0.13, 0.16, 0.19), &sky, 8.0, 5)
}

// Noon and after: turning columns, and their shadows.

const COLUMNS: &[Key<9>] = &[
    [0.0, 1.5, 0.7, 5.8, -0.4, 1.7, -4.0, 48.0, 0.0],
    [6.0, 0.7, 1.3, 1.2, -0.5, 1.6, -9.0, 48.0, 0.0],
    [12.0, -0.9, 2.0, -3.6, 0.3, 1.5, -14.0, 48.0, 0.0],
];

fn columns(time: f32, _: f32) -> World {
    const STONE: Texture = marble(vec3(0.12, 0.085, 0.06), vec3(0.36, 0.27, 0.19), 0.6);
    const BEAM: Material = matt(STONE);
    const FLOOR: Material = stone_floor(STONE, 0.7);
    const GOLD: Material = Material {
        reflectance: vec3(0.75, 0.52, 0.25),
        ..matt(Texture::plain(vec3(0.3, 0.18, 0.06))).polished(0.0, 0.6, 60.0)
    };
    let sun = vec3(0.8, 0.55, -0.3).normalize();
    let mut set = Set::default();
    set.floor(&FLOOR);
    for side in [-2.6, 2.6] {
        for i in 0..6 {
            let foot = vec3(side, 0.0, 1.0 - 3.4 * i as u32 as f32);
            set.marbled(i, foot, 5.4, 0.55, side * 0.2 * time + i as u32 as f32);
        }
        set.block(vec3(side, 5.8, -7.5), vec3(0.7, 0.4, 10.0), &BEAM);
    }
    set.ball(vec3(-1.2 * (0.42 * time).cos(), 0.6, -time), 0.6, &GOLD);
    set.sunlight(sun, vec3(1.7, 1.25, 0.8));
    let sky = [vec3(0.58, 0.52, 0.46), vec3(0.0, 0.08, 0.4), sun, vec3(0.5, 0.35, 0.15)];
    set.world(vec3(0.14, 0.19, 0.28), &sky, 6.0, 4)
}

// Evening: spheres dance on an inlaid floor, under a lamp.

const DANCE: &[Key<9>] = &[
    [0.0, 6.5, 4.6, 6.2, 0.6, 0.6, 0.0, 42.0, 0.0],
    [4.0, 1.0, 2.9, 7.6, 0.7, 0.9, 0.0, 42.0, 0.0],
    [8.0, -4.0, 1.8, 5.8, 0.9, 1.2, 0.5, 42.0, 0.0],
    [12.0, -6.6, 1.3, 2.3, 0.5, 1.4, 0.7, 42.0, 0.0],
];

fn dance(time: f32, _: f32) -> World {
    const INLAYS: [(f32, f32, f32, Texture); 3] = [
        (-0.04, 5.4, 0.0, marble(vec3(0.03, 0.05, 0.06), vec3(0.2, 0.26, 0.28), 7.0)),
        (-0.02, 4.0, 0.14, rings(vec3(0.12, 0.045, 0.015), vec3(0.4, 0.19, 0.075), 2.5, 0.3)),
        (0.0, 2.6, 0.14, {
            Texture::new(Pattern::Checker, Palette::Mix(vec3(0.06, 0.06, 0.07), vec3(0.46, 0.42, 0.35)), 1.4)
        }),
    ];
    const MOON: Material = Material::matt(clouds(vec3(0.1, 0.15, 0.25), vec3(0.75, 0.85, 1.0), 0.25));
    let moon = vec3(0.99, 0.15, 0.07).normalize();
    let mut set = Set::default();
    let turn = Mat3::from_rotation_y(0.12 * time);
    for (y, radius, mirror, texture) in INLAYS {
        let material = matt(texture.on(Vec3::ZERO, turn)).polished(mirror, 0.3, 50.0);
        set.backdrop(upright(vec3(0.0, y - 0.4, 0.0), 0.4, radius), &material);
    }
    set.ball(vec3(0.0, 1.5 + 0.12 * (1.1 * time).sin(), 0.0), 0.9, &GLASS);
    set.backdrop(Shape::Sphere { center: moon * 90.0, radius: 6.0 }, &MOON);
    for i in 0..9 {
        let (ring, k) = (i % 3, i as u32 as f32);
        let (radius, speed, size) = [(1.9, 0.55, 0.3), (3.2, -0.4, 0.42), (4.5, 0.28, 0.34)][ring];
        let (sin, cos) = ((i / 3) as u32 as f32 * 2.0944 + ring as u32 as f32 + speed * time).sin_cos();
        let height = size + 0.5 * (1.3 * time + k * 1.7).sin().abs();
        let center = vec3(radius * cos, height, radius * sin);
        let texture = [RED, WHITE, GREEN][(i / 3 + ring) % 3].on(center, Mat3::from_rotation_x(time + k));
        set.ball(center, size, &matt(texture).polished(0.35 * (i % 2) as u32 as f32, 0.5, 50.0));
    }
    set.lamp(vec3(1.5, 5.5, -2.0), vec3(1.2, 0.95, 0.65), 0.4);
    set.sunlight(moon, vec3(0.1, 0.2, 0.42));
    let sky = [vec3(0.03, 0.05, 0.11), vec3(0.02, 0.02, 0.05), moon, vec3(0.16, 0.18, 0.3)];
    set.world(vec3(0.07, 0.08, 0.12), &sky, 6.0, 4)
}

// Sunset: the ball on the water, and the sun in it.

const SUNSET: &[Key<9>] = &[
    [0.0, -1.4, 0.9, 3.4, 0.3, 1.05, 0.0, 40.0, 0.0],
    [5.0, -0.8, 1.3, 5.4, 0.8, 1.3, 0.0, 40.0, 0.0],
    [11.0, 0.6, 2.3, 9.0, 1.2, 1.6, 0.0, 40.0, 0.0],
];

fn sunset(time: f32, _: f32) -> World {
    const LAMP: Material = Material::matt(Texture::plain(vec3(25.0, 14.0, 3.0)));
    const STONE: Material = matt(marble(VEINS[0].0, VEINS[0].1, 1.5));
    const WATER: Material = Material {
        fresnel: 1.0,
        ..matt(clouds(vec3(0.0, 0.01, 0.03), vec3(0.05, 0.1, 0.14), 0.4)).polished(0.05, 0.0, 1.0)
    };
    let day = 1.0 - ease(-2.0, 14.0, time as f64);
    let sun = vec3(0.17, -0.14 + 0.26 * day, -1.0).normalize();
    let ambient = vec3(0.1, 0.11, 0.2);
    // The clouds have no light but the ambient: theirs is painted on. Towards the horizon they mirror the sky.
    let lit = vec3(0.06, 0.06, 0.14) + vec3(1.1, 0.5, 0.16) * day;
    let deck = clouds(vec3(0.06, 0.02, 0.03) * day / ambient, lit / ambient, 0.05);
    let deck = Material { fresnel: 1.0, ..Material::matt(deck.on(vec3(0.0, 0.0, 1.5 * time), Mat3::IDENTITY)) };
    let mut set = Set::default();
    set.backdrop(Shape::Globe { touch: Vec3::ZERO, normal: Vec3::Y, radius: 220.0 }, &WATER);
    set.backdrop(Shape::Plane { normal: Vec3::NEG_Y, offset: -25.0 }, &deck);
    set.ball(vec3(-0.5, 0.9, 0.0), 1.0, &GLASS);
    set.backdrop(Shape::Sphere { center: sun * 60.0, radius: 2.4 }, &LAMP);
    set.block(vec3(3.3, 4.7, -14.0), vec3(3.0, 0.35, 0.6), &STONE);
    for (x, z) in [(1.1, -14.0), (5.5, -14.0), (-5.2, -9.0), (-8.0, -17.0)] {
        set.column(vec3(x, -1.5, z), 6.0, 0.5, &STONE);
    }
    let red = vec3(1.0, 0.45, 0.12) * (0.2 + 0.8 * day);
    set.sunlight(sun, red * 1.2);
    let sky = [vec3(0.12, 0.1, 0.2) + vec3(0.6, 0.2, 0.0) * day, vec3(0.02, 0.05, 0.2), sun, red];
    set.world(ambient, &sky, 18.0, 6)
}

// What the sets are made of.

const GLASS: Material = Material { specular: 0.8, exponent: 200.0, ..Material::glass(1.5, vec3(0.95, 0.985, 0.98)) };
/// Veins and ground of the columns' marbles.
const VEINS: [(Vec3, Vec3); 3] = [
    (vec3(0.2, 0.13, 0.09), vec3(0.74, 0.66, 0.54)),
    (vec3(0.62, 0.66, 0.58), vec3(0.16, 0.27, 0.25)),
    (vec3(0.7, 0.52, 0.44), vec3(0.44, 0.2, 0.14)),
];
const RED: Texture = clouds(vec3(0.15, 0.0, 0.0), vec3(0.9, 0.2, 0.08), 4.0);
const GREEN: Texture = Texture::new(
    Pattern::Marble { warp: 6.0, scale: 3.0, octaves: 3 },
    Palette::Mix(vec3(0.01, 0.08, 0.07), vec3(0.2, 0.55, 0.42)),
    7.0,
);
const WHITE: Texture =
    Texture::new(Pattern::Turbulence { octaves: 4 }, Palette::Mix(vec3(0.9, 0.86, 0.78), vec3(0.1, 0.15, 0.4)), 3.0);

const fn clouds(dark: Vec3, light: Vec3, scale: f32) -> Texture {
    Texture::new(Pattern::Clouds { octaves: 4 }, Palette::Mix(dark, light), scale)
}

/// Layers along x, folded.
const fn marble(dark: Vec3, light: Vec3, scale: f32) -> Texture {
    Texture::new(Pattern::Marble { warp: 7.0, scale: 3.5, octaves: 3 }, Palette::Mix(dark, light), scale)
}

/// Wood: `scale` rings a metre around y, bent by `warp` rings. The last year's wood is as dark as the next one's.
const fn rings(dark: Vec3, light: Vec3, scale: f32, warp: f32) -> Texture {
    let late = vec3(0.4 * dark.x + 0.6 * light.x, 0.4 * dark.y + 0.6 * light.y, 0.4 * dark.z + 0.6 * light.z);
    Texture::new(Pattern::Wood { warp, octaves: 2 }, Palette::Ramp([dark, light, late, dark]), scale)
}

#[inline(never)] // Some hundred bytes, for many callers.
const fn matt(texture: Texture) -> Material {
    Material::matt(texture).polished(0.0, 0.12, 24.0)
}

/// Polished: far away it is a mirror of the sky, so that nothing shimmers at the horizon.
const fn stone_floor(texture: Texture, fresnel: f32) -> Material {
    Material { fresnel, ..matt(texture).polished(0.06, 0.2, 40.0) }
}

/// An upright cylinder on `foot`.
fn upright(foot: Vec3, height: f32, radius: f32) -> Shape {
    Shape::Cylinder { center: foot + Vec3::Y * (height * 0.5), axis: Vec3::Y, half: height * 0.5, radius }
}

/// A world that is being built.
#[derive(Default)]
struct Set {
    objects: Vec<Object>,
    lights: Vec<Light>,
}

impl Set {
    fn solid(&mut self, shape: Shape, material: &Material) {
        self.objects.push(Object { shape, material: *material, casts_shadow: true });
    }

    /// What lies below or beyond all lights.
    fn backdrop(&mut self, shape: Shape, material: &Material) {
        self.objects.push(Object { shape, material: *material, casts_shadow: false });
    }

    fn floor(&mut self, material: &Material) {
        self.backdrop(Shape::Plane { normal: Vec3::Y, offset: 0.0 }, material);
    }

    fn ball(&mut self, center: Vec3, radius: f32, material: &Material) {
        self.solid(Shape::Sphere { center, radius }, material);
    }

    fn block(&mut self, center: Vec3, half: Vec3, material: &Material) {
        self.solid(Shape::Block { center, half, turn: Mat3::IDENTITY }, material);
    }

    fn column(&mut self, foot: Vec3, height: f32, radius: f32, material: &Material) {
        self.solid(upright(foot, height, radius), material);
    }

    /// A column of marble number `i`, turned by `angle`.
    fn marbled(&mut self, i: usize, foot: Vec3, height: f32, radius: f32, angle: f32) {
        let (vein, ground) = VEINS[i % VEINS.len()];
        let palette = Palette::Ramp([vein, ground, ground * 0.75, ground]);
        let texture = Texture { palette, ..marble(vein, ground, 6.0) }.on(foot, Mat3::from_rotation_y(angle));
        self.column(foot, height, radius, &matt(texture).polished(0.0, 0.35, 40.0));
    }

    fn sunlight(&mut self, sun: Vec3, color: Vec3) {
        self.lights.push(Light { source: Source::Directional(sun), color, radius: 0.0 });
    }

    fn lamp(&mut self, position: Vec3, color: Vec3, radius: f32) {
        self.lights.push(Light { source: Source::Point(position), color, radius });
    }

    /// The world, under a sky of these colours at the horizon and the zenith, with a glow in a direction.
    fn world(self, ambient: Vec3, sky: &[Vec3; 4], glow: f32, max_level: u32) -> World {
        let [horizon, zenith, towards, color] = *sky;
        let sky = Sky { horizon, zenith, glow: (towards, color, glow) };
        World { objects: self.objects, lights: self.lights, ambient, sky, max_level }
    }
}
