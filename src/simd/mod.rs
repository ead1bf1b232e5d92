//! Numbers in vectors: lanes, blocks, elementary functions and hashes over them.

pub mod block;
pub mod hash;
pub mod lanes;
pub mod level;
pub mod math;
