//! From linear light to codes, and the elementary functions.

use crate::case::{Case, Effort, Runs};
use fearless_simd::dispatch;
use paprsek::frame::encode::{Transfer, encode, gamma22_encode, quantize, srgb_decode, srgb_encode};
use testkit::elementary::{Function, worst};
use testkit::random::Random;
use testkit::{Found, levels};

pub const CASES: &[Case] = &[
    Case::new(Runs::Scalar, "sRGB of the 256 codes to light", "[sRGB]", "f64, the piecewise curve", 2e-7, decoded),
    Case::new(
        Runs::Scalar,
        "sRGB there and back, light of 1e-8 to 1",
        "[sRGB]: two pieces meet at 0.0031308",
        "identity",
        2e-7,
        round_trip,
    ),
    Case::new(Runs::Scalar, "sRGB and gamma 2.2 of light of 1e-8 to 1", "not 2.2", "f64", 6e-8, curves),
    Case::new(
        Runs::Levels,
        "codes of light, beyond what lies at a step",
        "[sRGB], [Roberts18]",
        "f64 with the dither",
        0.0,
        codes,
    )
    .unit("codes"),
    Case::new(Runs::Levels, "codes rise with light", "monotone", "order", 0.0, rising).unit("failures"),
    Case::new(
        Runs::Levels,
        "NaN, infinities, negative light, light beyond 1, denormals",
        "the maximum of NaN and a number",
        "0 or 255",
        0.0,
        nonsense,
    )
    .unit("failures"),
    Case::new(Runs::Levels, "mean of the dither over 256 x 256 pixels", "no bias", "f64", 1e-3, dither).unit("codes"),
    Case::new(Runs::Levels, "2^x for x of -126 to 127", "[Cephes]", "f64, relative", 2e-7, exp2),
    Case::new(
        Runs::Levels,
        "1 - 2^x for -x of 1e-35 to 126",
        "1 - (1 - a)^k loses all at 1e-7",
        "f64 expm1, relative",
        2e-7,
        opacity,
    ),
    Case::new(Runs::Levels, "binary logarithm of 2^-126 to 2^127, and of 0.99 to 1.01", "[Cephes]", "f64", 1.0, log2)
        .unit("of the bound"),
    Case::new(Runs::Levels, "powers of -0.5 to 5", "[Cephes]", "f64", 1.0, powf).unit("of the bound"),
    Case::new(Runs::Levels, "sine of -1000 to 1000 radians", "range reduction", "f64", 2e-7, sine),
];

fn srgb(c: f64) -> f64 {
    if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}

fn light(v: f64) -> f64 {
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

fn decoded(_: &Effort) -> Found {
    let mut found = Found::default();
    for code in 0..=255u32 {
        let v = code as f32 / 255.0;
        found.see((srgb_decode(v) as f64 - light(code as f64 / 255.0)).abs(), || format!("{code}: {}", srgb_decode(v)));
    }
    found
}

fn round_trip(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(70));
    for _ in 0..effort.of(400_000) {
        let c = if random.unit() < 0.3 { random.range(0.003, 0.0033) } else { random.log(1e-8, 1.0) } as f32;
        let back = srgb_decode(srgb_encode(c));
        found.see((back - c).abs() as f64, || format!("{c}: {back}"));
    }
    found
}

fn curves(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(71));
    for _ in 0..effort.of(400_000) {
        let c = random.log(1e-8, 1.0) as f32;
        let errors = [srgb_encode(c) as f64 - srgb(c as f64), gamma22_encode(c) as f64 - (c as f64).powf(1.0 / 2.2)];
        found.see(errors[0].abs().max(errors[1].abs()), || format!("{c}: {errors:?}"));
    }
    found
}

/// Rows of random light, encoded at every level, and the scalar's codes: by how much they differ where the light is not
/// within the documented distance of a step between two codes.
fn codes(effort: &Effort) -> Found {
    let (mut found, mut random) = (Found::default(), Random(72));
    for round in 0..effort.of(4_000) {
        let (transfer, margin) =
            [(Transfer::Srgb, 5e-4), (Transfer::Gamma22, 8e-3), (Transfer::Linear, 1e-4)][round as usize % 3];
        let (x0, y) = ((random.unit() * 4000.0) as u32, (random.unit() * 4000.0) as u32);
        let planes: [Vec<f32>; 3] = [0; 3].map(|_| {
            (0..200).map(|_| if random.unit() < 0.5 { random.unit() } else { random.log(1e-8, 1.0) } as f32).collect()
        });
        for (name, level) in levels() {
            let mut out = vec![0; 200];
            dispatch!(level, simd => encode(simd, transfer, x0, y, &planes[0], &planes[1], &planes[2], &mut out));
            for (at, pixel) in out.iter().enumerate() {
                for (channel, plane) in planes.iter().enumerate() {
                    let wide = pixel >> (16 - 8 * channel) & 255;
                    let (x, channel) = (x0 + at as u32, channel as u32);
                    let plain = quantize(transfer, plane[at], x, y, channel);
                    // Light a margin of a code below and above, by the curve's slope.
                    let value = |c: f64| {
                        255.0
                            * match transfer {
                                Transfer::Srgb => srgb(c),
                                Transfer::Gamma22 => c.powf(1.0 / 2.2),
                                Transfer::Linear => c,
                            }
                    };
                    let c = plane[at] as f64;
                    let slope = ((value(c * 1.001) - value(c * 0.999)) / (0.002 * c)).max(1e-3);
                    let near = [-1.0, 1.0].map(|side| {
                        quantize(transfer, (c + side * 1.05 * margin / slope).max(0.0) as f32, x, y, channel)
                    });
                    let off = (near[0].min(near[1]).min(plain))
                        .saturating_sub(wide)
                        .max(wide.saturating_sub(near[0].max(near[1]).max(plain)));
                    found.more(off as f64, || format!("{name}, {transfer:?}, {c:e} at {x}, {y}: {wide} for {plain}"));
                }
            }
        }
        found.inputs += 600;
    }
    found
}

fn rising(effort: &Effort) -> Found {
    let mut found = Found::default();
    let n = effort.of(40_000);
    for transfer in [Transfer::Srgb, Transfer::Gamma22, Transfer::Linear] {
        for (x, y) in [(0, 0), (5, 9), (1279, 719), (4001, 77)] {
            for (name, level) in levels() {
                let mut last = 0;
                for k in 0..=n {
                    let c = [(k as f32 / n as f32).powi(2)];
                    let mut out = [0];
                    // A row of one pixel, so that the dither is the same for all.
                    dispatch!(level, simd => encode(simd, transfer, x, y, &c, &c, &c, &mut out));
                    let right = [0, 8, 16].iter().all(|shift| out[0] >> shift & 255 >= last >> shift & 255);
                    found.judge(right, || {
                        format!("{name}, {transfer:?} at {x}, {y}: {} after {last:06x}: {:06x}", c[0], out[0])
                    });
                    last = out[0];
                }
                found.fail(last != 0xff_ffff, || format!("{name}, {transfer:?}: full light is {last:06x}"));
            }
        }
    }
    found
}

fn nonsense(effort: &Effort) -> Found {
    let mut found = Found::default();
    let (dark, bright) = (
        [0.0, -0.0, -1.0, -1e-45, f32::MIN, f32::NEG_INFINITY, f32::NAN, -f32::NAN],
        [1.0, 1f32.next_up(), 7.0, f32::MAX, f32::INFINITY],
    );
    let all: Vec<(f32, u32)> = dark.map(|c| (c, 0)).into_iter().chain(bright.map(|c| (c, 0xff_ffff))).collect();
    for transfer in [Transfer::Srgb, Transfer::Gamma22, Transfer::Linear] {
        for y in 0..effort.of(400) {
            for &(c, code) in &all {
                for (name, level) in levels() {
                    let (row, mut out) = ([c; 70], [7; 70]);
                    dispatch!(level, simd => encode(simd, transfer, 3, y, &row, &row, &row, &mut out));
                    found
                        .judge(out.iter().all(|p| *p == code), || format!("{name}, {transfer:?}, {c}: {:06x}", out[0]));
                }
                found.fail(quantize(transfer, c, 3, y, 1) != code & 255, || format!("{transfer:?}, {c}"));
            }
        }
    }
    found
}

fn dither(effort: &Effort) -> Found {
    const AREA: u32 = 256;
    let (mut found, mut random) = (Found::default(), Random(73));
    for _ in 0..effort.of(120) {
        let c = random.log(1e-4, 1.0) as f32;
        let (x0, y0) = ((random.unit() * 4000.0) as u32, (random.unit() * 4000.0) as u32);
        let row = [c; AREA as usize];
        for (name, level) in levels() {
            let mut sum = [0u64; 3];
            for y in y0..y0 + AREA {
                let mut out = [0; AREA as usize];
                dispatch!(level, simd => encode(simd, Transfer::Srgb, x0, y, &row, &row, &row, &mut out));
                for p in out {
                    [16, 8, 0].into_iter().zip(&mut sum).for_each(|(shift, sum)| *sum += u64::from(p >> shift & 255));
                }
            }
            for sum in sum {
                let mean = sum as f64 / (AREA * AREA) as f64;
                found.more((mean - 255.0 * srgb(c as f64)).abs(), || format!("{name}, {c}: {mean}"));
            }
        }
        found.inputs += u64::from(AREA * AREA);
    }
    found
}

/// The worst error of a function over arguments, divided by what is allowed of the truth.
fn function(function: Function, x: Vec<f32>, truth: impl Fn(f64) -> f64, allowed: impl Fn(f64) -> f64) -> Found {
    let error = worst(function, &x, truth, allowed);
    Found { inputs: x.len() as u64, worst: error, at: format!("{function:?}") }
}

/// So many arguments from `a` to `b`, a multiple of 16.
fn arguments(effort: &Effort, a: f64, b: f64) -> Vec<f32> {
    let n = effort.of(1 << 20).next_multiple_of(16);
    let step = |i: u32| (a + (b - a) * i as f64 / (n - 1) as f64) as f32;
    (0..n).map(step).collect()
}

fn exp2(effort: &Effort) -> Found {
    function(Function::Exp2, arguments(effort, -126.0, 127.0), f64::exp2, |y| y)
}

fn opacity(effort: &Effort) -> Found {
    let truth = |x: f64| -(x * std::f64::consts::LN_2).exp_m1();
    let thin = arguments(effort, -116.0, 0.0).into_iter().map(|x| -x.exp2()).collect();
    let of = |x| function(Function::Opacity, x, truth, |y| y.max(1e-37));
    of(thin).and(of(arguments(effort, -126.0, 0.0))).and(of(arguments(effort, -1.0, 0.0)))
}

fn log2(effort: &Effort) -> Found {
    let of = |x| function(Function::Log2, x, f64::log2, |y| (2e-7 * y.abs()).max(1.5e-7));
    let wide = arguments(effort, -125.9, 127.9).into_iter().map(|x| x.exp2()).collect();
    of(wide).and(of(arguments(effort, 0.5, 2.0))).and(of(arguments(effort, 0.99, 1.01)))
}

fn powf(effort: &Effort) -> Found {
    let wide: Vec<f32> = arguments(effort, -25.0, 20.0).into_iter().map(|x| x.exp2()).collect();
    let all = [1.0 / 2.2, 1.0 / 2.4, 2.0, 2.4, 5.0, 0.0, -0.5].map(|power: f32| {
        let truth = |x: f64| x.powf(power as f64);
        function(Function::Powf(power), wide.clone(), truth, |y| y * (4e-7 + 1e-7 * y.log2().abs()))
    });
    all.into_iter().fold(Found::default(), Found::and)
}

fn sine(effort: &Effort) -> Found {
    let of = |a: f64| function(Function::Sin, arguments(effort, -a, a), f64::sin, |_| 1.0);
    of(1000.0).and(of(4.0)).and(of(1e-3))
}
