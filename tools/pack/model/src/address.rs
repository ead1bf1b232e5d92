//! Distances of calls, jumps and RIP-relative operands as absolute addresses: what is called, or read, from
//! many places is then the same four bytes each time, and the same as where its address stands in full.

use crate::parse::{IMM8, Parser};

/// Whether distances become addresses or the other way round.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Before packing.
    Absolute,
    /// After unpacking.
    Relative,
}

/// Converts all of `code`, whose first byte is at `address`. The parser looks at no converted byte except
/// to count it, so both ways find the same places and one undoes the other on any bytes whatsoever.
#[inline(never)]
pub fn convert(code: &mut [u8], address: u32, way: Way) {
    let mut parser = Parser::START;
    let mut at = 0;
    while let Some(&byte) = code.get(at) {
        parser.step(byte);
        at += 1;
        if parser.relative == 0 || parser.relative == IMM8 || parser.relative != parser.field() {
            continue;
        }
        let Some(bytes) = code.get_mut(at..).and_then(|rest| rest.first_chunk_mut::<4>()) else { return };
        let mut end = address.wrapping_add(at as u32 + 4 + parser.after_four());
        if way == Way::Relative {
            end = end.wrapping_neg();
        }
        *bytes = u32::from_le_bytes(*bytes).wrapping_add(end).to_le_bytes();
    }
}
