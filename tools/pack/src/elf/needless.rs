//! What is loaded but never read: zeros in its place cost nearly nothing.

use super::Section;

/// Types of sections.
const HASH: u64 = 5;
const DYNAMIC: u64 = 6;
const NOTE: u64 = 7;
const DYNSYM: u64 = 11;
const VERNEED: u64 = 0x6fff_fffe;
const VERSYM: u64 = 0x6fff_ffff;

/// Entries of the dynamic section that the loader asks for in vain: the sizes of names and of a symbol, a word for
/// debuggers, and versions of symbols. Without those it takes the first version that a library has, which goes on being
/// there for old programs: for what the intro calls it does the same, and as fast but for `memcpy` (see [`crate::link`]).
const UNASKED: [u64; 6] = [10, 11, 21, 0x6fff_fff0, VERNEED, VERSYM];

/// Clears it in the loaded `bytes`. `unwinds` says that a program header leads to `.eh_frame`.
pub fn clear(bytes: &mut [u8], sections: &[Section], unwinds: bool) {
    let all = |kind| sections.iter().filter(move |s| s.kind == kind).filter_map(|s| bytes.get(s.file.clone()));
    let exports = all(DYNSYM).any(|symbols| symbols.chunks_exact(24).any(defined));
    let at_once = all(DYNAMIC).any(|entries| entries.chunks_exact(16).any(binds_now));
    let versions: Vec<usize> = all(VERNEED).flat_map(versions).collect();
    for s in sections {
        let Some(content) = bytes.get_mut(s.file.clone()) else { continue };
        match (s.kind, &s.name[..]) {
            (NOTE | VERNEED | VERSYM, _) | (_, b".debug_gdb_scripts") => content.fill(0),
            (DYNAMIC, _) => shorten(content),
            (_, b".dynstr") => {
                for &name in &versions {
                    content.iter_mut().skip(name).take_while(|byte| **byte != 0).for_each(|byte| *byte = 0);
                }
            }
            (_, b".eh_frame") if !unwinds => content.fill(0),
            // One bucket, empty: whoever looks here for a symbol finds none either way.
            (HASH, _) if !exports && content.len() >= 12 => {
                content[0] = 1;
                content[1..4].fill(0);
                content[8..].fill(0);
            }
            // The loader fills all slots before the program starts.
            (_, b".got.plt") if at_once => content.fill(0),
            (_, b".plt") if at_once => content.chunks_exact_mut(16).for_each(clear_lazy),
            _ => {}
        }
    }
}

/// Is a dynamic symbol in a section of this file?
fn defined(symbol: &[u8]) -> bool {
    symbol[6..8] != [0, 0]
}

/// Where the names of versions are among the names: a library's record of 16 bytes counts those of its versions, which
/// follow it.
fn versions(needed: &[u8]) -> Vec<usize> {
    let (mut left, mut names) = (0, Vec::new());
    for record in needed.chunks_exact(16) {
        if left == 0 {
            left = u16::from_le_bytes([record[2], record[3]]);
        } else {
            left -= 1;
            names.push(u32::from_le_bytes([record[8], record[9], record[10], record[11]]) as usize);
        }
    }
    names
}

/// Leaves the unasked entries out of the dynamic section, which zeros end.
fn shorten(dynamic: &mut [u8]) {
    let tag = |entry: &[u8]| u64::from_le_bytes(std::array::from_fn(|i| entry[i]));
    let asked = dynamic.chunks_exact(16).filter(|entry| !UNASKED.contains(&tag(entry)));
    let mut kept = asked.collect::<Vec<_>>().concat();
    kept.resize(dynamic.len(), 0);
    dynamic.copy_from_slice(&kept);
}

/// Does an entry of the dynamic section, DT_FLAGS or DT_FLAGS_1, say that all functions are looked up at the start?
fn binds_now(entry: &[u8]) -> bool {
    match entry[..8] {
        [30, 0, 0, 0, 0, 0, 0, 0] => entry[8] & 8 != 0,
        [0xfb, 0xff, 0xff, 0x6f, 0, 0, 0, 0] => entry[8] & 1 != 0,
        _ => false,
    }
}

/// Leaves of an entry of the procedure linkage table its jump: what looks the function up at its first call goes.
fn clear_lazy(entry: &mut [u8]) {
    match entry[..] {
        [0xff, 0x35, ..] => entry.fill(0),
        [0xff, 0x25, _, _, _, _, 0x68, ..] => entry[6..].fill(0),
        _ => {}
    }
}
