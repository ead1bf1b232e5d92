//! Truths that are not ours: numbers without rounding, crossings by the textbook, and where cases come from.
#![allow(dead_code)] // Every test takes its part.

pub mod exact;
pub mod random;
pub mod span;

/// Rounding of one f32 operation, relative: 2^-24, the 6e-8 of the targets.
pub const ULP: f64 = 1.0 / 16_777_216.0;
