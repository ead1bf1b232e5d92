//! The model's use on this side: coding with it, and asking what each byte costs.

use pack_model::coder::{Decoder, Encoder};
use pack_model::model::{LINES, Line, MOST, Model, Sets, State};

/// The memory of a model, on the heap.
pub struct Memory {
    table: Box<[Line; LINES]>,
    text: Box<[u8; MOST]>,
    state: Box<State>,
}

impl Default for Memory {
    fn default() -> Self {
        Self { table: zeros(), text: zeros(), state: Box::new(State::ZERO) }
    }
}

/// An array of zeros that never was on the stack.
fn zeros<T: Copy + Default, const N: usize>() -> Box<[T; N]>
where
    [T; N]: Sized,
{
    match vec![T::default(); N].into_boxed_slice().try_into() {
        Ok(array) => array,
        Err(_) => unreachable!("the length is the array's"),
    }
}

impl Memory {
    /// A model that knows nothing yet.
    pub fn model<'a>(&'a mut self, sets: &'a Sets, code: (usize, usize)) -> Model<'a> {
        Model::new(sets, &mut self.table, &mut self.text, &mut self.state, code)
    }
}

/// Codes `text`.
pub fn compress(sets: &Sets, text: &[u8], code: (usize, usize)) -> Vec<u8> {
    let mut memory = Memory::default();
    let mut model = memory.model(sets, code);
    let (mut encoder, mut out) = (Encoder::default(), Vec::new());
    for byte in text {
        for i in (0..8).rev() {
            let bit = (byte >> i & 1) as u32;
            encoder.encode(bit, model.predict(), |byte| out.push(byte));
            model.update(bit);
        }
    }
    out.push(encoder.finish());
    out
}

/// What [`compress`] coded as `packed`, a text of `length` bytes.
pub fn decompress(sets: &Sets, packed: &[u8], length: usize, code: (usize, usize)) -> Vec<u8> {
    let mut memory = Memory::default();
    let mut model = memory.model(sets, code);
    let mut decoder = Decoder::new(packed);
    while model.position() < length {
        let bit = decoder.decode(model.predict());
        model.update(bit);
    }
    memory.text[..length].to_vec()
}

/// Bits that each byte of `text` costs, and what kind of byte the model took it for.
pub fn costs(sets: &Sets, text: &[u8], code: (usize, usize)) -> Vec<(f32, usize)> {
    let mut memory = Memory::default();
    let mut model = memory.model(sets, code);
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
