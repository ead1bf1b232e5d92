//! Builds the intro for size, packs it, and says where the bytes go.

pub mod build;
pub mod compress;
pub mod elf;
pub mod encoder;
pub mod first;
mod library;
pub mod link;
pub mod marginal;
pub mod order;
pub mod packer;
pub mod pieces;
pub mod reloads;
pub mod rewrite;
pub mod shuffle;
pub mod stub;
pub mod table;
pub mod toolchain;
