//! Frames in memory and on their way out: as PPM files, as a stream of them to stdout, or as one still.
//!
//! PPM (P6) because it is a header of three numbers and then the pixels: every encoder of films and every viewer reads
//! it, and writing it takes no library.

use crate::args::Args;
use crate::io::{make_directory, save, stream};
use crate::text::{digits, figure, fill};
use paprsek::frame::{Frame, Renderer, Scene};
use std::mem::take;

/// Pixels that are converted and written at once.
const PIECE: usize = 1 << 14;
/// Added to the number of a frame, whose six digits then follow a 1 and keep their leading zeros.
const SIX_DIGITS: usize = 1_000_000;

/// The renderer that `args` ask for.
#[inline(always)]
pub fn renderer(args: &Args) -> Result<Renderer, String> {
    let renderer = Renderer::new(args.threads)?;
    #[cfg(feature = "full")]
    let renderer = renderer.at_level(args.level);
    Ok(renderer)
}

/// The renderer and the black frame that `args` ask for.
#[inline(never)]
pub fn open(args: &Args) -> Result<(Renderer, Frame), Vec<u8>> {
    Ok((renderer(args)?, black_frame(args.size)?))
}

/// A black frame of `size`, width and height in pixels. Not [`Frame::new`], which ends the process where there is no
/// memory: sizes come from the command line, and too large a one is to be answered with a line.
#[inline(never)]
pub fn black_frame(size: (usize, usize)) -> Result<Frame, &'static str> {
    let (width, height) = size;
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(width * height).map_err(|_| "no memory for a frame of that size")?;
    pixels.resize(width * height, 0);
    Ok(Frame { width, height, pixels })
}

/// Writes the frames that `args` ask for into the directory `target`, or to stdout where it is `-`.
#[inline(never)]
pub fn run(args: &Args, target: &[u8]) -> Result<(), Vec<u8>> {
    let piped = target == b"-";
    // Makes the directory and those above it. Most exist already; a failure shows when the first file cannot be
    // written.
    for end in 1..target.len() + 1 {
        if !piped && target.get(end).is_none_or(|&byte| byte == b'/') {
            make_directory(&target[..end]);
        }
    }
    let (mut renderer, mut frame) = open(args)?;
    for number in args.frames() {
        // A range takes the film's own frames that lie in it, whatever else is captured, so that pieces make the whole.
        let time = if args.still { args.start.unwrap_or(0.0) } else { number as f64 / args.fps };
        renderer.render_with(args.scene(), time, &args.options, &mut frame);
        let pieces = ppm(&frame);
        if piped {
            stream(pieces)?;
        } else {
            let name = fill("%/frame-%.ppm", &[target, &digits(SIX_DIGITS + number)[1..]]);
            save(&name, pieces, false)?;
        }
    }
    Ok(())
}

/// Saves a frame of `scene` at `time`, in seconds, into the working directory, named after both. Fails where a file of
/// that name exists.
pub fn save_still(scene: &Scene, time: f64, frame: &Frame) -> Result<(), Vec<u8>> {
    let name = fill("paprsek-%-%.ppm", &[scene.name.as_bytes(), &figure(time)]);
    save(&name, ppm(frame), true)
}

/// The frame as a binary PPM (P6), in pieces: there may be no memory for the whole file beside the frame.
fn ppm(frame: &Frame) -> impl Iterator<Item = Vec<u8>> {
    let mut head = fill("P6\n% %\n255\n", &[&digits(frame.width), &digits(frame.height)]);
    frame.pixels.chunks(PIECE).map(move |pixels| {
        let head = take(&mut head);
        let mut at = head.len();
        let mut bytes = vec![0; at + 3 * pixels.len() + 1];
        bytes[..at].copy_from_slice(&head);
        for pixel in pixels {
            // Four bytes are one instruction; the next pixel overwrites the last of them.
            bytes[at..at + 4].copy_from_slice(&(pixel << 8).to_be_bytes());
            at += 3;
        }
        bytes.pop();
        bytes
    })
}
