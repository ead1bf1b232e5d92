//! Layers whose work is measured while they draw.

use fearless_simd::Level;
use paprsek::frame::{Cache, Layer, Stats, Tile, Workers};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

/// What a layer has taken in one frame: nanoseconds of all threads together, and samples.
#[derive(Default)]
pub struct Taken {
    /// Preparing, once per frame.
    pub prepare: AtomicU64,
    /// Drawing tiles.
    pub draw: AtomicU64,
    /// Samples of all tiles.
    pub samples: AtomicU64,
}

/// A layer that draws as the one within, and counts what that takes.
pub struct Watched {
    inner: Box<dyn Layer>,
    taken: Arc<Taken>,
}

impl Watched {
    /// The layer, watched, and where its figures will be.
    pub fn new(inner: Box<dyn Layer>) -> (Watched, Arc<Taken>) {
        let taken = Arc::<Taken>::default();
        (Watched { inner, taken: taken.clone() }, taken)
    }
}

impl Layer for Watched {
    fn prepare(&mut self, workers: &Workers, cache: &Cache) {
        let began = Instant::now();
        self.inner.prepare(workers, cache);
        self.taken.prepare.fetch_add(began.elapsed().as_nanos() as u64, Ordering::Relaxed);
    }

    fn foresee(&self, level: Level, tile: &mut Tile) {
        let began = Instant::now();
        self.inner.foresee(level, tile);
        self.taken.draw.fetch_add(began.elapsed().as_nanos() as u64, Ordering::Relaxed);
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let began = Instant::now();
        let stats = self.inner.draw(level, tile);
        self.taken.draw.fetch_add(began.elapsed().as_nanos() as u64, Ordering::Relaxed);
        self.taken.samples.fetch_add(stats.samples, Ordering::Relaxed);
        stats
    }

    fn positions(&self, level: Level, tile: &mut Tile) -> Vec<(f32, f32)> {
        self.inner.positions(level, tile)
    }

    fn name(&self) -> &'static str {
        self.inner.name()
    }
}
