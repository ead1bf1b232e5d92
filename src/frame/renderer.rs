//! From a scene at an instant to finished pixels.

use super::encode::{self, Transfer};
use super::layer::{Picture, Stats};
use super::pool::Pool;
use super::scene::{FrameSpec, Scene};
use super::tile::Tile;
use super::workers::Workers;
use crate::cuts::BENCH;
use crate::settings::Quality;
use crate::view::Stereo;
use fearless_simd::{Level, Simd, dispatch};

/// A finished picture: `0RGB` pixels, row by row from the top left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Pixels in a row.
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
}

/// Renders frames on a fixed number of threads at one SIMD level.
pub struct Renderer {
    workers: Workers,
}

impl Renderer {
    /// A renderer on `threads` threads (0: all cores) at the best SIMD level of this machine.
    ///
    /// The calling thread becomes a worker where it can. Fails where threads cannot be started.
    pub fn new(threads: usize) -> Result<Renderer, String> {
        // What was built for processors with AVX2 need not look for it: 0.8 kB packed.
        let known = cfg!(target_feature = "avx2");
        let level = if known { Level::baseline() } else { Level::new() };
        Ok(Renderer { workers: Workers { pool: Pool::new(threads)?, level } })
    }

    /// The same renderer at another SIMD level.
    pub fn at_level(self, level: Level) -> Renderer {
        Renderer { workers: Workers { level, ..self.workers } }
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.workers.pool.threads()
    }

    /// Who works: what a [`FrameSpec`] needs.
    pub fn workers(&self) -> &Workers {
        &self.workers
    }

    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.workers.level
    }

    /// The SIMD level in use, as the benchmark names it: `avx512`, `avx2`, `sse4.2`, `sse2`, `neon`, `scalar`.
    pub fn simd(&self) -> &'static str {
        // What runs, which a build may hold below what the machine has.
        match dispatch!(self.workers.level, simd => simd.level()) {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(_) => "avx512",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2(_) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Level::Sse4_2(_) => "sse4.2",
            #[cfg(target_arch = "x86_64")]
            Level::Sse2(_) => "sse2",
            #[cfg(target_arch = "aarch64")]
            Level::Neon(_) => "neon",
            _ => "scalar",
        }
    }

    /// Renders `scene` at `time` seconds into `frame`: the same bytes after any history, on any number of threads.
    pub fn render(&mut self, scene: &Scene, time: f64, quality: &Quality, frame: &mut Frame) -> Stats {
        self.render_eyes(scene, time, quality, None, frame)
    }

    /// The same with a picture for each eye, side by side and equally wide: columns that are left over are black, at the
    /// right. A picture has the pixels that it has alone, as tiles and dither start at its own edge.
    pub fn render_eyes(
        &mut self,
        scene: &Scene,
        time: f64,
        quality: &Quality,
        stereo: Option<Stereo>,
        frame: &mut Frame,
    ) -> Stats {
        // The 64 kB build has one.
        let stereo = stereo.filter(|_| BENCH);
        let (eyes, pair) = stereo.map_or((1, Stereo { eye_distance: 0.0, convergence: 1.0 }), |pair| (2, pair));
        let (width, height, quality) = (frame.width / eyes, frame.height, *quality);
        if width * eyes < frame.width {
            frame.pixels.fill(0);
        }
        let mut samples = 0;
        for number in 0..eyes {
            let eye = pair.eye(number as u32 as f32 - 0.5);
            let picture = scene.picture(&FrameSpec { time, width, height, quality, eye, workers: &self.workers });
            samples += self.draw_at(picture, number * width, width, frame).samples;
        }
        Stats { samples }
    }

    /// Draws a picture that was made for a frame of that size.
    pub fn draw(&mut self, picture: Picture, frame: &mut Frame) -> Stats {
        self.draw_at(picture, 0, frame.width, frame)
    }

    /// Draws a picture that was made for that many columns of the frame, from column `x` on.
    fn draw_at(&mut self, mut picture: Picture, x: usize, width: usize, frame: &mut Frame) -> Stats {
        for layer in &mut picture.layers {
            layer.prepare(&self.workers);
        }
        let (level, stride, height) = (self.workers.level, frame.width, frame.height);
        let columns = width.div_ceil(Tile::SIZE);
        // A band of the frame is one row of tiles: its pixels are contiguous, so threads never share a line of memory.
        // Bands are handed out one at a time: a few dear ones at the end must not stay with one thread.
        let bands = frame.pixels.chunks_mut((stride * Tile::SIZE).max(1)).enumerate();
        let draw = |tile: &mut Tile, (row, pixels): (usize, &mut [u32])| {
            let mut samples = 0;
            for column in 0..columns {
                tile.place(column, row, width, height);
                for (index, layer) in picture.layers.iter().enumerate() {
                    tile.solids_matter = index + 1 < picture.layers.len();
                    samples += layer.draw(level, tile).samples;
                }
                dispatch!(level, simd => develop(simd, picture.transfer, tile, stride, &mut pixels[x..]));
            }
            samples
        };
        Stats { samples: self.workers.each_with(bands, Tile::new, draw) }
    }
}

/// From the tile's light to the screen's codes.
#[inline(always)]
fn develop<S: Simd>(simd: S, transfer: Transfer, tile: &Tile, stride: usize, pixels: &mut [u32]) {
    for row in 0..tile.height {
        let at = row * Tile::SIZE..row * Tile::SIZE + tile.width;
        let (r, g, b) = (&tile.red[at.clone()], &tile.green[at.clone()], &tile.blue[at]);
        let out = &mut pixels[row * stride + tile.x..][..tile.width];
        encode::encode(simd, transfer, tile.x as u32, (tile.y + row) as u32, r, g, b, out);
    }
}
