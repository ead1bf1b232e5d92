//! SIMD levels.

use fearless_simd::Level;

/// The best SIMD level: any gives the same bits.
pub fn best() -> Level {
    if cfg!(target_feature = "avx2") { Level::baseline() } else { Level::new() }
}
