//! SIMD levels: which this machine has, and what they are called.

use fearless_simd::{Level, Simd, dispatch};

/// The best SIMD level of this machine.
///
/// Every level gives the same bits, so which one a kernel runs at is a question of speed alone.
pub fn best() -> Level {
    // What was built for processors with AVX2 need not look for it: 0.8 kB packed.
    if cfg!(target_feature = "avx2") { Level::baseline() } else { Level::new() }
}

/// The name of the level that kernels run at when they are asked for `level`: `avx512`, `avx2`, `sse4.2`, `sse2`,
/// `neon`, `simd128` or `scalar`.
///
/// A build may hold kernels for fewer levels than the machine has; then it is the name of the one that runs.
pub fn name(level: Level) -> &'static str {
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
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        Level::WasmSimd128(_) => "simd128",
        _ => "scalar",
    }
}

/// Every SIMD level of this machine with its name, the best first.
pub fn all() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let levels = [
        ("avx512", best.as_avx512().map(Level::Avx512)),
        ("avx2", best.as_avx2().map(Level::Avx2)),
        ("sse4.2", best.as_sse4_2().map(Level::Sse4_2)),
        ("sse2", best.as_sse2().map(Level::Sse2)),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let levels = [(name(best), Some(best))];
    levels.into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
}
