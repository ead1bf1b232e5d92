//! What becomes of light in a cloud, against closed forms.

use crate::case::{Case, Effort, Runs};
use fearless_simd::{Level, dispatch};
use glam::{Vec3A, vec3a};
use paprsek::cloud::{Cloud, sunlight};
use std::f64::consts::PI;
use testkit::random::Random;
use testkit::voxels::{self, DAY, FURNACE, aim, ball, cloud, filled, ray, rays, span, truth};
use testkit::{Found, levels};

const FOREVER: f32 = f32::INFINITY;
/// Transmittance is a sum of a hundred roundings of numbers up to 1.
const ROUNDING: f64 = 6e-6;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Levels,
        "even clouds of extinction 0 to 1000, 1 to 800 steps",
        "Beer and Lambert",
        "closed form",
        ROUNDING,
        even,
    ),
    Case::new(
        Runs::Levels,
        "the same at 64 steps, optical depths to 8.7",
        "the target of transmittance",
        "closed form",
        1e-4,
        relative,
    )
    .unit("relative"),
    Case::new(
        Runs::Levels,
        "opacity of depths from 2e-12 to 20",
        "T - 1 has no digits left at 1e-7",
        "f64 expm1",
        2e-5,
        thin,
    )
    .unit("relative"),
    Case::new(Runs::Levels, "depths beyond the least float", "e^-126 and thinner", "0 to 1e-30, no NaN", 0.0, opaque)
        .unit("failures"),
    Case::new(
        Runs::Levels,
        "a linear ramp between centres of voxels",
        "half-texel faults",
        "closed form",
        ROUNDING,
        ramp,
    ),
    Case::new(
        Runs::Levels,
        "a Gaussian ball at 64 steps",
        "1.7e-2 by alpha = sigma ds",
        "6400 steps in f64",
        1e-4,
        gaussian,
    )
    .unit("relative"),
    Case::new(
        Runs::Levels,
        "the same against its integral",
        "bytes of density are off by 1/510",
        "closed form",
        3e-3,
        integral,
    ),
    Case::new(
        Runs::Levels,
        "half the step: the error falls by the second order",
        "midpoint rule",
        "3000 steps in f64, order 2",
        0.2,
        order,
    )
    .unit("orders short"),
    Case::new(Runs::Best, "baked sunlight through a slab", "[Wrenninge13]", "closed form", 0.51, slab).unit("bytes"),
];

/// One ray at every level; the answers have the same bits, or the error is infinite.
pub fn at_levels(found: &mut Found, cloud: &Cloud, eye: Vec3A, d: Vec3A, limit: f32, steps: f32) -> (Vec3A, f32) {
    let all: Vec<_> = levels()
        .into_iter()
        .map(|(_, level)| rays(level, cloud, &DAY, eye, &[d; 16], limit, [steps, 0.0])[0])
        .collect();
    let bits = |k: usize| all[k].0.extend(all[k].1).to_array().map(f32::to_bits);
    found.more(if (1..all.len()).all(|k| bits(k) == bits(0)) { 0.0 } else { f64::INFINITY }, || {
        format!("levels differ from {eye} along {d}: {all:?}")
    });
    all[0]
}

fn every(found: &mut Found, largest: f64, error: impl Fn(f64, f64) -> f64) {
    let ways = [
        (vec3a(0.0, 0.0, 5.0), Vec3A::NEG_Z, 2.0),
        (Vec3A::ZERO, Vec3A::X, 1.0),
        (Vec3A::splat(-3.0), Vec3A::ONE.normalize(), 12f64.sqrt()),
        (vec3a(0.25, 0.5, 0.0), Vec3A::NEG_Y, 1.5),
    ];
    for extinction in [0.0, 1e-30, 1e-7, 1e-3, 0.1, 1.0, 2.5, 10.0, 100.0, 1000.0] {
        let cloud = cloud(filled(32, |_| 255), extinction);
        for (eye, d, length) in ways {
            let exact = (-extinction as f64 * length).exp();
            for steps in [1.0, 8.0, 64.0, 100.0, 800.0] {
                if (extinction as f64) <= largest && (largest > 100.0 || steps == 64.0) {
                    let left = at_levels(found, &cloud, eye, d, FOREVER, steps).1;
                    found.see(error(left as f64, exact), || format!("{extinction} along {length} in {steps}: {left}"));
                }
            }
        }
    }
}

fn even(_: &Effort) -> Found {
    let mut found = Found::default();
    every(&mut found, f64::INFINITY, |left, exact| (left - exact).abs());
    found
}

fn relative(_: &Effort) -> Found {
    let mut found = Found::default();
    every(&mut found, 2.5, |left, exact| (left - exact).abs() / exact);
    found
}

fn thin(effort: &Effort) -> Found {
    let mut found = Found::default();
    let (eye, d) = (vec3a(0.25, 0.5, 4.0), vec3a(-0.05, 0.1, -1.0).normalize());
    let Some((entry, exit)) = span(eye.as_dvec3(), d.as_dvec3()) else { return found };
    let n = effort.of(1300).max(130);
    for k in 0..=n {
        let extinction = 10f32.powf(-12.0 + 13.0 * k as f32 / n as f32);
        let cloud = cloud(filled(8, |_| 255), extinction);
        let depth = extinction as f64 * (exit - entry);
        for steps in [8.0, 100.0] {
            for (name, level) in levels() {
                let (light, _) = rays(level, &cloud, &FURNACE, eye, &[d; 16], FOREVER, [steps, 0.0])[0];
                // All light is 1 and comes from everywhere: a cloud is as bright as it is opaque.
                found.see((light.x as f64 / -(-depth).exp_m1() - 1.0).abs(), || format!("{name}, depth {depth:e}"));
            }
        }
    }
    found
}

fn opaque(_: &Effort) -> Found {
    let mut found = Found::default();
    for extinction in [70.0, 90.0, 150.0, 1e3, 1e6, 1e30, f32::MAX] {
        let cloud = cloud(filled(8, |_| 255), extinction);
        for steps in [1.0, 100.0] {
            for (name, level) in levels() {
                let (light, left) =
                    rays(level, &cloud, &FURNACE, vec3a(0.0, 0.0, 3.0), &[Vec3A::NEG_Z; 16], FOREVER, [steps, 0.0])[0];
                let right = (0.0..1e-30).contains(&left) && (light - Vec3A::ONE).abs().max_element() < 1e-5;
                found.judge(right, || format!("{name}, {extinction} in {steps}: {light}, {left}"));
            }
        }
    }
    found
}

fn ramp(_: &Effort) -> Found {
    let mut found = Found::default();
    for axis in 0..3 {
        let cloud = cloud(filled(32, |place| 8 * place[axis] as u8), 1.0);
        for (x, y) in [(0.1, 0.2), (0.0, 0.0), (-0.77, 0.93)] {
            let mut eye = vec3a(x, y, x * y);
            eye[axis] = -1.0 + 0.5 / 16.0;
            for voxels in [4.0, 10.0, 31.0] {
                let left = at_levels(&mut found, &cloud, eye, Vec3A::AXES[axis], voxels / 16.0, 2.0 * voxels).1;
                // The mean density of the way is half of that at its end.
                let exact = (-(voxels as f64) / 16.0 * 4.0 * voxels as f64 / 255.0).exp();
                found.see((left as f64 - exact).abs(), || format!("{voxels} voxels along axis {axis}: {left}"));
            }
        }
    }
    found
}

/// Rays along -z through a ball: transmittance, the same in f64, and the place squared.
fn through(effort: &Effort, narrow: f32, mut each: impl FnMut(f64, f64, f64)) {
    let cloud = cloud(ball(64, narrow), 2.0);
    let mut random = Random(80);
    for _ in 0..effort.of(200) {
        let (x, y) = (random.range(-0.5, 0.5) as f32, random.range(-0.5, 0.5) as f32);
        let eye = vec3a(x, y, 4.0);
        let left = ray(&cloud, &FURNACE, eye, Vec3A::NEG_Z, FOREVER, 64.0).1;
        each(left as f64, truth(&cloud, &FURNACE, eye, Vec3A::NEG_Z, 6400).1, (x * x + y * y) as f64);
    }
}

fn gaussian(effort: &Effort) -> Found {
    let mut found = Found::default();
    through(effort, 6.0, |left, exact, r2| {
        found.see((left - exact).abs() / exact, || format!("{r2}: {left} for {exact}"))
    });
    found
}

fn integral(effort: &Effort) -> Found {
    let mut found = Found::default();
    through(effort, 6.0, |left, _, r2| {
        // Over all z, of which the cube holds all but a thousandth.
        let exact = (-2.0 * (-6.0 * r2).exp() * (PI / 6.0).sqrt()).exp();
        found.see((left - exact).abs(), || format!("{r2}: {left} for {exact}"));
    });
    found
}

fn order(effort: &Effort) -> Found {
    // Few voxels: their kinks, and not the roundness of the ball, decide the error, with many steps to a voxel.
    let cloud = cloud(ball(8, 5.0), 3.0);
    let n = effort.of(500).max(100);
    let mut errors = [0.0; 3];
    for k in 0..n {
        let (eye, d) = aim(k as usize);
        let exact = truth(&cloud, &FURNACE, eye, d, 3000).1;
        for (error, steps) in errors.iter_mut().zip([32.0, 64.0, 128.0]) {
            *error += (ray(&cloud, &FURNACE, eye, d, FOREVER, steps).1 as f64 - exact).powi(2);
        }
    }
    let orders = [0, 1].map(|k| 0.5 * (errors[k] / errors[k + 1]).log2());
    let short = (2.0 - orders[0]).max(2.0 - orders[1]).max(0.0);
    Found { inputs: 3 * u64::from(n), worst: short, at: format!("orders {orders:?}") }
}

/// A slab below the sun: the light at each voxel by its depth.
fn slab(_: &Effort) -> Found {
    let mut found = Found::default();
    for extinction in [1.0, 5.0, 20.0] {
        for axis in 0..3 {
            let mut voxels = filled(64, |place| (place[axis] * 4) as u8);
            let towards = Vec3A::AXES[axis];
            dispatch!(Level::new(), simd => sunlight::bake(simd, &mut voxels, towards, extinction));
            for at in 0..64 {
                // Every layer beyond, and half of its own.
                let sum: f64 = (at + 1..64).map(|k| 4.0 * k as f64).sum::<f64>() + 2.0 * at as f64;
                let truth = 255.0 * voxels::lit(extinction as f64 * sum / 255.0 * 2.0 / 64.0);
                let mut index = [31; 3];
                index[axis] = at;
                let light = voxels.light(index[0] + 64 * (index[1] + 64 * index[2])) as f64;
                found.see((light - truth).abs(), || {
                    format!("{extinction}, axis {axis}, voxel {at}: {light} for {truth}")
                });
            }
        }
    }
    found
}
