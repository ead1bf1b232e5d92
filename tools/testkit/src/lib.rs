//! What Paprsek's tests, benches and tools share: oracles, pictures and metrics, and running the program.

// Oracles of renderers, for what the 64 kB build may leave out.
#[cfg(feature = "full")]
pub mod bodies;
#[cfg(feature = "full")]
pub mod coverage;
#[cfg(feature = "full")]
pub mod depth_map;
pub mod drawn;
pub mod elementary;
#[cfg(feature = "full")]
pub mod exact;
pub mod flip;
pub mod found;
pub mod frames;
pub mod fresnel;
#[cfg(feature = "full")]
pub mod lines;
pub mod metrics;
mod needs;
#[cfg(feature = "full")]
pub mod particles;
pub mod perlin;
pub mod picture;
pub mod random;
pub mod run;
pub mod sky;
#[cfg(feature = "full")]
pub mod span;
#[cfg(feature = "full")]
pub mod sprites;
pub mod sunny;
#[cfg(feature = "full")]
pub mod voxels;

pub use found::Found;
pub use needs::{Tool, left_out, needs};
pub use paprsek::simd::level::all as levels;

/// Rounding of one f32 operation, relative: 2^-24.
pub const ULP: f64 = 1.0 / 16_777_216.0;

/// The median; of an even number of values the mean of the middle two.
pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let half = values.len() / 2;
    if values.len().is_multiple_of(2) { 0.5 * (values[half - 1] + values[half]) } else { values[half] }
}
