//! The size table: what each module of ours and each crate costs in the packed file.
//!
//! Every byte that the program loads belongs to a stack of places, innermost first: the functions inlined there.
//! A view picks one of them.

mod code;
mod data;
mod place;

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

use object::read::elf::ElfFile64;
use object::{Object, ObjectSection, ObjectSegment, SectionKind};

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
    /// The innermost place of ours, else of the innermost crate above `core`: what a feature costs.
    Owner,
    /// The innermost place, whoever wrote it: what `core` and the SIMD wrappers add everywhere.
    Inner,
    /// The outermost function of ours, as it stands in the file, else the outermost.
    Function,
    /// The line of the owner.
    Line,
}

/// A place in the source.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Site {
    /// `paprsek::trace::packet`, or a crate.
    module: Rc<str>,
    /// With its types.
    function: Rc<str>,
    file: Rc<str>,
    line: u32,
    ours: bool,
}

impl Site {
    fn nameless(module: &str) -> Self {
        let name: Rc<str> = module.into();
        Self { module: name.clone(), function: name.clone(), file: name, line: 0, ours: false }
    }
}

/// The places of a byte, innermost first; never empty.
type Stack = Rc<[Site]>;

/// What is glue wherever it stands: it does the work of its caller.
const GLUE: [&str; 3] = ["core", "alloc", "fearless_simd"];

fn owner(stack: &[Site]) -> &Site {
    let above_core = || stack.iter().find(|s| !GLUE.contains(&&*s.module));
    stack.iter().find(|s| s.ours).or_else(above_core).unwrap_or_else(|| &stack[stack.len() - 1])
}

impl View {
    fn name(self, stack: &[Site]) -> String {
        match self {
            View::Owner => owner(stack).module.to_string(),
            View::Inner => stack[0].module.to_string(),
            View::Function => {
                stack.iter().rfind(|s| s.ours).unwrap_or(&stack[stack.len() - 1]).function.to_string()
            }
            View::Line => {
                let Site { file, line, .. } = owner(stack);
                format!("{file}:{line}")
            }
        }
    }
}

/// Every loaded byte of a program and the places that it comes from.
pub struct Profile {
    pieces: Vec<(Range<u64>, Stack)>,
}

impl Profile {
    /// Reads an executable that still has its symbols and its lines (`-Cdebuginfo=1`).
    pub fn read(elf: &[u8]) -> Result<Self, String> {
        let file = ElfFile64::parse(elf).map_err(|e| e.to_string())?;
        let text = |s: &_| ObjectSection::kind(s) == SectionKind::Text && ObjectSection::name(s) == Ok(".text");
        let text = file.sections().find(text).ok_or("no .text")?;
        let mut code = code::Code::read(&file, &text)?;
        let mut pieces = std::mem::take(&mut code.pieces);
        pieces.extend(data::pieces(&file, code));
        pieces.sort_by_key(|(range, _)| range.start);

        // What nobody claims among the loaded bytes is there for the loader.
        let linking: Stack = [Site::nameless("linking")].into();
        let mut whole = Vec::new();
        for segment in file.segments() {
            let (start, length) = (segment.address(), segment.file_range().1);
            let mut at = start;
            let inside = |range: &Range<u64>| range.start >= start && range.end <= start + length;
            for (range, stack) in pieces.iter().filter(|(range, _)| inside(range)) {
                whole.push((at..range.start, linking.clone()));
                whole.push((range.clone(), stack.clone()));
                at = range.end;
            }
            whole.push((at..start + length, linking.clone()));
        }
        whole.retain(|(range, _)| !range.is_empty());
        Ok(Self { pieces: whole })
    }

    /// The table of a view, dearest first. `bits` is the cost of the byte at an address,
    /// nothing where the packed file leaves it out.
    pub fn rows(&self, view: View, bits: &dyn Fn(u64) -> Option<f32>) -> Vec<Row> {
        let mut sums: HashMap<String, (u64, f64)> = HashMap::new();
        for (range, stack) in &self.pieces {
            let sum = sums.entry(view.name(stack)).or_default();
            for cost in range.clone().filter_map(bits) {
                sum.0 += 1;
                sum.1 += f64::from(cost) / 8.0;
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

/// The table as Markdown, with its total. The rounded column adds up to the rounded total.
pub fn markdown(rows: &[Row]) -> String {
    let mut text = String::from("| what | bytes | packed |\n|---|---:|---:|\n");
    let (mut bytes, mut packed) = (0, 0.0);
    for row in rows {
        let before = f64::round(packed);
        bytes += row.bytes;
        packed += row.packed;
        text += &format!("| {} | {} | {} |\n", row.name, row.bytes, packed.round() - before);
    }
    text + &format!("| total | {bytes} | {} |\n", packed.round())
}
