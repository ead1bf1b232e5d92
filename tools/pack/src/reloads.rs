//! Loads that load what a register holds already: the basic register allocator leaves them behind.
//!
//! It puts a value that finds no register into memory, and loads it anew for each use, even where the last load, or the
//! store itself, has left it in a register that nothing has written to since. Later passes of LLVM do not look. So the
//! compiler writes assembly, with remarks on what is spilled and what is reloaded, and here
//!
//! ```text
//! movq  8(%rsp), %rax   # 8-byte Reload              goes where %rax holds those 8 bytes
//! movq  %rax, 8(%rsp)   # 8-byte Spill               likewise
//! vaddps 32(%rsp), %ymm1, %ymm0  # 32-byte Folded Reload    becomes  vaddps %ymm2, %ymm1, %ymm0  where %ymm2 does
//! ```
//!
//! What registers hold is followed through each function, along all ways that lead to an instruction. Nothing but spills and
//! reloads writes to and reads from the memory of a spilled value, as its address is not known to anybody. What is not known
//! to leave other registers alone makes all forgotten.

mod function;
mod instruction;
mod known;
mod register;

use function::Function;
use std::collections::{BTreeMap, BTreeSet};

/// The labels in each table of jumps, by the table's name.
type Tables<'a> = BTreeMap<&'a str, BTreeSet<&'a str>>;

/// The assembly without needless loads and stores, for the GNU assembler.
pub fn shorten(assembly: &str) -> String {
    let lines: Vec<&str> = assembly.lines().collect();
    let tables = tables(&lines);
    let mut out: Vec<String> = lines.iter().map(|line| (*line).into()).collect();
    let mut start = None;
    for (number, line) in lines.iter().enumerate() {
        if line.contains(": ") && line.contains("# @") && !line.starts_with(char::is_whitespace) {
            start = Some(number);
        } else if line.starts_with(".Lfunc_end")
            && let Some(start) = start.take()
        {
            for (changed, new) in Function::read(&lines[start..number], &tables).changes() {
                out[start + changed] = new;
            }
        }
    }
    for line in &mut out {
        *line = file(line).unwrap_or_else(|| std::mem::take(line));
    }
    without_shared_table(&mut out);
    out.join("\n") + "\n"
}

/// The tables of jumps of an assembly.
fn tables<'a>(lines: &[&'a str]) -> Tables<'a> {
    let mut tables = Tables::new();
    let mut table = None;
    for line in lines {
        if line.starts_with(".LJTI") {
            table = line.split_once(':').map(|(name, _)| name);
        } else if let (Some(table), Some(entry)) = (table, line.trim().strip_prefix(".quad\t")) {
            tables.entry(table).or_default().insert(entry.trim());
        }
    }
    tables
}

/// A directive that names a source file by its folder and its name, with both as one: older assemblers know no other.
fn file(line: &str) -> Option<String> {
    let rest = line.strip_prefix("\t.file\t")?;
    let [number, folder, _, name, ""] = rest.split('"').collect::<Vec<_>>()[..] else { return None };
    let path = if name.starts_with('/') { name.into() } else { format!("{folder}/{name}") };
    Some(format!("\t.file\t{number}\"{path}\""))
}

/// All units of an assembly share one table of lines. Readers take those without code, which say of no address that it is
/// theirs, for the owners of all that is in the table: here these have none.
fn without_shared_table(lines: &mut [String]) {
    let mut list = None;
    let mut units = false;
    for number in 0..lines.len() {
        let line = &lines[number];
        if line.ends_with("# Abbreviation Code") {
            units = lines.get(number + 1).is_some_and(|next| next.ends_with("# DW_TAG_compile_unit"));
            list = None;
        } else if units && line.ends_with("# DW_AT_stmt_list") {
            list = Some(number);
        } else if line.ends_with("# DW_AT_ranges") || line.ends_with("# DW_AT_low_pc") {
            units = false;
        } else if units
            && line.ends_with("# EOM(1)")
            && let Some(list) = list.take()
        {
            // An attribute that nobody reads, of the same form.
            lines[list] = "\t.byte\t67\t# DW_AT_macro_info".into();
        }
    }
}
