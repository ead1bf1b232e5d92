//! Bytes are currency: every executable of `size-budget.toml`, built and weighed, and the packed intro part by part.

use crate::{cargo, pack, root, target};
use flate2::Compression;
use flate2::write::GzEncoder;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::fmt::Write;
use std::fs;
use std::io::{self, Write as _};
use std::path::Path;

/// The arguments of cargo that pack the intro.
pub const PACK: [&str; 3] = ["run", "--package", "pack"];

/// What may be spent.
#[derive(Deserialize)]
struct Budget {
    row: Vec<Row>,
    part: Vec<Part>,
}

/// A part of the packed intro.
#[derive(Deserialize)]
struct Part {
    name: String,
    /// Modules and crates by name, with all that is in them.
    of: Vec<String>,
    /// Bytes after packing.
    budget: u64,
}

/// What `tools/pack` finds in the packed intro.
#[derive(Deserialize)]
struct Found {
    module: Vec<Module>,
}

/// A module of ours or a crate, and its bytes after packing.
#[derive(Deserialize)]
struct Module {
    name: String,
    packed: u64,
}

/// One executable.
#[derive(Deserialize)]
struct Row {
    name: String,
    /// Arguments of cargo that build it.
    build: Vec<String>,
    /// Where it is then, below the target directory: a file, or a directory of files that are sent, gzipped.
    path: String,
    /// Bytes.
    budget: u64,
}

/// The table of rows and their bytes; an error where one is over.
fn weigh(rows: &[(String, u64, u64)]) -> Result<String, String> {
    let mut table = format!("{:<12} {:>12} {:>12} {:>12}\n", "row", "bytes", "budget", "left");
    for (name, bytes, budget) in rows {
        let left = *budget as i64 - *bytes as i64;
        writeln!(table, "{name:<12} {bytes:>12} {budget:>12} {left:>12}").unwrap();
    }
    if rows.iter().all(|(_, bytes, budget)| bytes <= budget) { Ok(table) } else { Err(table) }
}

/// Whether that is packed, which takes more than a compiler.
fn is_packed(row: &Row) -> bool {
    row.build == PACK
}

fn read<T: DeserializeOwned>(path: &Path) -> T {
    let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    toml::from_str(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// The bytes of a file, or of a directory's files, each gzipped as a server sends them.
fn bytes(path: &Path) -> io::Result<u64> {
    if path.is_file() {
        return Ok(fs::metadata(path)?.len());
    }
    let mut sum = 0;
    for entry in fs::read_dir(path)? {
        let mut gzip = GzEncoder::new(Vec::new(), Compression::best());
        gzip.write_all(&fs::read(entry?.path())?)?;
        sum += gzip.finish()?.len() as u64;
    }
    Ok(sum)
}

/// Builds every executable and gives its bytes. What takes a target of Rust's that is not there is left out.
fn build(rows: &[&Row]) -> Vec<(String, u64, u64)> {
    let mut weights = vec![];
    for row in rows {
        // What is packed has been already.
        if !is_packed(row) {
            let built = cargo(&row.build.iter().map(String::as_str).collect::<Vec<_>>());
            let said = String::from_utf8_lossy(&built.stderr);
            if said.contains("lacks the module's target") {
                testkit::left_out("Rust's target wasm32-unknown-unknown", "libstd-rust-dev-wasm32");
                continue;
            }
            assert!(built.status.success(), "{} does not build: {said}", row.name);
        }
        let file = target().join(&row.path);
        let bytes = bytes(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        weights.push((row.name.clone(), bytes, row.budget));
    }
    weights
}

/// Adds up the modules of each part: to that part which names most of the module's name. None may be left over.
fn parts(parts: &[Part], modules: &[Module]) -> Vec<(String, u64, u64)> {
    let mut sums: Vec<_> = parts.iter().map(|part| (part.name.clone(), 0, part.budget)).collect();
    for module in modules {
        let inside = |of: &&String| module.name == **of || module.name.starts_with(&format!("{of}::"));
        let named = |part: &Part| part.of.iter().filter(inside).map(String::len).max();
        let best = (0..parts.len()).max_by_key(|&i| named(&parts[i])).filter(|&i| named(&parts[i]).is_some());
        let best = best.unwrap_or_else(|| panic!("no part of size-budget.toml has {}", module.name));
        sums[best].1 += module.packed;
    }
    sums
}

#[test]
#[ignore = "long: run by .ci/run"]
fn executables_keep_to_their_budgets() {
    let budget: Budget = read(&root().join("size-budget.toml"));
    let packed = pack();
    let rows: Vec<_> = budget.row.iter().filter(|row| packed || !is_packed(row)).collect();
    let mut weights = build(&rows);
    if packed {
        let found: Found = read(&target().join("intro/size.toml"));
        let parts = parts(&budget.part, &found.module);
        let whole = weights.iter().find(|(name, ..)| name == "intro").expect("a row of the packed intro").1;
        assert_eq!(parts.iter().map(|part| part.1).sum::<u64>(), whole, "the parts are not the whole");
        weights.extend(parts);
    }
    match weigh(&weights) {
        Ok(table) => println!("{table}"),
        Err(table) => panic!("over budget:\n{table}"),
    }
}

#[test]
fn a_directory_weighs_what_is_sent_of_it() {
    let directory = tempfile::tempdir().unwrap();
    // Zeros pack by a thousand to one at most, and take a header each.
    for name in ["one", "two"] {
        fs::write(directory.path().join(name), [0; 100_000]).unwrap();
    }
    let sent = bytes(directory.path()).unwrap();
    assert!((200..1000).contains(&sent), "{sent}");
    assert_eq!(bytes(&directory.path().join("one")).unwrap(), 100_000);
}

#[test]
fn modules_are_counted_where_they_are_named_best() {
    let part = |name: &str, of: &[&str]| Part {
        name: name.into(),
        of: of.iter().map(|&of| of.to_owned()).collect(),
        budget: 9,
    };
    let module = |name: &str, packed| Module { name: name.into(), packed };
    let found =
        [module("std", 1), module("paprsek::trace", 2), module("paprsek::trace::grid", 4), module("paprsek", 8)];
    let sums = parts(&[part("all", &["std", "paprsek"]), part("trace", &["paprsek::trace"])], &found);
    assert_eq!(sums, [("all".to_owned(), 9, 9), ("trace".to_owned(), 6, 9)]);
}

#[test]
fn a_row_over_its_budget_fails_with_the_table() {
    let row = |bytes| vec![("fits".to_owned(), 5, 10), ("tight".to_owned(), bytes, 1000)];
    assert!(weigh(&row(1000)).is_ok());
    let table = weigh(&row(1001)).unwrap_err();
    assert!(table.contains("tight") && table.contains("1001") && table.contains("-1"), "{table}");
}
