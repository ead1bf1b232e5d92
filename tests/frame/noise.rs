//! Noise against an independent one in f64, against what is known of it, and every SIMD level against the scalar.

use fearless_simd::dispatch;
use glam::Vec3A;
use paprsek::noise::{Footprint, Scratch, fbm, noise, noise_block, octaves_block, turbulence};
use paprsek::simd::block::BLOCK;
use proptest::prelude::*;
use testkit::perlin::{exact, exact_at};

/// f32 against exact arithmetic, all roundings of one noise together.
const TOLERANCE: f64 = 4e-7;

/// A fixed sequence of numbers in 0..1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f64 / (1u64 << 24) as f64
    }

    /// A coordinate of either sign, log-uniform over 1e-8..1e8.
    fn coordinate(&mut self) -> f32 {
        let magnitude = 10f64.powf(self.next() * 16.0 - 8.0) as f32;
        if self.next() < 0.5 { magnitude } else { -magnitude }
    }

    fn within(&mut self, radius: f32) -> Vec3A {
        Vec3A::from_array([0; 3].map(|_| (self.next() as f32 * 2.0 - 1.0) * radius))
    }
}

/// Coordinates where implementations go wrong.
fn specials() -> Vec<f32> {
    let mut all =
        vec![0.0, 0.5, 255.0, 255.5, 256.0, 256.5, 257.0, 1e8, 1e20, f32::MAX, f32::MIN_POSITIVE, 1e-45, 3e-40];
    all.extend([16_777_215.0, 16_777_216.0, 2_147_483_520.0, 2_147_483_648.0, 4_294_967_296.0, 9.3e18]);
    for lattice in [1.0f32, 2.0, 7.0, 255.0, 256.0, 1024.0] {
        all.extend([lattice.next_up(), lattice.next_down()]);
    }
    let negative: Vec<f32> = all.iter().map(|x| -x).collect();
    all.extend(negative);
    all
}

#[test]
#[allow(clippy::approx_constant)] // 3.14 is what was published.
fn agrees_with_the_published_value() {
    // Quoted for Perlin's reference code, in f64: the f32 coordinates themselves are off by 1e-7.
    assert!((exact([3.14, 42.0, 7.0]) - 0.13691995878400012).abs() < 1e-15);
    assert!((noise(Vec3A::new(3.14, 42.0, 7.0)) as f64 - 0.13691995878400012).abs() < TOLERANCE);
}

#[test]
fn agrees_with_exact_arithmetic() {
    let mut random = Random(1);
    let mut worst = 0.0f64;
    for radius in [1.0, 10.0, 300.0, 5000.0, 1e6] {
        for _ in 0..100_000 {
            let p = random.within(radius);
            worst = worst.max((noise(p) as f64 - exact_at(p)).abs());
        }
    }
    for _ in 0..200_000 {
        let p = Vec3A::new(random.coordinate(), random.coordinate(), random.coordinate());
        worst = worst.max((noise(p) as f64 - exact_at(p)).abs());
    }
    assert!(worst < TOLERANCE, "{worst:e}");
}

#[test]
fn specials_agree_with_exact_arithmetic() {
    for &x in &specials() {
        for &y in &specials() {
            let p = Vec3A::new(x, y, 0.4);
            // Beyond i64 the oracle's lattice saturates; all such floats are multiples of 256.
            let q = p.to_array().map(|x| if x.abs() >= 9.2e18 { 0.0 } else { x as f64 });
            assert!((noise(p) as f64 - exact(q)).abs() < TOLERANCE, "{p}");
        }
    }
}

#[test]
fn vanishes_on_the_lattice() {
    for i in -300..300 {
        let p = Vec3A::new(i as f32, (i * 7 % 301) as f32, (i * 13 % 257) as f32);
        assert_eq!(noise(p).to_bits(), 0, "{p}");
    }
}

#[test]
fn repeats_after_256() {
    let mut random = Random(2);
    for _ in 0..10_000 {
        // Multiples of 1/64, so that adding 256 is exact.
        let p = (random.within(256.0) * 64.0).floor() / 64.0;
        for axis in [Vec3A::X, Vec3A::Y, Vec3A::Z] {
            assert_eq!(noise(p).to_bits(), noise(p + 256.0 * axis).to_bits(), "{p}");
        }
    }
}

#[test]
fn is_continuous_across_cells() {
    for i in -260..260 {
        for (y, z) in [(0.3, 0.7), (-0.6, 12.1)] {
            let (x, y, z) = (i as f32, y, z);
            let here = noise(Vec3A::new(x, y, z));
            for near in [x.next_up(), x.next_down()] {
                // The slope is below 2.
                let step = 2.0 * (near - x).abs() + 1e-6;
                assert!((noise(Vec3A::new(near, y, z)) - here).abs() < step, "{x}");
                assert!((noise(Vec3A::new(y, near, z)) - noise(Vec3A::new(y, x, z))).abs() < step, "{x}");
                assert!((noise(Vec3A::new(y, z, near)) - noise(Vec3A::new(y, z, x))).abs() < step, "{x}");
            }
        }
    }
}

#[test]
fn has_the_known_distribution() {
    let mut random = Random(3);
    let (mut low, mut high, mut sum, mut squares) = (0.0f32, 0.0f32, 0.0, 0.0);
    let n = 1_000_000;
    for _ in 0..n {
        let v = noise(random.within(128.0));
        (low, high) = (low.min(v), high.max(v));
        sum += v as f64;
        squares += (v * v) as f64;
    }
    let sigma = (squares / n as f64).sqrt();
    assert!((-1.04..-0.8).contains(&low) && (0.8..1.04).contains(&high), "{low} {high}");
    assert!((sum / n as f64).abs() < 0.01, "{}", sum / n as f64);
    assert!((0.25..0.29).contains(&sigma), "{sigma}");
}

#[test]
fn octaves_add_up() {
    let mut random = Random(4);
    for _ in 0..10_000 {
        let p = random.within(50.0);
        let octaves: Vec<f64> = (0..6).map(|m| exact_at(p * (1 << m) as f32)).collect();
        for n in 0..=6 {
            let sum = |f: fn(f64) -> f64| (0..n).map(|m| f(octaves[m]) * 0.5f64.powi(m as i32 + 1)).sum::<f64>();
            assert!((fbm(p, n as u32) as f64 - sum(|v| v)).abs() < TOLERANCE);
            assert!((turbulence(p, n as u32) as f64 - sum(f64::abs)).abs() < TOLERANCE);
        }
    }
}

#[test]
fn not_numbers_are_survived() {
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for p in [Vec3A::new(bad, 0.5, 0.5), Vec3A::new(0.5, bad, 0.5), Vec3A::new(0.5, 0.5, bad), Vec3A::splat(bad)] {
            assert!(noise(p).is_nan());
            fbm(p, 4);
            turbulence(p, 4);
        }
    }
}

/// Every level against the scalar, bit by bit; NaN against any NaN.
fn check_levels(points: &[Vec3A; BLOCK]) {
    let [mut x, mut y, mut z] = [[0.0; BLOCK]; 3];
    for (i, p) in points.iter().enumerate() {
        (x[i], y[i], z[i]) = (p.x, p.y, p.z);
    }
    let same = |what: &str, level: &str, out: &[f32; BLOCK], truth: &dyn Fn(Vec3A) -> f32| {
        for (p, v) in points.iter().zip(out) {
            let t = truth(*p);
            assert!(t.to_bits() == v.to_bits() || t.is_nan() && v.is_nan(), "{what} {level} at {p}: {v:e} for {t:e}");
        }
    };
    for (name, level) in testkit::levels() {
        let (mut scratch, mut out) = (Scratch::default(), [0.0; BLOCK]);
        dispatch!(level, simd => noise_block(simd, &x, &y, &z, 1.0, BLOCK, &mut scratch, &mut out));
        same("noise", name, &out, &noise);
        for octaves in [0, 1, 5] {
            dispatch!(level, simd => octaves_block(simd, [&x, &y, &z], octaves, false, BLOCK, None, &mut out));
            same("fbm", name, &out, &|p| fbm(p, octaves));
            dispatch!(level, simd => octaves_block(simd, [&x, &y, &z], octaves, true, BLOCK, None, &mut out));
            same("turbulence", name, &out, &|p| turbulence(p, octaves));
        }
    }
}

#[test]
fn every_level_gives_the_same_bits() {
    let mut random = Random(5);
    for round in 0..3000 {
        check_levels(&core::array::from_fn(|_| match round % 3 {
            0 => random.within(300.0),
            1 => Vec3A::new(random.coordinate(), random.coordinate(), random.coordinate()),
            // Half cells: many ties and zeros.
            _ => random.within(20.0).floor() * 0.5,
        }));
    }
}

#[test]
fn every_level_gives_the_same_bits_of_specials() {
    let mut all = specials();
    all.extend([f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
    let mut i = 0;
    for &x in &all {
        for &y in &all {
            check_levels(&core::array::from_fn(|k| {
                i += 1;
                let z = all[(i + k) % all.len()];
                if k % 2 == 0 { Vec3A::new(x, y, 0.3) } else { Vec3A::new(y, 0.7, z) }
            }));
        }
    }
}

/// Points as pixels have them: along a line, so that cells are shared by runs of any length, and there and back, so that
/// cells are met again. For every count of points that matter.
#[test]
fn every_level_gives_the_same_bits_along_lines() {
    let mut random = Random(6);
    for round in 0..2000 {
        let (start, step) = (random.within(300.0), random.within(1.0) * 10f32.powf(random.next() as f32 * 4.0 - 3.0));
        let row = 1 + (random.next() * BLOCK as f64) as usize;
        let points = core::array::from_fn(|i| start + (i % row) as f32 * step);
        check_levels(&points);
        let count = round % BLOCK + 1;
        let [x, y, z] = [0, 1, 2].map(|axis| points.map(|p| p[axis]));
        for (name, level) in testkit::levels() {
            let (mut all, mut some) = ([0.0; BLOCK], [0.0; BLOCK]);
            dispatch!(level, simd => octaves_block(simd, [&x, &y, &z], 3, false, BLOCK, None, &mut all));
            dispatch!(level, simd => octaves_block(simd, [&x, &y, &z], 3, false, count, None, &mut some));
            assert_eq!(all[..count], some[..count], "{name}: {count} points");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn any_bits_are_survived(bits: [[u32; 3]; BLOCK]) {
        check_levels(&bits.map(|p| Vec3A::from_array(p.map(f32::from_bits))));
    }
}

/// A unit vector of any direction.
fn direction(random: &mut Random) -> Vec3A {
    loop {
        let v = random.within(1.0);
        if v.length_squared() > 0.01 && v.length_squared() < 1.0 {
            return v.normalize();
        }
    }
}

#[test]
fn an_octave_fades_as_its_mean_over_the_footprint_does() {
    const SQUARES: usize = 40 * BLOCK;
    let mut random = Random(7);
    for length in [0.25f32, 0.5, 1.0, 1.5, 2.0, 3.0, 3.9] {
        let (mut together, mut alone, mut ours) = (0.0, 0.0, 0.0);
        for _ in 0..SQUARES / BLOCK {
            let mut points = [[0.0; BLOCK]; 3];
            let mut means = [0.0; BLOCK];
            for (i, mean) in means.iter_mut().enumerate() {
                let (middle, a) = (random.within(100.0), direction(&mut random));
                let b = a.cross(direction(&mut random)).normalize();
                let count = 8.max((4.0 * length) as usize);
                let place = |k: usize| ((k as f32 + 0.5) / count as f32 - 0.5) * length;
                for k in 0..count * count {
                    *mean +=
                        noise(middle + a * place(k % count) + b * place(k / count)) as f64 / (count * count) as f64;
                }
                for axis in 0..3 {
                    points[axis][i] = middle[axis];
                }
            }
            let (mut lost, mut out) = ([0.0; BLOCK], [0.0; BLOCK]);
            let lengths = [length; BLOCK];
            let mut footprint = Some(Footprint { length: &lengths, lost: &mut lost });
            let [x, y, z] = &points;
            dispatch!(testkit::levels()[0].1, simd => octaves_block(simd, [x, y, z], 1, false, BLOCK, footprint.take(), &mut out));
            for i in 0..BLOCK {
                let here = noise(Vec3A::from_array([0, 1, 2].map(|axis| points[axis][i]))) as f64;
                together += here * means[i];
                alone += here * here;
                // The first octave has an amplitude of a half.
                ours += here * 2.0 * out[i] as f64;
            }
        }
        // The best linear predictor of the mean keeps this of the noise in the middle.
        let (best, keeps) = (together / alone, ours / alone);
        println!("{length}: keeps {keeps:.3}, the best predictor {best:.3}");
        assert!((-0.03..0.13).contains(&(keeps - best)), "{length}: {keeps} instead of {best}");
    }
}
