//! What is packed comes back, whatever it is.

use pack::compress::{compress, costs, decompress, model};
use pack::rewrite::search::Price;
use pack_model::form::{Form, convert};
use pack_model::parse::Parser;
use pack_model::tuned::SETS;
use proptest::prelude::*;

/// Bytes between arbitrary and code-like: common opcodes, small numbers, zeros.
fn texts() -> impl Strategy<Value = Vec<u8>> {
    let common = prop::sample::select(b"\x00\xff\x48\x8b\x89\x0f\xc5\xc4\xe8\xe9\x84\x05\x24\x66\xc7\x81".to_vec());
    prop_oneof![
        prop::collection::vec(any::<u8>(), 0..600),
        prop::collection::vec(common, 0..600),
        prop::collection::vec(Just(0), 0..3000),
        prop::collection::vec(any::<u8>(), 1..9).prop_map(|part| part.repeat(50)),
    ]
}

/// Instructions in the form that is coded, to their last byte.
fn coded(instructions: &[u8]) -> Vec<u8> {
    let mut all = [instructions, &[0; 4]].concat();
    convert(&mut all, 0, Form::Coded);
    all.truncate(instructions.len());
    all
}

/// Instructions that do not jump, as they are coded.
fn instructions() -> impl Strategy<Value = Vec<u8>> {
    let some: [&[u8]; 8] = [
        b"\xc5\xfc\x58\xc1",
        b"\xc4\xe2\x7d\x18\x44\x24\x08",
        b"\x48\x8b\x44\x24\x10",
        b"\x89\xd8",
        b"\x55",
        b"\xb8\x01\x02\x03\x04",
        b"\x48\x8d\x84\xc8\x00\x01\x00\x00",
        b"\x0f\xb6\xc0",
    ];
    prop::collection::vec(prop::sample::select(some.to_vec()), 0..150).prop_map(|all| coded(&all.concat()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn decompressing_undoes_compressing(text in texts(), a in 0u32..700, b in 0u32..700) {
        let packed = compress(&SETS, &text, [a, b, 0x40_0000]);
        prop_assert_eq!(&decompress(&SETS, &packed, text.len(), [a, b, 0x40_0000]), &text);
        // The costs are those of the packed bytes, up to the rounding of the coder.
        let bits: f32 = costs(&SETS, &text, [a, b, 0x40_0000]).iter().map(|cost| cost.0).sum();
        prop_assert!((bits / 8.0 - packed.len() as f32).abs() < 3.0 + bits / 800.0);
    }

    /// A model that has gone back codes what comes as one that was never there.
    #[test]
    fn going_back_undoes(start in instructions(), lost in instructions(), rest in instructions(), code in 0u32..700) {
        let bits = |lost: &[&[u8]]| {
            let mut model = model(&SETS, [0, code, 0x40_0000]);
            let before = model.price(start.iter().copied());
            for text in lost {
                model.mark();
                model.price(text.iter().copied());
                // Back to a second mark, which is forgotten then, and what comes after it stays until the first one.
                model.mark();
                model.price(start.iter().copied());
                model.back_to_mark();
                model.price(rest.iter().copied());
                model.unmark();
                model.price(text.iter().copied());
                model.back_to_mark();
                model.unmark();
            }
            (before, model.price(rest.iter().copied()), model.position())
        };
        prop_assert_eq!(bits(&[]), bits(&[&lost, &rest, &lost]));
    }

    #[test]
    fn plain_undoes_coded(text in texts(), address: u32) {
        let mut there = text.clone();
        convert(&mut there, address, Form::Coded);
        convert(&mut there, address, Form::Plain);
        prop_assert_eq!(there, text);
    }
}

#[test]
fn calls_to_one_place_become_alike() {
    let mut code = *b"\xe8\x0b\0\0\0\x90\xe8\x05\0\0\0";
    convert(&mut code, 0x40_0000, Form::Coded);
    assert_eq!(&code, b"\xe8\x10\0\x40\0\x90\xe8\x10\0\x40\0");
}

/// What is done comes before the registers that it is done to.
#[test]
fn instructions_that_differ_in_registers_begin_alike() {
    // vaddps ymm0, ymm0, [rsp + 32] and vaddps ymm9, ymm3, [rsp + 32], in bits: 1 00 01011 000, then R and vvvv; 01 100, then
    // the register.
    let one = coded(b"\xc5\xfc\x58\x44\x24\x20");
    let other = coded(b"\xc5\x64\x58\x4c\x24\x20");
    assert_eq!(one, [0xc5, 0x8b, 0x1f, 0x60, 0x24, 0x20]);
    assert_eq!(other, [0xc5, 0x8b, 0x0c, 0x61, 0x24, 0x20]);
}

/// As the GNU assembler has them.
#[test]
fn instructions_end_where_they_end() {
    let instructions: [&[u8]; 24] = [
        b"\x90",                                     // nop
        b"\x00\xc0",                                 // add al, al
        b"\x48\x89\xe5",                             // mov rbp, rsp
        b"\x48\x8b\x44\x24\x08",                     // mov rax, [rsp + 8]
        b"\x48\x8d\x05\x10\x00\x00\x00",             // lea rax, [rip + 16]
        b"\x81\x3d\x01\x00\x00\x00\x02\0\0\0",       // cmp dword [rip + 1], 2
        b"\x66\xc7\x00\x01\x00",                     // mov word [rax], 1
        b"\x48\xb8\x01\x02\x03\x04\x05\x06\x07\x08", // mov rax, imm64
        b"\xe8\x00\x00\x00\x00",                     // call
        b"\x0f\x84\x00\x00\x00\x00",                 // je
        b"\x74\x00",                                 // je, short
        b"\xf6\xc1\x01",                             // test cl, 1
        b"\xf7\xc1\x01\x00\x00\x00",                 // test ecx, 1
        b"\xf7\xd9",                                 // neg ecx
        b"\x8b\x04\x25\x00\x00\x40\x00",             // mov eax, [0x400000]
        b"\xf3\x0f\x10\x45\xfc",                     // movss xmm0, [rbp - 4]
        b"\x66\x0f\x3a\x0f\xc1\x08",                 // palignr xmm0, xmm1, 8
        b"\x0f\x38\xf0\x07",                         // movbe eax, [rdi]
        b"\xc5\xf8\x77",                             // vzeroupper
        b"\xc5\xfc\x58\x44\x24\x20",                 // vaddps ymm0, ymm0, [rsp + 32]
        b"\xc5\xfc\xc6\xc1\x1b",                     // vshufps ymm0, ymm0, ymm1, 27
        b"\xc4\xe2\x7d\x18\x05\x00\x00\x00\x00",     // vbroadcastss ymm0, [rip]
        b"\xc4\xe3\x7d\x19\xc1\x01",                 // vextractf128 xmm1, ymm0, 1
        b"\xc4\xe2\x75\xb8\x84\x88\x00\x01\0\0",     // vfmadd231ps ymm0, ymm1, [rax + 4 * rcx + 256]
    ];
    let mut parser = Parser::START;
    for instruction in instructions {
        let ends: Vec<_> = coded(instruction).iter().map(|&byte| (parser.step(byte), parser.done).1).collect();
        let expected: Vec<_> = (1..=ends.len()).map(|i| i == ends.len()).collect();
        assert_eq!(ends, expected, "{instruction:02x?}");
    }
}
