//! Frames to PPM files or a pipe.

use crate::args::Args;
use crate::canvas;
use crate::number::digits;
use crate::output::{fill, make_directory, print, save};

/// Writes the frames that `args` ask for into the directory `target`, or to stdout where it is `-`.
#[inline(never)]
pub fn run(args: &Args, target: &[u8]) -> Result<(), Vec<u8>> {
    let stream = target == b"-";
    // The directory and those above it. Most exist; what fails is said by the first file that cannot be written.
    for end in 1..=target.len() {
        if !stream && target.get(end).is_none_or(|&byte| byte == b'/') {
            make_directory(&target[..end]);
        }
    }
    let (mut renderer, mut frame) = canvas::open(args)?;
    let part = fill("%/%.part", &[target, &digits(std::process::id() as usize)]);
    let mut bytes = Vec::new();
    for number in 0..args.frames() {
        // Divided, not accumulated: frame k is the same instant whatever was captured before it.
        let time = args.start.unwrap_or(0.0) + number as f64 / args.fps;
        renderer.render_eyes(args.scene(), time, &args.quality, args.stereo, &mut frame);
        // A binary PPM (P6).
        bytes.clear();
        bytes.extend_from_slice(&fill("P6\n% %\n255\n", &[&digits(frame.width), &digits(frame.height)]));
        for pixel in &frame.pixels {
            bytes.extend_from_slice(&pixel.to_be_bytes()[1..]);
        }
        if stream {
            print(&bytes)?;
        } else {
            // The one before the six digits keeps their zeros.
            save(&part, &fill("%/frame-%.ppm", &[target, &digits(1_000_000 + number)[1..]]), &bytes)?;
        }
    }
    Ok(())
}
