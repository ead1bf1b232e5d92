//! Rays through voxels: against marches in f64, from anywhere, with any numbers.

use super::clouds::at_levels;
use super::rays::any;
use crate::case::{Case, Effort, Runs};
use fearless_simd::{Level, dispatch};
use glam::{Vec3A, vec3a};
use paprsek::cloud::{Cloud, CloudKind, Voxels, sunlight};
use std::sync::Arc;
use testkit::random::Random;
use testkit::voxels::{DAY, FURNACE, aim, cloud, eighths, filled, ray, rays, truth, whole_and_eighths};
use testkit::{Found, levels};

const FOREVER: f32 = f32::INFINITY;
/// Places in voxels are good to 1e-5, where a hard edge has a slope of 10 in optical depth.
const PLACES: f64 = 1e-4;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Levels,
        "a cumulus, light and transmittance",
        "[Kajiya84]",
        "the same steps in f64",
        PLACES,
        cumulus,
    ),
    Case::new(
        Runs::Levels,
        "the same from 1e3 and 1e5 half edges away",
        "places were counted from the eye: 3e-3",
        "the same steps in f64",
        PLACES,
        far,
    ),
    Case::new(Runs::Levels, "one cube against eight", "seams between bricks", "each other", PLACES, bricks),
    Case::new(
        Runs::Levels,
        "a needle of one voxel from all sides",
        "leaps over what is empty",
        "the same steps in f64",
        PLACES,
        needles,
    ),
    Case::new(
        Runs::Levels,
        "the eye inside, on faces, edges and corners, behind, slivers, axis-parallel, denormal slopes",
        "0 times infinity, [Williams05]",
        "closed form",
        PLACES,
        awkward,
    ),
    Case::new(
        Runs::Levels,
        "any eye, direction, extinction and limit: light and transmittance make 1",
        "conservation: white furnace",
        "alpha + T = 1",
        1e-5,
        furnace,
    ),
    Case::new(
        Runs::Levels,
        "eyes, directions and extinctions of any bits",
        "0, -0, denormals, MAX, infinities, NaN",
        "no panic, T from 0 to 1 where all is finite",
        0.0,
        any_bits,
    )
    .unit("failures"),
    Case::new(Runs::Levels, "empty clouds of any size", "an empty grid", "no light, T of 1, bit for bit", 0.0, empty)
        .unit("failures"),
];

fn grown(kind: &CloudKind, seed: u32, edge: usize) -> Voxels {
    dispatch!(Level::new(), simd => CloudKind::grow(simd, kind, seed, edge))
}

fn against_f64(effort: &Effort, count: u32, away: f32) -> Found {
    let mut voxels = grown(&CloudKind::CUMULUS, 3, 64);
    dispatch!(Level::new(), simd => sunlight::bake(simd, &mut voxels, vec3a(0.6, 0.5, 0.3).normalize(), 20.0));
    let cloud = cloud(voxels, 20.0);
    let mut found = Found::default();
    for k in 0..effort.of(count) {
        let (near, d) = aim(k as usize);
        let eye = near - d * away;
        let (light, left) = at_levels(&mut found, &cloud, eye, d, FOREVER, 100.0);
        let (exact, exact_left) = truth(&cloud, &DAY, eye, d, 100);
        let error = (light.as_dvec3() - exact).abs().max_element().max((left as f64 - exact_left).abs());
        found.see(error, || format!("from {eye} along {d}: {light}, {left}"));
    }
    found
}

fn cumulus(effort: &Effort) -> Found {
    against_f64(effort, 2000, 0.0)
}

fn far(effort: &Effort) -> Found {
    against_f64(effort, 600, 1e3).and(against_f64(effort, 600, 1e5))
}

fn bricks(effort: &Effort) -> Found {
    let whole = cloud(grown(&CloudKind::CUMULUS, 2, 64), 8.0);
    let parts = eighths(&whole);
    let (mut found, mut random) = (Found::default(), Random(81));
    for _ in 0..effort.of(400) {
        let (y, z) = (random.range(-0.95, 0.95) as f32, random.range(-0.95, 0.95) as f32);
        let [one, eight] = whole_and_eighths(&whole, &parts, y, z);
        found.see((one - eight).abs() as f64, || format!("at {y}, {z}: {one} and {eight}"));
    }
    found
}

fn needles(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(82));
    for _ in 0..effort.of(200) {
        let edge = [8, 16, 32, 64][(random.unit() * 4.0) as usize];
        let needle = [0; 3].map(|_| (random.unit() * edge as f64) as usize);
        let cloud = cloud(filled(edge, |place| if place == needle { 255 } else { 0 }), 50.0);
        let target = Vec3A::from(needle.map(|i| (2 * i + 1) as f32 / edge as f32 - 1.0));
        for side in 0..20 {
            let d = if side < 6 { Vec3A::AXES[side / 2] * [1.0, -1.0][side % 2] } else { random.direction() };
            let eye = target - d * 4.0;
            let (light, left) = ray(&cloud, &DAY, eye, d, FOREVER, 100.0);
            let (exact, exact_left) = truth(&cloud, &DAY, eye, d, 100);
            let error = (left as f64 - exact_left).abs().max((light.as_dvec3() - exact).abs().max_element());
            found.see(error, || format!("{needle:?} of {edge} along {d}: {left} for {exact_left}"));
        }
    }
    found
}

fn awkward(_: &Effort) -> Found {
    let solid = cloud(filled(32, |_| 255), 1.0);
    let (diagonal, s) = (Vec3A::ONE.normalize(), 1.0 - 1e-6);
    let edge = vec3a(1.0, 0.0, 1.0);
    let ways = [
        (vec3a(0.0, 0.0, 2.0), Vec3A::Z, 0.0),
        (Vec3A::Z, Vec3A::NEG_Z, 2.0),
        (Vec3A::Z, Vec3A::Z, 0.0),
        (edge, -edge.normalize(), 8f64.sqrt()),
        (edge, edge.normalize(), 0.0),
        (Vec3A::ONE, -diagonal, 12f64.sqrt()),
        (Vec3A::ONE, diagonal, 0.0),
        (Vec3A::ZERO, Vec3A::Y, 1.0),
        (vec3a(2.0, s, s), Vec3A::NEG_X, 2.0),
        (vec3a(2.0, 1.0 + 1e-5, 0.0), Vec3A::NEG_X, 0.0),
        (vec3a(1.0, 0.999, 0.0), vec3a(-1.0, 1.0, 0.0).normalize(), 0.001 * 2f64.sqrt()),
        (vec3a(-0.0, -0.0, 3.0), vec3a(-0.0, -0.0, -1.0), 2.0),
        (vec3a(0.5, -0.5, 3.0), vec3a(1e-42, -1e-42, -1.0), 2.0),
        (vec3a(0.5, -1.0, 3.0), vec3a(1e-42, 1e-42, -1.0), 2.0),
        (vec3a(0.0, 0.0, 1024.0), Vec3A::NEG_Z, 2.0),
    ];
    let mut found = Found::default();
    for (eye, d, length) in ways {
        for turn in 0..3 {
            // The same along every axis.
            let turned = |v: Vec3A| Vec3A::from_array(std::array::from_fn(|k| v[(k + turn) % 3]));
            let (eye, d) = (turned(eye), turned(d));
            let left = at_levels(&mut found, &solid, eye, d, FOREVER, 100.0).1;
            found.see((left as f64 - (-length).exp()).abs(), || format!("from {eye} along {d}: {left}"));
        }
    }
    found
}

fn furnace(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(83));
    let voxels = Arc::new(filled(8, |[i, j, l]| (i * 31 + j * 17 + l * 7) as u8));
    for _ in 0..effort.of(20_000) {
        let size = random.log(1e-3, 1e5) as f32;
        let centre =
            if random.unit() < 0.5 { Vec3A::ZERO } else { random.direction() * size * random.log(1e-2, 10.0) as f32 };
        let extinction = if random.unit() < 0.1 { 0.0 } else { random.log(1e-8, 1e3) as f32 };
        let cloud = Cloud { voxels: voxels.clone(), centre, size, extinction };
        let on = |random: &mut Random| {
            [random.range(-4.0, 4.0), 1.0, -1.0, 0.0, 1e-30][(random.unit() * 5.0) as usize] as f32
        };
        let eye = centre + vec3a(on(&mut random), on(&mut random), on(&mut random)) * size;
        let d = if random.unit() < 0.3 { Vec3A::AXES[(random.unit() * 3.0) as usize] } else { random.direction() };
        let limit = if random.unit() < 0.5 { FOREVER } else { size * random.range(0.0, 5.0) as f32 };
        let steps = random.log(1.0, 300.0).floor() as f32;
        for (name, level) in levels() {
            let (light, left) = rays(level, &cloud, &FURNACE, eye, &[d; 16], limit, [steps, 0.0])[0];
            let range = if (0.0..=1.0).contains(&left) { 0.0 } else { f64::INFINITY };
            found.see(((light.x + left - 1.0).abs() as f64).max(range), || {
                format!(
                    "{name}: {size} at {centre}, {extinction}, from {eye} along {d}, {limit}, {steps}: {light}, {left}"
                )
            });
        }
    }
    found
}

fn any_bits(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(84));
    let voxels = Arc::new(filled(8, |[i, j, l]| (i * 31 + j * 17 + l * 7) as u8));
    for _ in 0..effort.of(20_000) {
        let [size, extinction, limit] = [0; 3].map(|_| any(&mut random).abs());
        let (centre, eye) = (super::rays::any3(&mut random), super::rays::any3(&mut random));
        let d = super::rays::any3(&mut random).normalize_or(Vec3A::Z);
        let cloud = Cloud { voxels: voxels.clone(), centre, size, extinction };
        // Where squares of lengths have no place in a float there is no way through.
        let sane = |x: f32| x == 0.0 || (1e-9..1e9).contains(&x.abs());
        let finite = (1e-9..1e9).contains(&size)
            && sane(extinction)
            && [centre, eye].iter().all(|v| v.to_array().into_iter().all(sane))
            && d.is_finite()
            && !limit.is_nan();
        for (name, level) in levels() {
            let (light, left) = rays(level, &cloud, &FURNACE, eye, &[d; 16], limit, [100.0, 0.0])[0];
            found.judge(!finite || (0.0..=1.0).contains(&left) && light.is_finite(), || {
                format!("{name}: {size:e} at {centre:?}, {extinction:e}, from {eye:?} along {d:?}, {limit:e}: {light}, {left}")
            });
        }
    }
    found
}

fn empty(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(85));
    for round in 0..effort.of(2_000) {
        let edge = [8, 16, 32][round as usize % 3];
        let cloud = Cloud {
            voxels: Arc::new(filled(edge, |_| 0)),
            centre: Vec3A::ZERO,
            size: random.log(1e-3, 1e5) as f32,
            extinction: random.log(1e-8, 1e8) as f32,
        };
        let eye = random.direction() * cloud.size * random.log(0.1, 100.0) as f32;
        let d = (random.direction() * cloud.size - eye).normalize();
        for (name, level) in levels() {
            let (light, left) = rays(level, &cloud, &DAY, eye, &[d; 16], FOREVER, [100.0, 0.0])[0];
            found.judge(light == Vec3A::ZERO && left == 1.0, || format!("{name}: {light}, {left}"));
        }
    }
    found
}
