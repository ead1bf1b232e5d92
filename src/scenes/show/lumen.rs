//! The first part of the intro: a ray of light finds a ball of glass, and they see a day out together.
//!
//! Five shots, each with its own set, its own light and one camera move: each a script.

use crate::cuts::BENCH;
use crate::frame::Picture;
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Scene};
use crate::scenes::script::{
    ABS, ADD, AGAIN, CHECKER, CLOUDS, COS, COUNT, CREASES, MARBLE, MUL, PICK, PLAIN, REPEAT, SIN, Script, VARIABLES,
    VEINS, WOOD, Word, get, kind, operations, script, set, texture,
};
use crate::scenes::traced;
use crate::timeline::{self, ease};
use crate::trace::{Background, Emitter, Glow, Light, Material, Object, Shape, World};
use crate::view::Camera;
use glam::{Mat3, Vec3, vec3};

/// The part.
pub const LUMEN: Scene = Scene {
    name: "lumen",
    about: "a ray of light: glass, marble, wood, mirrors",
    duration: END,
    parameters: &[],
    picture,
}
.part();

/// Seconds that the part takes.
const END: f64 = 56.0;

/// The shots' scripts, by the second that each starts.
pub const CUTS: &[(f64, &[u8])] = &[(0.0, DOOR), (11.0, TABLE), (21.0, OWN[0]), (33.0, OWN[1]), (45.0, OWN[2])];

/// Those of this part alone: the show leaves them out, and so does the 64 kB build.
const OWN: [&[u8]; 3] = if BENCH { [COLUMNS, DANCE, SUNSET] } else { [TABLE, TABLE, SUNSET] };

operations! {
    /// The camera's keys, nine numbers each: seconds since the shot's start; eye, target, vertical field of view in
    /// tens of degrees, and what `NUMBER` shall be.
    CAMERA = 40;
    /// A place: the next texture's origin, the middle of the next body.
    AT = 41;
    /// Moves that place along its direction to a distance from the origin, hundreds of metres.
    AWAY = 42;
    /// Columns of a matrix: how the next texture is turned (world to texture).
    TURN = 43;
    /// A texture, as `texture` takes it.
    TEXTURE = 44;
    /// What the next bodies have beside the last texture: mirror, weight and a tenth of the exponent of the highlight, what Fresnel
    /// adds, and 1 where they keep light from others.
    SURFACE = 45;
    /// Or they are of glass.
    GLASS = 46;
    /// Bodies: a ball of a radius,
    BALL = 47;
    /// a box of half a size,
    BLOCK = 48;
    /// an upright cylinder on that place, of a height and a radius,
    COLUMN = 49;
    /// a plane, upwards for 1 and downwards for -1, that far from the origin,
    PLANE = 50;
    /// Light of a colour from a ball in the direction of that place, whose radius is the sine of what is seen of it,
    SUN = 51;
    /// or of a radius on the place.
    LAMP = 52;
    /// The last word: light from everywhere; the sky's colours at the horizon, at the zenith, and of a glow in the
    /// direction of that place, with a tenth of its exponent; the longest chain of rays.
    WORLD = 53;
}

// Variables: seconds since the shot's start, how much of the evening is left (1 to 0), the number of the keys.
const TIME: Word = get(0);
const DAY: Word = get(1);
const GAP: Word = get(2);
const NUMBER: usize = 2;

fn picture(spec: &FrameSpec) -> Picture {
    let (world, camera) = stage(spec.time);
    traced(spec, world, camera, Transfer::Srgb)
}

/// What is seen at `time` seconds, and from where.
pub fn stage(time: f64) -> (World, Camera) {
    let (bytes, time) = timeline::cut(CUTS, END, time);
    let mut set = EMPTY;
    let mut script = Script::new(bytes, [time as f32, 1.0 - ease(-2.0, 14.0, time)]);
    set.build(&mut script, time);
    let [_, x, y, z, tx, ty, tz, fov, _] = set.key;
    (set.world, Camera::look_at(vec3(x, y, z), vec3(tx, ty, tz), (10.0 * fov).to_radians(), 0.0))
}

/// A world that is being built.
struct Set {
    world: World,
    /// The last body, and what the next one has of it.
    object: Object,
    at: Vec3,
    turn: Mat3,
    /// The camera.
    key: [f32; 9],
}

const EMPTY: Set = Set { world: World::EMPTY, object: CLEAR, at: Vec3::ZERO, turn: Mat3::IDENTITY, key: [0.0; 9] };

impl Set {
    /// Runs a script at `time` seconds.
    #[inline(never)]
    fn build(&mut self, script: &mut Script, time: f64) {
        loop {
            let operation = script.next();
            let n: &[f32; 17] = script.numbers[VARIABLES..].first_chunk().unwrap();
            let vector = |i: usize| vec3(n[i], n[i + 1], n[i + 2]);
            let at = self.at;
            let material = &mut self.object.material;
            match operation {
                byte::CAMERA => {
                    self.key = timeline::sample(script.stack().as_chunks().0, time);
                    script.numbers[NUMBER] = self.key[8];
                }
                byte::AT => self.at = vector(0),
                byte::AWAY => self.at = at.normalize() * (100.0 * n[0]),
                byte::TURN => self.turn = Mat3::from_cols(vector(0), vector(3), vector(6)),
                byte::TEXTURE => {
                    material.albedo = texture(n, &self.turn, at);
                    self.turn = Mat3::IDENTITY;
                }
                byte::SURFACE => {
                    material.reflectance = vector(0);
                    [material.specular, material.exponent, material.fresnel] = [n[3], 10.0 * n[4], n[5]];
                    material.ior = 0.0;
                    self.object.casts_shadow = n[6] > 0.0;
                }
                byte::GLASS => self.object = CLEAR,
                byte::BALL..byte::SUN => {
                    let half = n[0] * 0.5;
                    self.object.shape = match operation {
                        byte::BALL => Shape::Sphere { center: at, radius: n[0] },
                        byte::BLOCK => Shape::Block { center: at, half: vector(0), turn: Mat3::IDENTITY },
                        byte::COLUMN => {
                            Shape::Cylinder { center: at + Vec3::Y * half, axis: Vec3::Y, half, radius: n[1] }
                        }
                        _ => Shape::Plane { normal: Vec3::Y * n[0], offset: n[1] },
                    };
                    self.world.objects.push(self.object);
                }
                byte::SUN | byte::LAMP => {
                    let emitter = match operation {
                        byte::SUN => Emitter::Directional(at.normalize()),
                        _ => Emitter::Point(at),
                    };
                    self.world.lights.push(Light { emitter, color: vector(0), radius: n[3] });
                }
                _ => {
                    self.world.ambient = vector(0);
                    let glow = Glow { direction: at.normalize(), color: vector(9), exponent: 10.0 * n[12] };
                    self.world.background = Background { horizon: vector(3), zenith: vector(6), glow };
                    self.world.max_level = n[13] as u32;
                    return;
                }
            }
        }
    }
}

/// Of glass.
const CLEAR: Object = Object {
    shape: Shape::Sphere { center: Vec3::ZERO, radius: 0.0 },
    material: Material::glass(1.5, vec3(0.95, 0.985, 0.98)).shiny(0.8, 200.0),
    casts_shadow: true,
};

// What is in several sets.

const MATT: [Word; 8] = polished(0.0, 0.12, 2.4);
/// As bright as it can be.
const LUMINOUS: [Word; 8] = surface(0.0, 0.0, 0.1, 0.0, 0.0);

/// With a mirror of one grey and a highlight.
const fn polished(mirror: Word, specular: Word, exponent: Word) -> [Word; 8] {
    surface(mirror, specular, exponent, 0.0, 1.0)
}

/// Polished: far away it is a mirror of the sky, so that nothing shimmers at the horizon.
const fn floor(fresnel: Word) -> [Word; 8] {
    surface(0.06, 0.2, 4.0, fresnel, 0.0)
}

const fn surface(mirror: Word, specular: Word, exponent: Word, fresnel: Word, shadow: Word) -> [Word; 8] {
    [mirror, mirror, mirror, specular, exponent, fresnel, shadow, SURFACE]
}

const fn plain(color: [Word; 3]) -> [Word; 9] {
    kind(PLAIN, color, color, 1.0, 0.0)
}

const fn marble(dark: [Word; 3], light: [Word; 3], scale: Word) -> [Word; 9] {
    kind(MARBLE, dark, light, scale, 7.0)
}

const RED: [Word; 9] = kind(CLOUDS, [0.15, 0.0, 0.0], [0.9, 0.2, 0.08], 4.0, 4.0);
const GREEN: [Word; 9] = kind(MARBLE, [0.01, 0.08, 0.07], [0.2, 0.55, 0.42], 7.0, 6.0);
const WHITE: [Word; 9] = kind(CREASES, [0.9, 0.86, 0.78], [0.1, 0.15, 0.4], 3.0, 4.0);

/// Variables 4 and 5 become the cosine and the sine of the angle on the stack.
const ANGLE: [Word; 7] = [set(5), get(5), COS, set(4), get(5), SIN, set(5)];
/// The next texture is turned around x, y or z by that angle.
#[rustfmt::skip]
const PITCH: [Word; 12] = [1.0, 0.0, 0.0, 0.0, get(4), get(5), 0.0, get(5), -1.0, MUL, get(4), TURN];
#[rustfmt::skip]
const YAW: [Word; 12] = [get(4), 0.0, get(5), -1.0, MUL, 0.0, 1.0, 0.0, get(5), 0.0, get(4), TURN];
#[rustfmt::skip]
const ROLL: [Word; 12] = [get(4), get(5), 0.0, get(5), -1.0, MUL, get(4), 0.0, 0.0, 0.0, 1.0, TURN];

/// A column of one of three marbles, by the count.
#[rustfmt::skip]
const VEINED: [Word; 25] = [
    0.2, 0.13, 0.09, 0.74, 0.66, 0.54,
    0.62, 0.66, 0.58, 0.16, 0.27, 0.25,
    0.7, 0.52, 0.44, 0.44, 0.2, 0.14,
    COUNT, 6.0, PICK, 6.0, 7.0, VEINS as Word, TEXTURE,
];
const COLUMN_POLISH: [Word; 8] = polished(0.0, 0.35, 4.0);

/// Dawn: two doors open, and the first ray falls across a dark hall. The keys' number is half of the gap between them,
/// metres.
#[rustfmt::skip]
const DOOR: &[u8] = script![
    [
        0.0, 2.7, 0.8, 9.6, 0.3, 1.7, 0.0, 4.2, 0.08,
        5.25, 2.1, 0.9, 8.9, 0.3, 1.7, 0.0, 4.2, 0.5,
        11.0, 0.7, 1.2, 7.4, 0.3, 1.7, 0.0, 4.0, 1.6, CAMERA,
    ],
    HALL, [TEXTURE], floor(0.4), [1.0, 0.0, PLANE],
    [GLASS, 1.75, 0.75, 3.6, AT, 0.75, BALL],
    SUNRISE, [5.0, 2.8, 1.1, 0.0, SUN],
    plain([25.0, 16.0, 5.0]), [TEXTURE], LUMINOUS, [3.0, AWAY, 8.0, BALL],
    [0.0, 0.0, 0.0, AT], HALL, [TEXTURE], MATT,
    [0.0, 6.5, 6.0, AT, 9.0, 1.0, 9.0, BLOCK, 0.0, 3.0, 15.0, AT, 9.0, 5.0, 1.0, BLOCK],
    [2.0, REPEAT, 2.0, COUNT, MUL, -1.0, ADD, SIDE, GAP, 4.0, ADD, X, MUL, set(5)],
    // A leaf, then a wall and its columns.
    [X, -1.5, MUL, get(5), ADD, 2.8, -1.0, AT, 0.03, 0.07, 0.2, MUL, 0.04, 0.2, MUL],
    [0.16, 0.075, 0.03, 3.0, 0.2, WOOD as Word, TEXTURE],
    MATT, [get(5), 2.8, 0.0, AT, 4.0, 2.9, 0.25, BLOCK],
    [0.0, 0.0, 0.0, AT], HALL, [TEXTURE], MATT,
    [X, 7.0, MUL, 3.0, 7.0, AT, 1.0, 4.0, 9.0, BLOCK],
    [X, 3.7, MUL, 0.0, 2.2, AT, 5.6, 0.42, COLUMN, X, 3.7, MUL, 0.0, 5.6, AT, 5.6, 0.42, COLUMN, AGAIN],
    [-2.0, 4.6, 10.0, AT, 0.1, 0.15, 0.26, 0.0, LAMP],
    SUNRISE, [0.06, 0.085, 0.15, 0.5, 0.27, 0.2, 0.1, 0.2, 0.45, 0.45, 0.32, 0.12, 2.4, 6.0, WORLD],
];
const HALL: [Word; 9] = marble([0.06, 0.06, 0.06], [0.3, 0.29, 0.27], 0.9);
const SUNRISE: [Word; 4] = [-0.1, 0.14, -1.0, AT];
// Left and right.
const SIDE: Word = set(6);
const X: Word = get(6);

/// Morning: a table, close, through the ball.
#[rustfmt::skip]
const TABLE: &[u8] = script![
    [
        0.0, 1.9, 1.15, 3.3, 0.25, 0.95, 0.0, 3.8, 0.0,
        5.0, 0.5, 1.0, 3.5, 0.35, 0.95, 0.0, 3.8, 0.0,
        10.0, -1.1, 1.25, 3.4, 0.1, 0.95, 0.0, 3.8, 0.0, CAMERA,
    ],
    [0.0, -1.1, 0.4, AT, 0.0, 0.2, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, TURN],
    kind(WOOD, [0.1, 0.04, 0.015], [0.34, 0.17, 0.065], 2.5, 1.0), [TEXTURE], polished(0.05, 0.3, 4.0),
    [0.0, -0.2, -1.0, AT, 7.0, 0.2, 5.6, BLOCK, GLASS, -0.4, 1.0, 0.0, AT, 1.0, BALL],
    [7.0, REPEAT, 1.6, COUNT, MUL, -4.6, ADD, 0.0, -5.4, AT, 0.3, COUNT, MUL], ANGLE, YAW, VEINED, COLUMN_POLISH,
    [COUNT, 0.7, MUL, 0.5, TIME, MUL, ADD, SIN, 1.2, MUL, 2.1, ADD, 0.45, COLUMN, AGAIN],
    rolling(0.42, -1.5, -3.6, 0.75, 2.38), ANGLE, ROLL, RED, [TEXTURE], ROLLING, [0.42, BALL],
    rolling(0.55, -3.7, 3.6, -0.6, 1.82), ANGLE, ROLL, GREEN, [TEXTURE], ROLLING, [0.55, BALL],
    rolling(0.3, 1.1, 3.0, -0.25, 3.335), ANGLE, ROLL, WHITE, [TEXTURE], ROLLING, [0.3, BALL],
    [-0.75, 0.5, 0.1, AT, 1.15, 0.95, 0.7, 0.0, SUN],
    [-0.5, 0.3, -0.8, AT, 0.13, 0.16, 0.19, 0.2, 0.36, 0.4, 0.02, 0.06, 0.12, 0.5, 0.4, 0.2, 0.8, 5.0, WORLD],
];
const ROLLING: [Word; 8] = polished(0.12, 0.5, 6.0);
/// A ball on the table rolls along x: as far as it has come it has turned, by `curvature`, 1 over its radius.
#[rustfmt::skip]
const fn rolling(radius: Word, z: Word, start: Word, speed: Word, curvature: Word) -> [Word; 13] {
    [speed, TIME, MUL, start, ADD, set(5), get(5), radius, z, AT, get(5), curvature, MUL]
}

/// Noon and after: turning columns, and their shadows.
#[rustfmt::skip]
const COLUMNS: &[u8] = script![
    [
        0.0, 1.5, 0.7, 5.8, -0.4, 1.7, -4.0, 4.8, 0.0,
        6.0, 0.7, 1.3, 1.2, -0.5, 1.6, -9.0, 4.8, 0.0,
        12.0, -0.9, 2.0, -3.6, 0.3, 1.5, -14.0, 4.8, 0.0, CAMERA,
    ],
    SANDSTONE, [TEXTURE], floor(0.7), [1.0, 0.0, PLANE],
    [-2.6, SIDE], ROW, ANGLE, YAW, VEINED, COLUMN_POLISH, [5.4, 0.55, COLUMN, AGAIN],
    [0.0, 0.0, 0.0, AT], SANDSTONE, [TEXTURE], MATT, BEAM,
    [2.6, SIDE], ROW, ANGLE, YAW, VEINED, COLUMN_POLISH, [5.4, 0.55, COLUMN, AGAIN],
    [0.0, 0.0, 0.0, AT], SANDSTONE, [TEXTURE], MATT, BEAM,
    plain([0.3, 0.18, 0.06]), [TEXTURE, 0.75, 0.52, 0.25, 0.6, 6.0, 0.0, 1.0, SURFACE],
    [0.42, TIME, MUL, COS, -1.2, MUL, 0.6, TIME, -1.0, MUL, AT, 0.6, BALL],
    [0.8, 0.55, -0.3, AT, 1.7, 1.25, 0.8, 0.0, SUN],
    [0.14, 0.19, 0.28, 0.58, 0.52, 0.46, 0.0, 0.08, 0.4, 0.5, 0.35, 0.15, 0.6, 4.0, WORLD],
];
const SANDSTONE: [Word; 9] = marble([0.12, 0.085, 0.06], [0.36, 0.27, 0.19], 0.6);
/// Six columns on one side, turned by an angle.
#[rustfmt::skip]
const ROW: [Word; 17] =
    [6.0, REPEAT, X, 0.0, COUNT, -3.4, MUL, 1.0, ADD, AT, X, 0.2, MUL, TIME, MUL, COUNT, ADD];
const BEAM: [Word; 8] = [X, 5.8, -7.5, AT, 0.7, 0.4, 10.0, BLOCK];

/// Evening: spheres dance on an inlaid floor, under a lamp.
#[rustfmt::skip]
const DANCE: &[u8] = script![
    [
        0.0, 6.5, 4.6, 6.2, 0.6, 0.6, 0.0, 4.2, 0.0,
        4.0, 1.0, 2.9, 7.6, 0.7, 0.9, 0.0, 4.2, 0.0,
        8.0, -4.0, 1.8, 5.8, 0.9, 1.2, 0.5, 4.2, 0.0,
        12.0, -6.6, 1.3, 2.3, 0.5, 1.4, 0.7, 4.2, 0.0, CAMERA,
    ],
    [0.12, TIME, MUL], ANGLE, [0.0, 0.0, 0.0, AT],
    YAW, marble([0.03, 0.05, 0.06], [0.2, 0.26, 0.28], 7.0), [TEXTURE], inlay(0.0, -0.44, 5.4),
    YAW, kind(WOOD, [0.12, 0.045, 0.015], [0.4, 0.19, 0.075], 2.5, 0.3), [TEXTURE], inlay(0.14, -0.42, 4.0),
    YAW, kind(CHECKER, [0.06, 0.06, 0.07], [0.46, 0.42, 0.35], 1.4, 0.0), [TEXTURE], inlay(0.14, -0.4, 2.6),
    [GLASS, 0.0, 1.1, TIME, MUL, SIN, 0.12, MUL, 1.5, ADD, 0.0, AT, 0.9, BALL],
    [0.0, 0.0, 0.0, AT], kind(CLOUDS, [0.1, 0.15, 0.25], [0.75, 0.85, 1.0], 0.25, 4.0), [TEXTURE], LUMINOUS,
    MOON, [0.9, AWAY, 6.0, BALL],
    // Three by three, in rings: which of its ring; radius, speed and size.
    [9.0, REPEAT, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, COUNT, 1.0, PICK, set(6)],
    [1.9, 0.55, 0.3, 3.2, -0.4, 0.42, 4.5, 0.28, 0.34, COUNT, 3.0, PICK, set(9), set(8), set(7)],
    [get(6), -0.03, 0.02, MUL, -0.905, ADD, MUL, COUNT, ADD, get(8), TIME, MUL, ADD], ANGLE,
    [get(7), get(4), MUL, 1.3, TIME, MUL, COUNT, 1.7, MUL, ADD, SIN, ABS, 0.5, MUL, get(9), ADD],
    [get(7), get(5), MUL, AT, TIME, COUNT, ADD], ANGLE, PITCH,
    RED, WHITE, GREEN, [COUNT, get(6), ADD, 9.0, PICK, TEXTURE],
    [0.0, 0.35, COUNT, 1.0, PICK, set(5), get(5), get(5), get(5), 0.5, 5.0, 0.0, 1.0, SURFACE, get(9), BALL, AGAIN],
    [1.5, 5.5, -2.0, AT, 1.2, 0.95, 0.65, 0.4, LAMP],
    MOON, [0.1, 0.2, 0.42, 0.0, SUN],
    [0.07, 0.08, 0.12, 0.03, 0.05, 0.11, 0.02, 0.02, 0.05, 0.16, 0.18, 0.3, 0.6, 4.0, WORLD],
];
const MOON: [Word; 4] = [0.99, 0.15, 0.07, AT];
/// A disc of 40 cm on `y`; around its texture's origin.
#[rustfmt::skip]
const fn inlay(mirror: Word, y: Word, radius: Word) -> [Word; 19] {
    [
        mirror, mirror, mirror, 0.3, 5.0, 0.0, 0.0, SURFACE,
        0.0, y, 0.0, AT, 0.4, radius, COLUMN, 0.0, 0.0, 0.0, AT,
    ]
}

/// Sunset: the ball on the water, and the sun in it. The sea is a disc, so that its edge and the clouds mirror the sky
/// beyond.
#[rustfmt::skip]
const SUNSET: &[u8] = script![
    [
        0.0, -1.4, 0.9, 3.4, 0.3, 1.05, 0.0, 4.0, 0.0,
        5.0, -0.8, 1.3, 5.4, 0.8, 1.3, 0.0, 4.0, 0.0,
        11.0, 0.6, 2.3, 9.0, 1.2, 1.6, 0.0, 4.0, 0.0, CAMERA,
    ],
    kind(CLOUDS, [0.0, 0.01, 0.03], [0.05, 0.1, 0.14], 0.4, 4.0),
    [TEXTURE, 0.05, 0.05, 0.05, 0.0, 0.1, 1.0, 0.0, SURFACE, 0.0, -1.0, 0.0, AT, 1.0, 5.0, 11.0, MUL, COLUMN],
    // The clouds have no light but the ambient: theirs is painted on. Towards the horizon they mirror the sky.
    [0.0, 0.0, 1.5, TIME, MUL, AT, 0.6, DAY, MUL, 0.18, DAY, MUL, 0.15, DAY, MUL],
    [11.0, DAY, MUL, 0.6, ADD, 4.545, DAY, MUL, 0.545, ADD, 0.8, DAY, MUL, 0.7, ADD],
    [0.05, 4.0, CLOUDS as Word, TEXTURE, 0.0, 0.0, 0.0, 0.0, 0.1, 1.0, 0.0, SURFACE, -1.0, -25.0, PLANE],
    [GLASS, -0.5, 0.9, 0.0, AT, 1.0, BALL],
    LOW, [0.2, 0.8, DAY, MUL, ADD, set(5)],
    [get(5), 1.2, MUL, get(5), 0.54, MUL, get(5), 0.145, MUL, 0.0, SUN],
    plain([25.0, 14.0, 3.0]), [TEXTURE], LUMINOUS, [0.6, AWAY, 2.4, BALL],
    [0.0, 0.0, 0.0, AT], marble([0.2, 0.13, 0.09], [0.74, 0.66, 0.54], 1.5), [TEXTURE], MATT,
    [3.3, 4.7, -14.0, AT, 3.0, 0.35, 0.6, BLOCK],
    [1.1, -1.5, -14.0, AT, 6.0, 0.5, COLUMN, 5.5, -1.5, -14.0, AT, 6.0, 0.5, COLUMN],
    [-5.2, -1.5, -9.0, AT, 6.0, 0.5, COLUMN, -8.0, -1.5, -17.0, AT, 6.0, 0.5, COLUMN],
    LOW, [0.1, 0.11, 0.2, 0.6, DAY, MUL, 0.12, ADD, 0.2, DAY, MUL, 0.1, ADD, 0.2, 0.02, 0.05, 0.2],
    [get(5), get(5), 0.45, MUL, get(5), 0.12, MUL, 1.8, 6.0, WORLD],
];
const LOW: [Word; 8] = [0.17, 0.2, DAY, MUL, -0.05, ADD, -1.0, AT];
