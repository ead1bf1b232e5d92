//! The joined object, taken apart into what can be placed by itself: functions, statics, tables, single constants.

use object::elf::{SHF_MERGE, SHF_STRINGS, SHT_INIT_ARRAY};
use object::read::elf::{ElfFile64, SectionHeader};
use object::{
    LittleEndian, Object, ObjectSection, ObjectSymbol, RelocationFlags, RelocationTarget, SectionFlags, SectionIndex,
    SectionKind, SymbolKind, SymbolSection,
};
use std::collections::HashMap;

/// Names scripts for a debugger. `main` reads its first byte, so that linkers keep it.
pub const GDB_SCRIPTS: &str = ".debug_gdb_scripts";

/// Where a piece lies in the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Kind {
    /// A function.
    Code,
    /// What is never written: tables, texts, constants of functions.
    Constant,
    /// Variables with a value at the start.
    Data,
    /// Variables of zeros.
    Zero,
    /// Each thread's own variables, of zeros.
    Thread,
    /// Addresses of functions that run before `main`.
    Start,
}

/// What a reference leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Target {
    /// A piece, by its index.
    Piece(usize),
    /// A function or variable of a library, by its index.
    Import(usize),
}

/// A field that the linker fills with an address.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Reference {
    /// Where in the piece.
    pub at: u64,
    /// The type of relocation, R_X86_64_....
    pub kind: u32,
    /// What it leads to.
    pub to: Target,
    /// What is added to the address.
    pub addend: i64,
}

/// A function, a static or a constant.
#[derive(Clone, Debug)]
pub struct Piece {
    /// Its symbol's, as far as it has one.
    pub name: String,
    /// Which part of the program it belongs to.
    pub kind: Kind,
    /// Its bytes, with zeros where references are.
    pub bytes: Vec<u8>,
    /// Its address is a multiple of that.
    pub align: u64,
    /// By `at`.
    pub references: Vec<Reference>,
    /// Is it one of a pool of constants, which all have a size and no names?
    pub pooled: bool,
}

/// What a library has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Import {
    /// Its name.
    pub name: String,
    /// May it be missing?
    pub weak: bool,
}

/// A program in pieces.
#[derive(Clone, Debug, Default)]
pub struct Pieces {
    /// All of them.
    pub all: Vec<Piece>,
    /// What libraries have.
    pub imports: Vec<Import>,
}

/// Where the bytes of an object went.
pub struct Parts {
    /// The pieces that a section became, by where they started in it.
    places: HashMap<SectionIndex, Vec<(u64, usize)>>,
    /// Imports by symbol.
    imports: HashMap<object::SymbolIndex, usize>,
}

impl Parts {
    /// What a relocation leads to, if that is a piece or an import, and what is to be added to its address.
    pub fn target(
        &self,
        object: &ElfFile64<'_, LittleEndian>,
        relocation: &object::Relocation,
    ) -> Option<(Target, i64)> {
        let RelocationTarget::Symbol(index) = relocation.target() else { return None };
        if let Some(&import) = self.imports.get(&index) {
            return Some((Target::Import(import), relocation.addend()));
        }
        let symbol = object.symbol_by_index(index).ok()?;
        let places = self.places.get(&symbol.section_index()?)?;
        // The assembler names a constant by its section where it may: then only the addend tells which one is meant,
        // and it may in fields that hold an address.
        let address = match symbol.kind() {
            SymbolKind::Section if places.len() > 1 => symbol.address().wrapping_add_signed(relocation.addend()),
            _ => symbol.address(),
        };
        let after = places.partition_point(|&(start, _)| start <= address);
        let (start, piece) = places[after.checked_sub(1)?];
        Some((Target::Piece(piece), symbol.address() as i64 - start as i64 + relocation.addend()))
    }
}

impl Pieces {
    /// Takes an object apart.
    pub fn read(object: &ElfFile64<'_, LittleEndian>) -> Result<(Pieces, Parts), String> {
        let mut pieces = Pieces::default();
        let mut parts = Parts { places: HashMap::new(), imports: HashMap::new() };
        let mut constants = HashMap::new();
        let text = |error: object::Error| format!("the joined object: {error}");
        for section in object.sections() {
            let Some(kind) = kind(&section) else { continue };
            let mut bytes = section.data().map_err(text)?.to_vec();
            if matches!(kind, Kind::Zero | Kind::Thread) {
                bytes = vec![0; section.size() as usize];
            }
            let name = section.name().map_err(text)?;
            if name == GDB_SCRIPTS {
                bytes = vec![0];
            }
            let header = section.elf_section_header();
            let merged = header.sh_flags(LittleEndian).0 & (SHF_MERGE.0 | SHF_STRINGS.0) == SHF_MERGE.0;
            let size = if merged { header.sh_entsize(LittleEndian) as usize } else { bytes.len() };
            let places = parts.places.entry(section.index()).or_default();
            for (i, part) in bytes.chunks(size.max(1)).enumerate() {
                let piece = Piece {
                    name: name.into(),
                    kind,
                    bytes: part.to_vec(),
                    // What fills gaps between functions would cost 118 bytes packed.
                    align: if kind == Kind::Code { 1 } else { section.align().max(1) },
                    references: Vec::new(),
                    pooled: merged,
                };
                let new = pieces.all.len();
                let index = if merged { *constants.entry(part.to_vec()).or_insert(new) } else { new };
                if index == new {
                    pieces.all.push(piece);
                }
                places.push(((i * size) as u64, index));
            }
        }
        for symbol in object.symbols() {
            let name = symbol.name().map_err(text)?;
            if symbol.is_undefined() && !name.is_empty() {
                parts.imports.insert(symbol.index(), pieces.imports.len());
                pieces.imports.push(Import { name: name.into(), weak: symbol.is_weak() });
            }
            if let SymbolSection::Section(section) = symbol.section()
                && let Some(&[(_, piece)]) = parts.places.get(&section).map(|places| &places[..])
                && symbol.address() == 0
                && !name.is_empty()
                && !name.starts_with('.')
            {
                pieces.all[piece].name = name.into();
            }
        }
        for section in object.sections() {
            let Some(places) = parts.places.get(&section.index()) else { continue };
            for (at, relocation) in section.relocations() {
                let &[(_, piece)] = &places[..] else { return Err("a constant that holds an address".into()) };
                let (to, addend) = parts
                    .target(object, &relocation)
                    .ok_or_else(|| format!("{} has a reference to nothing that is known", pieces.all[piece].name))?;
                let RelocationFlags::Elf { r_type } = relocation.flags() else { return Err("not ELF".into()) };
                if let Target::Piece(constant) = to
                    && pieces.all[constant].pooled
                    // Up to eight bytes of an instruction stand from an address in it to its end.
                    && !(-8..pieces.all[constant].bytes.len() as i64).contains(&addend)
                {
                    return Err(format!("{} reads beside a constant", pieces.all[piece].name));
                }
                let reference = Reference { at, kind: r_type.0, to, addend };
                pieces.all[piece].references.push(reference);
            }
        }
        for piece in &mut pieces.all {
            piece.references.sort_by_key(|reference| reference.at);
        }
        Ok((pieces, parts))
    }
}

/// The kind of a section's pieces, where it has any.
fn kind(section: &object::read::elf::ElfSection64<'_, '_, LittleEndian>) -> Option<Kind> {
    let SectionFlags::Elf { .. } = section.flags() else { return None };
    if section.size() == 0 {
        return None;
    }
    if section.elf_section_header().sh_type(LittleEndian) == SHT_INIT_ARRAY {
        return Some(Kind::Start);
    }
    Some(match section.kind() {
        SectionKind::Text => Kind::Code,
        SectionKind::ReadOnlyData | SectionKind::ReadOnlyString => Kind::Constant,
        SectionKind::Data => Kind::Data,
        SectionKind::UninitializedData => Kind::Zero,
        SectionKind::UninitializedTls => Kind::Thread,
        _ => return None,
    })
}
