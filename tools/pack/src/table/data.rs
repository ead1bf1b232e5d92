//! Who pays for data: the symbol that names it, else the first code that refers to it.

use std::collections::BTreeMap;
use std::ops::Range;

use object::read::elf::ElfFile64;
use object::{Object, ObjectSection, ObjectSymbol};

use super::code::Code;
use super::{Piece, Site, Stack};

/// Starts of pieces and who pays for them, as far as is known.
type Starts = BTreeMap<u64, Option<Stack>>;

struct Section<'a> {
    address: u64,
    bytes: &'a [u8],
}

impl Section<'_> {
    fn end(&self) -> u64 {
        self.address + self.bytes.len() as u64
    }
}

/// Every byte of the sections of data.
pub fn pieces(file: &ElfFile64, code: &mut Code) -> Vec<Piece> {
    let data = [".rodata", ".data", ".tdata"];
    let holds_data = |name: &str| data.iter().any(|d| name == *d || name.starts_with(&format!("{d}.")));
    let sections: Vec<_> = file
        .sections()
        .filter(|s| s.name().is_ok_and(holds_data))
        .filter_map(|s| Some(Section { address: s.address(), bytes: s.data().ok()? }))
        .collect();
    let inside = |at: u64| sections.iter().any(|s| (s.address..s.end()).contains(&at));

    let mut starts: Starts = sections.iter().map(|s| (s.address, None)).collect();
    let mut named: Vec<Range<u64>> = Vec::new();
    for symbol in file.symbols().filter(|s| s.size() > 0 && inside(s.address())) {
        let range = symbol.address()..symbol.address() + symbol.size();
        let site = code.names.symbol(symbol.name().unwrap_or(""));
        starts.insert(range.start, Some([site].into()));
        starts.entry(range.end).or_insert(None);
        named.push(range);
    }
    let free = |at: u64| inside(at) && !named.iter().any(|r| r.contains(&at));
    for (at, stack) in code.references.iter().filter(|(at, _)| free(*at)) {
        starts.entry(*at).or_insert(None).get_or_insert_with(|| stack.clone());
    }
    follow_pointers(&sections, &mut starts, &free);

    let mut pieces = Vec::new();
    let unknown: Stack = [Site::nowhere("data")].into();
    for section in &sections {
        let mut inner = starts.range(section.address..section.end()).peekable();
        while let Some((&start, stack)) = inner.next() {
            let end = inner.peek().map_or(section.end(), |(next, _)| **next);
            pieces.push((start..end, stack.as_ref().unwrap_or(&unknown).clone()));
        }
    }
    pieces
}

/// Data that only data points to belongs to the owner of the pointer.
fn follow_pointers(sections: &[Section], starts: &mut Starts, free: &dyn Fn(u64) -> bool) {
    let words: Vec<(u64, u64)> = sections.iter().flat_map(words).filter(|(_, to)| free(*to)).collect();
    loop {
        let mut changed = false;
        for &(at, to) in &words {
            let Some((_, Some(stack))) = starts.range(..=at).next_back() else { continue };
            let stack = stack.clone();
            let target = starts.entry(to).or_insert(None);
            changed |= target.is_none();
            target.get_or_insert(stack);
        }
        if !changed {
            return;
        }
    }
}

/// The aligned words of a section with their addresses.
fn words<'a>(section: &'a Section) -> impl Iterator<Item = (u64, u64)> + 'a {
    let skip = (section.address.wrapping_neg() % 8) as usize;
    let bytes = section.bytes.get(skip..).unwrap_or(&[]);
    let word = |c: &[u8; 8]| u64::from_le_bytes(*c);
    let first = section.address + skip as u64;
    bytes.as_chunks::<8>().0.iter().enumerate().map(move |(i, c)| (first + 8 * i as u64, word(c)))
}
