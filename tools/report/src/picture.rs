//! Frames as pictures of the `image` crate.

use image::RgbImage;
use paprsek::frame::Frame;

/// The pixels of a frame, red first.
pub fn rgb(frame: &Frame) -> RgbImage {
    RgbImage::from_raw(frame.width as u32, frame.height as u32, frame.to_rgb()).expect("three bytes a pixel")
}
