//! The scene `lumen`, first and last part of the show: a ray of light finds a ball of glass, and they see a day out.
//!
//! Ray traced as in thesis A: spheres, boxes, cylinders and planes with noise textures, mirrors and glass. Five shots,
//! each with its own set, its own light and one camera move, and each written as a script (`script.rs`).

use crate::cuts;
use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Parameter, Picture, Scene};
use crate::scenes::script::kind::{self, CLOUDS, VEINS, WOOD};
use crate::scenes::script::{
    COUNT, Script, VARIABLES, Word, assign, assign_all, fragment, instruction, operations, pattern, script, texture,
    variable, words,
};
use crate::scenes::single::traced;
use crate::texture::Texture;
use crate::timeline::{self, ease};
use crate::trace::{Background, Emitter, Glow, Light, Material, Object, Shape, World};
use crate::vector::unit;
use crate::view::Camera;
use glam::{Mat3A, Vec3A, vec3a};

/// The scene.
pub const LUMEN: Scene = Scene {
    name: "lumen",
    about: "a ray of light: glass, marble, wood, mirrors",
    duration: END,
    parameters: &[BODIES, DEPTH, TEXTURES],
    picture,
}
.part();

const BODIES: Parameter = Parameter::new(
    "bodies",
    "count",
    (1.0, 64.0),
    64.0,
    "the most bodies; those that a set lists last are left out first",
);
const DEPTH: Parameter = Parameter::new(
    "depth",
    "count",
    (1.0, 8.0),
    8.0,
    "the most rays in a path; 1 is the eye's alone. Sets ask for 4 to 6",
);
const TEXTURES: Parameter =
    Parameter::new("textures", "count", (0.0, 1.0), 1.0, "1 with textures, 0 with their mean colours");

/// The length of the scene, seconds.
const END: f64 = 56.0;

/// The shots: the second at which each starts, and its script.
pub const CUTS: &[(f64, &[u8])] = &[(0.0, DOOR), (11.0, TABLE), (21.0, MIDDLE[0]), (33.0, MIDDLE[1]), (45.0, SUNSET)];

/// The shots that the show does not play; the 64 kB build leaves them out.
const MIDDLE: [&[u8]; 2] = if cuts::SCENES { [COLUMNS, DANCE] } else { [TABLE, TABLE] };

operations! {
    /// The camera's keys, of nine numbers each: see [`key`].
    camera = 40;
    /// `at(x, y, z)`, metres: the origin of the next texture, the middle of the next bodies.
    at = 41;
    /// `away(distance)`: moves that place along its direction to a distance from the origin, hundreds of metres.
    away = 42;
    /// `turn(...)`, the columns of a matrix: how the next texture is turned, from the world's axes to the texture's.
    turn = 43;
    /// The texture of the next bodies, with the operands of [`pattern`].
    texture = 44;
    /// The rest of the next bodies' material: see [`surface`].
    surface = 45;
    /// The next bodies are of glass.
    glass = 46;
    /// `ball(radius)`, metres.
    ball = 47;
    /// `block(x, y, z)`: a box by half of its edges, metres.
    block = 48;
    /// `column(height, radius)`: an upright cylinder whose foot is on the place, metres.
    column = 49;
    /// `plane(up, offset)`: a level plane that faces up for 1 and down for -1, at that distance from the origin,
    /// metres.
    plane = 50;
    /// `sun(r, g, b, radius)`: light from the direction of the place. The radius is the sine of the disc's angular
    /// radius.
    sun = 51;
    /// `lamp(r, g, b, radius)`: light from a ball at the place, metres.
    lamp = 52;
    /// `world(...)`, the last operation: the ambient light; the sky's colours at the horizon, at the zenith, and of a
    /// glow towards the place; how often its cosine is squared; the greatest number of rays in a path.
    world = 53;
}

/// Seconds since the shot's start.
const TIME: Word = variable(0);
/// What is left of the evening's light, from 1 to 0.
const DAY: Word = variable(1);
/// The number that the camera's keys carry.
const GAP: Word = variable(2);
const NUMBER: usize = 2;
// Registers of the shots, as each of them needs.
const COS: Word = variable(4);
const SIN: Word = variable(5);
const EDGE: Word = variable(5);
const LIGHT: Word = variable(5);
const ROLLED: Word = variable(5);
const SIDE: Word = variable(6);
const RANK: Word = variable(6);
const RADIUS: Word = variable(7);
const SPEED: Word = variable(8);
const SIZE: Word = variable(9);
const MIRROR: Word = variable(5);

fn picture(spec: &FrameSpec) -> Picture {
    let (mut world, camera) = stage(spec.time);
    if cuts::PARAMETERS {
        alter(spec, &mut world);
    }
    traced(spec, world, camera, Transfer::Srgb)
}

/// Applies the parameters to a set.
fn alter(spec: &FrameSpec, world: &mut World) {
    world.objects.truncate(spec.get(&BODIES) as usize);
    world.max_level = world.max_level.min(spec.get(&DEPTH) as u32);
    if spec.get(&TEXTURES) == 0.0 {
        for object in &mut world.objects {
            object.material.albedo = Texture::plain(object.material.albedo.mean());
        }
    }
}

/// What is seen at `time` seconds, and from where.
pub fn stage(time: f64) -> (World, Camera) {
    let (bytes, time) = timeline::cut(CUTS, END, time);
    let mut set = EMPTY;
    let mut script = Script::new(bytes, [time as f32, 1.0 - ease(-2.0, 14.0, time)]);
    set.build(&mut script, time);
    let [_, x, y, z, tx, ty, tz, fov, _] = set.key;
    (set.world, Camera::look_at(vec3a(x, y, z), vec3a(tx, ty, tz), (10.0 * fov).to_radians(), 0.0))
}

/// A world that is being built.
struct Set {
    world: World,
    /// The last body; the next one inherits what no operation changes.
    object: Object,
    at: Vec3A,
    turn: Mat3A,
    /// The camera: a [`key`].
    key: [f32; 9],
}

const EMPTY: Set = Set { world: World::EMPTY, object: CLEAR, at: Vec3A::ZERO, turn: Mat3A::IDENTITY, key: [0.0; 9] };

impl Set {
    /// Runs a shot's script, `time` seconds after the shot's start.
    #[inline(never)]
    fn build(&mut self, script: &mut Script, time: f64) {
        loop {
            let operation = script.next();
            let n: &[f32; 17] = script.numbers[VARIABLES..].first_chunk().unwrap();
            let vector = |i: usize| vec3a(n[i], n[i + 1], n[i + 2]);
            let at = self.at;
            let material = &mut self.object.material;
            match operation {
                op::camera => {
                    self.key = timeline::sample(script.stack().as_chunks().0, time);
                    script.numbers[NUMBER] = self.key[8];
                }
                op::at => self.at = vector(0),
                op::away => self.at = unit(at) * (100.0 * n[0]),
                op::turn => self.turn = Mat3A::from_cols(vector(0), vector(3), vector(6)),
                op::texture => {
                    material.albedo = texture(n, &self.turn, at);
                    self.turn = Mat3A::IDENTITY;
                }
                op::surface => {
                    material.reflectance = vector(0);
                    [material.specular, material.exponent, material.fresnel] = [n[3], 10.0 * n[4], n[5]];
                    material.ior = 0.0;
                    self.object.casts_shadow = n[6] > 0.0;
                }
                op::glass => self.object = CLEAR,
                op::ball..op::sun => {
                    let half = n[0] * 0.5;
                    self.object.shape = match operation {
                        op::ball => Shape::Sphere { center: at, radius: n[0] },
                        op::block => Shape::Block { center: at, half: vector(0), turn: Mat3A::IDENTITY },
                        op::column => {
                            Shape::Cylinder { center: at + Vec3A::Y * half, axis: Vec3A::Y, half, radius: n[1] }
                        }
                        _ => Shape::Plane { normal: Vec3A::Y * n[0], offset: n[1] },
                    };
                    self.world.objects.push(self.object);
                }
                op::sun | op::lamp => {
                    let emitter = match operation {
                        op::sun => Emitter::Directional(unit(at)),
                        _ => Emitter::Point(at),
                    };
                    self.world.lights.push(Light { emitter, color: vector(0), radius: n[3] });
                }
                _ => {
                    self.world.ambient = vector(0);
                    let glow = Glow { direction: unit(at), color: vector(9), squarings: n[12] as u32 };
                    self.world.background = Background { horizon: vector(3), zenith: vector(6), glow };
                    self.world.max_level = n[13] as u32;
                    return;
                }
            }
        }
    }
}

/// A body of glass.
const CLEAR: Object = Object {
    shape: Shape::Sphere { center: Vec3A::ZERO, radius: 0.0 },
    material: Material::glass(1.5, vec3a(0.9375, 0.984375, 0.984375)).shiny(0.75, 200.0),
    casts_shadow: true,
};

/// A key of the camera: seconds since the shot's start; eye and target, metres; the vertical field of view, degrees; a
/// number that the script reads as [`GAP`].
const fn key(time: Word, [x, y, z]: [Word; 3], [tx, ty, tz]: [Word; 3], fov: Word, number: Word) -> [Word; 9] {
    [time, x, y, z, tx, ty, tz, fov / 10.0, number]
}

/// A surface: the share of light that it mirrors, in all colours; the weight and the exponent of its highlight; what
/// Fresnel adds to the mirror at grazing angles; and whether bodies of it cast shadows.
const fn surface(mirror: Word, specular: Word, exponent: Word, fresnel: Word, shadow: bool) -> [Word; 8] {
    let shadow = if shadow { 1.0 } else { 0.0 };
    [mirror, mirror, mirror, specular, exponent / 10.0, fresnel, shadow, instruction(op::surface)]
}

const MATT: [Word; 8] = polished(0.0, 0.12, 24.0);
/// Of what shines by its own: its texture is as bright as light gets.
const LUMINOUS: [Word; 8] = surface(0.0, 0.0, 1.0, 0.0, false);
const COLUMN_POLISH: [Word; 8] = polished(0.0, 0.35, 40.0);
const BALL_POLISH: [Word; 8] = polished(0.12, 0.5, 60.0);

/// With a mirror and a highlight.
const fn polished(mirror: Word, specular: Word, exponent: Word) -> [Word; 8] {
    surface(mirror, specular, exponent, 0.0, true)
}

/// A polished floor: at a distance it mirrors the sky, so that its texture does not shimmer at the horizon.
const fn floor(fresnel: Word) -> [Word; 8] {
    surface(0.06, 0.2, 40.0, fresnel, false)
}

// Textures, which `texture();` follows.
const RED: [Word; 9] = pattern(kind::CLOUDS, [0.15, 0.0, 0.0], [0.9, 0.2, 0.08], 4.0, 4.0);
const GREEN: [Word; 9] = pattern(kind::MARBLE, [0.01, 0.08, 0.07], [0.2, 0.55, 0.42], 7.0, 6.0);
const WHITE: [Word; 9] = pattern(kind::CREASES, [0.9, 0.86, 0.78], [0.1, 0.15, 0.4], 3.0, 4.0);
const HALL: [Word; 9] = marble([0.06, 0.06, 0.06], [0.3, 0.29, 0.27], 0.9);
const SANDSTONE: [Word; 9] = marble([0.12, 0.085, 0.06], [0.36, 0.27, 0.19], 0.6);

/// One colour.
const fn plain(color: [Word; 3]) -> [Word; 9] {
    pattern(kind::PLAIN, color, color, 1.0, 0.0)
}

const fn marble(dark: [Word; 3], light: [Word; 3], scale: Word) -> [Word; 9] {
    pattern(kind::MARBLE, dark, light, scale, 7.0)
}

/// One of three marbles, by the count: veins and stone of each.
const VEINED: [Word; 25] = fragment! {
    push(0.2, 0.13, 0.09, 0.74, 0.66, 0.54);
    push(0.62, 0.66, 0.58, 0.16, 0.27, 0.25);
    push(0.7, 0.52, 0.44, 0.44, 0.2, 0.14);
    pick(COUNT, 6.0);
    texture(6.0, 7.0, VEINS);
};

/// The angle on the stack leaves its cosine in COS and its sine in SIN.
const ANGLE: [Word; 7] = fragment! { ..[assign(SIN)]; COS = (cos(SIN)); SIN = (sin(SIN)); };
// The next texture is turned by that angle around x, y or z.
const PITCH: [Word; 12] = words!(1.0, 0.0, 0.0, 0.0, COS, SIN, 0.0, SIN * -1.0, COS; op::turn);
const YAW: [Word; 12] = words!(COS, 0.0, SIN * -1.0, 0.0, 1.0, 0.0, SIN, 0.0, COS; op::turn);
/// The next texture is the same at every height, that of the lattice, where noise takes some two thirds of its time.
const FLAT: [Word; 10] = words!(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0; op::turn);
const ROLL: [Word; 12] = words!(COS, SIN, 0.0, SIN * -1.0, COS, 0.0, 0.0, 0.0, 1.0; op::turn);

/// Dawn: two doors open, and the first ray falls across a dark hall. The keys' number is half of the gap between the
/// doors, metres.
const DOOR: &[u8] = script! {
    ..key(0.0, [2.7, 0.8, 9.6], [0.3, 1.7, 0.0], 42.0, 0.08);
    ..key(5.25, [2.1, 0.9, 8.9], [0.3, 1.7, 0.0], 42.0, 0.5);
    ..key(11.0, [0.7, 1.2, 7.4], [0.3, 1.7, 0.0], 40.0, 1.6);
    camera();

    ..HALL; texture(); ..floor(0.4); plane(1.0, 0.0);
    glass(); at(1.75, 0.75, 3.6); ball(0.75);
    // The sun outside, and the disc that it shows.
    ..SUNRISE; sun(5.0, 2.8, 1.1, 0.0);
    ..plain([25.0, 16.0, 5.0]); texture(); ..LUMINOUS; away(3.0); ball(8.0);
    // The ceiling, and the wall behind the eye.
    at(0.0, 0.0, 0.0); ..HALL; texture(); ..MATT;
    at(0.0, 6.5, 6.0); block(9.0, 1.0, 9.0);
    at(0.0, 3.0, 15.0); block(9.0, 5.0, 1.0);
    repeat(2.0) {
        // -1 to the left and 1 to the right; the middle of the wall beside the leaf.
        SIDE = (2.0 * COUNT + -1.0);
        EDGE = ((GAP + 4.0) * SIDE);
        // The leaf of the door.
        at(SIDE * -1.5 + EDGE, 2.8, -1.0);
        texture(0.03, 0.07 * 0.2, 0.04 * 0.2, 0.16, 0.075, 0.03, 3.0, 0.2, WOOD);
        ..MATT; at(EDGE, 2.8, 0.0); block(4.0, 2.9, 0.25);
        // A side wall, and two columns before it.
        at(0.0, 0.0, 0.0); ..HALL; texture(); ..MATT;
        at(SIDE * 7.0, 3.0, 7.0); block(1.0, 4.0, 9.0);
        at(SIDE * 3.7, 0.0, 2.2); column(5.6, 0.42);
        at(SIDE * 3.7, 0.0, 5.6); column(5.6, 0.42);
    }
    // What is left of the night, from above.
    at(-2.0, 4.6, 10.0); lamp(0.1, 0.15, 0.26, 0.0);
    ..SUNRISE;
    world(0.06, 0.085, 0.15, 0.5, 0.27, 0.2, 0.1, 0.2, 0.45, 0.45, 0.32, 0.12, 4.0, 6.0);
};
const SUNRISE: [Word; 4] = words!(-0.1, 0.14, -1.0; op::at);

/// Morning: a table, close, through the ball of glass, while other balls roll past and columns rise and sink.
const TABLE: &[u8] = script! {
    ..key(0.0, [1.9, 1.15, 3.3], [0.25, 0.95, 0.0], 38.0, 0.0);
    ..key(5.0, [0.5, 1.0, 3.5], [0.35, 0.95, 0.0], 38.0, 0.0);
    ..key(10.0, [-1.1, 1.25, 3.4], [0.1, 0.95, 0.0], 38.0, 0.0);
    camera();

    // The grain runs along the board, whose top is at 0.
    at(0.0, -1.1, 0.4); turn(0.0, 0.2, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    ..pattern(kind::WOOD, [0.1, 0.04, 0.015], [0.34, 0.17, 0.065], 2.5, 1.0); texture(); ..polished(0.05, 0.3, 40.0);
    at(0.0, -0.2, -1.0); block(7.0, 0.2, 5.6);
    glass(); at(-0.4, 1.0, 0.0); ball(1.0);
    repeat(7.0) {
        at(1.6 * COUNT + -4.6, 0.0, -5.4);
        push(0.3 * COUNT); ..ANGLE; ..YAW; ..VEINED; ..COLUMN_POLISH;
        column(sin(COUNT * 0.7 + 0.5 * TIME) * 1.2 + 2.1, 0.45);
    }
    ..rolling(0.42, -1.5, -3.6, 0.75, 2.38); ..ANGLE; ..ROLL; ..RED; texture(); ..BALL_POLISH; ball(0.42);
    ..rolling(0.55, -3.7, 3.6, -0.6, 1.82); ..ANGLE; ..ROLL; ..GREEN; texture(); ..BALL_POLISH; ball(0.55);
    ..rolling(0.3, 1.1, 3.0, -0.25, 3.335); ..ANGLE; ..ROLL; ..WHITE; texture(); ..BALL_POLISH; ball(0.3);
    at(-0.75, 0.5, 0.1); sun(1.15, 0.95, 0.7, 0.0);
    at(-0.5, 0.3, -0.8);
    world(0.13, 0.16, 0.19, 0.2, 0.36, 0.4, 0.02, 0.06, 0.12, 0.5, 0.4, 0.2, 3.0, 5.0);
};

/// A ball on the table that rolls along x, from `start` at `speed`, metres per second; leaves on the stack the angle by
/// which it has turned. `curvature` is 1 over the radius.
const fn rolling(radius: Word, z: Word, start: Word, speed: Word, curvature: Word) -> [Word; 13] {
    fragment! {
        ROLLED = (speed * TIME + start);
        at(ROLLED, radius, z);
        push(ROLLED * curvature);
    }
}

/// Noon and after: between two rows of turning columns, and their shadows.
const COLUMNS: &[u8] = script! {
    ..key(0.0, [1.5, 0.7, 5.8], [-0.4, 1.7, -4.0], 48.0, 0.0);
    ..key(6.0, [0.7, 1.3, 1.2], [-0.5, 1.6, -9.0], 48.0, 0.0);
    ..key(12.0, [-0.9, 2.0, -3.6], [0.3, 1.5, -14.0], 48.0, 0.0);
    camera();

    ..SANDSTONE; texture(); ..floor(0.7); plane(1.0, 0.0);
    SIDE = (-2.6);
    repeat(6.0) { ..TURNING_COLUMN; }
    ..BEAM;
    SIDE = (2.6);
    repeat(6.0) { ..TURNING_COLUMN; }
    ..BEAM;
    // A ball of brass ahead of the eye.
    ..plain([0.3, 0.18, 0.06]); texture(); surface(0.75, 0.52, 0.25, 0.6, 6.0, 0.0, 1.0);
    at(cos(0.42 * TIME) * -1.2, 0.6, TIME * -1.0); ball(0.6);
    at(0.8, 0.55, -0.3); sun(1.7, 1.25, 0.8, 0.0);
    world(0.14, 0.19, 0.28, 0.58, 0.52, 0.46, 0.0, 0.08, 0.4, 0.5, 0.35, 0.15, 3.0, 4.0);
};
/// A column of a row, by the count.
const TURNING_COLUMN: [Word; 70] = fragment! {
    at(SIDE, 0.0, COUNT * -3.4 + 1.0);
    push(SIDE * 0.2 * TIME + COUNT); ..ANGLE; ..YAW; ..VEINED; ..COLUMN_POLISH;
    column(5.4, 0.55);
};
/// What lies on the columns of a row.
const BEAM: [Word; 30] = fragment! {
    at(0.0, 0.0, 0.0); ..SANDSTONE; texture(); ..MATT;
    at(SIDE, 5.8, -7.5); block(0.7, 0.4, 10.0);
};

/// Evening: spheres dance on an inlaid floor, under a lamp and the moon.
const DANCE: &[u8] = script! {
    ..key(0.0, [6.5, 4.6, 6.2], [0.6, 0.6, 0.0], 42.0, 0.0);
    ..key(4.0, [1.0, 2.9, 7.6], [0.7, 0.9, 0.0], 42.0, 0.0);
    ..key(8.0, [-4.0, 1.8, 5.8], [0.9, 1.2, 0.5], 42.0, 0.0);
    ..key(12.0, [-6.6, 1.3, 2.3], [0.5, 1.4, 0.7], 42.0, 0.0);
    camera();

    // The floor turns: discs of marble, of wood and of squares, one on the other.
    push(0.12 * TIME); ..ANGLE; at(0.0, 0.0, 0.0);
    ..YAW; ..marble([0.03, 0.05, 0.06], [0.2, 0.26, 0.28], 7.0); texture(); ..inlay(0.0, -0.44, 5.4);
    ..YAW; ..pattern(kind::WOOD, [0.12, 0.045, 0.015], [0.4, 0.19, 0.075], 2.5, 0.3); texture();
    ..inlay(0.14, -0.42, 4.0);
    ..YAW; ..pattern(kind::CHECKER, [0.06, 0.06, 0.07], [0.46, 0.42, 0.35], 1.4, 0.0); texture();
    ..inlay(0.14, -0.4, 2.6);
    glass(); at(0.0, sin(1.1 * TIME) * 0.12 + 1.5, 0.0); ball(0.9);
    // The moon.
    at(0.0, 0.0, 0.0); ..pattern(kind::CLOUDS, [0.1, 0.15, 0.25], [0.75, 0.85, 1.0], 0.25, 4.0); texture(); ..LUMINOUS;
    ..MOON; away(0.9); ball(6.0);
    // Nine balls in three rings.
    repeat(9.0) {
        // Which ball of its ring it is; the ring's radius, its angular speed, and the size of its balls.
        push(0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0); pick(COUNT, 1.0); ..assign_all([RANK]);
        push(1.9, 0.55, 0.3, 3.2, -0.4, 0.42, 4.5, 0.28, 0.34); pick(COUNT, 3.0); ..assign_all([RADIUS, SPEED, SIZE]);
        // A third of a turn apart.
        push(RANK * (-0.03 * 0.02 + -0.905) + COUNT + SPEED * TIME); ..ANGLE;
        at(RADIUS * COS, abs(sin(1.3 * TIME + COUNT * 1.7)) * 0.5 + SIZE, RADIUS * SIN);
        push(TIME + COUNT); ..ANGLE; ..PITCH;
        ..RED; ..WHITE; ..GREEN; pick(COUNT + RANK, 9.0); texture();
        push(0.0, 0.35); pick(COUNT, 1.0); ..assign_all([MIRROR]);
        surface(MIRROR, MIRROR, MIRROR, 0.5, 5.0, 0.0, 1.0); ball(SIZE);
    }
    at(1.5, 5.5, -2.0); lamp(1.2, 0.95, 0.65, 0.4);
    ..MOON; sun(0.1, 0.2, 0.42, 0.0);
    world(0.07, 0.08, 0.12, 0.03, 0.05, 0.11, 0.02, 0.02, 0.05, 0.16, 0.18, 0.3, 3.0, 4.0);
};
const MOON: [Word; 4] = words!(0.99, 0.15, 0.07; op::at);

/// A disc of 40 cm whose foot is at `y`; the place is the origin again afterwards.
const fn inlay(mirror: Word, y: Word, radius: Word) -> [Word; 19] {
    fragment! {
        ..surface(mirror, 0.3, 50.0, 0.0, false);
        at(0.0, y, 0.0); column(0.4, radius); at(0.0, 0.0, 0.0);
    }
}

/// Sunset: the ball on the water, and the sun in it. The sea is a disc, so that its edge and the clouds mirror the sky
/// beyond.
const SUNSET: &[u8] = script! {
    ..key(0.0, [-0.5, 1.5, 21.0], [-0.5, 0.9, 0.0], 40.0, 0.0);
    ..key(4.0, [0.6, 2.3, 9.0], [1.2, 1.6, 0.0], 40.0, 0.0);
    ..key(11.0, [-1.4, 0.9, 3.4], [0.3, 1.05, 0.0], 40.0, 0.0);
    camera();

    // The sea.
    ..FLAT; ..pattern(kind::CLOUDS, [0.0, 0.01, 0.03], [0.05, 0.1, 0.14], 0.4, 4.0); texture();
    ..surface(0.05, 0.0, 1.0, 1.0, false); at(0.0, -1.0, 0.0); column(1.0, 5.0 * 11.0);
    // The clouds, a ceiling that drifts. They have no light but the ambient, so theirs is painted on. Towards the
    // horizon they mirror the sky.
    ..FLAT; at(0.0, 0.0, 1.5 * TIME);
    push(0.6 * DAY, 0.18 * DAY, 0.15 * DAY, 11.0 * DAY + 0.6, 4.545 * DAY + 0.545, 0.8 * DAY + 0.7);
    texture(0.05, 4.0, CLOUDS); ..surface(0.0, 0.0, 1.0, 1.0, false); plane(-1.0, -25.0);
    glass(); at(-0.5, 0.9, 0.0); ball(1.0);
    // The sun and its disc.
    ..LOW_SUN; LIGHT = (0.2 + 0.8 * DAY); sun(LIGHT * 1.2, LIGHT * 0.54, LIGHT * 0.145, 0.0);
    ..plain([25.0, 14.0, 3.0]); texture(); ..LUMINOUS; away(0.6); ball(2.4);
    // Ruins on the shore.
    at(0.0, 0.0, 0.0); ..marble([0.2, 0.13, 0.09], [0.74, 0.66, 0.54], 1.5); texture(); ..MATT;
    at(3.3, 4.7, -14.0); block(3.0, 0.35, 0.6);
    at(1.1, -1.5, -14.0); column(6.0, 0.5);
    at(5.5, -1.5, -14.0); column(6.0, 0.5);
    at(-5.2, -1.5, -9.0); column(6.0, 0.5);
    at(-8.0, -1.5, -17.0); column(6.0, 0.5);
    ..LOW_SUN;
    push(0.1, 0.11, 0.2, 0.6 * DAY + 0.12, 0.2 * DAY + 0.1, 0.2, 0.02, 0.05, 0.2);
    world(LIGHT, LIGHT * 0.45, LIGHT * 0.12, 4.0, 6.0);
};
const LOW_SUN: [Word; 8] = words!(0.17, 0.2 * DAY + -0.05, -1.0; op::at);
