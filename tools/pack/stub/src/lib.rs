//! What a packed executable begins with: unpacks the payload behind it into memory and runs it there.
//!
//! No libc, nothing but the kernel. `tools/pack` links it flat (`stub.ld`) and writes the ELF header.
//! Arguments, environment, exit status and even `argv[0]` are those of the packed file.
#![no_std]
#![no_main]

mod run;
mod sys;

use pack_model::coder::Decoder;
use pack_model::features::hash;
use pack_model::form::{Form, convert};
use pack_model::tuned::SETS;

/// Comes straight from `_start`, with the stack as the kernel left it: argc, argv, 0, envp, 0.
fn main(stack: &sys::Stack) -> ! {
    if !sys::has_avx2() {
        sys::fail(b"paprsek: needs a processor with AVX2\n");
    }
    if !is_right(sys::image()) {
        sys::fail(b"paprsek: this file is damaged\n");
    }
    let (head, mut packed) = sys::payload();
    let model = sys::model();
    model.start(&SETS, head.code);
    let mut decoder = Decoder::START;
    while model.position() < head.end as usize {
        let bit = decoder.decode(model.predict(), |n| packed.append_to(n));
        model.update(bit);
    }
    let [start, end, address] = model.code;
    convert(sys::part(model.text(), start, end), address, Form::Plain);
    run::run(sys::part(model.text(), 0, head.end), stack)
}

/// Does the file have its checksum?
fn is_right((image, sum): (&[u8], u32)) -> bool {
    sum == image.iter().fold(0, |sum, &byte| hash(sum, byte as u32))
}

/// What the payload begins with. The coded bytes follow, and the checksum of all before.
#[repr(C, packed)]
struct Head {
    /// Length of the program.
    end: u32,
    /// Where in it the instructions start and end, and where the first one will be in memory.
    code: [u32; 3],
}
