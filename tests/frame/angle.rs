//! Sines, cosines, tangents and turns of single numbers: correctly rounded, also far from zero and beside the zeros.

use glam::{Mat3A, Vec3A};
use paprsek::angle::{sin, sin_cos, tan, turn_x, turn_y, turn_z};
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// An angle, and the bits of its sine and cosine, rounded from 200 binary digits (mpmath).
const ROUNDED: [(f32, u32, u32); 23] = [
    // Nearest to multiples of a right angle, so that one of both is all cancellation.
    (FRAC_PI_2, 0x3f80_0000, 0xb33b_bd2e),
    (PI, 0xb3bb_bd2e, 0xbf80_0000),
    (4.712_389, 0xbf80_0000, 0x324c_de2e),
    (TAU, 0x343b_bd2e, 0x3f80_0000),
    (7.853_981_5, 0x3f80_0000, 0x3415_5386),
    (10.995_574, 0xbf80_0000, 0xb49b_ba77),
    (157.079_64, 0x3645_5799, 0x3f80_0000),
    (1_572.367_1, 0x3f80_0000, 0x3871_fa51),
    (102_945.28, 0x3f7f_ffd0, 0xbb1c_07e1),
    (15_707_965.0, 0x3f7c_adc7, 0xbe24_68fe),
    // The same for all of f32: 16367173 * 2^72.
    (7.729_179e28, 0x3f80_0000, 0xb0dd_eea9),
    (1e-30, 0x0da2_4260, 0x3f80_0000),
    (1e-4, 0x38d1_b717, 0x3f80_0000),
    (0.41, 0x3ecc_1685, 0x3f6a_c86e),
    (0.5, 0x3ef5_7744, 0x3f60_a940),
    (FRAC_PI_4, 0x3f35_04f3, 0x3f35_04f3),
    (1.0, 0x3f57_6aa4, 0x3f0a_5140),
    (-1.0, 0xbf57_6aa4, 0x3f0a_5140),
    (2.5, 0x3f19_3578, 0xbf4d_17bf),
    (-47.0, 0xbdfd_13e8, 0xbf7e_09b3),
    (1e5, 0x3d12_6d55, 0xbf7f_d61c),
    (1e9, 0x3f0b_bc65, 0x3f56_7fc6),
    (3e38, 0x3f5f_f9c4, 0xbef7_f57c),
];

#[test]
fn sines_and_cosines_are_rounded_correctly() {
    for (x, s, c) in ROUNDED {
        assert_eq!(sin_cos(x), (f32::from_bits(s), f32::from_bits(c)), "{x}");
        assert_eq!(sin(x), f32::from_bits(s), "{x}");
    }
}

#[test]
fn tangents_are_off_by_two_units_at_most() {
    for (x, s, c) in ROUNDED {
        let truth = f64::from(f32::from_bits(s)) / f64::from(f32::from_bits(c));
        assert!((f64::from(tan(x)) / truth - 1.0).abs() < 2.0 * f64::from(f32::EPSILON), "{x}");
    }
    for k in 0..2000 {
        let x = k as f32 * 0.000_77;
        let truth = f64::from(x).tan();
        assert!((f64::from(tan(x)) - truth).abs() <= 2.0 * f64::from(f32::EPSILON) * truth, "{x}");
    }
}

#[test]
fn what_is_no_angle_gives_nan() {
    for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let (s, c) = sin_cos(x);
        assert!(s.is_nan() && c.is_nan() && tan(x).is_nan(), "{x}");
    }
}

#[test]
fn turns_lead_from_axis_to_axis() {
    for (turn, axis, from, to) in [
        (turn_x as fn(f32) -> Mat3A, Vec3A::X, Vec3A::Y, Vec3A::Z),
        (turn_y, Vec3A::Y, Vec3A::Z, Vec3A::X),
        (turn_z, Vec3A::Z, Vec3A::X, Vec3A::Y),
    ] {
        assert!((turn(FRAC_PI_2) * from).distance(to) < 1e-7);
        for x in [-7.0, -0.3, 0.0, 1e-3, 0.5, 2.0, 100.0] {
            assert_eq!(turn(x) * axis, axis);
            assert!((turn(x).determinant() - 1.0).abs() < 3e-7);
            assert!((turn(x) * turn(-x)).abs_diff_eq(Mat3A::IDENTITY, 3e-7));
            assert!(turn(x).abs_diff_eq(Mat3A::from_axis_angle(axis.into(), x), 3e-7));
        }
    }
}
