//! Frames to PPM files or a pipe.

use crate::args::Args;
use crate::canvas;
use crate::number::digits;
use crate::output::{make_directory, print, save};
use paprsek::tile::{Frame, Renderer};

/// Writes the frames that `args` ask for into the directory `target`, or to stdout where it is `-`.
pub fn run(args: &Args, target: &[u8]) -> Result<(), Vec<u8>> {
    let stream = target == b"-";
    // The directory and those above it. Most exist; what fails is said by the first file that cannot be written.
    for end in 1..=target.len() {
        if !stream && target.get(end).is_none_or(|&byte| byte == b'/') {
            make_directory(&target[..end]);
        }
    }
    let mut renderer = Renderer::new(args.threads)?;
    let mut frame = canvas::frame(args.size)?;
    let part = [target, b"/", &digits(std::process::id() as usize), b".part"].concat();
    let mut bytes = Vec::new();
    for number in 0..args.frames() {
        // Divided, not accumulated: frame k is the same instant whatever was captured before it.
        let time = args.start() + number as f64 / args.fps;
        renderer.render_eyes(args.scene(), time, &args.quality, args.stereo, &mut frame);
        encode(&frame, &mut bytes);
        if stream {
            print(&bytes)?;
        } else {
            // The one before the six digits keeps their zeros.
            save(&part, &[target, b"/frame-", &digits(1_000_000 + number)[1..], b".ppm"].concat(), &bytes)?;
        }
    }
    Ok(())
}

/// A binary PPM (P6).
fn encode(frame: &Frame, bytes: &mut Vec<u8>) {
    bytes.clear();
    bytes.extend_from_slice(&[b"P6\n", &*digits(frame.width), b" ", &digits(frame.height), b"\n255\n"].concat());
    for pixel in &frame.pixels {
        bytes.extend_from_slice(&pixel.to_be_bytes()[1..]);
    }
}
