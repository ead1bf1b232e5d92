//! What Paprsek's tests, benches and report share: oracles, pictures and metrics, and running the program.

pub mod drawn;
pub mod frames;
pub mod metrics;
mod needs;
pub mod picture;
pub mod random;
pub mod run;

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
