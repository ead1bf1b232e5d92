//! Builds the intro for size, packs it, and says where the bytes go.

pub mod table;
