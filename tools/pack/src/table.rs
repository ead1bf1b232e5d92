//! The size table: what each module of ours and each crate costs in the packed file.
//!
//! Every byte that the program loads belongs to a stack of places, innermost first: the functions inlined there.
//! A view picks one of them.

mod code;
mod data;
mod name;
mod place;

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

use object::read::elf::ElfFile64;
use object::{Object, ObjectSegment};

/// One line of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// A module of ours, a crate, a function or a line; else `linking` or `data`.
    pub name: String,
    /// Bytes in the unpacked file.
    pub bytes: u64,
    /// Bytes in the packed file.
    pub packed: f64,
}

/// Who pays for a byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The innermost place that is not glue: what a feature costs.
    Owner,
    /// The innermost place, whoever wrote it: what `core` and the SIMD wrappers add everywhere.
    Inner,
    /// The outermost function of ours, else the outermost: what stands in the file.
    Function,
    /// Every function of the stack, whatever its types. Bytes count several times, so there is no total.
    Within,
    /// The line of the owner.
    Line,
}

/// A place in the source.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Site {
    /// `paprsek::trace::packet`, or a crate.
    module: Rc<str>,
    function: Rc<str>,
    file: Rc<str>,
    line: u32,
    ours: bool,
}

impl Site {
    /// A place outside of the source.
    fn nowhere(module: &str) -> Self {
        let name: Rc<str> = module.into();
        Self { module: name.clone(), function: name.clone(), file: name, line: 0, ours: false }
    }
}

/// The places of a byte, innermost first; never empty.
type Stack = Rc<[Site]>;

/// Addresses with their places.
type Piece = (Range<u64>, Stack);

/// The language, which does the work of its caller; so do these crates wherever they stand.
const LANGUAGE: [&str; 3] = ["core", "core_arch", "alloc"];
const WRAPPERS: [&str; 4] = ["std", "fearless_simd", "glam", "once_cell"];

fn is_glue(site: &Site) -> bool {
    LANGUAGE.contains(&&*site.module) || WRAPPERS.contains(&&*site.module)
}

fn owner(stack: &[Site]) -> &Site {
    let wrapper = || stack.iter().find(|s| !LANGUAGE.contains(&&*s.module));
    stack.iter().find(|s| !is_glue(s)).or_else(wrapper).unwrap_or_else(|| outermost(stack))
}

fn outermost(stack: &[Site]) -> &Site {
    &stack[stack.len() - 1]
}

impl View {
    fn names(self, stack: &[Site]) -> Vec<String> {
        let name = match self {
            View::Owner => owner(stack).module.to_string(),
            View::Inner => stack[0].module.to_string(),
            View::Function => {
                let ours = stack.iter().rfind(|s| s.ours);
                ours.unwrap_or_else(|| outermost(stack)).function.to_string()
            }
            View::Within => {
                let mut names: Vec<_> = stack.iter().map(|s| name::without_types(&s.function)).collect();
                names.sort();
                names.dedup();
                return names;
            }
            View::Line => {
                let Site { file, line, .. } = owner(stack);
                format!("{file}:{line}")
            }
        };
        vec![name]
    }
}

/// Every loaded byte of a program and the places that it comes from.
pub struct Profile {
    pieces: Vec<Piece>,
}

impl Profile {
    /// Reads an executable that still has its symbols and its lines (`-Cdebuginfo=1`).
    pub fn read(elf: &[u8]) -> Result<Self, String> {
        let file = ElfFile64::parse(elf).map_err(|e| e.to_string())?;
        let mut code = code::Code::read(&file)?;
        let mut claimed = data::pieces(&file, &mut code);
        claimed.extend(code.pieces);
        claimed.sort_by_key(|(range, _)| range.start);

        // What nobody claims of the loaded bytes is there for the loader.
        let linking: Stack = [Site::nowhere("linking")].into();
        let mut pieces = Vec::new();
        for segment in file.segments() {
            let mut at = segment.address();
            let end = at + segment.file_range().1;
            for (range, stack) in claimed.iter().filter(|(r, _)| segment.address() <= r.start && r.end <= end) {
                pieces.push((at..range.start, linking.clone()));
                pieces.push((range.clone(), stack.clone()));
                at = range.end;
            }
            pieces.push((at..end, linking.clone()));
        }
        Ok(Self { pieces })
    }

    /// The table of a view, dearest first. `bits` is the cost of the byte at an address,
    /// nothing where the packed file leaves it out.
    pub fn rows(&self, view: View, bits: &dyn Fn(u64) -> Option<f32>) -> Vec<Row> {
        let mut sums: HashMap<String, (u64, f64)> = HashMap::new();
        for (range, stack) in &self.pieces {
            let costs = range.clone().filter_map(bits);
            let (bytes, packed) = costs.fold((0, 0.0), |(n, sum), cost| (n + 1, sum + f64::from(cost) / 8.0));
            for name in view.names(stack) {
                let sum = sums.entry(name).or_default();
                *sum = (sum.0 + bytes, sum.1 + packed);
            }
        }
        let mut rows: Vec<_> = sums.into_iter().map(|(name, (bytes, packed))| Row { name, bytes, packed }).collect();
        rows.retain(|r| r.bytes > 0);
        rows.sort_by(|a, b| b.packed.total_cmp(&a.packed).then_with(|| a.name.cmp(&b.name)));
        rows
    }
}

/// The size table: packed bytes by our modules and by crate.
pub fn by_module(elf: &[u8], bits: &dyn Fn(u64) -> Option<f32>) -> Result<Vec<Row>, String> {
    Ok(Profile::read(elf)?.rows(View::Owner, bits))
}

/// Rows as a table in Markdown, with their total. The rounded column adds up to the rounded total.
pub fn markdown(rows: &[Row]) -> String {
    let sum = Row {
        name: "total".into(),
        bytes: rows.iter().map(|row| row.bytes).sum(),
        packed: rows.iter().map(|row| row.packed).sum(),
    };
    let mut all = rounded(rows);
    all.push(sum);
    lines(&all)
}

/// Rows in whole bytes, which add up to the rounded total.
pub fn rounded(rows: &[Row]) -> Vec<Row> {
    let mut sum = 0.0;
    let mut whole = |row: &Row| {
        let before = f64::round(sum);
        sum += row.packed;
        Row { packed: sum.round() - before, ..row.clone() }
    };
    rows.iter().map(&mut whole).collect()
}

/// Rows as a table in Markdown, without a total.
pub fn lines(rows: &[Row]) -> String {
    let line = |row: &Row| format!("| {} | {} | {:.0} |\n", row.name, row.bytes, row.packed);
    String::from("| what | bytes | packed |\n|---|---:|---:|\n") + &rows.iter().map(line).collect::<String>()
}
