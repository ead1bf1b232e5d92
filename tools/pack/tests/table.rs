//! The size table of a small program.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

use object::read::elf::ElfFile64;
use object::{Endianness, Object, ObjectSection, ObjectSegment};
use pack::table::{Profile, Row, View, by_module, lines, markdown};

const MAIN: &str = r#"
mod deep;
mod words;
fn main() {
    let n = std::env::args().count();
    println!("{}{}", deep::sum(n), words::long(n));
}
"#;

/// A named table of 4096 bytes; a function that is inlined and one that is not.
const DEEP: &str = r#"
static TABLE: [u8; 4096] = { let mut t = [0; 4096]; let mut i = 0; while i < 4096 { t[i] = (i * i >> 4) as u8; i += 1 } t };
#[inline(always)]
fn look(n: usize) -> u32 { TABLE[n % 4096].into() }
#[inline(never)]
pub fn sum(n: usize) -> u32 { (0..n).map(|i| look(i * 77)).sum() }
"#;

/// A constant without a name of 3000 bytes.
const WORDS: &str = r#"
#[inline(never)]
pub fn long(n: usize) -> &'static str { const { unsafe { std::str::from_utf8_unchecked(&[b'x'; 3000]) } }.split_at(n).0 }
"#;

/// The small program, made with these options.
fn compiled(name: &str, options: &[&str]) -> Vec<u8> {
    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(root.join("src")).unwrap();
    for (file, text) in [("main", MAIN), ("deep", DEEP), ("words", WORDS)] {
        fs::write(root.join(format!("src/{file}.rs")), text).unwrap();
    }
    let flags = ["--edition=2024", "--crate-name=small", "-Copt-level=s", "-Cpanic=abort", "-Ccodegen-units=1"];
    let mut rustc = Command::new("rustc");
    rustc.args(flags).args(options).args(["-Crelocation-model=static", "-o", "small", "src/main.rs"]);
    assert!(rustc.current_dir(&root).status().unwrap().success());
    fs::read(root.join("small")).unwrap()
}

fn program() -> &'static [u8] {
    static ELF: OnceLock<Vec<u8>> = OnceLock::new();
    ELF.get_or_init(|| compiled("small", &["-Cdebuginfo=1"]))
}

fn row<'a>(rows: &'a [Row], name: &str) -> &'a Row {
    rows.iter().find(|r| r.name == name).unwrap_or_else(|| panic!("no {name} in\n{}", markdown(rows)))
}

/// What the loader maps, counted from the file alone.
fn loaded(elf: &[u8]) -> u64 {
    let file = ElfFile64::<Endianness>::parse(elf).unwrap();
    file.segments().map(|s| s.file_range().1).sum()
}

#[test]
fn rows_add_up_to_what_is_loaded() {
    let elf = program();
    let profile = Profile::read(elf).unwrap();
    for view in [View::Owner, View::Inner, View::Function, View::Line] {
        let rows = profile.rows(view, &|at| Some((at % 16) as f32));
        assert_eq!(rows.iter().map(|r| r.bytes).sum::<u64>(), loaded(elf), "{view:?}");
        let file = ElfFile64::<Endianness>::parse(elf).unwrap();
        let addresses = file.segments().flat_map(|s| s.address()..s.address() + s.file_range().1);
        let bits: u64 = addresses.map(|at| at % 16).sum();
        assert_eq!(rows.iter().map(|r| r.packed).sum::<f64>(), bits as f64 / 8.0, "{view:?}");
    }
}

#[test]
fn data_belongs_to_its_module() {
    let rows = by_module(program(), &|_| Some(8.0)).unwrap();
    // Code of some tens of bytes comes on top.
    for (module, size) in [("small::deep", 4096), ("small::words", 3000)] {
        let bytes = row(&rows, module).bytes;
        assert!((size + 10..size + 300).contains(&bytes), "{module}: {bytes}");
    }
    for name in ["small::main", "core", "alloc", "std", "linking"] {
        row(&rows, name);
    }
    // Nothing of size is without an owner.
    assert!(row(&rows, "data").bytes < 1000, "{}", markdown(&rows));
}

#[test]
fn functions_and_lines_have_their_bytes() {
    let profile = Profile::read(program()).unwrap();
    let one_each = |_| Some(8.0);
    let function = row(&profile.rows(View::Function, &one_each), "small::deep::sum").bytes;
    assert!((10..300).contains(&function), "{function}");
    // What is inlined shows where it comes from, too.
    assert!(row(&profile.rows(View::Within, &one_each), "small::deep::look").bytes < function);
    assert!(row(&profile.rows(View::Line, &one_each), "src/deep.rs:4").bytes < function);
}

#[test]
fn what_the_packed_file_leaves_out_is_not_counted() {
    let elf = program();
    let file = ElfFile64::<Endianness>::parse(elf).unwrap();
    let text = file.section_by_name(".text").unwrap();
    let range = text.address()..text.address() + text.size();
    let rows = by_module(elf, &|at| (!range.contains(&at)).then_some(4.0)).unwrap();
    let bytes: u64 = rows.iter().map(|r| r.bytes).sum();
    assert_eq!(bytes, loaded(elf) - text.size());
}

#[test]
fn rounded_rows_add_up() {
    let rows: Vec<_> = (0..7).map(|i| Row { name: format!("m{i}"), bytes: 10, packed: 1.4 }).collect();
    let text = markdown(&rows);
    let cells = |line: &str| line.split('|').nth(3).and_then(|c| c.trim().parse::<u64>().ok());
    let numbers: Vec<_> = text.lines().filter_map(cells).collect();
    let (total, parts) = numbers.split_last().unwrap();
    assert_eq!((*total, parts.len()), (10, 7));
    assert_eq!(parts.iter().sum::<u64>(), *total);
    assert!(!lines(&rows).contains("total"));
}

#[test]
fn a_stripped_program_is_an_error() {
    assert!(Profile::read(b"no program").is_err());
    let error = Profile::read(&compiled("without_symbols", &["-Cdebuginfo=0", "-Cstrip=symbols"])).err();
    assert!(error.is_some_and(|e| e.contains("debuginfo")));
}
