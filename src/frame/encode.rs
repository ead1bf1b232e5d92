//! From linear light to the 8-bit codes of a screen's pixels.
//!
//! A transfer function turns light into a code, which is rounded, or for sRGB truncated after a dither has been added:
//! a dither turns the bands of a smooth gradient into a pattern too fine to be seen.
//!
//! [`encode`] is what a frame uses, 64 pixels at a time. The reference beside it is [`quantize`], one channel of one
//! pixel in f64.

use crate::simd::block::{BLOCK, load, store};
use fearless_simd::{Simd, prelude::*};
use fearless_simd_macros::simd;

/// How linear light becomes an 8-bit code. Light is clamped to 0..1 first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transfer {
    /// `round(255 c^(1/2.2))`, no dither: what most bench scenes specify.
    Gamma22,
    /// `round(255 c)`, no dither: for the bench scenes that specify sums of display light instead of linear light.
    Linear,
    /// The piecewise sRGB curve with an unbiased dither.
    Srgb,
}

/// The sRGB code, 0 to 1, of linear light (IEC 61966-2-1). Light is clamped to 0..1; NaN is 0.
pub fn srgb_encode(linear: f32) -> f32 {
    let c = clamp(linear);
    (if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }) as f32
}

/// The linear light, 0 to 1, of an sRGB code (IEC 61966-2-1). Codes are clamped to 0..1; NaN is 0.
pub fn srgb_decode(code: f32) -> f32 {
    let v = clamp(code);
    (if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }) as f32
}

/// The code, 0 to 1, of linear light on a screen of gamma 2.2: `linear^(1/2.2)`. Light is clamped to 0..1; NaN is 0.
pub fn gamma22_encode(linear: f32) -> f32 {
    clamp(linear).powf(1.0 / 2.2) as f32
}

/// `x` clamped to 0..1; NaN is 0.
fn clamp(x: f32) -> f64 {
    if x > 0.0 { x.min(1.0) as f64 } else { 0.0 }
}

/// The code, 0 to 255, of one channel (0 red, 1 green, 2 blue) of the pixel at column `x` and row `y`.
///
/// No light is always 0 and full light always 255. Light is clamped to 0..1; NaN is 0.
pub fn quantize(transfer: Transfer, linear: f32, x: u32, y: u32, channel: u32) -> u32 {
    let (value, threshold) = match transfer {
        Transfer::Gamma22 => (gamma22_encode(linear), 0.5),
        Transfer::Linear => (clamp(linear) as f32, 0.5),
        Transfer::Srgb => (srgb_encode(linear), dither(x, y, channel)),
    };
    (255.0 * value as f64 + threshold as f64) as u32
}

/// Steps of the dither along x and y, in units of 2^-32: the inverse of the plastic number and its square, rounded to
/// odd numbers, so that every value comes before one comes again.
const STEP_X: u32 = 0xC13F_A9A9;
const STEP_Y: u32 = 0x91E1_0DA5;
/// Step of the dither from red to green to blue, in units of 2^-32: a third, so that the three seldom round up
/// together.
const STEP_CHANNEL: u32 = 0x5555_5555;

/// The dither, 0 to 1 - 2^-16, that is added to a code before it is truncated.
///
/// It is the R2 sequence `[Roberts18]` laid out over the picture: neighbours differ, and every area has all values
/// equally often, so the mean of its codes is the light itself. It has 16 bits, so that 255 and a dither stay below 256
/// in f32.
fn dither(x: u32, y: u32, channel: u32) -> f32 {
    let turns = x.wrapping_mul(STEP_X).wrapping_add(y.wrapping_mul(STEP_Y));
    let turns = turns.wrapping_add(channel.wrapping_mul(STEP_CHANNEL));
    (turns >> 16) as f32 * (1.0 / 65536.0)
}

/// A transfer function times 255: a polynomial of the fourth root of light, but `toe c` up to `toe_end`; and what is added
/// to it.
///
/// Every transfer function is one of these, so that the code is there once and the loop has no branch. In the fourth root
/// powers of 5/12 and 1/2.2 are nearly cubic, so that few coefficients do; in the square root they would need twice as
/// many. The coefficients are minimax (Remez' exchange in 30 digits) with 255 at full light.
struct Curve {
    /// Coefficients from the constant on.
    power: [f32; 7],
    toe: f32,
    toe_end: f32,
    /// Added before truncation.
    round: f32,
    /// Factor of the dither, 0 to 2^16 - 1, that is added before truncation.
    dither: f32,
}

/// Off by at most 7.2e-3 codes from code 0.49 on; darker light is rounded to 0.
const GAMMA22: Curve = Curve {
    power: [-0.107_161_75, 7.667_427_6, 341.613_2, -220.450_6, 237.613_04, -152.041_88, 40.705_974],
    toe: 0.0,
    toe_end: 0.0,
    round: 0.5,
    dither: 0.0,
};
/// 255 times light, exactly.
const LINEAR: Curve = Curve { power: [0.0, 0.0, 0.0, 0.0, 255.0, 0.0, 0.0], ..GAMMA22 };
/// Off by at most 4e-4 codes.
const SRGB: Curve = Curve {
    power: [-15.195_41, 35.742_47, 347.570_9, -215.572_15, 164.873_29, -79.256_3, 16.837_21],
    toe: 255.0 * 12.92,
    toe_end: 0.003_130_8,
    round: 0.0,
    dither: 1.0 / 65536.0,
};

/// Encodes a row of linear light, from the pixel at column `x0` and row `y` on, to `0x00RRGGBB`.
///
/// Every channel is what [`quantize`] gives, except that light within 5e-4 codes of the step between two codes (sRGB) or
/// 8e-3 (gamma 2.2) may get either. The bits are the same at every SIMD level. Panics where a channel is shorter than `out`.
#[simd]
#[allow(clippy::too_many_arguments)] // Three channels and where they lie.
pub fn encode<S: Simd>(simd: S, transfer: Transfer, x0: u32, y: u32, r: &[f32], g: &[f32], b: &[f32], out: &mut [u32]) {
    let curve = match transfer {
        Transfer::Gamma22 => &GAMMA22,
        Transfer::Linear => &LINEAR,
        Transfer::Srgb => &SRGB,
    };
    let mut turns = x0.wrapping_mul(STEP_X).wrapping_add(y.wrapping_mul(STEP_Y));
    let mut done = 0;
    while done < out.len() {
        let end = out.len();
        let (r, g, b, out) = (&r[done..end], &g[done..end], &b[done..end], &mut out[done..]);
        if let (Some(r), Some(g), Some(b), Some(out)) =
            (r.first_chunk(), g.first_chunk(), b.first_chunk(), out.first_chunk_mut())
        {
            encode_block(simd, curve, turns, [r, g, b], out);
        } else {
            let (mut rest, mut pixels) = ([[0.0; BLOCK]; 3], [0; BLOCK]);
            for (block, plane) in rest.iter_mut().zip([r, g, b]) {
                block[..plane.len()].copy_from_slice(plane);
            }
            encode_block(simd, curve, turns, [&rest[0], &rest[1], &rest[2]], &mut pixels);
            out.copy_from_slice(&pixels[..out.len()]);
        }
        turns = turns.wrapping_add(STEP_X.wrapping_mul(BLOCK as u32));
        done += BLOCK;
    }
}

/// Encodes a block of red, green and blue; `turns` is the dither of its first pixel, in units of 2^-32.
#[simd]
fn encode_block<S: Simd>(simd: S, curve: &Curve, turns: u32, light: [&[f32; BLOCK]; 3], pixels: &mut [u32; BLOCK]) {
    // The dither of the first vector's pixels; that of the next vector is a step of as many pixels on.
    let mut lanes = [turns; 16];
    for (x, lane) in (0u32..).zip(&mut lanes) {
        *lane = turns.wrapping_add(STEP_X.wrapping_mul(x));
    }
    let mut along = S::u32s::from_slice(simd, &lanes[..S::u32s::LEN]);
    let mut i = 0;
    while i < BLOCK / S::f32s::LEN {
        let mut turns = along;
        let mut pixel = S::u32s::splat(simd, 0);
        // Unrolled, the channels are three chains of operations that need not wait for each other.
        for plane in light {
            let c = limit(simd, load(simd, plane, i));
            pixel = (pixel << 8) | code::<S>(curve, c, turns);
            turns += STEP_CHANNEL;
        }
        store(pixel, pixels, i);
        along += STEP_X.wrapping_mul(S::u32s::LEN as u32);
        i += 1;
    }
}

/// Linear light clamped to 0..1; NaN is 0.
#[inline(always)]
fn limit<S: Simd>(simd: S, linear: S::f32s) -> S::f32s {
    // A comparison, since the maximum of a NaN and a number is not the same on every machine.
    let black = S::f32s::splat(simd, 0.0);
    linear.simd_gt(black).select(linear, black).min(S::f32s::splat(simd, 1.0))
}

/// The codes of one channel of linear light `c`, 0 to 1.
#[inline(always)]
fn code<S: Simd>(curve: &Curve, c: S::f32s, turns: S::u32s) -> S::u32s {
    let dither = (turns >> 16).bitcast::<S::i32s>().to_float::<S::f32s>() * curve.dither + curve.round;
    (value::<S>(curve, c) + dither).to_int::<S::i32s>().bitcast()
}

/// The curve at linear light `c`, 0 to 1.
#[inline(always)]
fn value<S: Simd>(curve: &Curve, c: S::f32s) -> S::f32s {
    let root = c.sqrt();
    let fourth = root.sqrt();
    let p = &curve.power;
    // Terms in pairs, whose factors are at hand: in a chain each would wait for the last one's result.
    let low = (fourth * p[1] + p[0]) + root * (fourth * p[3] + p[2]);
    let power = low + c * ((fourth * p[5] + p[4]) + root * p[6]);
    c.simd_le(curve.toe_end).select(c * curve.toe, power)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    /// Values of a curve at every `step`th float from `low` to 1, with the light that each is of.
    fn values(curve: &Curve, low: f32, step: usize) -> Vec<(f32, f32)> {
        let all: Vec<f32> = (low.to_bits()..=1f32.to_bits()).step_by(step).map(f32::from_bits).collect();
        let mut values = Vec::new();
        for chunk in all.chunks(16) {
            let mut lanes = [1.0; 16];
            lanes[..chunk.len()].copy_from_slice(chunk);
            dispatch!(Level::new(), simd => through(simd, curve, &mut lanes));
            values.extend(chunk.iter().copied().zip(lanes));
        }
        values
    }

    #[inline(always)]
    fn through<S: Simd>(simd: S, curve: &Curve, lanes: &mut [f32; 16]) {
        for chunk in lanes.chunks_exact_mut(S::f32s::LEN) {
            value::<S>(curve, S::f32s::from_slice(simd, chunk)).store_slice(chunk);
        }
    }

    #[test]
    fn curves_are_off_by_less_than_they_say() {
        let srgb = |c: f64| if c <= 0.003_130_8 { 12.92 * c } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
        let gamma = |c: f64| c.powf(1.0 / 2.2);
        // From code 0.49 on; the second is the limit of what rounds to 0.
        for (curve, exact, low, most) in
            [(&SRGB, &srgb as &dyn Fn(f64) -> f64, 1e-30, 4.2e-4), (&GAMMA22, &gamma, 1.06e-6, 7.3e-3)]
        {
            let values = values(curve, low, 97);
            let worst = values.iter().map(|&(c, v)| (v as f64 - 255.0 * exact(c as f64)).abs()).fold(0.0, f64::max);
            assert!(worst < most, "{worst}");
        }
        let dark = values(&GAMMA22, 0.0, 9973);
        assert!(dark.iter().all(|&(c, v)| c > 1.06e-6 || v.abs() < 0.5));
    }

    #[test]
    fn only_full_light_is_full() {
        // More than 255 and the largest dither would be 256.
        let values = values(&SRGB, 0.99, 1);
        assert!(values.iter().all(|&(_, v)| v <= 255.0));
        assert_eq!(values.last(), Some(&(1.0, 255.0)));
    }
}
