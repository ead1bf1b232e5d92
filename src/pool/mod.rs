//! Threads that draw the bands of a frame.
//!
//! rayon's workers wait for the next frame; in the 64 kB build, which has no rayon, threads live for a frame.

#[cfg(not(feature = "rayon"))]
mod scoped;
#[cfg(feature = "rayon")]
mod workers;

#[cfg(not(feature = "rayon"))]
pub use scoped::Pool;
#[cfg(feature = "rayon")]
pub use workers::Pool;
