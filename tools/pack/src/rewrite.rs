//! Rewrites the linked program into an equal one that packs better: in each basic block the order of the instructions, and
//! of operands that commute, is what the model codes in the fewest bits.
//!
//! A compiler chooses among such orders for reasons that mean nothing here, and each choice costs bits. So the text is coded
//! from its start, block by block; at each block other orders are tried, and the model goes on with the cheapest. No
//! instruction leaves its block and none changes its length, so that no address in the program changes.
//!
//! Tried on 61,284 bytes of coded program, in bytes less: operands 168, base and index 23, floating-point forms of
//! moves and logic 136, orders 750 more, together 1,211 in one pass, 75 more in a second one and 40 in a third; in a fourth
//! none. A pass that looks 0, 2 or 4 instructions beyond its window instead of 1: 310, 120 and 130 bytes less of that.
//! Other registers for values that live and die within a window: 686 of 80,000 tried names were better, for 49 bytes; the
//! register of an operand that dies, wherever there is one: 330 bytes more. `mov a, b` and its likes by the opcode that has
//! the operands the other way round: 11 bytes more. Orders of stores through one register: nothing.
//!
//! Tried on a packed file of 61,684 bytes, where single instructions moved: exchanged runs of up to 2, 3, 4, 6 instructions and
//! of any length give 61,559, 61,522, 61,493, 61,457 and 61,447 bytes. Ways given up 0.5, 1, 2 or 4 bits behind instead of
//! 1.5: 75 to 140 bytes more, chance for the most part. Each half of the program by a thread of its own, from what comes before
//! it as it was: 220 bytes more, 130 after five passes.
//!
//! The unpacker is rewritten too, for the simple model that it is coded with: 69 of 3,493 bytes.

mod instruction;
pub mod search;
mod window;

use crate::compress::model;
use crate::elf::{self, Trimmed};
use crate::first;
use iced_x86::{Decoder, DecoderOptions, InstructionInfoFactory, OpKind};
use instruction::Op;
use pack_model::form::{Form, convert};
use pack_model::tuned::SETS;
use search::Price;
use std::collections::HashSet;
use std::ops::Range;

/// How often the whole program is gone through.
const PASSES: usize = 3;

/// Rewrites an executable.
pub fn rewrite(file: &[u8]) -> Result<Vec<u8>, String> {
    let mut file = file.to_vec();
    for _ in 0..PASSES {
        file = pass(&file)?;
    }
    Ok(file)
}

fn pass(file: &[u8]) -> Result<Vec<u8>, String> {
    let mut program = elf::trim(file)?;
    let (range, address) = (program.code.clone(), program.code_address);
    let original = program.bytes[range.clone()].to_vec();
    // What is relative to an instruction's place is absolute from here on, so that it can move.
    convert(&mut program.bytes[range.clone()], address as u32, Form::Coded);
    let instructions = read(&program, &original, Form::Coded)?;
    let mut model = model(&SETS, program.code());
    model.price(program.bytes[..range.start].iter().copied());
    let mut code = Vec::with_capacity(original.len());
    search::search(&mut *model, instructions, &mut code);
    convert(&mut code, address as u32, Form::Plain);
    let mut rewritten = file.to_vec();
    rewritten[range].copy_from_slice(&code);
    Ok(rewritten)
}

/// Rewrites bytes that begin with instructions, at these addresses, and are coded as they are, by [`first`].
pub fn rewrite_alone(bytes: &mut [u8], addresses: Range<u64>) -> Result<(), String> {
    let code = 0..(addresses.end - addresses.start) as usize;
    for _ in 0..PASSES {
        let program = Trimmed {
            bytes: bytes.to_vec(),
            code: code.clone(),
            code_parts: vec![code.clone()],
            code_address: addresses.start,
            loads: Vec::new(),
        };
        let mut instructions = read(&program, &bytes[code.clone()], Form::Plain)?;
        instructions.iter_mut().for_each(Op::stay_if_relative);
        let mut rewritten = Vec::with_capacity(code.len());
        search::search(&mut first::Counts::default(), instructions, &mut rewritten);
        bytes[code.clone()].copy_from_slice(&rewritten);
    }
    Ok(())
}

/// The instructions, which are known as they were in `original` and have the bytes of `program`, in this form.
fn read(program: &Trimmed, original: &[u8], form: Form) -> Result<Vec<Op>, String> {
    let (start, first) = (program.code.start, program.code_address);
    let code = first..first + original.len() as u64;
    let mut starts = addresses(&program.bytes, &program.code, &code);
    let constants = program.loads.iter().find(|load| load.address <= first && first - load.address < load.memory);
    let constants = constants.map_or(0..0, |load| load.address..load.address + load.memory);
    let mut factory = InstructionInfoFactory::new();
    let (mut all, mut jumps) = (Vec::new(), HashSet::new());
    let mut at = start;
    for part in &program.code_parts {
        // Zeros between sections.
        all.extend((at < part.start).then(|| Op::filler(&program.bytes[at..part.start])));
        let bytes = &original[part.start.max(at) - start..part.end - start];
        at = part.end.max(at);
        let address = first + (at - bytes.len() - start) as u64;
        let mut decoder = Decoder::with_ip(64, bytes, address, DecoderOptions::NONE);
        while decoder.can_decode() {
            let instruction = decoder.decode();
            jumps.insert(instruction.near_branch64());
            for k in 0..instruction.op_count() {
                starts.extend(match instruction.op_kind(k) {
                    OpKind::Immediate32 | OpKind::Immediate64 | OpKind::Immediate32to64 => {
                        Some(instruction.immediate(k))
                    }
                    OpKind::Memory => Some(instruction.memory_displacement64()),
                    _ => None,
                });
            }
            let at = start + (instruction.ip() - first) as usize;
            all.push(Op::new(&mut factory, instruction, &program.bytes[at..at + instruction.len()], form, &constants));
        }
    }
    // The last four bytes are not converted: so nothing comes to lie there.
    all.iter_mut().rev().take(5).for_each(|op| op.fixed = true);
    for op in &mut all {
        op.starts_block = starts.contains(&op.address()) | jumps.remove(&op.address());
    }
    match jumps.into_iter().find(|to| code.contains(to)) {
        Some(to) => Err(format!("what is jumped to at {to:#x} is no instruction")),
        None => Ok(all),
    }
}

/// What may be addresses of instructions in the rest of the file, tables of jumps among them.
fn addresses(bytes: &[u8], within: &Range<usize>, code: &Range<u64>) -> HashSet<u64> {
    let words = bytes.windows(8).enumerate().filter(|(at, _)| !within.contains(at));
    let words = words.map(|(_, word)| u64::from_le_bytes(word.try_into().expect("it has eight")));
    words.filter(|word| code.contains(word)).collect()
}
