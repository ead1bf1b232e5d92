//! FLIP `[Andersson20]`: the difference that a viewer sees who flips between two pictures, 0 for none to 1.
//!
//! ```text
//! codes -> light -> YCxCz -> blurred as contrast sensitivity has it -> CIELAB, Hunt's effect -> colour difference
//!                   Y -> edges and points of both pictures -> feature difference
//! colour difference ^ (1 - feature difference)
//! ```
//!
//! For pictures of 8-bit sRGB codes. Filters are separable; the blue-yellow one is the sum of two that are.
//!
//! P. Andersson et al., "FLIP: A Difference Evaluator for Alternating Images", 2020, whose names and constants these are.

use crate::metrics::channels;
use glam::{DMat3, DVec2, DVec3, Mat3, Vec3, dvec2, dvec3};
use paprsek::frame::Frame;
use std::f64::consts::PI;

/// Pixels per degree of a viewer 0.7 m before a display of 3840 pixels on 0.7 m, about.
pub const PIXELS_PER_DEGREE: f64 = 67.0;

/// Chromaticities of the primaries of sRGB, and of its white, D65 `[sRGB]`.
const PRIMARIES: [DVec2; 3] = [dvec2(0.64, 0.33), dvec2(0.30, 0.60), dvec2(0.15, 0.06)];
const WHITE: DVec2 = dvec2(0.3127, 0.3290);
/// Contrast sensitivity to lightness, red-green and blue-yellow: `a1`, `b1`, `a2`, `b2` of a sum of two Gaussians.
const SENSITIVITY: [[f64; 4]; 3] = [[1.0, 0.0047, 0.0, 1e-5], [1.0, 0.0053, 0.0, 1e-5], [34.1, 0.04, 13.5, 0.025]];
/// Exponent of colour differences, `qc`.
const COLOUR: f32 = 0.7;
/// The share of the largest colour difference, `pc`, that is mapped to the share `pt` of the scale.
const KNEE: [f32; 2] = [0.4, 0.95];
/// Width of the feature detectors, degrees, and exponent of feature differences: `w` and `qf`.
const FEATURE: f64 = 0.082;
const FEATURES: f32 = 0.5;

/// FLIP of every pixel, row by row, at [`PIXELS_PER_DEGREE`]. The pictures have the same size; which of them is the truth
/// makes no difference.
pub fn flip(picture: &Frame, truth: &Frame) -> Vec<f32> {
    assert_eq!((picture.width, picture.height), (truth.width, truth.height), "pictures of different sizes");
    let space = Space::new();
    let [a, b] = [picture, truth].map(|frame| Seen::new(&space, frame));
    let most = distance(space.colour(Vec3::Y), space.colour(Vec3::Z)).powf(COLOUR);
    let difference = |at: usize| {
        let colour = redistributed(distance(a.colours[at], b.colours[at]).powf(COLOUR), most);
        let gap = |k: usize| (a.features[k][at] - b.features[k][at]).abs();
        colour.powf(1.0 - (gap(0).max(gap(1)) * 0.5f32.sqrt()).powf(FEATURES))
    };
    (0..picture.pixels.len()).map(difference).collect()
}

/// The mean of a picture's FLIP over its pixels.
pub fn mean(flip: &[f32]) -> f64 {
    flip.iter().copied().map(f64::from).sum::<f64>() / flip.len().max(1) as f64
}

/// A colour difference on the scale from 0 to 1: most of the scale is for the smaller ones.
fn redistributed(difference: f32, most: f32) -> f32 {
    let [pc, pt] = KNEE;
    let knee = pc * most;
    if difference < knee { difference * pt / knee } else { pt + (difference - knee) / (most - knee) * (1.0 - pt) }
}

/// The HyAB distance of two colours: city blocks of lightness, Euclid's of the rest.
fn distance(a: Vec3, b: Vec3) -> f32 {
    (a.x - b.x).abs() + (a.y - b.y).hypot(a.z - b.z)
}

/// From light in sRGB's primaries to XYZ as shares of white, and back.
struct Space {
    to: Mat3,
    back: Mat3,
    /// Light of each 8-bit code.
    light: [f32; 256],
}

impl Space {
    fn new() -> Space {
        let xyz = |at: DVec2| dvec3(at.x, at.y, 1.0 - at.x - at.y) / at.y;
        let [red, green, blue] = PRIMARIES.map(xyz);
        let primaries = DMat3::from_cols(red, green, blue);
        let amounts = primaries.inverse() * xyz(WHITE);
        let to = DMat3::from_diagonal(DVec3::ONE / xyz(WHITE)) * primaries * DMat3::from_diagonal(amounts);
        let light = |code: usize| {
            let code = code as f64 / 255.0;
            if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
        };
        Space { to: to.as_mat3(), back: to.inverse().as_mat3(), light: std::array::from_fn(|code| light(code) as f32) }
    }

    /// CIELAB of light, less colourful where it is dark, as Hunt found.
    fn colour(&self, light: Vec3) -> Vec3 {
        const DELTA: f32 = 6.0 / 29.0;
        let root = |share: f32| {
            if share > DELTA.powi(3) { share.cbrt() } else { share / (3.0 * DELTA * DELTA) + 4.0 / 29.0 }
        };
        let lab = opponent((self.to * light).map(root));
        Vec3::new(lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z)
    }
}

/// Lightness, red against green and blue against yellow of XYZ: CIELAB of roots, YCxCz of shares.
fn opponent(xyz: Vec3) -> Vec3 {
    Vec3::new(116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z))
}

/// XYZ of YCxCz.
fn shares(seen: Vec3) -> Vec3 {
    let y = (seen.x + 16.0) / 116.0;
    Vec3::new(y + seen.y / 500.0, y, y - seen.z / 200.0)
}

/// What a viewer sees of a picture, per pixel.
struct Seen {
    /// Colours as [`Space::colour`] has them.
    colours: Vec<Vec3>,
    /// How much of an edge there is, and how much of a point.
    features: [Vec<f32>; 2],
}

impl Seen {
    fn new(space: &Space, frame: &Frame) -> Seen {
        let light = |pixel: &u32| Vec3::from_array(channels(*pixel).map(|code| space.light[code as usize]));
        let seen: Vec<Vec3> = frame.pixels.iter().map(|pixel| opponent(space.to * light(pixel))).collect();
        let planes = [0, 1, 2]
            .map(|k| Plane { width: frame.width, numbers: seen.iter().map(|seen| seen[k]).collect::<Vec<f32>>() });
        let blurred = [0, 1, 2].map(|k| planes[k].blurred(&SENSITIVITY[k]));
        let colours = (0..seen.len()).map(|at| {
            let light = space.back * shares(Vec3::new(blurred[0][at], blurred[1][at], blurred[2][at]));
            space.colour(light.clamp(Vec3::ZERO, Vec3::ONE))
        });
        let lightness = planes[0].numbers.iter().map(|y| (y + 16.0) / 116.0).collect();
        let features = Plane { width: frame.width, numbers: lightness }.features();
        Seen { colours: colours.collect(), features }
    }
}

/// A number per pixel.
struct Plane {
    width: usize,
    numbers: Vec<f32>,
}

impl Plane {
    /// The plane as contrast sensitivity lets it through.
    fn blurred(&self, sensitivity: &[f64; 4]) -> Vec<f32> {
        let [a1, b1, a2, b2] = *sensitivity;
        // All filters reach as far as the widest one.
        let widest = SENSITIVITY.iter().flat_map(|row| [row[1], row[3]]).fold(0.0, f64::max);
        let reach = (3.0 * (widest / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as i32;
        let gaussian = |a: f64, b: f64| -> Vec<f64> {
            let at = |x: i32| (f64::from(x) / PIXELS_PER_DEGREE).powi(2);
            (-reach..=reach).map(|x| (a * (PI / b).sqrt()).sqrt() * (-PI * PI * at(x) / b).exp()).collect()
        };
        let parts = [gaussian(a1, b1), gaussian(a2, b2)];
        let all: f64 = parts.iter().map(|part| part.iter().sum::<f64>().powi(2)).sum();
        let mut sum = vec![0.0; self.numbers.len()];
        for part in parts.iter().filter(|part| part.iter().any(|weight| *weight > 0.0)) {
            let weights: Vec<f32> = part.iter().map(|weight| (weight / all.sqrt()) as f32).collect();
            sum.iter_mut().zip(self.filtered(&weights, &weights)).for_each(|(sum, part)| *sum += part);
        }
        sum
    }

    /// Edges and points: lengths of the first and of the second derivatives of a blurred plane.
    fn features(&self) -> [Vec<f32>; 2] {
        let deviation = 0.5 * FEATURE * PIXELS_PER_DEGREE;
        let reach = (3.0 * deviation).ceil() as i32;
        let gaussian = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
        let weights = |weight: &dyn Fn(f64) -> f64| -> Vec<f32> {
            let weights: Vec<f64> = (-reach..=reach).map(|x| weight(f64::from(x))).collect();
            // What is above 0 adds up to 1, and what is below to -1.
            let above: f64 = weights.iter().map(|weight| weight.max(0.0)).sum();
            let below: f64 = weights.iter().map(|weight| -weight.min(0.0)).sum();
            weights
                .iter()
                .map(|weight| (weight / if *weight > 0.0 { above } else { below.max(1e-300) }) as f32)
                .collect()
        };
        let blur = weights(&gaussian);
        let edge = weights(&|x| -x * gaussian(x));
        let point = weights(&|x| ((x / deviation).powi(2) - 1.0) * gaussian(x));
        [edge, point].map(|detector| {
            let (across, down) = (self.filtered(&detector, &blur), self.filtered(&blur, &detector));
            across.iter().zip(&down).map(|(across, down)| across.hypot(*down)).collect()
        })
    }

    /// The plane filtered along its rows and then along its columns by weights around the middle ones. Beyond its border
    /// it goes on as it ends.
    fn filtered(&self, across: &[f32], down: &[f32]) -> Vec<f32> {
        let (width, height) = (self.width, self.numbers.len() / self.width);
        let within = |at: usize, reach: usize, count: usize| at.saturating_sub(reach).min(count - 1);
        let reach = across.len() / 2;
        let mut rows = vec![0.0; self.numbers.len()];
        let mut wide = vec![0.0; width + 2 * reach];
        for (row, out) in self.numbers.chunks_exact(width).zip(rows.chunks_exact_mut(width)) {
            for (at, number) in wide.iter_mut().enumerate() {
                *number = row[within(at, reach, width)];
            }
            for (shift, weight) in across.iter().enumerate() {
                out.iter_mut().zip(&wide[shift..]).for_each(|(out, number)| *out += weight * number);
            }
        }
        let reach = down.len() / 2;
        let mut filtered = vec![0.0; rows.len()];
        for (y, out) in filtered.chunks_exact_mut(width).enumerate() {
            for (shift, weight) in down.iter().enumerate() {
                let row = &rows[within(y + shift, reach, height) * width..][..width];
                out.iter_mut().zip(row).for_each(|(out, number)| *out += weight * number);
            }
        }
        filtered
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plain(pixel: u32, count: usize) -> Frame {
        Frame { width: count, height: count, pixels: vec![pixel; count * count] }
    }

    /// CIELAB of sRGB's green and blue, and of white, as tables have them.
    const GREEN: [f64; 3] = [87.737, -86.184, 83.181];
    const BLUE: [f64; 3] = [32.303, 79.197, -107.864];

    /// Pictures of one colour have no features: their FLIP is the colours' difference on its scale.
    #[test]
    fn plain_pictures_differ_by_their_colours() {
        let hunt = |[l, a, b]: [f64; 3]| [l, 0.01 * l * a, 0.01 * l * b];
        let hyab = |a: [f64; 3], b: [f64; 3]| (a[0] - b[0]).abs() + (a[1] - b[1]).hypot(a[2] - b[2]);
        let most = hyab(hunt(GREEN), hunt(BLUE)).powf(0.7);
        let scale = |difference: f64| {
            let (difference, knee) = (difference.powf(0.7), 0.4 * most);
            if difference < knee { difference / knee * 0.95 } else { 0.95 + (difference - knee) / (most - knee) * 0.05 }
        };
        // Lightness of code 119: 116 (light)^(1/3) - 16 of light ((119 / 255 + 0.055) / 1.055)^2.4.
        let grey = 116.0 * ((119.0 / 255.0 + 0.055) / 1.055f64).powf(2.4 / 3.0) - 16.0;
        let cases = [
            (0x00_ff00, 0x00_00ff, 1.0),
            (0x00_0000, 0xff_ffff, scale(100.0)),
            (0x00_0000, 0x77_7777, scale(grey)),
            (0xff_ffff, 0x00_ff00, scale(hyab([100.0, 0.0, 0.0], hunt(GREEN)))),
        ];
        for (a, b, truth) in cases {
            let found = flip(&plain(a, 30), &plain(b, 30));
            assert!(
                found.iter().all(|found| (f64::from(*found) - truth).abs() < 2e-4),
                "{a:x} {b:x}: {} {truth}",
                found[0]
            );
        }
    }

    #[test]
    fn equal_pictures_differ_nowhere_and_a_dot_where_it_is() {
        let (plain, mut dotted) = (plain(0x80_8080, 61), plain(0x80_8080, 61));
        assert_eq!(mean(&flip(&plain, &plain)), 0.0);
        dotted.pixels[30 * 61 + 30] = 0xff_ffff;
        let found = flip(&dotted, &plain);
        assert_eq!(found, flip(&plain, &dotted));
        let most = found.iter().copied().fold(0.0, f32::max);
        assert!(found[30 * 61 + 30] == most && most > 0.1, "{most}");
        // Filters reach ten pixels.
        assert!((0..61 * 61).all(|at| found[at] == 0.0 || (at % 61).abs_diff(30).max((at / 61).abs_diff(30)) <= 10));
    }
}
