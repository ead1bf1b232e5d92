//! A frame by bands: a picture that is prepared once, and drawn some rows at a time, as several machines or several
//! instances in a browser do that share no memory.

use super::layer::Picture;
use super::renderer::{Frame, Options, Renderer};
use super::scene::{FrameSpec, Scene};
use super::tile::Tile;
use std::mem;
use std::ops::Range;

/// A picture whose layers are prepared, by the renderer that is to draw it.
pub struct Prepared {
    picture: Picture,
    size: (usize, usize),
}

impl Prepared {
    /// Width and height of the whole frame, pixels.
    pub fn size(&self) -> (usize, usize) {
        self.size
    }
}

impl Renderer {
    /// Makes ready what [`Renderer::draw_rows`] draws: the frame of `scene` at `time` seconds, of that width and height, for
    /// one eye.
    pub fn prepare_rows(&self, scene: &Scene, time: f64, options: &Options, size: (usize, usize)) -> Prepared {
        let spec = FrameSpec { values: options.values, ..self.spec(time, options.quality, size) };
        let mut picture = (scene.picture)(&spec);
        for layer in &mut picture.layers {
            layer.prepare(self.workers(), self.cache());
        }
        Prepared { picture, size }
    }

    /// Draws those rows of a prepared frame: their `0RGB` pixels, the same bytes that they have in the whole frame.
    ///
    /// It takes as long as the bands of 64 rows that the rows lie in. Rows past the last one are none.
    pub fn draw_rows(&self, prepared: &Prepared, rows: Range<usize>, pixels: &mut Vec<u32>) {
        let (width, height) = prepared.size;
        let end = rows.end.min(height);
        let start = rows.start.min(end);
        let first = start / Tile::SIZE;
        // The rows before the first band are of no concern, and those after the last one have no pixels here.
        let above = first * Tile::SIZE;
        let last = end.next_multiple_of(Tile::SIZE).min(height);
        let mut bands = Frame { width, height, pixels: mem::take(pixels) };
        bands.pixels.resize((last - above) * width, 0);
        self.draw_bands(&prepared.picture, first, 0, width, &mut bands);
        *pixels = bands.pixels;
        pixels.truncate((end - above) * width);
        pixels.drain(..(start - above) * width);
    }
}
