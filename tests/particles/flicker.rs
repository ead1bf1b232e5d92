//! How fires waver: against the formula in f64, and that nothing jumps or bends sharply, however late it is.

use paprsek::particles::flicker::flicker;

const RATES: [f64; 4] = [2.3, 3.7, 6.1, 9.7];
const LEAST: f32 = 0.4;
/// Of sums of a few numbers below 1 in f32.
const ROUNDING: f64 = 3e-7;
/// Seconds between the values that slopes are taken from.
const STEP: f64 = 1e-4;

/// PCG-RXS-M-XS-32 as in Jarzynski and Olano, 2020, wrapped in 64 bits; 24 bits of it, 0 to 1.
fn random(counter: u64) -> f64 {
    let low = |n: u64| n % (1 << 32);
    let state = low(low(counter) * 747_796_405 + 2_891_336_453);
    let word = low(((state >> ((state >> 28) + 4)) ^ state) * 277_803_737);
    let hash = (word >> 22) ^ word;
    (hash >> 8) as f64 / 16_777_216.0
}

/// The same in f64.
fn truth(seed: u64, time: f64, least: f64) -> f64 {
    let wave = |(k, rate): (usize, &f64)| {
        let at = rate * time;
        let x = at - at.floor();
        let value = |n: f64| random((seed << 24) + 8 * n.rem_euclid(268_435_456.0) as u64 + k as u64);
        let share = 10.0 * x.powi(3) - 15.0 * x.powi(4) + 6.0 * x.powi(5);
        value(at.floor()) * (1.0 - share) + value(at.floor() + 1.0) * share
    };
    let mean = RATES.iter().enumerate().map(wave).sum::<f64>() / 4.0;
    mean * (1.0 - least) + least
}

/// Most that it may change a second, and that its slope may: all waves from 0 to 1 at once, where the quintic is steepest,
/// 15/8, and most bent, 10 / sqrt 3.
fn most() -> (f64, f64) {
    let share = (1.0 - LEAST as f64) / 4.0;
    let (speed, bend) = RATES.iter().fold((0.0, 0.0), |(speed, bend), rate| (speed + rate, bend + rate * rate));
    (share * 1.875 * speed, share * 10.0 / 3f64.sqrt() * bend)
}

/// Times of all kinds.
fn times() -> impl Iterator<Item = f64> {
    [0.0, -1.0, -12.5, 30.0, 1234.5, -1e6, 1e9]
        .into_iter()
        .flat_map(|from| (0..2000).map(move |k| from + 0.0137 * k as f64))
}

#[test]
fn it_is_the_mean_of_four_smooth_waves() {
    let mut worst: f64 = 0.0;
    for seed in [0, 1, 7, 255] {
        for time in times() {
            let found = flicker(seed, time, LEAST);
            assert!((LEAST..=1.0).contains(&found), "{seed}, {time}: {found}");
            worst = worst.max((found as f64 - truth(seed as u64, time, LEAST as f64)).abs());
        }
    }
    println!("worst {worst:.1e}");
    assert!(worst < ROUNDING, "{worst}");
}

#[test]
fn it_depends_on_nothing_but_time_and_fire() {
    let first: Vec<u32> = times().map(|time| flicker(3, time, LEAST).to_bits()).collect();
    let last: Vec<u32> =
        times().collect::<Vec<_>>().into_iter().rev().map(|time| flicker(3, time, LEAST).to_bits()).collect();
    assert!(first.iter().eq(last.iter().rev()));
}

/// At a knot of any wave the values and the slopes of both sides meet: a straight line from number to number would bend by
/// up to 0.7 there.
#[test]
fn neither_value_nor_slope_jumps_at_a_knot() {
    let (speed, bend) = most();
    let (mut worst, mut largest) = (0f64, 0f64);
    for from in [0.0, -40.0, 86_400.0] {
        for rate in RATES {
            for n in 0..200 {
                let knot = ((from * rate).floor() + n as f64) / rate;
                let [a, b, c] = [-1.0, 0.0, 1.0].map(|k| flicker(2, knot + k * STEP, LEAST) as f64);
                assert!((c - a).abs() <= speed * 2.0 * STEP + ROUNDING, "{knot}: {a} {c}");
                let jump = (c - 2.0 * b + a).abs() / STEP;
                worst = worst.max(jump);
                largest = largest.max((c - a).abs() / (2.0 * STEP));
            }
        }
    }
    println!("slopes differ by {worst:.3} at most, of {largest:.2}");
    assert!(worst <= bend * STEP + 2.0 * ROUNDING / STEP, "{worst}");
    // Waves do move.
    assert!(largest > 0.5, "{largest}");
}

/// After 30 years a step is still a step: time is not rounded before its fraction is taken.
#[test]
fn it_is_as_smooth_late_as_early() {
    let (speed, bend) = most();
    for from in [0.0, -3.0, 1e9, -1e9] {
        let at = |k: u32| flicker(5, from + k as f64 * STEP, LEAST) as f64;
        // How exactly such a time is known.
        let blur = speed * f64::EPSILON * 1e9 * 2.0;
        let mut changed = 0;
        for k in 0..20_000 {
            let [a, b, c] = [at(k), at(k + 1), at(k + 2)];
            assert!((b - a).abs() <= speed * STEP + ROUNDING + blur, "{from} {k}");
            assert!((a - 2.0 * b + c).abs() <= bend * STEP * STEP + 2.0 * ROUNDING + 4.0 * blur, "{from} {k}");
            changed += (a != b) as u32;
        }
        assert!(changed > 15_000, "{from}: {changed}");
    }
}

/// Over many knots: the mean of uniform numbers, and nothing that two fires share.
#[test]
fn in_the_mean_it_is_half_way_up() {
    // A few times what is left of a sigma of 0.12 x 0.6 after 50,000 numbers, of which each counts some ten times.
    const SHARE: f64 = 0.004;
    let count = 200_000;
    let values =
        |seed: u32| -> Vec<f64> { (0..count).map(|k| flicker(seed, k as f64 * 0.0531, LEAST) as f64).collect() };
    let [a, b] = [values(0), values(1)];
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (x, y) = (mean(&a), mean(&b));
    let expected = 0.5 * (1.0 + LEAST as f64);
    assert!((x - expected).abs() < SHARE && (y - expected).abs() < SHARE, "{x} {y}");
    let product = |u: &[f64], v: &[f64]| u.iter().zip(v).map(|(p, q)| (p - x) * (q - y)).sum::<f64>();
    let correlation = product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt();
    println!("means {x:.4} {y:.4}, correlation {correlation:.4}");
    assert!(correlation.abs() < 0.05, "{correlation}");
}
