//! The first part of the intro: a ray of light finds a ball of glass, and they see a day out together.
//!
//! Five shots, each with its own set, its own light and one camera move.

use super::{Scene, Shot};
use crate::camera::Camera;
use crate::color::Transfer;
use crate::tile::Picture;
use crate::timeline::{self, Key, ease};
use crate::trace::shape::Shape;
use crate::trace::texture::{Palette, Pattern, Texture};
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
    /// The world, by seconds since the shot's start.
    set: fn(f64) -> World,
    /// Seconds since the shot's start; eye, target, vertical field of view in degrees.
    camera: &'static [Key<7>],
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
    let [x, y, z, tx, ty, tz, fov] = timeline::sample(take.camera, time);
    ((take.set)(time), Camera::look_at(vec3(x, y, z), vec3(tx, ty, tz), fov.to_radians(), 0.0))
}

// Dawn: two doors open, and the first ray falls across a dark hall.

const DOOR: &[Key<7>] = &[
    (0.0, [2.7, 0.8, 9.6, 0.3, 1.7, 0.0, 42.0]),
    (5.0, [2.1, 0.9, 8.9, 0.3, 1.7, 0.0, 42.0]),
    (11.0, [0.7, 1.2, 7.4, 0.3, 1.7, 0.0, 40.0]),
];

/// Half of the gap between the doors, metres.
const GAP: &[Key<1>] = &[(0.0, [0.08]), (5.5, [0.5]), (11.0, [1.6])];

fn door(time: f64) -> World {
    let sun = vec3(-0.1, 0.14, -1.0).normalize();
    let stone = MARBLE.painted([0.06, 0.06, 0.06], [0.3, 0.29, 0.27], 0.9);
    let wall = matt(stone);
    let mut objects = vec![
        floor(stone_floor(stone, 0.4)),
        ball(vec3(1.75, 0.75, 3.6), 0.75, GLASS),
        lamp(sun * 300.0, 8.0, vec3(25.0, 16.0, 5.0)),
        block(vec3(0.0, 6.5, 6.0), vec3(9.0, 1.0, 9.0), wall),
        block(vec3(0.0, 3.0, 15.0), vec3(9.0, 5.0, 1.0), wall),
    ];
    let [gap] = timeline::sample(GAP, time);
    for side in [-1.0, 1.0] {
        let leaf = vec3(side * (gap + 4.0), 2.8, 0.0);
        let wood = rings([0.03, 0.014, 0.008], [0.16, 0.075, 0.03], 3.0, 0.2)
            .on(leaf - vec3(side * 1.5, 0.0, 1.0), Mat3::IDENTITY);
        objects.push(block(leaf, vec3(4.0, 2.9, 0.25), matt(wood)));
        objects.push(block(vec3(side * 7.0, 3.0, 7.0), vec3(1.0, 4.0, 9.0), wall));
        for z in [2.2, 5.6] {
            objects.push(column(vec3(side * 3.7, 0.0, z), 5.6, 0.42, wall));
        }
    }
    World {
        objects,
        lights: vec![
            sunlight(sun, vec3(5.0, 2.8, 1.1)),
            Light { source: Source::Point(vec3(-2.0, 4.6, 10.0)), color: vec3(0.1, 0.15, 0.26), radius: 0.0 },
        ],
        ambient: vec3(0.06, 0.085, 0.15),
        sky: Sky {
            horizon: vec3(0.5, 0.27, 0.2),
            zenith: vec3(0.1, 0.2, 0.45),
            glow: (sun, vec3(0.45, 0.32, 0.12), 24.0),
        },
        max_level: 6,
    }
}

// Morning: a table, close, through the ball.

const TABLE: &[Key<7>] = &[
    (0.0, [1.9, 1.15, 3.3, 0.25, 0.95, 0.0, 38.0]),
    (5.0, [0.5, 1.0, 3.5, 0.35, 0.95, 0.0, 38.0]),
    (10.0, [-1.1, 1.25, 3.4, 0.1, 0.95, 0.0, 38.0]),
];

fn table(time: f64) -> World {
    let sun = vec3(-0.75, 0.5, 0.1).normalize();
    let grain = rings([0.1, 0.04, 0.015], [0.34, 0.17, 0.065], 2.5, 1.0);
    let along = Mat3::from_cols(vec3(0.0, 0.2, 0.0), Vec3::X, Vec3::Z);
    let top = Texture { origin: vec3(0.0, -1.1, 0.4), turn: grain.turn * along, ..grain };
    let mut objects = vec![
        block(vec3(0.0, -0.2, -1.0), vec3(7.0, 0.2, 5.6), matt(top).polished(0.05, 0.3, 40.0)),
        ball(vec3(-0.4, 1.0, 0.0), 1.0, GLASS),
    ];
    for i in 0..7 {
        let k = i as f32;
        let foot = vec3(1.6 * k - 4.6, 0.0, -5.4);
        let height = 2.1 + 1.2 * (k * 0.7 + 0.5 * time as f32).sin();
        objects.push(column(foot, height, 0.45, marbled(i, foot, 0.3 * k)));
    }
    for (texture, radius, z, start, speed) in
        [(RED, 0.42, -1.5, -3.6, 0.75), (GREEN, 0.55, -3.7, 3.6, -0.6), (WHITE, 0.3, 1.1, 3.0, -0.25)]
    {
        let way = start + speed * time as f32;
        objects.push(rolling(vec3(way, radius, z), radius, way, texture));
    }
    World {
        objects,
        lights: vec![sunlight(sun, vec3(1.15, 0.95, 0.7))],
        ambient: vec3(0.13, 0.16, 0.19),
        sky: Sky {
            horizon: vec3(0.2, 0.36, 0.4),
            zenith: vec3(0.02, 0.06, 0.12),
            glow: (vec3(-0.5, 0.3, -0.8).normalize(), vec3(0.5, 0.4, 0.2), 8.0),
        },
        max_level: 5,
    }
}

// Noon and after: turning columns, and their shadows.

const COLUMNS: &[Key<7>] = &[
    (0.0, [1.5, 0.7, 5.8, -0.4, 1.7, -4.0, 48.0]),
    (6.0, [0.7, 1.3, 1.2, -0.5, 1.6, -9.0, 48.0]),
    (12.0, [-0.9, 2.0, -3.6, 0.3, 1.5, -14.0, 48.0]),
];

fn columns(time: f64) -> World {
    let sun = vec3(0.8, 0.55, -0.3).normalize();
    let stone = MARBLE.painted([0.12, 0.085, 0.06], [0.36, 0.27, 0.19], 0.6);
    let mut objects = vec![floor(stone_floor(stone, 0.7))];
    for i in 0..6 {
        for side in [-2.6, 2.6] {
            let foot = vec3(side, 0.0, 1.0 - 3.4 * i as f32);
            objects.push(column(foot, 5.4, 0.55, marbled(i, foot, side * 0.2 * time as f32 + i as f32)));
        }
    }
    for side in [-2.6, 2.6] {
        objects.push(block(vec3(side, 5.8, -7.5), vec3(0.7, 0.4, 10.0), matt(stone)));
    }
    let way = -time as f32;
    let gold = Material {
        reflectance: vec3(0.75, 0.52, 0.25),
        ..matt(Texture::plain(vec3(0.3, 0.18, 0.06))).polished(0.0, 0.6, 60.0)
    };
    objects.push(ball(vec3(-1.2 * (0.42 * time as f32).cos(), 0.6, way), 0.6, gold));
    World {
        objects,
        lights: vec![sunlight(sun, vec3(1.7, 1.25, 0.8))],
        ambient: vec3(0.14, 0.19, 0.28),
        sky: Sky {
            horizon: vec3(0.58, 0.52, 0.46),
            zenith: vec3(0.0, 0.08, 0.4),
            glow: (sun, vec3(0.5, 0.35, 0.15), 6.0),
        },
        max_level: 4,
    }
}

// Evening: spheres dance on an inlaid floor, under a lamp.

const DANCE: &[Key<7>] = &[
    (0.0, [6.5, 4.6, 6.2, 0.6, 0.6, 0.0, 42.0]),
    (4.0, [1.0, 2.9, 7.6, 0.7, 0.9, 0.0, 42.0]),
    (8.0, [-4.0, 1.8, 5.8, 0.9, 1.2, 0.5, 42.0]),
    (12.0, [-6.6, 1.3, 2.3, 0.5, 1.4, 0.7, 42.0]),
];

fn dance(time: f64) -> World {
    let t = time as f32;
    let turn = Mat3::from_rotation_y(0.12 * t);
    let disc = |y: f32, radius: f32, mirror: f32, texture: Texture| {
        let material = matt(texture.on(Vec3::ZERO, turn)).polished(mirror, 0.3, 50.0);
        Object { casts_shadow: false, ..column(vec3(0.0, y - 0.4, 0.0), 0.4, radius, material) }
    };
    let checker = Texture::new(Pattern::Checker, Palette::Mix(vec3(0.06, 0.06, 0.07), vec3(0.46, 0.42, 0.35)), 1.4);
    let moon = vec3(0.99, 0.15, 0.07).normalize();
    let craters = clouds(vec3(0.1, 0.15, 0.25), vec3(0.75, 0.85, 1.0), 0.25);
    let mut objects = vec![
        disc(-0.04, 5.4, 0.0, MARBLE.painted([0.03, 0.05, 0.06], [0.2, 0.26, 0.28], 7.0)),
        disc(-0.02, 4.0, 0.14, rings([0.12, 0.045, 0.015], [0.4, 0.19, 0.075], 2.5, 0.3)),
        disc(0.0, 2.6, 0.14, checker),
        ball(vec3(0.0, 1.5 + 0.12 * (1.1 * t).sin(), 0.0), 0.9, GLASS),
        unshadowing(Shape::Sphere { center: moon * 90.0, radius: 6.0 }, Material::matt(craters)),
    ];
    for i in 0..9 {
        let (ring, k) = (i % 3, i as f32);
        let (radius, speed, size) = [(1.9, 0.55, 0.3), (3.2, -0.4, 0.42), (4.5, 0.28, 0.34)][ring];
        let angle = (i / 3) as f32 * 2.0944 + ring as f32 + speed * t;
        let height = size + 0.5 * (1.3 * t + k * 1.7).sin().abs();
        let center = vec3(radius * angle.cos(), height, radius * angle.sin());
        let texture = [RED, WHITE, GREEN][(i / 3 + ring) % 3].on(center, Mat3::from_rotation_x(t + k));
        objects.push(ball(center, size, matt(texture).polished(0.35 * (i % 2) as f32, 0.5, 50.0)));
    }
    World {
        objects,
        lights: vec![
            Light { source: Source::Point(vec3(1.5, 5.5, -2.0)), color: vec3(1.2, 0.95, 0.65), radius: 0.4 },
            sunlight(moon, vec3(0.1, 0.2, 0.42)),
        ],
        ambient: vec3(0.07, 0.08, 0.12),
        sky: Sky {
            horizon: vec3(0.03, 0.05, 0.11),
            zenith: vec3(0.02, 0.02, 0.05),
            glow: (moon, vec3(0.16, 0.18, 0.3), 6.0),
        },
        max_level: 4,
    }
}

// Sunset: the ball on the water, and the sun in it.

const SUNSET: &[Key<7>] = &[
    (0.0, [-1.4, 0.9, 3.4, 0.3, 1.05, 0.0, 40.0]),
    (5.0, [-0.8, 1.3, 5.4, 0.8, 1.3, 0.0, 40.0]),
    (11.0, [0.6, 2.3, 9.0, 1.2, 1.6, 0.0, 40.0]),
];

fn sunset(time: f64) -> World {
    let day = 1.0 - ease(-2.0, 14.0, time);
    let sun = vec3(0.17, -0.14 + 0.26 * day, -1.0).normalize();
    let ambient = vec3(0.1, 0.11, 0.2);
    let deep = clouds(vec3(0.0, 0.01, 0.03), vec3(0.05, 0.1, 0.14), 0.4);
    // The clouds have no light but the ambient: theirs is painted on. Towards the horizon they mirror the sky.
    let lit = vec3(0.06, 0.06, 0.14) + vec3(1.1, 0.5, 0.16) * day;
    let deck = clouds(vec3(0.06, 0.02, 0.03) * day / ambient, lit / ambient, 0.05);
    let deck = Material { fresnel: 1.0, ..Material::matt(deck.on(vec3(0.0, 0.0, 1.5 * time as f32), Mat3::IDENTITY)) };
    let stone = matt(MARBLE.painted(VEINS[0].0, VEINS[0].1, 1.5));
    let water = Shape::Globe { touch: Vec3::ZERO, normal: Vec3::Y, radius: 220.0 };
    let mut objects = vec![
        unshadowing(water, Material { fresnel: 1.0, ..matt(deep).polished(0.05, 0.0, 1.0) }),
        unshadowing(Shape::Plane { normal: Vec3::NEG_Y, offset: -25.0 }, deck),
        ball(vec3(-0.5, 0.9, 0.0), 1.0, GLASS),
        lamp(sun * 60.0, 2.4, vec3(25.0, 14.0, 3.0)),
        block(vec3(3.3, 4.7, -14.0), vec3(3.0, 0.35, 0.6), stone),
    ];
    for (x, z) in [(1.1, -14.0), (5.5, -14.0), (-5.2, -9.0), (-8.0, -17.0)] {
        objects.push(column(vec3(x, -1.5, z), 6.0, 0.5, stone));
    }
    let red = vec3(1.0, 0.45, 0.12) * (0.2 + 0.8 * day);
    World {
        objects,
        lights: vec![sunlight(sun, red * 1.2)],
        ambient,
        sky: Sky {
            horizon: vec3(0.12, 0.1, 0.2) + vec3(0.6, 0.2, 0.0) * day,
            zenith: vec3(0.02, 0.05, 0.2),
            glow: (sun, red, 18.0),
        },
        max_level: 6,
    }
}

// What the sets are made of.

const GLASS: Material = Material { specular: 0.8, exponent: 200.0, ..Material::glass(1.5, vec3(0.95, 0.985, 0.98)) };
/// Layers along x, folded.
const MARBLE: Texture =
    Texture::new(Pattern::Marble { warp: 7.0, scale: 3.5, octaves: 3 }, Palette::Mix(Vec3::ZERO, Vec3::ONE), 1.0);
/// Veins and ground of the columns' marbles.
const VEINS: [([f32; 3], [f32; 3]); 3] = [
    ([0.2, 0.13, 0.09], [0.74, 0.66, 0.54]),
    ([0.62, 0.66, 0.58], [0.16, 0.27, 0.25]),
    ([0.7, 0.52, 0.44], [0.44, 0.2, 0.14]),
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

impl Texture {
    /// The same in other colours, `scale` times finer.
    fn painted(self, dark: [f32; 3], light: [f32; 3], scale: f32) -> Texture {
        Texture { palette: Palette::Mix(dark.into(), light.into()), turn: self.turn * scale, ..self }
    }
}

/// Wood: `scale` rings a metre around y, bent by `warp` rings. The last year's wood is as dark as the next one's.
fn rings(dark: [f32; 3], light: [f32; 3], scale: f32, warp: f32) -> Texture {
    let (dark, light) = (Vec3::from(dark), Vec3::from(light));
    Texture::new(Pattern::Wood { warp, octaves: 2 }, Palette::Ramp([dark, light, dark.lerp(light, 0.6), dark]), scale)
}

/// The marble of column number `i` on `foot`, turned by `angle`.
fn marbled(i: usize, foot: Vec3, angle: f32) -> Material {
    let (vein, ground) = VEINS[i % VEINS.len()];
    let (vein, ground) = (Vec3::from(vein), Vec3::from(ground));
    let palette = Palette::Ramp([vein, ground, ground * 0.75, ground]);
    let texture = Texture { palette, ..MARBLE.painted([0.0; 3], [0.0; 3], 6.0) };
    matt(texture.on(foot, Mat3::from_rotation_y(angle))).polished(0.0, 0.35, 40.0)
}

fn sunlight(sun: Vec3, color: Vec3) -> Light {
    Light { source: Source::Directional(sun), color, radius: 0.0 }
}

fn matt(texture: Texture) -> Material {
    Material::matt(texture).polished(0.0, 0.12, 24.0)
}

/// Polished: far away it is a mirror of the sky, so that nothing shimmers at the horizon.
fn stone_floor(texture: Texture, fresnel: f32) -> Material {
    Material { fresnel, ..matt(texture).polished(0.06, 0.2, 40.0) }
}

fn solid(shape: Shape, material: Material) -> Object {
    Object { shape, material, casts_shadow: true }
}

/// What lies below or beyond all lights.
fn unshadowing(shape: Shape, material: Material) -> Object {
    Object { shape, material, casts_shadow: false }
}

fn floor(material: Material) -> Object {
    unshadowing(Shape::Plane { normal: Vec3::Y, offset: 0.0 }, material)
}

fn ball(center: Vec3, radius: f32, material: Material) -> Object {
    solid(Shape::Sphere { center, radius }, material)
}

/// A ball that has rolled `way` metres along x.
fn rolling(center: Vec3, radius: f32, way: f32, texture: Texture) -> Object {
    ball(center, radius, matt(texture.on(center, Mat3::from_rotation_z(way / radius))).polished(0.12, 0.5, 60.0))
}

/// A ball that shines by itself: brighter than white in the faintest light.
fn lamp(center: Vec3, radius: f32, color: Vec3) -> Object {
    unshadowing(Shape::Sphere { center, radius }, Material::matt(Texture::plain(color)))
}

fn block(center: Vec3, half: Vec3, material: Material) -> Object {
    solid(Shape::Block { center, half, turn: Mat3::IDENTITY }, material)
}

/// An upright cylinder on `foot`.
fn column(foot: Vec3, height: f32, radius: f32, material: Material) -> Object {
    let center = foot + Vec3::Y * (height * 0.5);
    solid(Shape::Cylinder { center, axis: Vec3::Y, half: height * 0.5, radius }, material)
}
