//! Frames at the size of a window, for windows that do not scale by themselves.
//!
//! Bilinear, in whole numbers: a pixel of the window is a mix of the four pixels of the frame that are nearest to its
//! middle. The channels of a pixel are mixed at once, in the fields of a `u64`.

use crate::frame::Frame;
use std::ops::Range;

/// Columns and rows of the largest picture with the aspect of `frame` that fits into a window of `width` x `height`
/// pixels.
///
/// Each is at least 1. Panics where the frame has no pixels.
pub fn fit(frame: &Frame, (width, height): (usize, usize)) -> (usize, usize) {
    let columns = (height * frame.width / frame.height).min(width).max(1);
    (columns, (width * frame.height / frame.width).min(height).max(1))
}

/// Some `rows` of the frame scaled to `columns` x `count` pixels: four bytes per pixel, blue, green, red and 0.
///
/// Panics where the frame, `columns` or `count` is 0, or where `rows` go beyond `count`.
pub fn rows(frame: &Frame, columns: usize, count: usize, rows: Range<usize>) -> Vec<u8> {
    let (across, down) = ((frame.width << 16) / columns, (frame.height << 16) / count);
    let mut bytes = vec![0; 4 * columns * rows.len()];
    let (pixels, _) = bytes.as_chunks_mut();
    if (columns, count) == (frame.width, frame.height) {
        for (place, pixel) in pixels.iter_mut().zip(&frame.pixels[rows.start * columns..rows.end * columns]) {
            *place = pixel.to_le_bytes();
        }
        return bytes;
    }
    // A row between two of the frame's.
    let mut between = vec![0; frame.width];
    for (row, line) in rows.zip(pixels.chunks_exact_mut(columns)) {
        let (upper, lower, below) = tap(row, down, frame.height);
        let (upper, lower) = (&frame.pixels[upper * frame.width..], &frame.pixels[lower * frame.width..]);
        for column in 0..frame.width {
            between[column] = mix(spread(upper[column]), spread(lower[column]), below);
        }
        for (column, place) in line.iter_mut().enumerate() {
            let (left, right, beyond) = tap(column, across, frame.width);
            let pixel = mix(between[left], between[right], beyond);
            *place = ((pixel | pixel >> 24) as u32).to_le_bytes();
        }
    }
    bytes
}

/// The two of `from` pixels between whose middles the middle of pixel `number` lies, and its way from the first to the
/// second in 256ths. A pixel is `width` 65536ths as wide as those.
fn tap(number: usize, width: usize, from: usize) -> (usize, usize, u64) {
    let place = (number * width + width / 2).saturating_sub(1 << 15);
    let first = place >> 16;
    (first, (first + 1).min(from - 1), (place >> 8) as u64 & 255)
}

/// The fields of the channels, each with room for a product with a share: from low to high blue, red, green.
const CHANNELS: u64 = 0xff_00ff_00ff;

/// A pixel as these fields: its green is moved above the others.
fn spread(pixel: u32) -> u64 {
    (u64::from(pixel) | u64::from(pixel) << 24) & CHANNELS
}

/// A mix of two pixels' fields, at `share` 256ths of the way from `a` to `b`.
fn mix(a: u64, b: u64, share: u64) -> u64 {
    // Fields may borrow from each other on the way to the sum, which is right again.
    (a << 8).wrapping_add(b.wrapping_sub(a).wrapping_mul(share)) >> 8 & CHANNELS
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: usize, height: usize) -> Frame {
        let pixels = (0..width * height).map(|i| (i as u32).wrapping_mul(0x9e3779b1) & 0xffffff).collect();
        Frame { width, height, pixels }
    }

    fn scaled(frame: &Frame, columns: usize, count: usize) -> Vec<u32> {
        let bytes = rows(frame, columns, count, 0..count);
        bytes.as_chunks().0.iter().map(|pixel| u32::from_le_bytes(*pixel)).collect()
    }

    #[test]
    fn the_same_size_is_the_same_picture() {
        for (width, height) in [(1, 1), (7, 3), (320, 180)] {
            let frame = frame(width, height);
            assert_eq!(scaled(&frame, width, height), frame.pixels);
        }
    }

    #[test]
    fn bands_are_the_whole() {
        let frame = frame(16, 9);
        let bands: Vec<_> = [0..5, 5..6, 6..40].map(|band| rows(&frame, 50, 40, band)).concat();
        assert_eq!(bands, rows(&frame, 50, 40, 0..40));
        assert_eq!([rows(&frame, 16, 9, 0..4), rows(&frame, 16, 9, 4..9)].concat(), rows(&frame, 16, 9, 0..9));
    }

    #[test]
    #[should_panic(expected = "out of range")]
    fn rows_beyond_the_frame_are_refused() {
        rows(&frame(16, 9), 16, 9, 8..10);
    }

    #[test]
    fn between_pixels_it_is_linear() {
        let frame = Frame { width: 2, height: 1, pixels: vec![0x000000, 0xff8040] };
        // The middles of eight pixels are at -3/8, -1/8, 1/8 ... of the distance of the two.
        let expected = [0x000000, 0x000000, 0x1f1008, 0x5f3018, 0x9f5028, 0xdf7038, 0xff8040, 0xff8040];
        assert_eq!(scaled(&frame, 8, 1), expected);
        // The mean of two and two where it is halved.
        assert_eq!(scaled(&frame, 1, 1), [0x7f4020]);
    }

    #[test]
    fn one_colour_stays_it_at_any_size() {
        let frame = Frame { width: 5, height: 4, pixels: vec![0xfffefd; 20] };
        for (columns, count) in [(1, 1), (3, 7), (5, 4), (64, 33)] {
            assert_eq!(scaled(&frame, columns, count), vec![0xfffefd; columns * count]);
        }
    }

    #[test]
    fn the_aspect_is_kept() {
        let frame = frame(1280, 720);
        for (window, expected) in [
            ((1280, 720), (1280, 720)),
            ((1920, 1200), (1920, 1080)),
            ((3440, 1440), (2560, 1440)),
            ((320, 300), (320, 180)),
            ((1, 1), (1, 1)),
        ] {
            assert_eq!(fit(&frame, window), expected);
        }
    }
}
