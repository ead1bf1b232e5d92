//! Shadow maps against what stands between a point and the light.

use crate::case::{Case, Effort, Runs};
use glam::{Vec2, Vec3A, vec3a};
use paprsek::raster::{Bias, Light, Projection, ShadowViews, World};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use testkit::depth_map;
use testkit::drawn::{self, Count, body, dark, ground, ray};
use testkit::random::Random;
use testkit::sunny::{REACH, SHARE, Sunny, cameras};
use testkit::{Found, levels};

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Best,
        "a box's shadow at 1 to 90 degrees, maps of 512 and 2048 texels",
        "[Williams78], [Reeves87]",
        "rays in f64: share misclassified",
        SHARE,
        outline,
    ),
    Case::new(
        Runs::Best,
        "the same farther than 1.5 texels from the edge, from 128 texels on",
        "leaks and acne",
        "rays in f64: points",
        0.0,
        far,
    )
    .unit("points"),
    Case::new(
        Runs::Best,
        "level ground that shadows itself at 1 to 90 degrees",
        "acne, [Isidoro06]",
        "rays in f64: points",
        0.0,
        acne,
    )
    .unit("points"),
    Case::new(
        Runs::Best,
        "light that level ground loses at 0.5 to 30 degrees",
        "grazing light, [Isidoro06]",
        "closed form: none",
        1e-4,
        grazing,
    ),
    Case::new(
        Runs::Best,
        "traced shadows farther than 0.1 texels from the edge",
        "[Whitted80]",
        "rays in f64: points",
        0.0,
        traced,
    )
    .unit("points"),
    Case::new(
        Runs::Best,
        "twice the texels: misclassified points fall by the first order",
        "refinement",
        "rays in f64, order 1",
        0.35,
        order,
    )
    .unit("orders short"),
    Case::new(
        Runs::Levels,
        "lookups in the map, on its border and beyond, interpolated and not",
        "[Reeves87]",
        "area of the lit texels in f64",
        2e-4,
        lookups,
    ),
    Case::new(
        Runs::Levels,
        "lamps 0.5 to 5 m above level ground",
        "fading light",
        "cosine over 1 + a d + b d^2, in f64",
        1e-3,
        lamps,
    )
    .unit("relative"),
];

const ELEVATIONS: [f64; 7] = [30.0, 1.0, 90.0, 5.0, 60.0, 15.0, 75.0];
const TIGHT: Bias = Bias { constant: 1e-3, slope: 0.0, normal: 0.0 };

fn sunny(elevation: f64, texels: u32) -> Sunny {
    Sunny { elevation, texels, width: 44.0, bias: TIGHT, smooth: true, back_faces: true, traced: false }
}

/// Every scene of a kind from both cameras.
fn counts(effort: &Effort, texels: &[u32], mut each: impl FnMut(f64, u32, Count)) {
    for &elevation in effort.some(&ELEVATIONS, 2) {
        for &texels in texels {
            for camera in cameras() {
                each(elevation, texels, sunny(elevation, texels).count(camera, REACH));
            }
        }
    }
}

fn outline(effort: &Effort) -> Found {
    let mut found = Found::default();
    counts(effort, &[512, 2048], |elevation, texels, count| {
        found.inputs += u64::from(count.pixels);
        found.more(count.share(), || format!("{elevation} degrees, {texels} texels: {count:?}"));
        // Without a shadow in sight nothing is tried.
        found.more(if count.dark > 20 { 0.0 } else { f64::INFINITY }, || format!("{elevation} degrees: no shadow"));
    });
    found
}

fn far(effort: &Effort) -> Found {
    let mut found = Found::default();
    counts(effort, &[128, 512, 2048], |elevation, texels, count| {
        found.inputs += u64::from(count.pixels);
        found.more(count.far as f64, || format!("{elevation} degrees, {texels} texels: {count:?}"));
    });
    found
}

fn acne(effort: &Effort) -> Found {
    let mut found = Found::default();
    for &elevation in effort.some(&ELEVATIONS, 2) {
        for texels in [512, 2048] {
            // Two texels along the normal lift level ground over all texels that are looked up.
            let bias = Bias { constant: 0.002, slope: 0.0, normal: 2.0 };
            let count = Sunny { bias, back_faces: false, ..sunny(elevation, texels) }.count(cameras()[0], REACH + 2.0);
            found.inputs += u64::from(count.pixels);
            found.more(count.far as f64, || format!("{elevation} degrees, {texels} texels: {count:?}"));
        }
    }
    found
}

/// The bias of the show's sun on ground without anything on it.
fn grazing(effort: &Effort) -> Found {
    let mut found = Found::default();
    let size = [160, 100];
    for &elevation in effort.some(&[1.0, 0.5, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0], 2) {
        for texels in [256, 1024] {
            let (sin, cos) = f64::to_radians(elevation).sin_cos();
            let towards = vec3a((cos * 0.6) as f32, sin as f32, (cos * 0.8) as f32).normalize();
            let view = Projection::parallel(towards, Vec3A::ZERO, 44.0, texels);
            let bias = Bias { constant: 0.02, slope: 3.0, normal: 0.5 };
            let light = Light::sun(towards, Vec3A::ONE).with_shadow(ShadowViews::new(vec![view], bias));
            let camera = Camera::look_at(vec3a(0.0, 24.0, -2.0), Vec3A::ZERO, 0.9, 0.0);
            let world = World { lights: vec![light], ..dark(vec![body(ground(18.0, 0.0, 6))]) };
            let planes = drawn::draw(&world, camera, size, Quality::FAST, levels()[0].1);
            let (mut sum, mut n) = (0.0, 0u64);
            for (pixel, color) in planes.color.iter().enumerate() {
                let d = ray(&camera, size, (pixel % size[0]) as f64 + 0.5, (pixel / size[0]) as f64 + 0.5);
                let p = camera.eye.as_dvec3() - d * (camera.eye.y as f64 / d.y);
                if p.abs().max_element() < 17.9 {
                    (sum, n) = (sum + color.x as f64 / towards.y as f64, n + 1);
                }
            }
            found.inputs += n;
            found.more((sum / n as f64 - 1.0).abs(), || {
                format!("{elevation} degrees, {texels} texels: {}", sum / n as f64)
            });
        }
    }
    found
}

fn traced(effort: &Effort) -> Found {
    // Texels: corners are snapped to 1/256, and a little is left of the bias.
    const TRACED_REACH: f64 = 0.1;
    let mut found = Found::default();
    for &elevation in effort.some(&ELEVATIONS, 2) {
        for (back_faces, share) in [(false, 1.0), (true, 0.0)] {
            let bias = Bias { constant: 0.02, slope: share, normal: share };
            for camera in cameras() {
                let count =
                    Sunny { bias, back_faces, traced: true, ..sunny(elevation, 512) }.count(camera, TRACED_REACH);
                found.inputs += u64::from(count.pixels);
                found.more(count.far as f64, || format!("{elevation} degrees: {count:?}"));
            }
        }
    }
    found
}

fn order(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut wrong = [0u32; 3];
    for &elevation in effort.some(&ELEVATIONS, 3) {
        for camera in cameras() {
            for (wrong, texels) in wrong.iter_mut().zip([64, 256, 1024]) {
                let count = sunny(elevation, texels).count(camera, REACH);
                found.inputs += u64::from(count.pixels);
                *wrong += count.acne + count.leaks;
            }
        }
    }
    // Two doublings each: the edge's length times the size of a texel.
    let orders = [0, 1].map(|k| 0.5 * (wrong[k] as f64 / wrong[k + 1].max(1) as f64).log2());
    found.more(1.0 - orders[0].min(orders[1]), || format!("{wrong:?} points, orders {orders:?}"));
    found
}

fn lookups(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(110));
    for size in [64, 128] {
        let (map, depths) = depth_map::random_map(&mut random, size);
        for case in 0..effort.of(20_000) as usize {
            let (at, view) = (depth_map::place(&mut random, case, size), case % 2);
            let near = if case % 5 == 0 { depths[view][case % (size * size)] } else { random.unit() as f32 };
            let smooth = case / 4 % 2 == 0;
            let truth = depth_map::truth(&depths[view], size, at.map(f64::from), near, smooth);
            found.inputs += 1;
            for (name, level) in levels() {
                let share = depth_map::lit(level, &map, view, at, near, smooth);
                found.more((share as f64 - truth).abs(), || {
                    format!("{name}, {size}, {smooth}, {at:?}: {share} for {truth}")
                });
            }
        }
    }
    found
}

/// Lamps above level ground, by the formula of the light: its colour times the cosine, over `1 + a d + b d^2`.
fn lamps(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(111));
    let size = [64, 48];
    for _ in 0..effort.of(60) {
        let lamp = vec3a(random.range(-3.0, 3.0) as f32, random.log(0.5, 5.0) as f32, random.range(-3.0, 3.0) as f32);
        let fade = Vec2::new(random.range(0.0, 0.5) as f32, random.log(1e-2, 2.0) as f32);
        let camera = Camera::look_at(vec3a(0.0, 9.0, 6.0), Vec3A::ZERO, 0.9, 0.0);
        let world = World {
            lights: vec![Light::lamp(lamp, Vec3A::ONE, fade, f32::INFINITY)],
            ..dark(vec![body(ground(20.0, 0.0, 4))])
        };
        for (name, level) in levels() {
            let planes = drawn::draw(&world, camera, size, Quality::EXACT, level);
            for (pixel, color) in planes.color.iter().enumerate() {
                let d = ray(&camera, size, (pixel % size[0]) as f64 + 0.5, (pixel / size[0]) as f64 + 0.5);
                let p = camera.eye.as_dvec3() - d * (camera.eye.y as f64 / d.y);
                if p.abs().max_element() > 19.0 {
                    continue;
                }
                let q = lamp.as_dvec3() - p;
                let distance = q.length();
                let due = q.y / distance / (1.0 + fade.x as f64 * distance + fade.y as f64 * distance * distance);
                found.see((color.x as f64 / due - 1.0).abs(), || {
                    format!("{name}, lamp {lamp}, {fade}, {p}: {color} for {due}")
                });
            }
        }
    }
    found
}
