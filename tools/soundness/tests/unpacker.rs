//! The unpacker's model with a text that is short enough to be interpreted: each place that it reads or writes is held
//! against its bounds.

use pack::compress::{compress, decompress};
use pack_model::address::{Way, convert};
use pack_model::tuned::SETS;

/// A call, a jump, moves with each kind of address, and text.
const TEXT: &[u8] = b"\xe8\x10\x00\x00\x00\x48\x8b\x44\x24\x08\x0f\x84\xf0\xff\xff\xff\xc3abab";

#[test]
fn a_text_comes_back() {
    let code = [0, 17, 0x0040_1000];
    let packed = compress(&SETS, b"\x55\x48\x89\xe5", TEXT, code);
    assert_eq!(decompress(&SETS, b"\x55\x48\x89\xe5", &packed, TEXT.len(), code), TEXT);
}

#[test]
fn bytes_that_nobody_packed_end_too() {
    assert_eq!(decompress(&SETS, &[], &[0xff, 0x00, 0x80], 6, [5, 2, u32::MAX]).len(), 6);
}

#[test]
fn addresses_come_back() {
    let mut text = TEXT.to_vec();
    convert(&mut text, u32::MAX - 8, Way::Absolute);
    convert(&mut text, u32::MAX - 8, Way::Relative);
    assert_eq!(text, TEXT);
}
