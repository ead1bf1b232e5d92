//! Frames to PPM files or a pipe.

use crate::args::Args;
use crate::canvas;
use crate::io::{fill, make_directory, save, stream};
use crate::text::{digits, figure};
use paprsek::frame::Frame;
use paprsek::frame::Scene;
use std::mem::take;

/// Pixels that are written at once.
const PIECE: usize = 1 << 14;

/// Writes the frames that `args` ask for into the directory `target`, or to stdout where it is `-`.
#[inline(never)]
pub fn run(args: &Args, target: &[u8]) -> Result<(), Vec<u8>> {
    let piped = target == b"-";
    // The directory and those above it. Most exist; what fails is said by the first file that cannot be written.
    for end in 1..=target.len() {
        if !piped && target.get(end).is_none_or(|&byte| byte == b'/') {
            make_directory(&target[..end]);
        }
    }
    let (mut renderer, mut frame) = canvas::open(args)?;
    for number in args.frames() {
        // Of a range the film's frames that lie in it, whatever else was captured: so pieces make the whole.
        let time = if args.still { args.start.unwrap_or(0.0) } else { number as f64 / args.fps };
        renderer.render_with(args.scene(), time, &args.options, &mut frame);
        let pieces = ppm(&frame);
        if piped {
            stream(pieces)?;
        } else {
            // The one before the six digits keeps their zeros.
            let name = fill("%/frame-%.ppm", &[target, &digits(1_000_000 + number)[1..]]);
            save(&name, pieces, false)?;
        }
    }
    Ok(())
}

/// Saves a frame of `scene` under its time, in the working directory; an error where there is such a file.
pub fn still(scene: &Scene, time: f64, frame: &Frame) -> Result<(), Vec<u8>> {
    let name = fill("paprsek-%-%.ppm", &[scene.name.as_bytes(), &figure(time)]);
    save(&name, ppm(frame), true)
}

/// A binary PPM (P6) in pieces: there may be no memory for all of it beside the frame.
fn ppm(frame: &Frame) -> impl Iterator<Item = Vec<u8>> {
    let mut bytes = fill("P6\n% %\n255\n", &[&digits(frame.width), &digits(frame.height)]);
    frame.pixels.chunks(PIECE).map(move |pixels| {
        let head = bytes.len();
        bytes.resize(head + 3 * pixels.len(), 0);
        for (triple, pixel) in bytes[head..].as_chunks_mut().0.iter_mut().zip(pixels) {
            let [_, red, green, blue] = pixel.to_be_bytes();
            *triple = [red, green, blue];
        }
        take(&mut bytes)
    })
}
