//! What Perlin's noise is made of, sums of it, and its distribution.

use crate::case::{Case, Effort, Runs};
use fearless_simd::dispatch;
use glam::Vec3A;
use paprsek::noise::reference::{fade, gradient};
use paprsek::noise::{fbm, noise, octaves_block, turbulence};
use paprsek::simd::block::BLOCK;
use testkit::perlin::{EDGES, exact_at};
use testkit::random::Random;
use testkit::{Found, ULP, levels};

/// The target of noise against exact arithmetic, and of sums whose amplitudes add up to 1.
const NOISE: f64 = 1e-6;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Scalar,
        "each of the 16 gradients, offsets of -1 to 1",
        "[Perlin02]",
        "f64, the paper's list",
        1.0,
        gradients,
    )
    .unit("roundings"),
    Case::new(Runs::Scalar, "the fade from 0 to 1", "6 t^5 - 15 t^4 + 10 t^3 cancels near 1", "f64", 4.0, fades)
        .unit("roundings"),
    Case::new(Runs::All, "sums of 1 to 8 octaves, plain and absolute", "[Perlin02]", "f64", NOISE, octaves),
    Case::new(
        Runs::Scalar,
        "slopes on both sides of a cell's face",
        "[Perlin02]: the quintic's derivatives vanish at its ends",
        "equal, but for the third derivative over 1/64 of a cell",
        2e-2,
        smooth,
    )
    .unit("per cell"),
    Case::new(
        Runs::Scalar,
        "standard deviation over a period",
        "0.27, never +-1",
        "0.27 by measurement of the oracle",
        5e-3,
        spread,
    ),
];

fn gradients(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(64));
    for round in 0..effort.of(160_000) as usize {
        let offset = [0; 3].map(|_| random.range(-1.0, 1.0) as f32);
        let terms = [0, 1, 2].map(|k| EDGES[round % 16][k] as f64 * offset[k] as f64);
        let (truth, size) = (terms.iter().sum::<f64>(), terms.iter().map(|t| t.abs()).sum::<f64>());
        // Any higher bits of the hash do not matter.
        let hash = round % 16 + 16 * (random.unit() * 1e6) as usize;
        let value = gradient(hash, offset[0], offset[1], offset[2]);
        found.see((value as f64 - truth).abs() / (size * ULP).max(1e-45), || format!("{hash} {offset:?}: {value}"));
    }
    found
}

fn fades(effort: &Effort) -> Found {
    let mut found = Found::default();
    let n = effort.of(1_000_000);
    for k in 0..=n {
        let t = (k as f64 / n as f64) as f32;
        let x = t as f64;
        let truth = x.powi(3) * (x * (x * 6.0 - 15.0) + 10.0);
        found.see((fade(t) as f64 - truth).abs() / ULP, || format!("{t}: {}", fade(t)));
    }
    found
}

fn octaves(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(65));
    for round in 0..effort.of(600) {
        let points: [Vec3A; BLOCK] =
            std::array::from_fn(|_| Vec3A::from_array([0; 3].map(|_| random.range(-50.0, 50.0) as f32)));
        let [x, y, z] = [0, 1, 2].map(|axis| points.map(|p| p[axis]));
        let (count, absolute) = (1 + round % 8, round % 16 < 8);
        let truth = |p: Vec3A| {
            let octave = |m: u32| exact_at(p * (1u32 << m) as f32);
            (0..count)
                .map(|m| if absolute { octave(m).abs() } else { octave(m) } * 0.5f64.powi(m as i32 + 1))
                .sum::<f64>()
        };
        let exact = points.map(truth);
        let mut see = |name: &str, values: [f32; BLOCK]| {
            for ((p, v), t) in points.iter().zip(values).zip(exact) {
                found.more((v as f64 - t).abs(), || format!("{name}, {count} octaves at {p}: {v} for {t}"));
            }
        };
        see("scalar", points.map(|p| if absolute { turbulence(p, count) } else { fbm(p, count) }));
        for (name, level) in levels() {
            let mut out = [0.0; BLOCK];
            dispatch!(level, simd => octaves_block(simd, [&x, &y, &z], count, absolute, BLOCK, None, &mut out));
            see(name, out);
        }
        found.inputs += BLOCK as u64;
    }
    found
}

/// Slopes on both sides of a face, by parabolas through three points each, 1/64 of a cell apart.
fn smooth(effort: &Effort) -> Found {
    const STEP: f32 = 1.0 / 64.0;
    let (mut found, mut random) = (Found::default(), Random(66));
    for round in 0..effort.of(100_000) {
        let mut p = Vec3A::from_array([0; 3].map(|_| random.range(-200.0, 200.0) as f32));
        let axis = round as usize % 3;
        p[axis] = p[axis].floor();
        let slopes = [-STEP, STEP].map(|step| {
            let [here, near, far] = [0.0, 1.0, 2.0].map(|k| noise(p + Vec3A::AXES[axis] * (k * step)));
            ((4.0 * near - 3.0 * here - far) / (2.0 * step)) as f64
        });
        found.see((slopes[0] - slopes[1]).abs(), || format!("{p}: {slopes:?}"));
    }
    found
}

fn spread(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(67));
    let n = effort.of(2_000_000).max(200_000);
    let (mut sums, mut truths) = ([0.0; 2], 0.0);
    for k in 0..n {
        let p = Vec3A::from_array([0; 3].map(|_| random.range(0.0, 256.0) as f32));
        let v = noise(p) as f64;
        sums = [sums[0] + v, sums[1] + v * v];
        if k < n / 4 {
            truths += exact_at(p).powi(2);
        }
    }
    let [mean, square] = sums.map(|s| s / n as f64);
    let (sigma, truth) = (square.sqrt(), (truths / (n / 4) as f64).sqrt());
    found.inputs = n as u64;
    found.more((sigma - truth).abs().max(mean.abs()), || format!("mean {mean}, {sigma} for {truth}"));
    found
}
