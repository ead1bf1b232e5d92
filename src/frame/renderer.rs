//! The renderer: from a scene at an instant to finished pixels.
//!
//! A frame is cut into tiles of 64 x 64 pixels. Threads take one run of tiles after another; each draws all layers of the
//! picture into a tile, encodes it, and goes on to the next. A frame is a pure function of what is asked for:
//! neither the number of threads, nor the SIMD level, nor the frames before it change a byte.

use super::cache::Cache;
use super::encode::{self, Transfer};
use super::layer::{Picture, Stats};
use super::parameter::Values;
use super::scene::{FrameSpec, Scene};
use super::tile::Tile;
use super::workers::Workers;
use crate::cuts;
use crate::settings::Quality;
use crate::simd::level;
use crate::simd::math::to_f32;
use crate::view::{Eye, Stereo};
use fearless_simd::{Level, Simd, dispatch};
use std::hint::black_box;

/// A finished picture: `0RGB` pixels, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Pixels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// `width * height` pixels, `0x00RRGGBB`.
    pub pixels: Vec<u32>,
}

impl Frame {
    /// A black frame.
    pub fn new(width: usize, height: usize) -> Frame {
        Frame { width, height, pixels: vec![0; width * height] }
    }

    /// The pixels as bytes, red, green and blue in turn: what encoders of pictures take.
    pub fn to_rgb(&self) -> Vec<u8> {
        self.pixels.iter().flat_map(|pixel| pixel.to_be_bytes().into_iter().skip(1)).collect()
    }
}

/// How a frame is asked for, beside its scene and its time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options<'a> {
    /// Speed against error.
    pub quality: &'a Quality,
    /// Two pictures side by side, for two eyes.
    pub stereo: Option<Stereo>,
    /// What the scene's parameters are set to.
    pub values: Values<'a>,
}

impl Default for Options<'_> {
    /// The default quality, one eye, the scene as it is shown.
    fn default() -> Self {
        Options { quality: &Quality::DEFAULT, stereo: None, values: &[] }
    }
}

/// Renders frames on a fixed number of threads at one SIMD level.
pub struct Renderer {
    workers: Workers,
    cache: Cache,
}

impl Renderer {
    /// A renderer on `threads` threads, or one per core if 0, at the best SIMD level of this machine.
    ///
    /// The calling thread is one of them where it can be. Fails where threads cannot be started.
    pub fn new(threads: usize) -> Result<Renderer, String> {
        if cfg!(target_env = "gnu") {
            // Once so large a block was freed, glibc keeps up to twice as much of what a frame frees for the next one, which
            // else begins with pages that the system has to clear: see M_MMAP_THRESHOLD in mallopt(3). Where there is not
            // so much, frames do without.
            _ = black_box(&mut Vec::<u8>::new()).try_reserve_exact(16 << 20);
        }
        Ok(Renderer { workers: Workers::new(threads)?, cache: Cache::default() })
    }

    /// The same renderer at another SIMD level.
    pub fn at_level(mut self, level: Level) -> Renderer {
        self.workers.set_level(level);
        self
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.workers.threads()
    }

    /// The threads, which a [`FrameSpec`] hands to its scene.
    pub fn workers(&self) -> &Workers {
        &self.workers
    }

    /// What is kept from frame to frame, which a [`FrameSpec`] hands to its scene.
    pub fn cache(&self) -> &Cache {
        &self.cache
    }

    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.workers.level()
    }

    /// The name of the SIMD level in use.
    pub fn simd(&self) -> &'static str {
        level::name(self.workers.level())
    }

    /// Renders `scene` at `time` seconds into `frame`: the same bytes after any history, on any number of threads.
    pub fn render(&mut self, scene: &Scene, time: f64, quality: &Quality, frame: &mut Frame) -> Stats {
        self.render_with(scene, time, &Options { quality, ..Options::default() }, frame)
    }

    /// Renders `scene` at `time` seconds into `frame`, with all that can be asked for.
    ///
    /// Two eyes have pictures of equal width; a column that is left over is black, at the right. Each picture has the
    /// pixels that it has alone, as tiles and dither start at its own edge.
    pub fn render_with(&mut self, scene: &Scene, time: f64, options: &Options, frame: &mut Frame) -> Stats {
        let Options { quality, stereo, values } = *options;
        let stereo = stereo.filter(|_| cuts::STEREO);
        let (eyes, pair) = stereo.map_or((1, Stereo { eye_distance: 0.0, convergence: 1.0 }), |pair| (2, pair));
        let (width, height) = (frame.width / eyes, frame.height);
        if width * eyes < frame.width {
            frame.pixels.fill(0);
        }
        let mut samples = 0;
        for number in 0..eyes {
            let eye = pair.eye(to_f32(number) - 0.5);
            let (workers, cache) = (&self.workers, &self.cache);
            let picture = (scene.picture)(&FrameSpec { time, width, height, quality, eye, values, workers, cache });
            samples += self.draw_at(picture, number * width, width, frame).samples;
        }
        Stats { samples }
    }

    /// The request for the frame of `time`, `width` x `height` pixels, with everything else as usual.
    pub fn spec<'a>(&'a self, time: f64, quality: &'a Quality, (width, height): (usize, usize)) -> FrameSpec<'a> {
        let (workers, cache) = (&self.workers, &self.cache);
        FrameSpec { time, width, height, quality, eye: Eye::MIDDLE, values: &[], workers, cache }
    }

    /// Draws a picture that was made for the frame's size.
    pub fn draw(&mut self, picture: Picture, frame: &mut Frame) -> Stats {
        self.draw_at(picture, 0, frame.width, frame)
    }

    /// Draws a picture that was made for `width` columns of the frame, from column `x` on.
    fn draw_at(&mut self, mut picture: Picture, x: usize, width: usize, frame: &mut Frame) -> Stats {
        for layer in &mut picture.layers {
            layer.prepare(&self.workers, &self.cache);
        }
        let (level, stride, height) = (self.workers.level(), frame.width, frame.height);
        let transfer = if cuts::TRANSFERS { picture.transfer } else { Transfer::Srgb };
        let across = width.div_ceil(RUN * Tile::SIZE);
        let draw = |tile: &mut Tile, (run, rows): (usize, &mut [&mut [u32]])| {
            let mut samples = 0;
            for column in 0..rows[0].len().div_ceil(Tile::SIZE) {
                tile.place(run % across * RUN + column, run / across, width, height);
                for layer in &picture.layers {
                    layer.foresee(level, tile);
                }
                for (index, layer) in picture.layers.iter().enumerate() {
                    tile.solids_matter = index + 1 < picture.layers.len();
                    samples += layer.draw(level, tile).samples;
                }
                dispatch!(level, simd => encode_tile(simd, transfer, tile, column, rows));
            }
            samples
        };
        let mut rows = runs(&mut frame.pixels, stride, x, width);
        Stats { samples: self.workers.each_with(rows.chunks_mut(Tile::SIZE).enumerate(), Tile::new, draw) }
    }
}

/// Tiles side by side that a thread draws one after another.
pub(super) const RUN: usize = 4;

/// The runs of tiles of `width` columns of pixels from column `x` on, in a frame whose rows have `stride` of them: for each run,
/// row by row of them, the pixels of its [`Tile::SIZE`] rows. Rows below the frame have none.
///
/// Threads take one run after another: with whole bands one waited for another for 2 to 6 hundredths of a frame, and with
/// single tiles what one draws is less in the cache of its core.
pub(super) fn runs(pixels: &mut [u32], stride: usize, x: usize, width: usize) -> Vec<&mut [u32]> {
    let across = width.div_ceil(RUN * Tile::SIZE);
    let mut rows: Vec<&mut [u32]> = Vec::new();
    rows.resize_with((pixels.len() / stride.max(1)).next_multiple_of(Tile::SIZE) * across, Default::default);
    for (y, line) in pixels.chunks_mut(stride.max(1)).enumerate() {
        for (run, part) in line[x..x + width].chunks_mut(RUN * Tile::SIZE).enumerate() {
            rows[(y / Tile::SIZE * across + run) * Tile::SIZE + y % Tile::SIZE] = part;
        }
    }
    rows
}

/// Encodes the pixels of the tile that is a run's `column`th into the rows of the run.
#[inline(always)]
pub(super) fn encode_tile<S: Simd>(simd: S, transfer: Transfer, tile: &Tile, column: usize, rows: &mut [&mut [u32]]) {
    for (row, out) in rows[..tile.height].iter_mut().enumerate() {
        let at = row * Tile::SIZE..row * Tile::SIZE + tile.width;
        let (r, g, b) = (&tile.red[at.clone()], &tile.green[at.clone()], &tile.blue[at]);
        let out = &mut out[column * Tile::SIZE..][..tile.width];
        encode::encode(simd, transfer, tile.x as u32, (tile.y + row) as u32, r, g, b, out);
    }
}
