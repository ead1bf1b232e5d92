//! The scene `clouds`, a part of the show: by aeroplane through a morning's clouds, from dawn to noon.
//!
//! The subject of thesis B: an aeroplane in a field of cumulus clouds, which the wind carries and the sun lights anew
//! as it rises. Clouds shade each other and the land.

use super::valley::{self, LATITUDE, LONGITUDE};
use crate::angle;
use crate::cloud::{Cloud, CloudField, CloudKind, CloudLayer, CloudLight, Voxels, grain, shadow, sunlight};
use crate::cuts;
use crate::frame::cache::keep;
use crate::frame::{FrameSpec, Parameter, Picture, Scene};
use crate::raster::CloudShadow;
use crate::simd::math::to_f32;
use crate::timeline;
use crate::vector::unit;
use crate::view::Camera;
use fearless_simd::dispatch;
use glam::{Mat3A, Vec2, Vec3A, vec3a};
use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

/// The scene.
pub const CLOUDS: Scene = Scene {
    name: "clouds",
    about: "a flight through clouds, from dawn to noon",
    duration: LENGTH,
    parameters: &[KIND, SHARE, SPACING, HEIGHT, SEED, THICKNESS, EAST, SOUTH, LIGHT, DATE, START, LATITUDE, LONGITUDE],
    picture,
}
.part();

const KIND: Parameter =
    Parameter::new("kind", "count", (0.0, 2.0), 0.0, "0 cumulus and congestus, 1 cumulus, 2 congestus");
const SHARE: Parameter = Parameter::new("share", "1", (0.0, 1.0), 0.55, "share of the places that hold a cloud");
const SPACING: Parameter = Parameter::new("spacing", "m", (260.0, 5000.0), 520.0, "distance from place to place");
const HEIGHT: Parameter = Parameter::new(
    "height",
    "m",
    (300.0, 3000.0),
    640.0,
    "height of the clouds above the lake; the flight stays where it is",
);
const SEED: Parameter = Parameter::new("seed", "count", (0.0, 1e6), 5.0, "another number, another sky");
const THICKNESS: Parameter = Parameter::new(
    "thickness",
    "1",
    (1.0, 100.0),
    40.0,
    "optical depth of the densest cloud through half of its width",
);
const EAST: Parameter =
    Parameter::new("wind-east", "m/s", (-50.0, 50.0), 8.0, "wind towards the east at 500 m, less below and more above");
const SOUTH: Parameter = Parameter::new("wind-south", "m/s", (-50.0, 50.0), 4.0, "wind towards the south at 500 m");
const LIGHT: Parameter = Parameter::new(
    "light",
    "1",
    (0.0, 4.0),
    1.0,
    "the sun's light on the clouds, times what it is; the rest comes from sky and ground",
);
const DATE: Parameter = Parameter::new("date", "days", (1.0, 366.0), 176.0, "the day's number in the year 2026");
const START: Parameter =
    Parameter::new("hour", "h", (0.0, 24.0), 4.1, "time of day at the start, UT + 1; it ends 7.9 hours later");

/// The length of the scene, seconds.
pub const LENGTH: f64 = 50.0;

/// The clouds of this morning.
const FIELD: CloudField = CloudField {
    seed: 5,
    spacing: 520.0,
    share: 0.55,
    height: 640.0,
    size: [110.0, 190.0],
    range: 5200.0,
    extinction: 40.0,
};

/// Voxels along an edge of a shape, and over what distance their density rises: two and a half voxels, since the flight
/// goes close by.
const VOXELS: usize = 96;
const RISE: f32 = 0.05;

/// A shot: how the aeroplane flies, and how the eye follows it.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// Where the aeroplane is at the start, metres.
    start: [f32; 3],
    /// Where it flies, radians from east towards south.
    heading: f32,
    /// Where the eye is, metres ahead of the aeroplane, above it and to its right.
    eye: [f32; 3],
    /// The share of the aeroplane's way that the eye goes along, hundredths.
    follows: f32,
    /// How far ahead of the aeroplane the eye looks, metres; 100 is the pilot's view, which banks with it.
    ahead: f32,
    /// The vertical field of view, degrees.
    fov: f32,
}

/// A shot of an aeroplane from `start` on along `heading`.
const fn shot(start: [f32; 3], heading: f32, eye: [f32; 3], follows: f32, ahead: f32, fov: f32) -> Shot {
    Shot { start, heading, eye, follows, ahead, fov }
}

/// The shots, by the second at which each starts.
#[rustfmt::skip]
pub static SHOTS: &[(f64, Shot)] = &[
    // Into a cloud, before the rising sun; through it by the pilot's eyes, and into the next; out of that, and past.
    (0.0, shot([-1230.0, 725.0, -110.0], -0.15, [-24.0, 5.0, 9.0], 78.0, 10.0, 50.0)),
    (4.25, shot([-626.0, 725.0, -190.0], -0.15, [7.0, 0.0, 0.0], 100.0, 100.0, 60.0)),
    (9.25, shot([-134.0, 725.0, -285.0], -0.15, [250.0, -8.0, 20.0], 0.0, 0.0, 45.0)),
    // Over the lake.
    (16.0, shot([-340.0, 770.0, 60.0], 0.0, [-24.0, 12.0, -12.0], 100.0, 12.0, 50.0)),
    // Out of a cloud, towards the eye.
    (26.0, shot([1590.0, 735.0, 410.0], 0.0, [30.0, -2.0, 6.0], 100.0, 0.0, 45.0)),
    // In and out, from afar.
    (34.0, shot([524.0, 745.0, 928.0], 0.0, [20.0, -14.0, 150.0], 95.0, 0.0, 20.0)),
    // Above all clouds.
    (41.0, shot([-1200.0, 970.0, 300.0], 0.0, [-24.0, 15.0, 8.0], 100.0, 12.0, 60.0)),
];

impl Shot {
    /// Where the aeroplane is `t` seconds after the start of the shot: it winds along its heading.
    #[inline(never)]
    fn way(&self, t: f32) -> Vec3A {
        let course = angle::turn_y(-self.heading);
        course * vec3a(70.0 * t, 8.0 * angle::sin(0.6 * t), 40.0 * angle::sin(0.35 * t)) + Vec3A::from(self.start)
    }
}

/// A shape of cloud, and the sun that it is lit by: none at first.
struct Shape {
    voxels: Option<Arc<Voxels>>,
    sun: Vec3A,
    kind: u32,
    extinction: f32,
}

impl Shape {
    const NONE: Shape = Shape { voxels: None, sun: Vec3A::ZERO, kind: 0, extinction: 0.0 };
}

/// The shapes that clouds have, kept from frame to frame.
struct Shapes {
    all: [Shape; 6],
    grain: Option<Arc<Voxels>>,
}
keep!(Shapes, Shapes { all: [const { Shape::NONE }; 6], grain: None });

impl Shapes {
    /// The shapes lit by a sun in a direction. Each is lit anew when the sun has moved by some degree.
    fn lit(&mut self, spec: &FrameSpec, towards: Vec3A, extinction: f32) -> Vec<Arc<Voxels>> {
        let level = spec.workers.level();
        let only = spec.get(&KIND) as u32;
        spec.workers.each(self.all.iter_mut().enumerate(), |(number, shape)| {
            // Two shapes at a time, one for each core of most machines that are slow, lest one frame has to light all.
            let turn = to_f32(number / 2) / 3.0;
            let sun = unit((towards * 64.0 + turn).floor() - turn + 0.5);
            let other = cuts::PARAMETERS && shape.kind != only;
            if other || shape.sun != sun || cuts::PARAMETERS && shape.extinction != extinction {
                let kind = match only {
                    1 => CloudKind::CUMULUS,
                    2 => CloudKind::CONGESTUS,
                    _ if number < 4 => CloudKind::CUMULUS,
                    _ => CloudKind::CONGESTUS,
                };
                let kind = kind.with_rise(RISE);
                // The last frame's picture is gone, so that nobody else has the shape but imposters.
                let own = if cuts::IMPOSTERS { |old| Some(Arc::unwrap_or_clone(old)) } else { Arc::into_inner };
                let old = std::mem::replace(shape, Shape::NONE).voxels.filter(|_| !other).and_then(own);
                let mut new = old
                    .unwrap_or_else(|| dispatch!(level, simd => CloudKind::grow(simd, &kind, number as u32, VOXELS)));
                dispatch!(level, simd => sunlight::bake(simd, &mut new, sun, extinction));
                *shape = Shape { voxels: Some(Arc::new(new)), sun, kind: only, extinction };
            }
        });
        let mut lit = Vec::new();
        for shape in &self.all {
            if let Some(voxels) = &shape.voxels {
                lit.push(voxels.clone());
            }
        }
        lit
    }
}

/// The field as the parameters say.
fn altered(spec: &FrameSpec) -> CloudField {
    CloudField {
        seed: spec.get(&SEED) as u32,
        spacing: spec.get(&SPACING) as f32,
        share: spec.get(&SHARE) as f32,
        height: spec.get(&HEIGHT) as f32,
        extinction: spec.get(&THICKNESS) as f32,
        ..FIELD
    }
}

/// The clouds of a field around the eye, carried by the wind that the parameters say: what it differs by from the
/// field's own moves both the clouds and the eye that they are looked for around.
fn blown(spec: &FrameSpec, field: &CloudField, eye: Vec3A, shapes: &[Arc<Voxels>]) -> Vec<Cloud> {
    let time = spec.time as f32;
    let [east, south] = [&EAST, &SOUTH].map(|wind| (spec.get(wind) - wind.default) as f32);
    let more = vec3a(east, 0.0, south) * (time * (field.height * 0.002).sqrt());
    let mut clouds = field.around(eye - more, time, shapes);
    for cloud in &mut clouds {
        cloud.centre += more;
    }
    clouds
}

fn picture(spec: &FrameSpec) -> Picture {
    let hour = spec.get(&START) + 7.9 * (spec.time / LENGTH).powf(1.6);
    let (shot, since) = timeline::cut(SHOTS, LENGTH, spec.time);
    let since = since as f32;
    let (place, next) = (shot.way(since), shot.way(since + 0.5));
    // The steeper it turns, the steeper it banks.
    let bank = 0.42 * angle::sin(0.35 * since + 0.26);
    let Camera { right: x, up: y, forward: ahead, .. } = Camera::look_at(place, next, FRAC_PI_2, bank);
    let turn = Mat3A::from_cols(x, y, -ahead);
    let eye = shot.way(since * shot.follows * 0.01) + angle::turn_y(-shot.heading) * Vec3A::from(shot.eye);
    let target = place + ahead * shot.ahead;
    let camera = Camera::look_at(eye, target, shot.fov.to_radians(), bank * shot.ahead * 0.01);
    #[cfg(feature = "full")]
    let camera = spec.placed(camera);
    // The clouds are those around the eye, wherever it is put.
    let eye = if cuts::PARAMETERS { camera.eye } else { eye };
    let view = spec.view(camera);
    let dome = valley::sky(spec, valley::date(spec, &DATE) + (hour - 1.0) / 24.0);
    let now = dome.lighting();
    let field = if cuts::PARAMETERS { altered(spec) } else { FIELD };
    let cache = spec.cache.get::<Shapes>();
    let mut kept = cache.lock();
    let shapes = kept.lit(spec, now.direction, field.extinction);
    let grain = kept.grain.get_or_insert_with(|| Arc::new(grain::table())).clone();
    drop(kept);
    let clouds =
        if cuts::PARAMETERS { blown(spec, &field, eye, &shapes) } else { field.around(eye, spec.time as f32, &shapes) };
    #[cfg(feature = "full")]
    let (place, turn) = spec.flown(place, turn);
    let mut world = valley::world(&dome, valley::season(0).1, turn, place, spec.time);
    // The map of the clouds' shadows moves by whole texels, and its slope is limited before the sun is level.
    let texel = 80.0;
    let corner = ((Vec2::new(eye.x, eye.z) / texel).floor() - to_f32(CloudShadow::SIDE) * 0.5) * texel;
    let slope = Vec2::new(now.direction.x, now.direction.z) / now.direction.y.max(0.05);
    let mut passes = vec![0.0; CloudShadow::SIDE * CloudShadow::SIDE];
    spec.workers.each(passes.chunks_mut(CloudShadow::SIDE).enumerate(), |(row, passes)| {
        let z = corner.y + to_f32(row) * texel;
        // Few shadows reach a row: most clouds are farther than half of their cube's edge from the sun's plane through it.
        // The others lie close together in the list, which goes by rows of the field's squares.
        let reaches = |cloud: &Cloud| {
            let beside = (cloud.centre.z - z) * now.direction.y - cloud.centre.y * now.direction.z;
            beside.abs() < cloud.size
        };
        let first = clouds.iter().position(reaches).unwrap_or(clouds.len());
        let end = clouds.iter().rposition(reaches).map_or(first, |last| last + 1);
        let mut points = Vec::new();
        for column in 0..CloudShadow::SIDE {
            points.push(vec3a(corner.x + to_f32(column) * texel, 0.0, z));
        }
        passes.copy_from_slice(&shadow::shares(&clouds[first..end], now.direction, &points));
    });
    if !cfg!(without = "cloud-shadows") {
        world.cloud_shadow = Some(CloudShadow { passes, corner, texel, slope });
    }
    // The brightest of it, glare aside, becomes white.
    let scale = 1.15 / (0.6 * now.color + 0.85 * now.sky).max_element().max(1.0);
    let [sun, sky, ground] = [now.color, now.sky, now.ground].map(|light| light * scale);
    let light = CloudLight {
        ambient: [ground * 0.5 + sky * 0.4, sky * 0.85],
        towards: now.direction,
        sun: sun * (0.75 * spec.get(&LIGHT) as f32),
        phase: [0.8, 0.8],
    };
    let air = |d: Vec3A| dome.radiance(unit(vec3a(d.x, d.y.max(0.03), d.z)));
    let clouds = CloudLayer::new(clouds.clone(), light, &view, &spec.quality.cloud)
        .in_air(9000.0, air)
        .shaded_by(&clouds)
        .with_grain(&grain);
    valley::show(spec, dome, world, view, Some(Box::new(clouds)))
}
