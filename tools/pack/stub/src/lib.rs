//! What a packed executable begins with: unpacks the payload behind it into memory and runs it there.
//!
//! No libc, nothing but the kernel. `tools/pack` links it flat (`stub.ld`) and writes the ELF header.
//! Arguments, environment, exit status and even `argv[0]` are those of the packed file.
#![no_std]
#![no_main]

mod run;
mod sys;

use pack_model::address::{Way, convert};
use pack_model::coder::Decoder;
use pack_model::features::hash;
use pack_model::model::MOST;
use pack_model::tuned::SETS;

/// Comes straight from `_start`, with the stack as the kernel left it: argc, argv, 0, envp, 0.
fn main(stack: &sys::Stack) -> ! {
    if !sys::has_avx2() {
        sys::fail(b"paprsek: needs a processor with AVX2 (x86-64-v3, from 2013 on)\n");
    }
    let image = sys::image();
    let Some(head) = Head::read(image) else { sys::fail(b"paprsek: this file is damaged\n") };
    let model = sys::model();
    let primer = sys::code();
    model.start(&SETS, primer, head.code);
    let mut decoder = Decoder::new(head.packed);
    while model.position() < head.end {
        let bit = decoder.decode(model.predict());
        model.update(bit);
    }
    let text = model.text();
    if let Some(code) = text.get_mut(head.code[0] as usize..head.code[1] as usize) {
        convert(code, head.address, Way::Relative);
    }
    run::run(text.get(primer.len()..head.end).unwrap_or(&[]), stack)
}

/// The payload: four words, the coded bytes, and the checksum of all before.
struct Head {
    /// Bytes unpacked, behind the primer, which is this code.
    end: usize,
    /// Where in both instructions start and end.
    code: [u32; 2],
    /// Where the first instruction will be in memory.
    address: u32,
    packed: &'static [u8],
}

impl Head {
    /// None if anything in the file is not as it was packed.
    fn read(image: &'static [u8]) -> Option<Self> {
        let (image, sum) = image.split_last_chunk()?;
        let (words, packed) = image.get(sys::payload_offset()..)?.split_first_chunk::<16>()?;
        let word = |i| u32::from_le_bytes([words[i], words[i + 1], words[i + 2], words[i + 3]]);
        let head = Self { end: word(0) as usize, code: [word(4), word(8)], address: word(12), packed };
        let found = image.iter().fold(0, |sum, &byte| hash(sum, byte as u32));
        (found == u32::from_le_bytes(*sum) && head.end <= MOST).then_some(head)
    }
}
