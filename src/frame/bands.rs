//! A frame by bands: a picture that is prepared once, and drawn some rows at a time, as several machines or several
//! instances in a browser do that share no memory.

use super::layer::Picture;
use super::renderer::{Options, RUN, Renderer, encode_tile, runs};
use super::scene::{FrameSpec, Scene};
use super::tile::Tile;
use fearless_simd::dispatch;
use std::ops::Range;

// What draws a band is written a second time here: shared with the renderer it would cost the 64 kB build 15 bytes packed.

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
        pixels.resize((last - above) * width, 0);
        let (level, Picture { layers, transfer }) = (self.level(), &prepared.picture);
        let across = width.div_ceil(RUN * Tile::SIZE);
        let draw = |tile: &mut Tile, (run, rows): (usize, &mut [&mut [u32]])| {
            for column in 0..rows[0].len().div_ceil(Tile::SIZE) {
                tile.place(run % across * RUN + column, first + run / across, width, height);
                for layer in layers {
                    layer.foresee(level, tile);
                }
                for (index, layer) in layers.iter().enumerate() {
                    tile.solids_matter = index + 1 < layers.len();
                    layer.draw(level, tile);
                }
                dispatch!(level, simd => encode_tile(simd, *transfer, tile, column, rows));
            }
            0
        };
        let mut rows = runs(pixels, width, 0, width);
        self.workers().each_with(rows.chunks_mut(Tile::SIZE).enumerate(), Tile::new, draw);
        pixels.truncate((end - above) * width);
        pixels.drain(..(start - above) * width);
    }
}
