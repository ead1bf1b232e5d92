//! Numbers in vectors: lanes, blocks of points, elementary functions, random numbers and SIMD levels.
//!
//! # How kernels are written
//!
//! A kernel is written once, generic over [`fearless_simd::Simd`], and compiled for each SIMD level; `dispatch!` picks
//! the level at run time, once per tile and layer. Some habits, which all kernels of the crate share, follow from that
//! and from the 64 kB build, which optimises for size and inlines little that does not ask for it:
//!
//! - Nothing is fused and no sum is reordered, so that every level gives the same bits.
//! - The functions that a kernel is made of are `#[inline(always)]`. A function that is called instead does not have
//!   the caller's target features, and passes vectors through memory. So do closures, among them those of `array::map`.
//! - Inner loops are `while` loops, since the iterator of a `for` loop may become a call in each round.
//! - Blocks are arrays of constant length ([`block::BLOCK`]), since each range of a slice is a call and a check.
//! - A `usize` becomes a float through [`math::to_f32`].

pub mod block;
pub mod hash;
pub mod lanes;
pub mod level;
pub mod math;
