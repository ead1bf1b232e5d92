//! Puts the unpacker and the coded program into one executable.

use crate::compress::{compress, costs, decompress};
use crate::elf::{self, HEADER, SEGMENT, Trimmed};
use crate::first;
use pack_model::features::hash;
use pack_model::form::{Form, convert};
use pack_model::model::MOST;
use pack_model::tuned::SETS;

/// Where the packed file is mapped; the unpacker is linked for it (`stub.ld`).
const BASE: u64 = 0x40_0000;
/// The file's own headers: the unpacker's code follows.
const HEADERS: usize = HEADER + SEGMENT;

/// A packed executable and where its bytes went.
pub struct Packed {
    /// The file.
    pub bytes: Vec<u8>,
    /// Bytes of the program before coding.
    pub trimmed: usize,
    /// Bytes of ELF headers.
    pub headers: usize,
    /// Bytes of the unpacker.
    pub stub: usize,
    /// Bytes of the coded program, with its lengths and checksum.
    pub payload: usize,
}

/// The program as it is coded: trimmed, with absolute addresses.
fn prepare(file: &[u8]) -> Result<Trimmed, String> {
    let mut trimmed = elf::trim(file)?;
    if trimmed.bytes.len() > MOST {
        return Err(format!("{} bytes, but the unpacker has room for {MOST}", trimmed.bytes.len()));
    }
    convert(&mut trimmed.bytes[trimmed.code.clone()], trimmed.code_address as u32, Form::Coded);
    Ok(trimmed)
}

/// Packs an executable. `stub` is the linked unpacker ([`crate::stub::build`]).
pub fn pack(file: &[u8], stub: &[u8]) -> Result<Packed, String> {
    let [one, two] = stages(stub)?;
    let program = prepare(file)?;
    let code = program.code();
    let mut unpacker = one.to_vec();
    unpacker.extend(first::compress(two));

    let mut payload = Vec::new();
    for word in [program.bytes.len() as u32, code[0], code[1], code[2]] {
        payload.extend(word.to_le_bytes());
    }
    let coded = compress(&SETS, &program.bytes, code);
    if decompress(&SETS, &coded, program.bytes.len(), code) != program.bytes {
        return Err("the coded program does not decode".into());
    }
    payload.extend(coded);

    let payload_at = HEADERS + unpacker.len();
    let length = (payload_at + payload.len() + 4) as u64;
    let mut bytes = b"\x7fELF\x02\x01\x01\0\0\0\0\0\0\0\0\0\x02\0\x3e\0\x01\0\0\0".to_vec();
    bytes.extend((BASE + HEADERS as u64).to_le_bytes());
    bytes.extend((HEADER as u64).to_le_bytes());
    bytes.extend([0; 12]);
    for half in [HEADER, SEGMENT, 1, 0, 0, 0] {
        bytes.extend((half as u16).to_le_bytes());
    }
    // All of the file, readable and executable. Its physical address, of no use to the kernel, tells the unpacker
    // where the payload is.
    bytes.extend([1, 0, 0, 0, 5, 0, 0, 0]);
    for word in [0, BASE, BASE + payload_at as u64, length, length, 0x1000] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(&unpacker);
    bytes.extend(&payload);
    let sum = bytes.iter().fold(0, |sum, &byte| hash(sum, byte as u32));
    bytes.extend(sum.to_le_bytes());
    Ok(Packed {
        bytes,
        trimmed: program.bytes.len(),
        headers: HEADERS,
        stub: unpacker.len(),
        payload: payload.len() + 4,
    })
}

/// The two stages of the unpacker. The first is in the file as it is; the second is coded for it.
pub fn stages(stub: &[u8]) -> Result<[&[u8]; 2], String> {
    let all = elf::segments(stub)?;
    let mut stages = all.iter().filter(|s| s.kind == 1 && s.flags & 1 != 0);
    let (Some(one), Some(two)) = (stages.next(), stages.next()) else { return Err("the stub lacks a stage".into()) };
    let entry = u64::from_le_bytes(stub[24..32].try_into().expect("segments() has read the header"));
    if (entry, one.address) != (BASE + HEADERS as u64, BASE + HEADERS as u64) {
        return Err("the stub is not linked as it should be".into());
    }
    Ok([one, two].map(|s| &stub[s.file.clone()]))
}

/// What the coded program costs, byte by byte.
pub struct Costs {
    /// Bits, by offset in the file that was packed.
    pub bits: Vec<f32>,
    loads: Vec<elf::Segment>,
}

impl Costs {
    /// Bits that the byte at a virtual address costs; 0 where nothing of the file is.
    pub fn bits(&self, address: u64) -> f32 {
        let within = |s: &&elf::Segment| address >= s.address && address - s.address < s.file.len() as u64;
        let offset = |s: &elf::Segment| s.file.start + (address - s.address) as usize;
        self.loads.iter().find(within).and_then(|s| self.bits.get(offset(s))).copied().unwrap_or(0.0)
    }
}

/// Measures what each byte of `file` costs in `pack`.
pub fn measure(file: &[u8]) -> Result<Costs, String> {
    let program = prepare(file)?;
    let code = program.code();
    let bits = costs(&SETS, &program.bytes, code).into_iter().map(|cost| cost.0).collect();
    Ok(Costs { bits, loads: program.loads })
}
