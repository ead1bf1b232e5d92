//! Time, and random numbers.

use crate::case::{Case, Effort, Runs};
use paprsek::simd::hash::{pcg, rnd};
use paprsek::timeline::{cut, ease, sample};
use testkit::Found;
use testkit::random::Random;

pub const CASES: &[Case] = &[
    Case::new(
        Runs::Scalar,
        "curves between keys, 1e-2 to 1e4 s apart",
        "[Steffen90]: nothing swings past a key",
        "between both keys",
        1e-6,
        monotone,
    ),
    Case::new(
        Runs::Scalar,
        "keys themselves, and times before, behind and NaN",
        "interpolation that misses its keys",
        "the key, bit for bit",
        0.0,
        keys,
    )
    .unit("failures"),
    Case::new(
        Runs::Scalar,
        "an ease at 1e9 s, in eighths of a second",
        "time never enters as f32",
        "f64; Perlin's form of the quintic",
        2e-6,
        eases,
    ),
    Case::new(
        Runs::Scalar,
        "cuts at, before and behind their instants",
        "a frame of the other shot",
        "order",
        0.0,
        cuts,
    )
    .unit("failures"),
    Case::new(
        Runs::Scalar,
        "random numbers over 2^21 things",
        "[ONeill14]",
        "a 64-bit writing of the same",
        0.0,
        hashes,
    )
    .unit("failures"),
    Case::new(
        Runs::Scalar,
        "mean and variance of random numbers",
        "[JarzynskiOlano20]",
        "1/2 and 1/12, standard errors",
        4.5,
        uniform,
    )
    .unit("standard errors"),
];

fn monotone(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(140));
    for _ in 0..effort.of(4_000) {
        let mut time = random.range(-100.0, 100.0);
        let keys: Vec<[f32; 2]> = (0..8)
            .map(|_| {
                time += random.log(1e-2, 1e4);
                [time as f32, if random.unit() < 0.2 { 0.0 } else { random.range(-5.0, 5.0) as f32 }]
            })
            .collect();
        for pair in keys.windows(2) {
            if pair[1][0] <= pair[0][0] {
                continue;
            }
            let (low, high) = (pair[0][1].min(pair[1][1]), pair[0][1].max(pair[1][1]));
            for _ in 0..8 {
                let time = random.range(pair[0][0] as f64, pair[1][0] as f64);
                let value = sample(&keys, time)[1];
                found.see((low - value).max(value - high).max(0.0) as f64 / 5.0, || {
                    format!("{time} of {keys:?}: {value}")
                });
            }
        }
    }
    found
}

fn keys(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(141));
    for _ in 0..effort.of(4_000) {
        let keys: Vec<[f32; 3]> = (0..6)
            .map(|k| [k as f32 * 2.5 - 3.0, random.range(-1e3, 1e3) as f32, random.log(1e-8, 1e8) as f32])
            .collect();
        for key in &keys {
            let value = sample(&keys, key[0] as f64);
            found.judge(value == *key, || format!("{value:?} for {key:?}"));
        }
        for (time, key) in
            [(f64::NAN, 0), (-1e300, 0), (f64::NEG_INFINITY, 0), (1e300, 5), (f64::INFINITY, 5), (-3.000_000_1, 0)]
        {
            let value = sample(&keys, time);
            found.judge(value == keys[key], || format!("{time}: {value:?}"));
        }
    }
    found
}

fn eases(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(142));
    for _ in 0..effort.of(100_000) {
        let from = (random.range(-1e9, 1e9) * 8.0).floor() / 8.0;
        let (to, time) = (from + random.range(1.0, 80.0).floor() / 8.0, from + random.range(-8.0, 88.0).floor() / 8.0);
        let x = ((time - from) / (to - from)).clamp(0.0, 1.0);
        let truth = x.powi(3) * (x * (x * 6.0 - 15.0) + 10.0);
        found.see((ease(from, to, time) as f64 - truth).abs(), || format!("{from}, {to}, {time}"));
    }
    found
}

fn cuts(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(143));
    for _ in 0..effort.of(20_000) {
        let mut start = 0.0;
        let list: Vec<(f64, usize)> = (0..5)
            .map(|k| {
                let here = start;
                start += random.log(1e-3, 1e3);
                (here, k)
            })
            .collect();
        let end = start;
        for k in 0..5 {
            let here = list[k].0;
            let until = list.get(k + 1).map_or(end, |next| next.0);
            let at = cut(&list, end, here);
            found.judge((*at.0, at.1) == (k, 0.0), || format!("{list:?} at {here}: {at:?}"));
            let before = cut(&list, end, here.next_down());
            found.judge(*before.0 == k.saturating_sub(1), || format!("{list:?} just before {here}: {before:?}"));
            let late = cut(&list, end, if k == 4 { f64::INFINITY } else { until.next_down() });
            found.judge(*late.0 == k && late.1 <= until - here, || format!("{list:?} just before {until}: {late:?}"));
        }
    }
    found
}

fn hashes(effort: &Effort) -> Found {
    let mut found = Found::default();
    let step = (1 << 21) / effort.of(1 << 21);
    let mask = u64::from(u32::MAX);
    for i in (0..1u32 << 21).step_by(step as usize) {
        let (seed, k) = (i % 256, i / 256 % 8);
        let n = ((u64::from(seed) << 24) + 8 * u64::from(i) + u64::from(k)) & mask;
        // In 64 bits, cut to 32 after each product.
        let s = (n * 747_796_405 + 2_891_336_453) & mask;
        let w = ((((s >> ((s >> 28) + 4)) ^ s) * 277_803_737) & mask) as u32;
        let truth = (w >> 22) ^ w;
        let right = pcg(n as u32) == truth && rnd(seed, i, k) as f64 == (truth >> 8) as f64 / 16_777_216.0;
        found.judge(right, || format!("{seed}, {i}, {k}"));
    }
    found
}

fn uniform(effort: &Effort) -> Found {
    let mut found = Found::default();
    let n = effort.of(1 << 20);
    for seed in [0, 1, 3, 77, 255] {
        for k in [0, 7] {
            let (mut sum, mut square, mut pairs) = (0.0, 0.0, 0.0);
            let mut last = 0.0;
            for i in 0..n {
                let x = rnd(seed, i, k) as f64 - 0.5;
                (sum, square, pairs) = (sum + x, square + x * x, pairs + x * last);
                last = x;
            }
            let n = n as f64;
            // Standard errors of the mean, the mean square and the mean product of neighbours.
            let errors =
                [sum / (n / 12.0).sqrt(), (square - n / 12.0) / (n / 180.0).sqrt(), pairs / (n / 144.0).sqrt()];
            found.inputs += n as u64;
            found.more(errors.iter().fold(0.0, |w, e| e.abs().max(w)), || format!("seed {seed}, {k}: {errors:?}"));
        }
    }
    found
}
