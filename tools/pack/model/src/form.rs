//! The form in which instructions are coded. It has as many bytes, in the order that is easier to foretell:
//!
//! - the distances of calls, jumps and RIP-relative operands are absolute addresses: what is called, or read, from many places
//!   is then the same four bytes each time, and the same as where its address stands in full;
//! - VEX's last byte, `R vvvv L pp` with R and vvvv naming registers, and the opcode behind it are `L pp opcode R vvvv`: what
//!   is done comes before what it is done to;
//! - of an operands byte the last three bits, which name an address or the second source, come before the middle three.

use crate::parse::{IMM8, MODRM, Parser, TURN, VEX};

/// How instructions are written.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// As the model codes them.
    Coded,
    /// As the processor has them.
    Plain,
}

/// Converts `code`, whose first byte is at `address`, but for what begins within its last four bytes. The parser sees the
/// coded form both ways, but for addresses, which it only counts: so one way undoes the other on any bytes whatsoever.
#[inline(never)]
pub fn convert(mut code: &mut [u8], mut address: u32, to: Form) {
    let mut parser = Parser::START;
    while let Some(bytes) = code.first_chunk_mut::<5>() {
        let field = parser.field();
        if to == Form::Coded {
            reorder(bytes, field, TURN);
        }
        parser.step(bytes[0]);
        let mut taken = 1;
        if field == VEX {
            parser.step(bytes[1]);
            taken = 2;
        }
        address = address.wrapping_add(taken);
        if to == Form::Plain {
            reorder(bytes, field, 16 - TURN);
        }
        // Not after VEX, where bytes that are no program may seem to be a jump.
        if taken == 1 && parser.relative & !IMM8 != 0 && parser.relative == parser.field() {
            let mut end = address.wrapping_add(4 + parser.after_four());
            if to == Form::Plain {
                end = end.wrapping_neg();
            }
            let [_, number @ ..] = bytes;
            *number = u32::from_le_bytes(*number).wrapping_add(end).to_le_bytes();
        }
        code = &mut code[taken as usize..];
    }
}

/// Brings the bits of a field in the other order.
fn reorder(bytes: &mut [u8; 5], field: u32, turn: u32) {
    let [byte, next, ..] = bytes;
    if field == MODRM {
        *byte = *byte & 0xc0 | *byte >> 3 & 7 | *byte << 3 & 0x38;
    }
    if field == VEX {
        [*byte, *next] = u16::from_be_bytes([*byte, *next]).rotate_left(turn).to_be_bytes();
    }
}
