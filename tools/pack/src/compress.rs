//! The model's use on this side: coding with it, and asking what each byte costs.

use crate::encoder::Encoder;
use pack_model::coder::Decoder;
use pack_model::model::{Model, Sets};
use std::alloc::{Layout, alloc_zeroed, handle_alloc_error};

/// A model at the start of the text, on the heap: 80 MB that must not pass through the stack.
#[allow(unsafe_code)]
pub fn model(sets: &Sets, code: [u32; 3]) -> Box<Model> {
    let layout = Layout::new::<Model>();
    // SAFETY: the memory has the layout of a model, and zeros are one: it consists of numbers, of falses, and of an
    // Option<Box>, whose zeros are None.
    let mut model = unsafe {
        let memory = alloc_zeroed(layout);
        if memory.is_null() {
            handle_alloc_error(layout);
        }
        Box::from_raw(memory.cast::<Model>())
    };
    // As the program that is packed does.
    assert!(is_x86_feature_detected!("avx2"), "packing needs a processor with AVX2");
    model.start(sets, code);
    model
}

/// Codes `text`, whose instructions are from byte `code[0]` to `code[1]`, and at `code[2]` in memory.
pub fn compress(sets: &Sets, text: &[u8], code: [u32; 3]) -> Vec<u8> {
    let mut model = model(sets, code);
    let mut encoder = Encoder::default();
    for byte in text {
        for i in (0..8).rev() {
            let bit = (byte >> i & 1) as u32;
            let p = model.predict();
            encoder.encode(bit == 1, [65536 - p, p]);
            model.update(bit);
        }
    }
    encoder.finish()
}

/// What [`compress`] coded as `packed`, a text of `length` bytes.
pub fn decompress(sets: &Sets, packed: &[u8], length: usize, code: [u32; 3]) -> Vec<u8> {
    let mut model = model(sets, code);
    let mut decoder = Decoder::START;
    // Zeros follow the last bit, the lowest of each byte first.
    let mut coded = packed.iter().flat_map(|&byte| (0..8).map(move |i| (byte >> i & 1) as u32));
    while model.position() < length {
        let bit = decoder.decode(model.predict(), |n| n << 1 | coded.next().unwrap_or(0));
        model.update(bit);
    }
    model.text()[..length].to_vec()
}

/// Bits that each byte of `text` costs, and what kind of byte the model took it for.
pub fn costs(sets: &Sets, text: &[u8], code: [u32; 3]) -> Vec<(f32, u32)> {
    let mut model = model(sets, code);
    let mut costs = Vec::new();
    for byte in text {
        let (mut sum, kind) = (0.0, model.kind());
        for i in (0..8).rev() {
            let bit = byte >> i & 1;
            let p = model.predict() as f32 / 65536.0;
            sum -= if bit != 0 { p } else { 1.0 - p }.log2();
            model.update(bit as u32);
        }
        costs.push((sum, kind));
    }
    costs
}
