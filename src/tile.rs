//! How a frame is cut into tiles and run.

use crate::BENCH;
use crate::camera::Stereo;
use crate::color::{self, Transfer};
use crate::pool::Pool;
use crate::quality::Quality;
use crate::scenes::{Scene, Shot};
use fearless_simd::{Level, Simd, dispatch};
use std::sync::{Mutex, PoisonError};

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

/// What a frame took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Eye rays traced.
    pub samples: u64,
}

/// A piece of the picture that stays in the first levels of the cache: linear light, and what lies in front of what.
///
/// All planes have rows of [`Tile::SIZE`] pixels, whatever the width.
pub struct Tile {
    /// Left edge in the picture, pixels.
    pub x: usize,
    /// Top edge in the picture, pixels.
    pub y: usize,
    /// Pixels in use in a row.
    pub width: usize,
    /// Rows in use.
    pub height: usize,
    /// Linear red.
    pub red: Box<[f32; Tile::AREA]>,
    /// Linear green.
    pub green: Box<[f32; Tile::AREA]>,
    /// Linear blue.
    pub blue: Box<[f32; Tile::AREA]>,
    /// 1 / distance along the view axis of the nearest solid, 0 for none: affine on planes, and empty space needs no infinity.
    pub closeness: Box<[f32; Tile::AREA]>,
    /// Share of the pixel that solids cover.
    pub coverage: Box<[f32; Tile::AREA]>,
    /// Will a later layer read `closeness` and `coverage`? Else they are not written.
    pub solids_matter: bool,
}

impl Tile {
    /// Pixels along an edge.
    pub const SIZE: usize = 64;
    /// Pixels.
    pub const AREA: usize = Tile::SIZE * Tile::SIZE;

    /// The tile of a picture of `width` x `height` pixels in that column and row of tiles.
    pub fn at(column: usize, row: usize, width: usize, height: usize) -> Tile {
        let mut tile = Tile::new();
        tile.place(column, row, width, height);
        tile
    }

    /// Moves the tile over the picture.
    fn place(&mut self, column: usize, row: usize, width: usize, height: usize) {
        (self.x, self.y) = (column * Tile::SIZE, row * Tile::SIZE);
        self.width = Tile::SIZE.min(width - self.x);
        self.height = Tile::SIZE.min(height - self.y);
    }

    fn new() -> Tile {
        let plane = || Box::new([0.0; Tile::AREA]);
        let (red, green, blue, closeness, coverage) = (plane(), plane(), plane(), plane(), plane());
        Tile { x: 0, y: 0, width: 0, height: 0, red, green, blue, closeness, coverage, solids_matter: true }
    }

    /// Black and empty.
    pub fn clear(&mut self) {
        for plane in [&mut self.red, &mut self.green, &mut self.blue] {
            plane.fill(0.0);
        }
        if self.solids_matter {
            self.closeness.fill(0.0);
            self.coverage.fill(0.0);
        }
    }
}

/// The threads of a frame, and the SIMD level that it is made at.
pub struct Crew {
    pool: Pool,
    level: Level,
}

impl Crew {
    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.level
    }

    /// Does `work` on every job once; threads take one after another.
    ///
    /// Two jobs may run at once in either order: what they give must not depend on it.
    pub fn each<T: Send>(&self, jobs: impl Iterator<Item = T> + Send, work: impl Fn(T) + Sync) {
        self.each_with(
            jobs,
            || (),
            |(), job| {
                work(job);
                0
            },
        );
    }

    /// The same with something that each thread makes once, for all of its jobs; the sum of what the jobs give.
    fn each_with<T: Send, M>(
        &self,
        jobs: impl Iterator<Item = T> + Send,
        make: impl Fn() -> M + Sync,
        work: impl Fn(&mut M, T) -> u64 + Sync,
    ) -> u64 {
        // A thread without a job would start for nothing.
        let most = jobs.size_hint().1.unwrap_or(usize::MAX);
        let jobs = Mutex::new(jobs);
        self.pool.sum(most, &|| {
            let mut own = make();
            let mut sum = 0;
            loop {
                // Bound, so that the lock is free again while the job is done.
                let next = jobs.lock().unwrap_or_else(PoisonError::into_inner).next();
                let Some(job) = next else { return sum };
                sum += work(&mut own, job);
            }
        })
    }
}

/// Something that draws into tiles: layers of a picture are drawn in order.
pub trait Layer: Sync {
    /// What is done once a frame, before any tile is drawn: shadow maps, triangles in bins.
    fn prepare(&mut self, _crew: &Crew) {}

    /// Draws the tile's part of the layer over what is there; returns what that took.
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats;

    /// Where eye rays are traced in a tile, pixels from the picture's top left; none for layers that trace none.
    #[cfg(feature = "bench-scenes")]
    fn positions(&self, _level: Level, _tile: &mut Tile) -> Vec<(f32, f32)> {
        Vec::new()
    }
}

/// A scene at one instant, ready to be drawn.
pub struct Picture {
    /// Back to front.
    pub layers: Vec<Box<dyn Layer>>,
    /// The screen's scale.
    pub transfer: Transfer,
}

impl Picture {
    /// No layers.
    pub const EMPTY: Picture = Picture { layers: Vec::new(), transfer: Transfer::Srgb };
}

/// Renders frames on a fixed number of threads at one SIMD level.
pub struct Renderer {
    crew: Crew,
}

impl Renderer {
    /// A renderer on `threads` threads (0: all cores) at the best SIMD level of this machine.
    ///
    /// The calling thread becomes a worker where it can. Fails where threads cannot be started.
    pub fn new(threads: usize) -> Result<Renderer, String> {
        // What was built for processors with AVX2 need not look for it: 0.8 kB packed.
        let known = cfg!(target_feature = "avx2");
        let level = if known { Level::baseline() } else { Level::new() };
        Ok(Renderer { crew: Crew { pool: Pool::new(threads)?, level } })
    }

    /// The same renderer at another SIMD level.
    pub fn at_level(self, level: Level) -> Renderer {
        Renderer { crew: Crew { level, ..self.crew } }
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.crew.pool.threads()
    }

    /// Who works: what a [`Shot`] needs.
    pub fn crew(&self) -> &Crew {
        &self.crew
    }

    /// The SIMD level in use.
    pub fn level(&self) -> Level {
        self.crew.level
    }

    /// The SIMD level in use, as the benchmark names it: `avx512`, `avx2`, `sse4.2`, `sse2`, `neon`, `scalar`.
    pub fn simd(&self) -> &'static str {
        // What runs, which a build may hold below what the machine has.
        match dispatch!(self.crew.level, simd => simd.level()) {
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
            let picture = scene.picture(&Shot { time, width, height, quality, eye, crew: &self.crew });
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
            layer.prepare(&self.crew);
        }
        let (level, stride, height) = (self.crew.level, frame.width, frame.height);
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
        Stats { samples: self.crew.each_with(bands, Tile::new, draw) }
    }
}

/// From the tile's light to the screen's codes.
#[inline(always)]
fn develop<S: Simd>(simd: S, transfer: Transfer, tile: &Tile, stride: usize, pixels: &mut [u32]) {
    for row in 0..tile.height {
        let at = row * Tile::SIZE..row * Tile::SIZE + tile.width;
        let (r, g, b) = (&tile.red[at.clone()], &tile.green[at.clone()], &tile.blue[at]);
        let out = &mut pixels[row * stride + tile.x..][..tile.width];
        color::encode(simd, transfer, tile.x as u32, (tile.y + row) as u32, r, g, b, out);
    }
}
