//! Reads an ELF64 executable and leaves out what running it does not need.

use std::ops::Range;

/// Size of the ELF header, of a program header and of a section header, in bytes.
pub const HEADER: usize = 64;
/// See [`HEADER`].
pub const SEGMENT: usize = 56;
const SECTION: usize = 64;

/// Program headers that a running program is not without: LOAD, DYNAMIC, INTERP, TLS, GNU_STACK. PHDR goes (only
/// a position-independent program needs it to find its base), and so do NOTE, GNU_EH_FRAME (where nothing unwinds),
/// GNU_PROPERTY and GNU_RELRO (which only makes pages read-only).
const KEPT: [u32; 5] = [1, 2, 3, 7, 0x6474_e551];
const LOAD: u32 = 1;
const PHDR: u32 = 6;
const EXECUTABLE: u32 = 1;

/// A program header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Segment {
    /// Its type, PT_....
    pub kind: u32,
    /// Bit 0 executable, 1 writable, 2 readable.
    pub flags: u32,
    /// Bytes of the file.
    pub file: Range<usize>,
    /// Virtual address.
    pub address: u64,
    /// Bytes in memory.
    pub memory: u64,
}

/// An executable that holds only what is loaded.
#[derive(Clone, Debug)]
pub struct Trimmed {
    /// The file. Offsets are those of the original, which it is a prefix of but for zeroed bytes.
    pub bytes: Vec<u8>,
    /// From the first to the last instruction: offsets in the file.
    pub code: Range<usize>,
    /// Address of the first instruction.
    pub code_address: u64,
    /// The segments that are loaded.
    pub loads: Vec<Segment>,
}

/// A little-endian number of `size` bytes at `at`.
fn number(bytes: &[u8], at: usize, size: usize) -> Result<u64, String> {
    let bytes = at.checked_add(size).and_then(|end| bytes.get(at..end)).ok_or("the file ends within a header")?;
    Ok(bytes.iter().rev().fold(0, |n, &byte| n << 8 | byte as u64))
}

/// The program headers.
pub fn segments(elf: &[u8]) -> Result<Vec<Segment>, String> {
    if !elf.starts_with(b"\x7fELF\x02\x01") || number(elf, 18, 2)? != 62 {
        return Err("not an ELF file for x86-64".into());
    }
    let (at, count) = (number(elf, 32, 8)? as usize, number(elf, 56, 2)? as usize);
    let mut all = Vec::new();
    for i in 0..count {
        let at = at.checked_add(i * SEGMENT).ok_or("program headers out of range")?;
        let offset = number(elf, at + 8, 8)? as usize;
        let end = offset.checked_add(number(elf, at + 32, 8)? as usize).filter(|&end| end <= elf.len());
        all.push(Segment {
            kind: number(elf, at, 4)? as u32,
            flags: number(elf, at + 4, 4)? as u32,
            file: offset..end.ok_or("a segment lies outside of the file")?,
            address: number(elf, at + 16, 8)?,
            memory: number(elf, at + 40, 8)?,
        });
    }
    Ok(all)
}

/// File ranges of the sections that hold instructions, as far as section headers tell.
fn code_sections(elf: &[u8]) -> Result<Option<Range<usize>>, String> {
    let (at, count) = (number(elf, 40, 8)? as usize, number(elf, 60, 2)? as usize);
    let mut code: Option<Range<usize>> = None;
    for i in 0..if at == 0 { 0 } else { count } {
        let at = at.checked_add(i * SECTION).ok_or("section headers out of range")?;
        // PROGBITS with the flag EXECINSTR.
        if number(elf, at + 4, 4)? == 1 && number(elf, at + 8, 8)? & 4 != 0 {
            let start = number(elf, at + 24, 8)? as usize;
            let end = start.checked_add(number(elf, at + 32, 8)? as usize).ok_or("a section out of range")?;
            let old = code.unwrap_or(start..end);
            code = Some(old.start.min(start)..old.end.max(end));
        }
    }
    Ok(code)
}

/// Drops section headers, whatever no loaded segment covers, and needless program headers.
pub fn trim(elf: &[u8]) -> Result<Trimmed, String> {
    let all = segments(elf)?;
    let loads: Vec<_> = all.iter().filter(|s| s.kind == LOAD).cloned().collect();
    let end = loads.iter().map(|s| s.file.end).max().ok_or("nothing in it is loaded")?;
    let executable = loads.iter().find(|s| s.flags & EXECUTABLE != 0).ok_or("nothing in it can be executed")?;
    let at = number(elf, 32, 8)? as usize;
    let headers = at..at + all.len() * SEGMENT;
    if headers.end > end || headers.start < HEADER {
        return Err("the program headers are not loaded".into());
    }

    let mut bytes = vec![0; end];
    let interpreted = all.iter().any(|s| s.kind == 3);
    bytes[..HEADER].copy_from_slice(elf.get(..HEADER).filter(|_| end >= HEADER).ok_or("the header is not loaded")?);
    for s in &loads {
        bytes[s.file.clone()].copy_from_slice(&elf[s.file.clone()]);
    }
    let mut to = headers.start;
    let position_independent = number(elf, 16, 2)? == 3;
    for (i, s) in all.iter().enumerate() {
        if KEPT.contains(&s.kind) || s.kind == PHDR && position_independent && interpreted {
            let from = headers.start + i * SEGMENT;
            bytes[to..to + SEGMENT].copy_from_slice(&elf[from..from + SEGMENT]);
            to += SEGMENT;
        }
    }
    bytes[to..headers.end].fill(0);
    bytes[56..58].copy_from_slice(&(((to - headers.start) / SEGMENT) as u16).to_le_bytes());
    // Section headers: offset; size, number, index of the names.
    bytes[40..48].fill(0);
    bytes[58..64].fill(0);

    // What the file says of its sections is only trusted within the segment that can be executed.
    let within = executable.file.clone();
    let code = code_sections(elf)?
        .map_or(within.clone(), |c| c.start.clamp(within.start, within.end)..c.end.clamp(within.start, within.end));
    let code_address = executable.address.wrapping_add((code.start - within.start) as u64);
    Ok(Trimmed { bytes, code, code_address, loads })
}
