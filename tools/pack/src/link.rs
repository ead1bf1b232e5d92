//! Links the intro: what the compiler wrote as assembly, without needless reloads; its functions and data in the order that
//! packs best, nothing that nobody needs; and then its instructions in the order that packs best.

use crate::order::{self, TASTES, Taste, fold::fold};
use crate::packer;
use crate::pieces::{GDB_SCRIPTS, Kind, Parts, Pieces, Target};
use crate::reloads;
use crate::rewrite::rewrite;
use crate::toolchain::run;
use object::elf::{RelocationType, SHF_ALLOC, SHF_WRITE, SHT_INIT_ARRAY};
use object::read::elf::ElfFile64;
use object::write::{Object, Relocation, SectionId, Symbol, SymbolId, SymbolSection};
use object::{
    Architecture, BinaryFormat, Endianness, LittleEndian, Object as _, ObjectSection, ObjectSymbol, RelocationFlags,
    RelocationTarget, SectionFlags, SectionIndex, SectionKind, SymbolFlags, SymbolKind, SymbolScope,
};
use std::collections::HashMap;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{fs, io};

/// Links what cargo has made the assembly of, in several orders; gives the path of the one that packs best, beside the
/// `executable` that it believes to have made.
pub fn link(executable: &Path) -> Result<PathBuf, String> {
    let made = linked(executable)?;
    let bytes = joined(&made)?;
    let how = made.with_extension("link");
    let arguments = fs::read_to_string(&how).map_err(failed(&how))?;
    let (object, out) = (made.with_extension("ordered.o"), executable.with_extension("ordered"));
    let mut best: Option<(f64, Vec<u8>)> = None;
    for taste in TASTES {
        fs::write(&object, ordered(&bytes, taste)?).map_err(failed(&object))?;
        finish(&object, &arguments, &out)?;
        let program = fs::read(&out).map_err(failed(&out))?;
        let bits = packer::measure(&program)?.bits.iter().map(|&bits| bits as f64).sum();
        if best.as_ref().is_none_or(|(least, _)| bits < *least) {
            best = Some((bits, program));
        }
    }
    let (_, program) = best.expect("some were tried");
    fs::write(&out, rewrite(&program)?).map_err(failed(&out))?;
    Ok(out)
}

/// The program and its libraries in one object, which keeps to itself what they call by name: else ld takes every function
/// of compiler_builtins that libm or libgcc_s has too for one that these libraries might call, and leaves none of them out
/// (24 kB, most of it arithmetic in 128 bits).
fn joined(made: &Path) -> Result<Vec<u8>, String> {
    let [assembly, short, object, all, libraries] =
        ["s", "short.s", "o", "all.o", "libraries"].map(|extension| made.with_extension(extension));
    let text = fs::read_to_string(&assembly).map_err(failed(&assembly))?;
    fs::write(&short, reloads::shorten(&text)).map_err(failed(&short))?;
    let list = fs::read_to_string(&libraries).map_err(failed(&libraries))?;
    run(Command::new("as").arg(&short).arg("-o").arg(&object))?;
    run(Command::new("ld").args(["-r", "--undefined=main", "-o"]).arg(&all).arg(&object).args(list.lines()))?;
    // `memcpy` without a version, which `elf` cuts, is the oldest one, which moves by SSE2, and what AVX leaves in the upper
    // halves of registers holds it up: 0.94 of the speed on an Intel Xeon. `memmove` has had one version.
    let copies = "--redefine-sym=memcpy=memmove";
    run(Command::new("objcopy").args(["--keep-global-symbol=main", copies]).arg(&all))?;
    fs::read(&all).map_err(failed(&all))
}

/// Links an object with the arguments that the compiler gave for what it was made of. Of the startup files only the one with
/// `_start` comes along: the others serve C++ and profilers.
fn finish(object: &Path, arguments: &str, out: &Path) -> Result<(), String> {
    let start = Command::new("cc").arg("-print-file-name=crt1.o").output().map_err(failed(Path::new("cc")))?;
    let mut cc = Command::new("cc");
    cc.arg("-nostartfiles").arg(String::from_utf8_lossy(&start.stdout).trim()).arg(object);
    // Of two `-o` the last one counts.
    run(cc.args(arguments.lines()).arg("-o").arg(out))
}

/// Says at what path something failed.
fn failed(path: &Path) -> impl Fn(io::Error) -> String {
    let path = path.display().to_string();
    move |error| format!("{path}: {error}")
}

/// The linker's own copy of an executable, which cargo has made a second name for.
fn linked(executable: &Path) -> Result<PathBuf, String> {
    let number = |path: &Path| path.metadata().map(|data| (data.dev(), data.ino()));
    let wanted = number(executable).map_err(failed(executable))?;
    let entries = fs::read_dir(executable.with_file_name("deps")).map_err(failed(executable))?;
    let mut paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let found = paths.find(|path| number(path).is_ok_and(|number| number == wanted));
    found.ok_or(format!("{} is not what was linked", executable.display()))
}

/// The joined object with its pieces in order.
pub fn ordered(joined: &[u8], taste: Taste) -> Result<Vec<u8>, String> {
    let object = ElfFile64::parse(joined).map_err(|error| format!("the joined object: {error}"))?;
    let (mut pieces, parts) = Pieces::read(&object)?;
    fold(&mut pieces);
    write(&object, &pieces, &parts, &order::order(&pieces, taste))
}

/// Where pieces go, and the kind of section that this is.
const SECTIONS: [(Kind, &str, SectionKind); 6] = [
    (Kind::Code, ".text", SectionKind::Text),
    (Kind::Constant, ".rodata", SectionKind::ReadOnlyData),
    (Kind::Start, ".init_array", SectionKind::Data),
    (Kind::Data, ".data", SectionKind::Data),
    (Kind::Zero, ".bss", SectionKind::UninitializedData),
    (Kind::Thread, ".tbss", SectionKind::UninitializedTls),
];

/// An object that is being written, and where in it the pieces are.
struct Writer<'a> {
    object: Object<'a>,
    pieces: &'a Pieces,
    places: Vec<Option<(SectionId, u64)>>,
    /// Symbols of the pieces that have one.
    symbols: HashMap<usize, SymbolId>,
    imports: Vec<SymbolId>,
}

/// The object of the pieces in `order`; what is not in it is left out. Line tables come from `joined`.
pub fn write(
    joined: &ElfFile64<'_, LittleEndian>,
    pieces: &Pieces,
    parts: &Parts,
    order: &[usize],
) -> Result<Vec<u8>, String> {
    let mut writer = Writer::new(pieces);
    writer.place(order);
    for &index in order {
        let (section, start) = writer.places[index].expect("it is in the order");
        for r in &pieces.all[index].references {
            if !writer.refer(section, start + r.at, RelocationType(r.kind), (r.to, r.addend))? {
                return Err(format!("{} needs what is left out", pieces.all[index].name));
            }
        }
    }
    writer.tables(joined, parts)?;
    // Says that the stack need not be executable.
    writer.object.add_section(Vec::new(), b".note.GNU-stack".into(), SectionKind::Other);
    writer.object.write().map_err(|error| format!("cannot link: {error}"))
}

impl<'a> Writer<'a> {
    /// Empty but for what libraries have.
    fn new(pieces: &'a Pieces) -> Self {
        let mut object = Object::new(BinaryFormat::Elf, Architecture::X86_64, Endianness::Little);
        let imports = pieces.imports.iter().map(|import| {
            object.add_symbol(Symbol {
                name: import.name.clone().into(),
                value: 0,
                size: 0,
                kind: SymbolKind::Unknown,
                scope: SymbolScope::Unknown,
                weak: import.weak,
                section: SymbolSection::Undefined,
                flags: SymbolFlags::None,
            })
        });
        let imports = imports.collect();
        Writer { object, pieces, places: vec![None; pieces.all.len()], symbols: HashMap::new(), imports }
    }

    /// The pieces' bytes and names.
    fn place(&mut self, order: &[usize]) {
        for (kind, name, section_kind) in SECTIONS {
            let section = self.object.add_section(Vec::new(), name.into(), section_kind);
            if kind == Kind::Start {
                *self.object.section_flags_mut(section) =
                    SectionFlags::Elf { sh_type: SHT_INIT_ARRAY, sh_flags: SHF_ALLOC | SHF_WRITE };
            }
            for &index in order.iter().filter(|&&index| self.pieces.all[index].kind == kind) {
                let piece = &self.pieces.all[index];
                let size = piece.bytes.len() as u64;
                let at = match kind {
                    Kind::Zero | Kind::Thread => self.object.append_section_bss(section, size, piece.align),
                    _ => self.object.append_section_data(section, &piece.bytes, piece.align),
                };
                self.places[index] = Some((section, at));
                if piece.name.starts_with('.') {
                    continue;
                }
                let symbol = self.object.add_symbol(Symbol {
                    name: piece.name.clone().into(),
                    value: at,
                    size,
                    kind: match kind {
                        Kind::Code => SymbolKind::Text,
                        Kind::Thread => SymbolKind::Tls,
                        _ => SymbolKind::Data,
                    },
                    scope: if piece.name == "main" { SymbolScope::Linkage } else { SymbolScope::Compilation },
                    weak: false,
                    section: SymbolSection::Section(section),
                    flags: SymbolFlags::None,
                });
                self.symbols.insert(index, symbol);
            }
        }
    }

    /// Has the linker fill a field; says whether what it refers to is there.
    fn refer(
        &mut self,
        section: SectionId,
        offset: u64,
        r_type: RelocationType,
        (to, addend): (Target, i64),
    ) -> Result<bool, String> {
        let (symbol, addend) = match to {
            Target::Import(import) => (self.imports[import], addend),
            Target::Piece(piece) => match (self.places[piece], self.symbols.get(&piece)) {
                (None, _) => return Ok(false),
                (_, Some(&symbol)) if self.pieces.all[piece].kind == Kind::Thread => (symbol, addend),
                (Some((home, start)), _) => (self.object.section_symbol(home), addend + start as i64),
            },
        };
        self.relocate(section, Relocation { offset, symbol, addend, flags: RelocationFlags::Elf { r_type } })?;
        Ok(true)
    }

    fn relocate(&mut self, section: SectionId, relocation: Relocation) -> Result<(), String> {
        self.object.add_relocation(section, relocation).map_err(|error| format!("cannot link: {error}"))
    }

    /// What tells lines of source from addresses. Of functions that are left out it says that they are at 0; in lists of
    /// ranges, which a pair of zeros ends, that they are from 1 to 1.
    fn tables(&mut self, joined: &ElfFile64<'_, LittleEndian>, parts: &Parts) -> Result<(), String> {
        let text = |error: object::read::Error| format!("the joined object: {error}");
        let mut tables = Vec::new();
        for section in joined.sections() {
            let name = section.name().map_err(text)?;
            if name.starts_with(".debug_") && name != GDB_SCRIPTS {
                let id = self.object.add_section(Vec::new(), name.into(), SectionKind::Debug);
                self.object.set_section_data(id, section.data().map_err(text)?.to_vec(), 1);
                tables.push((section, id));
            }
        }
        let ids: HashMap<SectionIndex, SectionId> = tables.iter().map(|(table, id)| (table.index(), *id)).collect();
        for (table, id) in &tables {
            for (offset, relocation) in table.relocations() {
                let RelocationFlags::Elf { r_type } = relocation.flags() else { return Err("not ELF".into()) };
                if let Some(target) = parts.target(joined, &relocation) {
                    let there = self.refer(*id, offset, r_type, target)?;
                    if !there && table.name().map_err(text)? == ".debug_ranges" {
                        self.object.section_mut(*id).data_mut()[offset as usize] = 1;
                    }
                } else if let RelocationTarget::Symbol(index) = relocation.target() {
                    let symbol = joined.symbol_by_index(index).map_err(text)?;
                    let Some(&to) = symbol.section_index().and_then(|section| ids.get(&section)) else { continue };
                    let addend = relocation.addend() + symbol.address() as i64;
                    let symbol = self.object.section_symbol(to);
                    self.relocate(*id, Relocation { offset, symbol, addend, flags: relocation.flags() })?;
                }
            }
        }
        Ok(())
    }
}
