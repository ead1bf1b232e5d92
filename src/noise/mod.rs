//! Gradient noise: Perlin's improved noise `[Perlin02]` and sums of its octaves.
//!
//! At each point of the integer lattice stands one of twelve gradients, chosen by a hash of the point. The noise at a
//! point in space is a blend of the eight corners of its cell, each of which adds the product of its gradient and the
//! offset from it. The blend's weights are a quintic, so that the first two derivatives are continuous across cells.
//!
//! The files, from the plain truth to the fastest kernel; all give the same bits:
//!
//! - [`mod@reference`]: one point at a time, as Perlin wrote it. The tests hold everything else against it.
//! - `permutation`: his table, from which both hashes and gradients are taken.
//! - `curve`: his weights and the interpolation, over lanes.
//! - `wide`: 64 points at any SIMD level. Hashes are looked up one by one, everything else is over lanes.
//! - `avx2`: 64 points, whose hashes are looked up once for each run of points in one cell.
//! - `avx512`: 64 points by byte permutations, which hold the whole table in four registers.
//! - `octaves`: picks the kernel of a SIMD level, and sums octaves, which may fade with the size of a pixel.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod curve;
mod octaves;
mod permutation;
pub mod reference;
mod wide;

#[cfg(feature = "full")]
pub use octaves::evaluated;
pub use octaves::{Footprint, Scratch, noise_block, octaves, octaves_block};
pub use reference::{fbm, noise, turbulence};
