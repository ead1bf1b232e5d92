//! A picture beside the truth, their difference amplified, and its FLIP map.

use crate::metrics::flip_map;
use crate::picture::rgb;
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};
use paprsek::frame::Frame;

/// How many times the difference is amplified.
pub const GAIN: i32 = 8;
/// Width of a panel, and the gap beside it, pixels.
const PANEL: u32 = 320;
const GAP: u32 = 4;

/// Four panels in a row: the picture, the truth, the difference around grey, and the FLIP map.
pub fn sheet(picture: &Frame, truth: &Frame) -> RgbImage {
    let (ours, exact) = (rgb(picture), rgb(truth));
    let mut difference = RgbImage::new(ours.width(), ours.height());
    for ((to, a), b) in difference.pixels_mut().zip(ours.pixels()).zip(exact.pixels()) {
        *to = Rgb([0, 1, 2].map(|k| (128 + GAIN * (i32::from(a[k]) - i32::from(b[k]))).clamp(0, 255) as u8));
    }
    let height = (PANEL * ours.height()).div_ceil(ours.width());
    let panels = [ours, exact, difference, flip_map(picture, truth)];
    let mut sheet = RgbImage::from_pixel(panels.len() as u32 * (PANEL + GAP) - GAP, height, Rgb([128; 3]));
    for (number, panel) in (0..).zip(&panels) {
        let small = imageops::resize(panel, PANEL, height, FilterType::Triangle);
        imageops::replace(&mut sheet, &small, i64::from(number * (PANEL + GAP)), 0);
    }
    sheet
}
