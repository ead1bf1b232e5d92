//! Sound.

/// Samples per second.
pub const RATE: u32 = 44_100;

/// A score.
pub struct Score {
    /// The number of samples that it is long.
    pub length: u64,
}

impl Score {
    /// Samples.
    pub fn samples(&self, first: u64, out: &mut [[i16; 2]]) {
        for (n, sample) in (first..).zip(out) {
            let x = if n < self.length { crate::angle::sin((n % 441_000) as f32 * 0.0627) } else { 0.0 };
            *sample = [(x * 8000.0) as i16, (x * x * 8000.0) as i16];
        }
    }
}
