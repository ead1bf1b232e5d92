//! Transfer functions against published values and f64, the dither's mean, elementary functions against f64.

use fearless_simd::{Simd, dispatch, prelude::*};
use paprsek::frame::encode::{Transfer, encode, gamma22_encode, quantize, srgb_decode, srgb_encode};
use paprsek::simd::math;
use testkit::elementary::{Function, apply_all, range, worst};

/// The transfer functions, and how near a step of the code, in codes, the wide encoder may take the other side of it: the
/// error of its polynomials.
const STEP_MARGINS: [(Transfer, f64); 2] = [(Transfer::Gamma22, 8e-3), (Transfer::Srgb, 5e-4)];

/// Encodes a row at every level, asserts that all give the same, and answers with it.
fn encode_all(transfer: Transfer, x0: u32, y: u32, r: &[f32], g: &[f32], b: &[f32]) -> Vec<u32> {
    let mut first = None;
    for (name, level) in testkit::levels() {
        let mut out = vec![0xdead_beef; r.len()];
        dispatch!(level, simd => encode(simd, transfer, x0, y, r, g, b, &mut out));
        assert_eq!(first.get_or_insert_with(|| out.clone()), &out, "{name}");
    }
    first.unwrap()
}

/// Linear lights: log-uniform below 1, uniform, and everything else.
fn lights() -> Vec<f32> {
    let mut all: Vec<f32> = (0..50_000).map(|i| i as f32 / 50_000.0).collect();
    all.extend((0..50_000).map(|i| 10f32.powf(-i as f32 / 1200.0)));
    all.extend([0.0, -0.0, 1.0, -1.0, 2.0, 1e-45, -1e-45, f32::MAX, f32::MIN, 0.003_130_8, 1f32.next_down()]);
    all.extend([f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1f32.next_up(), 0.003_130_8f32.next_up()]);
    all
}

#[test]
fn srgb_agrees_with_published_values() {
    // Linear light of 8-bit codes, as tables of IEC 61966-2-1 give it to eight places.
    for (code, linear) in [(1, 0.00030353), (10, 0.00303527), (11, 0.00334654), (128, 0.21586050), (188, 0.50288646)] {
        // The table's last place, and the rounding of the code to f32, which the curve's slope multiplies by 2.4.
        assert!((srgb_decode(code as f32 / 255.0) - linear as f32).abs() < 5e-9 + 2e-7 * linear as f32, "{code}");
    }
    assert!((srgb_encode(0.5) - 0.735_357).abs() < 1e-7);
    assert!((srgb_encode(0.18) - 0.461_356_1).abs() < 1e-7);
    assert!((gamma22_encode(0.5) - 0.729_740_1).abs() < 1e-7);
    assert_eq!((srgb_encode(0.0), srgb_encode(1.0)), (0.0, 1.0));
    assert_eq!((srgb_decode(0.0), srgb_decode(1.0)), (0.0, 1.0));
}

#[test]
fn srgb_decoding_inverts_encoding() {
    for i in 0..=100_000 {
        let c = i as f32 / 100_000.0;
        // The standard's constants leave a step of 3e-8 between its two pieces.
        assert!((srgb_decode(srgb_encode(c)) - c).abs() < 2e-7, "{c}");
    }
}

#[test]
fn codes_rise_with_light() {
    let rising: Vec<f32> = (0..200_000).map(|i| i as f32 / 199_999.0).collect();
    assert!(rising.windows(2).all(|w| srgb_encode(w[0]) <= srgb_encode(w[1])));
    assert!(rising.windows(2).all(|w| gamma22_encode(w[0]) <= gamma22_encode(w[1])));
    let codes = encode_all(Transfer::Gamma22, 0, 0, &rising, &rising, &rising);
    assert!(codes.is_sorted());
    assert_eq!((codes[0], codes[199_999]), (0, 0xffffff));
    // With dither, at one pixel.
    for (x, y) in [(0, 0), (5, 9), (1279, 719)] {
        let at = |c: f32| encode_all(Transfer::Srgb, x, y, &[c], &[c], &[c])[0];
        let codes: Vec<u32> = (0..2000).map(|i| at(i as f32 / 1999.0)).collect();
        for shift in [0, 8, 16] {
            assert!(codes.windows(2).all(|w| w[0] >> shift & 255 <= w[1] >> shift & 255));
        }
    }
}

#[test]
fn black_white_and_nonsense_have_fixed_codes() {
    for transfer in [Transfer::Gamma22, Transfer::Srgb] {
        for y in 0..64 {
            for (c, code) in [
                (0.0, 0),
                (-0.0, 0),
                (-1.0, 0),
                (f32::NEG_INFINITY, 0),
                (f32::NAN, 0),
                (1.0, 0xffffff),
                (7.0, 0xffffff),
                (f32::MAX, 0xffffff),
                (f32::INFINITY, 0xffffff),
            ] {
                let row = [c; 1000];
                assert!(encode_all(transfer, 3, y, &row, &row, &row).iter().all(|&p| p == code), "{transfer:?} {c}");
                assert_eq!(quantize(transfer, c, 3, y, 1), code & 255);
            }
        }
    }
}

#[test]
fn the_wide_encoder_agrees_with_the_scalar() {
    let lights = lights();
    let n = lights.len();
    let turned = |by: usize| -> Vec<f32> { (0..n).map(|i| lights[(i + by) % n]).collect() };
    let (g, b) = (turned(1000), turned(77_777));
    for (transfer, margin) in STEP_MARGINS {
        let codes = encode_all(transfer, 11, 5, &lights, &g, &b);
        let mut excused = 0;
        for (i, code) in codes.iter().enumerate() {
            for (channel, c) in [lights[i], g[i], b[i]].into_iter().enumerate() {
                let wide = code >> (16 - 8 * channel) & 255;
                let at = |c: f32| quantize(transfer, c, 11 + i as u32, 5, channel as u32);
                if wide != at(c) {
                    // A relative change of light by this much moves a code that is not 0 by no less than the margin.
                    let change = (margin * 2.4 / srgb_or_gamma(transfer, c).max(0.45)) as f32;
                    assert!(at(c * (1.0 - change)) == wide || at(c * (1.0 + change)) == wide, "{transfer:?} {c:e}");
                    excused += 1;
                }
            }
        }
        // Twice the margin is the share of all light that lies so near a step.
        assert!((excused as f64) < 2.0 * margin * 3.0 * n as f64, "{transfer:?}: {excused} of {} codes", 3 * n);
    }
}

/// The code, 0 to 255, without rounding.
fn srgb_or_gamma(transfer: Transfer, c: f32) -> f64 {
    255.0 * if transfer == Transfer::Srgb { srgb_encode(c) } else { gamma22_encode(c) } as f64
}

#[test]
fn any_cut_of_a_row_encodes_alike() {
    let light: Vec<f32> = (0..100).map(|i| i as f32 / 99.0).collect();
    let whole = encode_all(Transfer::Srgb, 20, 30, &light, &light, &light);
    for from in [0, 1, 15, 16, 33] {
        for to in [from, from + 1, from + 15, from + 16, from + 17, 100] {
            let cut = &light[from..to];
            assert_eq!(encode_all(Transfer::Srgb, 20 + from as u32, 30, cut, cut, cut), whole[from..to]);
        }
    }
}

#[test]
fn dither_keeps_the_mean() {
    const AREA: u32 = 256;
    let mut worst = 0f64;
    for (i, &(x0, y0)) in [(0, 0), (1000, 500), (77, 3)].iter().cycle().take(120).enumerate() {
        let c = (i as f32 / 120.0).powi(3) + 1e-4;
        let row = [c; AREA as usize];
        let level = fearless_simd::Level::new();
        let mut sum = [0u64; 3];
        for y in y0..y0 + AREA {
            let mut out = [0; AREA as usize];
            dispatch!(level, simd => encode(simd, Transfer::Srgb, x0, y, &row, &row, &row, &mut out));
            for p in out {
                sum[0] += p as u64 >> 16;
                sum[1] += p as u64 >> 8 & 255;
                sum[2] += p as u64 & 255;
            }
        }
        for sum in sum {
            let mean = sum as f64 / (AREA * AREA) as f64;
            worst = worst.max((mean - 255.0 * srgb_encode(c) as f64).abs());
        }
    }
    assert!(worst < 1e-3, "{worst} codes");
}

#[test]
fn exp2_is_accurate() {
    let error = worst(Function::Exp2, &range(-126.0, 127.0), f64::exp2, |y| y);
    assert!(error < 2e-7, "{error:e}");
    let whole: Vec<f32> = (-126..=127).map(|i| i as f32).chain([0.0, 0.0]).collect();
    assert_eq!(worst(Function::Exp2, &whole, f64::exp2, |y| y), 0.0);
}

/// `1 - 2^x` is 0 for all x above -4e-8, and its last digits are noise for long before.
#[test]
fn opacity_is_accurate_however_thin() {
    let truth = |x: f64| -(x * std::f64::consts::LN_2).exp_m1();
    let thin: Vec<f32> = range(-116.0, 0.0).iter().map(|x| -x.exp2()).collect();
    for x in [thin, range(-126.0, 0.0), range(-1.0, 0.0)] {
        let error = worst(Function::Opacity, &x, truth, |y| y.max(1e-37));
        println!("opacity: off by {error:.1e} of it");
        assert!(error < 2e-7, "{error:e}");
    }
    // What comes through is what it was: 2^x itself.
    let x = range(-126.0, 0.0);
    let exact = apply_all(Function::Exp2, &x);
    for (name, level) in testkit::levels() {
        let same = dispatch!(level, simd => left(simd, &x, &exact));
        assert!(same, "{name}");
    }
}

/// Whether what [`math::opacity`] leaves is what it should, bit for bit.
#[inline(always)]
fn left<S: Simd>(simd: S, x: &[f32], exact: &[f32]) -> bool {
    let pairs = x.chunks_exact(S::f32s::LEN).zip(exact.chunks_exact(S::f32s::LEN));
    pairs.into_iter().all(|(x, exact)| {
        let left = math::opacity(simd, S::f32s::from_slice(simd, x))[1];
        left.simd_eq(S::f32s::from_slice(simd, exact)).all_true()
    })
}

#[test]
fn log2_is_accurate() {
    let wide: Vec<f32> = range(-125.9, 127.9).iter().map(|x| x.exp2()).collect();
    for x in [wide, range(0.5, 2.0), range(0.99, 1.01)] {
        let error = worst(Function::Log2, &x, f64::log2, |y| (2e-7 * y.abs()).max(1.5e-7));
        assert!(error < 1.0, "{error}");
    }
    assert_eq!(apply_all(Function::Log2, &[1.0; 16]), [0.0; 16]);
}

#[test]
fn powf_is_accurate() {
    // No result leaves the normal numbers.
    let wide: Vec<f32> = range(-25.0, 20.0).iter().map(|x| x.exp2()).collect();
    for power in [1.0 / 2.2, 1.0 / 2.4, 2.0, 2.4, 5.0, 0.0, -0.5] {
        for x in [&wide, &range(1e-4, 1.0)] {
            let truth = |x: f64| x.powf(power as f64);
            let error = worst(Function::Powf(power), x, truth, |y| y * (4e-7 + 1e-7 * y.log2().abs()));
            assert!(error < 1.0, "{power}: {error}");
        }
    }
    // Zero, and all that is less than a normal number, counts as the least one.
    let tiny = apply_all(Function::Powf(1.0), &[0.0, 1e-45, -1.0, f32::NEG_INFINITY].repeat(4));
    assert!(tiny.iter().all(|v| (v / f32::MIN_POSITIVE - 1.0).abs() < 2e-5));
}

#[test]
fn sin_is_accurate() {
    for x in [range(-1000.0, 1000.0), range(-4.0, 4.0), range(-1e-3, 1e-3)] {
        let error = worst(Function::Sin, &x, f64::sin, |_| 1.0);
        assert!(error < 2e-7, "{error:e}");
    }
}
