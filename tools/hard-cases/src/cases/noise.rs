//! Perlin's noise, point by point.

use crate::case::{Case, Effort, Runs};
use fearless_simd::dispatch;
use glam::Vec3A;
use paprsek::noise::{Scratch, noise, noise_block};
use paprsek::simd::block::BLOCK;
use testkit::perlin::{exact, exact_at};
use testkit::random::Random;
use testkit::{Found, levels};

/// The target of noise against exact arithmetic, and of sums whose amplitudes add up to 1.
const NOISE: f64 = 1e-6;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Scalar,
        "the published value at (3.14, 42, 7)",
        "[Perlin02]",
        "0.13691995878400012",
        NOISE,
        published,
    ),
    Case::new(
        Runs::All,
        "coordinates of 1e-8 to 1e8 of both signs",
        "[Perlin02]",
        "f64, the lattice in 64 bits",
        NOISE,
        any_size,
    ),
    Case::new(
        Runs::All,
        "within 2 units in the last place of the lattice, -520 to 520",
        "floor, not truncation",
        "f64",
        NOISE,
        near_lattice,
    ),
    Case::new(
        Runs::All,
        "on the lattice, -2^24 to 2^24: no bit is set",
        "zeros that octaves share",
        "closed form: +0",
        0.0,
        lattice,
    )
    .unit("failures"),
    Case::new(Runs::All, "256 further along each axis: the same bits", "wrap from 255 to 256", "period", 0.0, period)
        .unit("failures"),
    Case::new(
        Runs::All,
        "beyond 2^24, 2^31 and 2^63, denormals, MAX",
        "as i32 saturates; no fraction is left",
        "f64",
        NOISE,
        huge,
    ),
    Case::new(
        Runs::All,
        "NaN and infinities in any coordinate give NaN",
        "as i32 of NaN is 0",
        "documented",
        0.0,
        not_numbers,
    )
    .unit("failures"),
];

/// Points at every implementation against a truth.
fn compare(found: &mut Found, points: &[Vec3A; BLOCK], truth: &dyn Fn(Vec3A) -> f64) {
    let [x, y, z] = [0, 1, 2].map(|axis| points.map(|p| p[axis]));
    let exact = points.map(truth);
    let mut see = |name: &str, values: &[f32; BLOCK], first: bool| {
        for ((p, v), t) in points.iter().zip(values).zip(exact) {
            found.inputs += u64::from(first);
            found.more((*v as f64 - t).abs(), || format!("{name} at {p:?}: {v:e} for {t:e}"));
        }
    };
    see("scalar", &points.map(noise), true);
    for (name, level) in levels() {
        let mut out = [0.0; BLOCK];
        dispatch!(level, simd => noise_block(simd, &x, &y, &z, 1.0, BLOCK, &mut Scratch::default(), &mut out));
        see(name, &out, false);
    }
}

#[allow(clippy::approx_constant)] // 3.14 is what was published.
fn published(_: &Effort) -> Found {
    let mut found = Found::default();
    let value = 0.136_919_958_784_000_12;
    found.see((noise(Vec3A::new(3.14, 42.0, 7.0)) as f64 - value).abs(), || "f32".into());
    // The oracle, too: an error of 1e-15 there would be seen nowhere else.
    found.see((exact([3.14, 42.0, 7.0]) - value).abs() * 1e9, || "the oracle".into());
    found
}

fn coordinate(random: &mut Random) -> f32 {
    random.log(1e-8, 1e8) as f32 * if random.unit() < 0.5 { -1.0 } else { 1.0 }
}

fn any_size(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(60));
    for round in 0..effort.of(12_000) {
        let radius = [1.0, 10.0, 300.0, 5000.0, 1e6][round as usize % 5];
        let within = |random: &mut Random| random.range(-radius, radius) as f32;
        let points = std::array::from_fn(|_| {
            Vec3A::from_array(
                [0; 3].map(|_| if round % 2 == 0 { coordinate(&mut random) } else { within(&mut random) }),
            )
        });
        compare(&mut found, &points, &exact_at);
    }
    found
}

fn step(x: f32, by: i32) -> f32 {
    (0..by.abs()).fold(x, |x, _| if by > 0 { x.next_up() } else { x.next_down() })
}

fn near_lattice(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(61));
    for _ in 0..effort.of(4_000) {
        let near = |random: &mut Random| {
            let whole = random.range(-520.0, 521.0).floor() as f32;
            step(whole, (random.unit() * 5.0) as i32 - 2)
        };
        let free = |random: &mut Random| random.range(-520.0, 520.0) as f32;
        let points = std::array::from_fn(|k| {
            let pick = |random: &mut Random, on| if on { near(random) } else { free(random) };
            let k = k % 7 + 1;
            Vec3A::new(pick(&mut random, k & 1 > 0), pick(&mut random, k & 2 > 0), pick(&mut random, k & 4 > 0))
        });
        compare(&mut found, &points, &exact_at);
    }
    found
}

/// Failures to have bits that are equal to a truth's, of every implementation.
fn same(found: &mut Found, points: &[Vec3A; BLOCK], truth: &dyn Fn(Vec3A) -> f32) {
    for &p in points {
        let (v, t) = (noise(p), truth(p));
        found.judge(v.to_bits() == t.to_bits(), || format!("{p:?}: {v:e} for {t:e}"));
    }
    // A level whose value is equal has another sign of zero at the most.
    let mut levels = Found::default();
    compare(&mut levels, points, &|p| truth(p) as f64);
    found.fail(levels.worst > 0.0, || levels.at.clone());
}

fn lattice(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(62));
    for round in 0..effort.of(2_000) {
        let reach = if round % 2 == 0 { 300.0 } else { 16_777_216.0 };
        let points =
            std::array::from_fn(|_| Vec3A::from_array([0; 3].map(|_| random.range(-reach, reach).floor() as f32)));
        same(&mut found, &points, &|_| 0.0);
    }
    found
}

fn period(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(63));
    for round in 0..effort.of(2_000) {
        // Multiples of 1/64, so that adding 256 is exact.
        let axis = Vec3A::AXES[round as usize % 3] * 256.0;
        let points = std::array::from_fn(|_| {
            Vec3A::from_array([0; 3].map(|_| (random.range(-512.0, 512.0) * 64.0).floor() as f32 / 64.0))
        });
        same(&mut found, &points, &|p| noise(p + axis));
    }
    found
}

fn huge(_: &Effort) -> Found {
    let mut found = Found::default();
    let mut all = vec![0.0, 0.5, 255.5, 256.5, 1e8, 1e20, f32::MAX, f32::MIN_POSITIVE, 1e-45, 3e-40, 4_194_304.5];
    all.extend([8_388_607.5, 16_777_215.0, 16_777_216.0, 2_147_483_520.0, 2_147_483_648.0, 4_294_967_296.0, 9.3e18]);
    all.extend(all.clone().iter().map(|x| -x));
    let triples = all.iter().flat_map(|&x| all.iter().map(move |&y| (x, y)));
    let points: Vec<Vec3A> =
        triples.flat_map(|(x, y)| [Vec3A::new(x, y, 0.4), Vec3A::new(0.7, x, y), Vec3A::new(y, -0.3, x)]).collect();
    for chunk in points.chunks(BLOCK) {
        let chunk = std::array::from_fn(|k| chunk[k % chunk.len()]);
        compare(&mut found, &chunk, &|p| {
            // Beyond i64 the oracle's lattice saturates; all such floats are multiples of 256.
            exact(p.to_array().map(|x| if x.abs() >= 9.2e18 { 0.0 } else { x as f64 }))
        });
    }
    found
}

fn not_numbers(_: &Effort) -> Found {
    let mut found = Found::default();
    for bad in [f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for k in 1..8 {
            for other in [0.5, 0.0, -1e30, 1e-45, 7.0] {
                let p = Vec3A::from_array([0, 1, 2].map(|axis| if k >> axis & 1 == 1 { bad } else { other }));
                found.judge(noise(p).is_nan(), || format!("{p}: {}", noise(p)));
                for (name, level) in levels() {
                    let [x, y, z] = p.to_array().map(|x| [x; BLOCK]);
                    let mut out = [0.0; BLOCK];
                    dispatch!(level, simd => noise_block(simd, &x, &y, &z, 1.0, BLOCK, &mut Scratch::default(), &mut out));
                    found.judge(out.iter().all(|v| v.is_nan()), || format!("{name} at {p}: {out:?}"));
                }
            }
        }
    }
    found
}
