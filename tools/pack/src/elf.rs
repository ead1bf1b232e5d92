//! Reads an ELF64 executable and leaves out what running it does not need.

mod needless;

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
const GNU_EH_FRAME: u32 = 0x6474_e550;
/// Flag of a section that is loaded.
const ALLOC: u64 = 2;
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
    /// The parts of that which sections have; between them are zeros.
    pub code_parts: Vec<Range<usize>>,
    /// Address of the first instruction.
    pub code_address: u64,
    /// The segments that are loaded.
    pub loads: Vec<Segment>,
}

impl Trimmed {
    /// Where the instructions are, as the model is told.
    pub fn code(&self) -> [u32; 3] {
        [self.code.start, self.code.end, self.code_address as usize].map(|word| word as u32)
    }
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

/// What a section header says of bytes that are loaded.
struct Section {
    kind: u64,
    flags: u64,
    file: Range<usize>,
    name: Vec<u8>,
}

/// The sections that are loaded from the file, as far as section headers tell.
fn sections(elf: &[u8]) -> Result<Vec<Section>, String> {
    const NOBITS: u64 = 8;
    let (table, count, names) = (number(elf, 40, 8)? as usize, number(elf, 60, 2)? as usize, number(elf, 62, 2)?);
    let header = |i: usize| table.checked_add(i * SECTION).ok_or("section headers out of range");
    let mut all = Vec::new();
    for i in 0..if table == 0 { 0 } else { count } {
        let at = header(i)?;
        let (kind, flags) = (number(elf, at + 4, 4)?, number(elf, at + 8, 8)?);
        if kind == NOBITS || flags & ALLOC == 0 {
            continue;
        }
        let start = number(elf, at + 24, 8)? as usize;
        let end = start.checked_add(number(elf, at + 32, 8)? as usize).ok_or("a section out of range")?;
        let name = (number(elf, header(names as usize)? + 24, 8)? as usize).checked_add(number(elf, at, 4)? as usize);
        let name = name.and_then(|name| elf.get(name..)).unwrap_or(&[]);
        let name = name.split(|&byte| byte == 0).next().unwrap_or(&[]).to_vec();
        all.push(Section { kind, flags, file: start..end, name });
    }
    Ok(all)
}

/// File ranges of the sections that hold instructions, in their order in the file.
fn code_sections(sections: &[Section]) -> Vec<Range<usize>> {
    const PROGBITS: u64 = 1;
    const EXECINSTR: u64 = 4;
    let code = sections.iter().filter(|s| s.kind == PROGBITS && s.flags & EXECINSTR != 0).map(|s| s.file.clone());
    let mut code: Vec<_> = code.collect();
    code.sort_by_key(|range| range.start);
    code
}

/// Drops section headers, whatever no loaded segment covers, needless program headers, and what nobody reads.
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

    let sections = sections(elf)?;
    needless::clear(&mut bytes, &sections, all.iter().any(|s| s.kind == GNU_EH_FRAME));
    // What the file says of its sections is only trusted within the segment that can be executed.
    let within = executable.file.clone();
    let clamped =
        |part: &Range<usize>| part.start.clamp(within.start, within.end)..part.end.clamp(within.start, within.end);
    let mut code_parts: Vec<_> = code_sections(&sections).iter().map(clamped).collect();
    if code_parts.is_empty() {
        code_parts.push(within.clone());
    }
    let code = code_parts[0].start..code_parts.iter().map(|part| part.end).max().expect("there is one");
    let code_address = executable.address.wrapping_add((code.start - within.start) as u64);
    Ok(Trimmed { bytes, code, code_parts, code_address, loads })
}
