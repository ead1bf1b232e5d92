//! Memory for frames, refused with a word where there is not enough.

use crate::args::Args;
use paprsek::frame::{Frame, Renderer};

/// What draws, and what it draws on.
#[inline(never)]
pub fn open(args: &Args) -> Result<(Renderer, Frame), Vec<u8>> {
    Ok((Renderer::new(args.threads)?, frame(args.size)?))
}

/// A black frame; an error where there is no memory for it.
#[inline(never)]
pub fn frame(size: (usize, usize)) -> Result<Frame, &'static str> {
    let (width, height) = size;
    let mut pixels = Vec::new();
    pixels.try_reserve_exact(width * height).map_err(|_| "no memory for a frame of that size")?;
    pixels.resize(width * height, 0);
    Ok(Frame { width, height, pixels })
}
