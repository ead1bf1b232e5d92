//! The unpacker's model, decoder and form of instructions with any payload, and with what the packer makes of any program.

use crate::input::Input;
use pack::compress::{compress, decompress};
use pack_model::form::{Form, convert};
use pack_model::tuned::SETS;

/// Most bytes that are coded, so that an input takes milliseconds.
const MOST: usize = 300;

pub fn run(bytes: &[u8]) {
    let mut input = Input::new(bytes);
    let (kind, length) = (input.below(3), input.below(MOST));
    // Where instructions are may be nonsense, even backwards or outside.
    let code = if input.flag() {
        [input.below(MOST) as u32, input.below(MOST) as u32, input.word()]
    } else {
        [input.word() >> 1, input.word(), input.word()]
    };
    let rest = input.rest();
    let rest = &rest[..rest.len().min(MOST)];
    match kind {
        0 => {
            let packed = compress(&SETS, rest, code);
            assert!(packed.len() <= rest.len() + rest.len() / 4 + 64, "{} for {}", packed.len(), rest.len());
            assert!(decompress(&SETS, &packed, rest.len(), code) == rest, "another program comes out");
            // What lacks its end, or has lost a bit, still ends.
            let damaged = &packed[..packed.len() / 2];
            assert_eq!(decompress(&SETS, damaged, rest.len(), code).len(), rest.len());
        }
        1 => assert_eq!(decompress(&SETS, rest, length, code).len(), length),
        _ => {
            let mut text = rest.to_vec();
            convert(&mut text, code[2], Form::Coded);
            assert!(text.len() == rest.len());
            convert(&mut text, code[2], Form::Plain);
            assert!(text == rest, "instructions do not come back");
        }
    }
}
