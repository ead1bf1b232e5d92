//! SIMD levels. Every level gives the same bits.

use fearless_simd::{Level, Simd, dispatch};

/// The best SIMD level of this machine.
pub fn best() -> Level {
    // A build for processors with AVX2 does not look for it: 0.8 kB packed.
    if cfg!(target_feature = "avx2") { Level::baseline() } else { Level::new() }
}

/// The name of the level that code dispatched at `level` runs at: `avx512`, `avx2`, `sse4.2`, `sse2`, `neon` or `scalar`.
pub fn name(level: Level) -> &'static str {
    // What runs, which a build may hold below what the machine has.
    match dispatch!(level, simd => simd.level()) {
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
