//! Paprsek as a WebAssembly module: some rows of any scene at any time, size and quality, with any parameters.
//!
//! The module imports nothing and exports what [`exports`] has, all of it plain numbers: text and pixels lie in its memory.
//! Several instances of it share nothing, since a frame is a pure function of what is asked for. The page beside it,
//! `web/page`, runs one per core in workers, and one in the page itself, which renders nothing.

pub mod describe;
pub mod exports;
/// The program's own rule for the size of frames.
#[path = "../../src/bin/paprsek/governor.rs"]
mod governor;
pub mod rows;
