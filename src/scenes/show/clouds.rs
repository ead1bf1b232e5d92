//! The third part of the intro: by aeroplane through a morning's clouds, from dawn to noon.

use super::day;
use crate::cloud::{CloudField, CloudKind, CloudLayer, CloudLight, Voxels, shadow, sunlight};
use crate::frame::{FrameSpec, Scene};
use crate::frame::{Picture, Workers};
use crate::raster::CloudShadow;
use crate::timeline;
use crate::view::Camera;
use crate::view::View;
use fearless_simd::dispatch;
use glam::{Mat3, Vec2, Vec3, vec3};
use std::f32::consts::FRAC_PI_2;
use std::sync::{Arc, Mutex};

/// The part.
pub const CLOUDS: Scene = Scene {
    name: "clouds",
    about: "a flight through clouds, from dawn to noon",
    duration: LENGTH,
    parameters: &[],
    picture,
}
.part();

/// Seconds that it takes.
pub const LENGTH: f64 = 50.0;

const FIELD: CloudField = CloudField {
    seed: 5,
    spacing: 520.0,
    share: 0.55,
    height: 640.0,
    size: [110.0, 190.0],
    range: 5200.0,
    extinction: 26.0,
};

/// Shots by the second that each starts. Where the aeroplane is then, metres, and its heading, radians from
/// east to south; where the eye is along that, upwards and to the right, metres; how fast it follows, hundredths;
/// how far before the aeroplane it looks, metres; the vertical field of view, degrees.
#[rustfmt::skip]
pub static SHOTS: &[(f64, [f32; 10])] = &[
    // Into a cloud, before the rising sun; through it, and into the next; out of that, and past.
    (0.0, [-1230.0, 725.0, -110.0, -0.15, -24.0, 5.0, 9.0, 78.0, 10.0, 50.0]),
    (5.0, [-626.0, 725.0, -190.0, -0.15, 7.0, 0.0, 0.0, 100.0, 100.0, 60.0]),
    (11.0, [-134.0, 725.0, -285.0, -0.15, 250.0, -8.0, 20.0, 0.0, 0.0, 45.0]),
    // Over the lake.
    (18.0, [-200.0, 770.0, 60.0, 0.0, -24.0, 12.0, -12.0, 100.0, 12.0, 50.0]),
    // After whoever looks, out of a cloud.
    (26.0, [1590.0, 735.0, 410.0, 0.0, 30.0, -2.0, 6.0, 100.0, 0.0, 45.0]),
    // In and out, from afar.
    (34.0, [524.0, 745.0, 928.0, 0.0, 20.0, -14.0, 150.0, 95.0, 0.0, 20.0]),
    // Above all.
    (41.0, [-1200.0, 970.0, 300.0, 0.0, -24.0, 15.0, 8.0, 100.0, 12.0, 60.0]),
];

/// Shapes lit by a sun that is `towards`: made again when it has moved by some half of a degree.
fn shapes(workers: &Workers, towards: Vec3) -> Vec<Arc<Voxels>> {
    type Slot = (Vec3, Option<Arc<Voxels>>);
    static SLOTS: Mutex<[Slot; 6]> = Mutex::new([const { (Vec3::ZERO, None) }; 6]);
    let mut slots = SLOTS.lock().unwrap();
    let level = workers.level();
    workers.each(slots.iter_mut().enumerate(), |(number, (lit, shape))| {
        // Each at a time of its own, lest all are made in one frame.
        let sun = ((towards * 128.0 + number as f32 / 6.0).floor() - number as f32 / 6.0 + 0.5).normalize();
        if *lit != sun || shape.is_none() {
            let kind = if number < 4 { CloudKind::CUMULUS } else { CloudKind::CONGESTUS };
            let mut new = match shape {
                Some(old) => Voxels::clone(old),
                None => dispatch!(level, simd => CloudKind::grow(simd, &kind, number as u32, 64)),
            };
            dispatch!(level, simd => sunlight::bake(simd, &mut new, sun, FIELD.extinction));
            *shape = Some(Arc::new(new));
            *lit = sun;
        }
    });
    slots.iter().filter_map(|(_, shape)| shape.clone()).collect()
}

/// Where a shot's aeroplane is so many seconds after its start: it winds along its heading.
#[inline(never)]
fn way(&[x, y, z, heading, ..]: &[f32; 10], t: f32) -> Vec3 {
    let course = Mat3::from_rotation_y(-heading);
    course * vec3(70.0 * t, 8.0 * (0.6 * t).sin(), 40.0 * (0.35 * t).sin()) + vec3(x, y, z)
}

fn picture(spec: &FrameSpec) -> Picture {
    let hour = 4.1 + 7.9 * (spec.time / LENGTH).powf(1.6);
    let (keys, since) = timeline::cut(SHOTS, LENGTH, spec.time);
    let [.., along, up, right, follows, before, fov] = *keys;
    let since = since as f32;
    let (place, next) = (way(keys, since), way(keys, since + 0.5));
    // As steep as it turns.
    let bank = 0.42 * (0.35 * since + 0.26).sin();
    let Camera { right: x, up: y, forward: ahead, .. } = Camera::look_at(place, next, FRAC_PI_2, bank);
    let turn = Mat3::from_cols(x, y, -ahead);
    let eye = way(keys, since * follows * 0.01) + Mat3::from_rotation_y(-keys[3]) * vec3(along, up, right);
    // Whoever looks far ahead sits in it.
    let camera = Camera::look_at(eye, place + ahead * before, fov.to_radians(), bank * before * 0.01);
    let camera = spec.camera(camera);
    let dome = day::sky(spec, 9671.5 + (hour - 1.0) / 24.0);
    let now = dome.lighting();
    let clouds = FIELD.around(eye, spec.time as f32, &shapes(spec.workers, now.direction));
    let mut world = day::world(&dome, day::plan(0, 0.0).2, turn, place, spec.time);
    // It moves by whole texels, and its slope ends before the sun is level.
    let texel = 80.0;
    let corner = ((Vec2::new(eye.x, eye.z) / texel).floor() - CloudShadow::SIDE as u32 as f32 * 0.5) * texel;
    let slope = Vec2::new(now.direction.x, now.direction.z) / now.direction.y.max(0.05);
    let mut points = Vec::new();
    for number in 0..CloudShadow::SIDE * CloudShadow::SIDE {
        let [x, z] = [number % CloudShadow::SIDE, number / CloudShadow::SIDE].map(|k| k as u32 as f32 * texel);
        points.push(vec3(corner.x + x, 0.0, corner.y + z));
    }
    let passes = shadow::shares(&clouds, now.direction, &points);
    if !cfg!(without = "cloud-shadows") {
        world.cloud_shadow = Some(CloudShadow { passes, corner, texel, slope });
    }
    let view = View::new(camera, spec.width, spec.height);
    // What is brightest without glare is to be no more than white.
    let scale = 1.15 / (0.6 * now.color + 0.85 * now.sky).max_element().max(1.0);
    let [sun, sky, ground] = [now.color, now.sky, now.ground].map(|light| light * scale);
    let light = CloudLight {
        ambient: [ground * 0.5 + sky * 0.4, sky * 0.85],
        towards: now.direction,
        sun: sun * 0.75,
        phase: [0.8, 0.8],
    };
    let air = |d: Vec3| dome.radiance(vec3(d.x, d.y.max(0.03), d.z).normalize());
    let seen =
        CloudLayer::new(clouds.clone(), light, &view, &spec.quality.cloud).in_air(9000.0, air).shaded_by(&clouds);
    day::show(spec, dome, world, view, Some(Box::new(seen)))
}
