//! All layers of a picture as one, which draws as they do and watches them: what each takes, and what is asked of them.

use crate::overlay::Overlay;
use fearless_simd::Level;
use paprsek::frame::{Cache, Layer, Stats, Tile, Workers};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// What is known of a frame while it is rendered and after.
#[derive(Default)]
pub struct Record {
    /// Nanoseconds of all threads together that each layer has prepared and drawn.
    pub layers: Vec<[AtomicU64; 2]>,
    /// Tiles that are finished.
    pub tiles: AtomicU64,
    /// Whether nobody waits for the frame any more: what is left of it is not drawn.
    pub cancelled: AtomicBool,
    /// A number per pixel of the picture, in rows, where an overlay is asked for; NaN where no layer knows any.
    pub numbers: Mutex<Vec<f32>>,
}

/// The layers of a picture.
pub struct Watched {
    layers: Vec<Box<dyn Layer>>,
    record: Arc<Record>,
    overlay: Option<Overlay>,
    /// Width and height of the picture, pixels.
    size: (usize, usize),
}

impl Watched {
    /// Layers of a picture of that size, watched, and where what is seen will be.
    pub fn new(layers: Vec<Box<dyn Layer>>, overlay: Option<Overlay>, size: (usize, usize)) -> (Watched, Arc<Record>) {
        let numbers = Mutex::new(if overlay.is_some() { vec![f32::NAN; size.0 * size.1] } else { Vec::new() });
        let times = layers.iter().map(|_| Default::default()).collect();
        let record = Arc::new(Record { layers: times, numbers, ..Record::default() });
        (Watched { layers, record: record.clone(), overlay, size }, record)
    }

    /// What the layers are called.
    pub fn names(&self) -> Vec<&'static str> {
        self.layers.iter().map(|layer| layer.name()).collect()
    }

    fn took(&self, layer: usize, part: usize, began: Instant) {
        self.record.layers[layer][part].fetch_add(began.elapsed().as_nanos() as u64, Ordering::Relaxed);
    }

    /// Keeps a tile's numbers.
    fn keep(&self, tile: &Tile, numbers: &[f32]) {
        let mut all = self.record.numbers.lock().unwrap_or_else(PoisonError::into_inner);
        for row in 0..tile.height {
            let at = (tile.y + row) * self.size.0 + tile.x;
            all[at..at + tile.width].copy_from_slice(&numbers[row * Tile::SIZE..][..tile.width]);
        }
    }
}

impl Layer for Watched {
    fn prepare(&mut self, workers: &Workers, cache: &Cache) {
        for place in 0..self.layers.len() {
            let began = Instant::now();
            self.layers[place].prepare(workers, cache);
            self.took(place, 0, began);
        }
    }

    fn foresee(&self, level: Level, tile: &mut Tile) {
        if self.record.cancelled.load(Ordering::Relaxed) {
            return;
        }
        for (place, layer) in self.layers.iter().enumerate() {
            let began = Instant::now();
            layer.foresee(level, tile);
            self.took(place, 1, began);
        }
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let mut samples = 0;
        if self.record.cancelled.load(Ordering::Relaxed) {
            return Stats { samples };
        }
        let start = Instant::now();
        for (place, layer) in self.layers.iter().enumerate() {
            // As the renderer has it; and an overlay reads depths too.
            tile.solids_matter = place + 1 < self.layers.len() || self.overlay.is_some();
            let began = Instant::now();
            samples += layer.draw(level, tile).samples;
            self.took(place, 1, began);
        }
        let time = start.elapsed();
        self.record.tiles.fetch_add(1, Ordering::Relaxed);
        if let Some(overlay) = self.overlay
            && let Some(numbers) = overlay.numbers(&self.layers, level, tile, time)
        {
            self.keep(tile, &numbers);
        }
        Stats { samples }
    }
}
