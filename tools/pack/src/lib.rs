//! Packs an ELF executable into a smaller one that unpacks and runs it.

pub mod compress;
pub mod elf;
pub mod packer;
pub mod stub;
