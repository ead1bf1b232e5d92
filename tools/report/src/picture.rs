//! Frames as pictures of the `image` crate.

use image::RgbImage;
use paprsek::frame::Frame;

/// The pixels of a frame, red first.
pub fn rgb(frame: &Frame) -> RgbImage {
    let bytes = frame.pixels.iter().flat_map(|p| [(p >> 16) as u8, (p >> 8) as u8, *p as u8]).collect();
    RgbImage::from_raw(frame.width as u32, frame.height as u32, bytes).expect("three bytes a pixel")
}
