//! Linear light, before it becomes codes.

use fearless_simd::Level;
use paprsek::frame::{Layer, Stats, Tile};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// What a probe has seen in the tiles of a picture.
#[derive(Default)]
pub struct Seen {
    /// Pixels.
    pub pixels: AtomicU64,
    /// Pixels with a channel that is NaN or infinite, or below 0 by more than rounding makes of a dark pixel.
    pub bad: AtomicU64,
}

/// A layer that draws nothing and looks at the light below it. It comes last.
pub struct Probe(pub Arc<Seen>);

/// Light that a difference of two roundings may make of black.
const BELOW: f32 = -1e-5;

impl Layer for Probe {
    fn draw(&self, _: Level, tile: &mut Tile) -> Stats {
        let mut bad = 0;
        for row in 0..tile.height {
            for at in row * Tile::SIZE..row * Tile::SIZE + tile.width {
                let light = [tile.red[at], tile.green[at], tile.blue[at]];
                bad += u64::from(light.iter().any(|c| !c.is_finite() || *c < BELOW));
            }
        }
        self.0.pixels.fetch_add((tile.width * tile.height) as u64, Ordering::Relaxed);
        self.0.bad.fetch_add(bad, Ordering::Relaxed);
        Stats::default()
    }
}
