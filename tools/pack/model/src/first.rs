//! Constants of the simple model that the second stage of the unpacker is coded with: `stub/src/first.s` decodes what
//! `src/first.rs` of the packer codes.

/// Contexts: one byte each, whose bits say which bytes before the current one belong to it, the highest the last
/// byte. The lowest must be zero and no other, and there must be eight.
pub const CONTEXTS: u64 = 0x9060_40a8_a0c0_8000;
/// The hash multiplies by this for each byte.
pub const MULTIPLIER: u32 = 0x9e37_79b1;
/// Logarithm of the number of pairs of counts.
pub const TABLE_BITS: u32 = 22;
/// What zeros and ones are taken to have been seen before there is any count.
pub const PRIOR: u32 = 8;
/// What the second stage ends with. No model would guess it.
pub const END: u32 = 0x5d8a_e3b4;
