//! `--pixel`: how one pixel of a frame comes to be.

use crate::args::Args;
use crate::capture;
use crate::io::print;
use paprsek::frame::probe::probe;

/// Prints what is known of the pixel at a column and a row.
pub fn run(args: &Args, pixel: (usize, usize)) -> Result<(), Vec<u8>> {
    let renderer = capture::renderer(args)?;
    let text = probe(&renderer, args.scene(), args.start.unwrap_or(0.0), &args.options, args.size, pixel);
    print(text.as_bytes())
}
