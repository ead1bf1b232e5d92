//! The SIMD levels of this machine.

use fearless_simd::Level;

/// Every SIMD level of this machine by name, the best first.
pub fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let levels = [
        ("avx512", best.as_avx512().map(Level::Avx512)),
        ("avx2", best.as_avx2().map(Level::Avx2)),
        ("sse4.2", best.as_sse4_2().map(Level::Sse4_2)),
        ("sse2", best.as_sse2().map(Level::Sse2)),
    ];
    #[cfg(not(target_arch = "x86_64"))]
    let levels = [("best", Some(best))];
    levels.into_iter().filter_map(|(name, level)| Some((name, level?))).collect()
}
