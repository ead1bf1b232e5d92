//! Coverage and depth of triangles.

use super::rays::any3;
use crate::case::{Case, Effort, Runs};
use glam::{DVec3, Vec3A, vec3a};
use paprsek::raster::World;
use paprsek::raster::project::NEAR;
use paprsek::raster::visible::CENTER;
use paprsek::settings::Quality;
use paprsek::view::Camera;
use testkit::coverage::{
    Corners, NEARNESS, SHEET, SIZES, Single, area, counts, covers, deep_triangle, draw, fan, grid, piece, plane,
    sample_of, single,
};
use testkit::drawn::{self, body, dark, ground, ray, triangles};
use testkit::random::Random;
use testkit::{Found, ULP, levels};

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Levels,
        "triangles of every hard kind: slivers, corners on samples, huge ones at the guard band",
        "[Pineda88], top-left rule",
        "24.8 in i128, every pixel",
        0.0,
        exact,
    )
    .unit("failures"),
    Case::new(
        Runs::Levels,
        "grids of triangles: gaps and overdraw",
        "shared edges, top-left rule",
        "each pixel once",
        0.0,
        grids,
    )
    .unit("failures"),
    Case::new(
        Runs::Levels,
        "fans around a corner on a sample: gaps and overdraw",
        "shared corners",
        "each pixel of the polygon once",
        0.0,
        fans,
    )
    .unit("failures"),
    Case::new(
        Runs::Levels,
        "depth of slivers and of planes from the near plane to the horizon",
        "depth precision",
        "f64",
        NEARNESS,
        depths,
    )
    .unit("roundings"),
    Case::new(Runs::Levels, "depth outside of its corners' range", "extrapolation at edges", "order", 0.0, between)
        .unit("failures"),
    Case::new(
        Runs::Levels,
        "level ground through the eye's plane, 3 m to 20 km, from 6 cm up",
        "[SutherlandHodgman74], w <= 0",
        "rays in f64, corners snapped by 1/100 pixel",
        1.0,
        clipped,
    )
    .unit("of the bound"),
    Case::new(
        Runs::Levels,
        "triangles behind the eye or before the near plane",
        "w <= 0",
        "nothing is covered",
        0.0,
        behind,
    )
    .unit("failures"),
    Case::new(
        Runs::Levels,
        "corners of any bits",
        "0, -0, denormals, MAX, infinities, NaN",
        "finite light, no panic",
        0.0,
        any_bits,
    )
    .unit("failures"),
    Case::new(Runs::Levels, "layers 1 m apart, 5 km away", "reversed depth", "the nearer is seen", 0.0, layers)
        .unit("failures"),
];

fn exact(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(100));
    for case in 0..effort.of(2000) as usize {
        let Single { corners: t, size, sample, back_faces, here } = single(&mut random, case);
        let piece = [piece(&[t], size, back_faces)];
        let truth: Vec<bool> = (0..(size[0] * size[1]) as usize)
            .map(|pixel| here && covers(&t, sample_of(pixel, size[0], sample)))
            .collect();
        for (name, level) in levels() {
            let shown = draw(level, &piece, size, sample);
            for (pixel, (shown, truth)) in shown.0.iter().zip(&truth).enumerate() {
                found.judge(shown.1.is_some() == *truth, || {
                    format!("{name}: pixel {pixel} of {size:?}, {sample:?}: {t:?}")
                });
            }
        }
    }
    found
}

fn grids(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(101));
    for case in 0..effort.of(40) as usize {
        let (mesh, sample) = grid(&mut random, case);
        for (name, level) in levels() {
            for (pixel, count) in counts(level, &mesh, SHEET, sample).into_iter().enumerate() {
                found.judge(count == 1, || format!("{name}, case {case}, pixel {pixel}: {count} times"));
            }
        }
    }
    found
}

fn fans(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(102));
    for case in 0..effort.of(120) as usize {
        let Some((fan, _)) = fan(&mut random, case, case % 6 == 5) else { continue };
        let due: Vec<u32> = (0..(SHEET[0] * SHEET[1]) as usize)
            .map(|pixel| fan.iter().filter(|t| covers(t, sample_of(pixel, SHEET[0], CENTER))).count() as u32)
            .collect();
        for (name, level) in levels() {
            for (pixel, count) in counts(level, &fan, SHEET, CENTER).into_iter().enumerate() {
                let right = count == due[pixel] && count <= 1;
                found.judge(right, || format!("{name}, case {case}, pixel {pixel}: {count} for {}", due[pixel]));
            }
        }
    }
    found
}

/// Every covered pixel of hard triangles: the nearness found, the triangle, and the pixel.
fn covered(effort: &Effort, mut each: impl FnMut(&str, f64, &Corners, usize)) {
    let mut random = Random(103);
    for _ in 0..effort.of(3000) {
        let t = deep_triangle(&mut random);
        let piece = [piece(&[t], SIZES[0], area(&t) > 0)];
        for (name, level) in levels() {
            let shown = draw(level, &piece, SIZES[0], CENTER);
            for (pixel, shown) in shown.0.iter().enumerate().filter(|(_, p)| p.1.is_some()) {
                each(name, shown.0 as f64, &t, pixel);
            }
        }
    }
}

fn depths(effort: &Effort) -> Found {
    let mut found = Found::default();
    covered(effort, |name, near, t, pixel| {
        let (truth, terms) = plane(t, sample_of(pixel, SIZES[0][0], CENTER));
        // It is clamped to the corners' range, in which the truth is.
        found.see((near - truth).abs() / (ULP * terms), || format!("{name}: {near} for {truth}: {t:?}"));
    });
    found
}

fn between(effort: &Effort) -> Found {
    let mut found = Found::default();
    covered(effort, |name, near, t, _| {
        let (low, high) = t.iter().fold((f64::MAX, 0f64), |(l, h), c| (l.min(c.near as f64), h.max(c.near as f64)));
        found.judge((low..=high).contains(&near), || format!("{name}: {near} of {t:?}"));
    });
    found
}

const SIZE: [usize; 2] = [97, 61];
const FOV: f32 = 0.9;
/// Corners are snapped to 1/256 pixel, and f32 adds a 1000th at the end of the guard band.
const SNAP: f64 = 1.0 / 100.0;

fn clipped(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(104));
    for case in 0..effort.of(60) as usize {
        let half = [3.0, 50.0, 2000.0, 20_000.0][case % 4];
        let cells = [1, 2, 13, 40][case / 4 % 4];
        let up = random.log(0.06, 100.0);
        let aside = |random: &mut Random| (random.range(-0.8, 0.8) * half) as f32;
        let eye = vec3a(aside(&mut random), up as f32, aside(&mut random));
        let camera = Camera::look_at(eye, eye + random.direction(), FOV, random.range(-1.0, 1.0) as f32);
        let world = dark(vec![body(ground(half as f32, 0.0, cells))]);
        let meets = |d: DVec3| {
            let t = -eye.as_dvec3().y / d.y;
            let p = eye.as_dvec3() + d * t;
            (d.y < 0.0 && t >= NEAR as f64 && p.x.abs() <= half && p.z.abs() <= half).then_some(1.0 / t)
        };
        // f32 of the far corners' places: metres of the eye's height, at most this share of it.
        let slack = 1e-5 + 4.0 * ULP * half / up;
        for (name, level) in levels() {
            let planes = drawn::draw(&world, camera, SIZE, Quality::EXACT, level);
            for (pixel, near) in planes.inv_depth.iter().enumerate() {
                let (x, y) = ((pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
                let around = [(0.0, 0.0), (-SNAP, -SNAP), (SNAP, -SNAP), (-SNAP, SNAP), (SNAP, SNAP)];
                let hits = around.map(|(dx, dy)| meets(ray(&camera, SIZE, x + dx, y + dy)));
                if hits.iter().any(Option::is_some) && hits.iter().any(Option::is_none) {
                    continue;
                }
                let (low, high) = hits.iter().flatten().fold((f64::MAX, 0f64), |(l, h), n| (l.min(*n), h.max(*n)));
                let error = match hits[0] {
                    None if *near == 0.0 => 0.0,
                    Some(truth) if *near > 0.0 => (*near as f64 - truth).abs() / ((high - low) + slack * truth),
                    _ => f64::INFINITY,
                };
                found.see(error, || format!("{name}, case {case}, eye {eye}, pixel {pixel}: {near} for {:?}", hits[0]));
            }
        }
    }
    found
}

fn behind(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(105));
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, FOV, 0.0);
    for _ in 0..effort.of(400) {
        // All corners at or behind the near plane, and up to it.
        let corner = |random: &mut Random| {
            let z = if random.unit() < 0.3 {
                -NEAR * random.range(0.0, 0.999) as f32
            } else {
                random.log(1e-6, 1e6) as f32
            };
            vec3a(random.range(-3.0, 3.0) as f32, random.range(-3.0, 3.0) as f32, z)
        };
        let [a, b, c] = [corner(&mut random), corner(&mut random), corner(&mut random)];
        let world = dark(vec![body(triangles(&[[a, b, c], [a, c, b]]))]);
        for (name, level) in levels() {
            let planes = drawn::draw(&world, camera, SIZE, Quality::DEFAULT, level);
            found.judge(planes.inv_depth.iter().all(|n| *n == 0.0), || format!("{name}: {a} {b} {c}"));
        }
    }
    found
}

fn any_bits(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(106));
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, FOV, 0.0);
    for round in 0..effort.of(2000) {
        let faces: Vec<[Vec3A; 3]> =
            (0..4).map(|_| [any3(&mut random), any3(&mut random), any3(&mut random)]).collect();
        let world = World { ambient: [Vec3A::ONE; 2], ..dark(vec![body(triangles(&faces))]) };
        let quality = [Quality::EXACT, Quality::DEFAULT][round as usize % 2];
        for (name, level) in levels() {
            let planes = drawn::draw(&world, camera, [33, 21], quality, level);
            let right = planes.color.iter().all(|c| c.is_finite())
                && planes.inv_depth.iter().all(|n| n.is_finite() && *n >= 0.0)
                && planes.coverage.iter().all(|c| (0.0..=1.0 + 1e-6).contains(c));
            found.judge(right, || format!("{name}: {faces:?}"));
        }
    }
    found
}

/// Walls that stand one behind another far away, in any order.
fn layers(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(107));
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, 0.1, 0.0);
    for _ in 0..effort.of(60) {
        let (first, gap) = (random.range(4000.0, 5000.0), random.range(1.0, 3.0));
        let mut walls: Vec<f64> = (0..5).map(|k| first + gap * k as f64).collect();
        if random.unit() < 0.5 {
            walls.reverse();
        }
        let wall = |z: f64| {
            let at = |x: f32, y: f32| vec3a(x, y, -z as f32);
            [[at(-2e3, -2e3), at(2e3, -2e3), at(2e3, 2e3)], [at(-2e3, -2e3), at(2e3, 2e3), at(-2e3, 2e3)]]
        };
        let world = dark(walls.iter().map(|z| body(triangles(&wall(*z)))).collect());
        for (name, level) in levels() {
            let planes = drawn::draw(&world, camera, SIZE, Quality::EXACT, level);
            for near in &planes.inv_depth {
                let seen = 1.0 / *near as f64;
                found.judge((seen - first).abs() < 0.4 * gap, || format!("{name}: {seen} of {walls:?}"));
            }
        }
    }
    found
}
