//! Sound in closed form: a sample is a function of its number and of the score, whatever was played before it.
//!
//! A [`Score`] is a list of [`Note`]s, each played by a [`Voice`] of two operators of frequency modulation
//! `[Chowning73]` and hashed noise. Notes are evaluated in blocks of [`BLOCK`] samples, which start at multiples of it:
//! amplitudes and modulation are computed at a block's ends and run along lines between them, phases are whole numbers
//! and exact. So no sample depends on where one starts to listen.
//!
//! Echo and room are sums of what sounded before (`room.rs`), not recursions: what a sample takes of them is evaluated
//! anew after a jump, and kept while one listens on.

mod note;
mod room;
mod samples;
mod score;
mod voice;

pub use crate::simd::block::BLOCK;
pub use note::Note;
pub use samples::{Pair, RATE};
pub use score::Score;
pub use voice::{Voice, exp2};
