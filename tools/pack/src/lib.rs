//! Packs an ELF executable into a smaller one that unpacks and runs it.
pub mod compress;
