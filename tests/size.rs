//! Bytes are currency: every executable of `size-budget.toml`, built and weighed.

use serde::Deserialize;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;

/// All rows.
#[derive(Deserialize)]
struct Budget {
    row: Vec<Row>,
}

/// One executable.
#[derive(Deserialize)]
struct Row {
    name: String,
    /// Arguments of cargo that build it.
    build: Vec<String>,
    /// Where it is then, below the target directory.
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

#[test]
fn executables_keep_to_their_budgets() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join("size-budget.toml")).expect("size-budget.toml");
    let budget: Budget = toml::from_str(&text).expect("rows of a name, build, path and budget");
    // The test's own directory lies below the target directory of its build.
    let target = root.join(option_env!("CARGO_TARGET_DIR").unwrap_or("target"));
    let mut rows = vec![];
    for row in &budget.row {
        let built = Command::new(env!("CARGO"))
            .current_dir(root)
            .args(&row.build)
            .args(["--quiet", "--target-dir"])
            .arg(&target)
            .status()
            .expect("cargo");
        assert!(built.success(), "{} does not build", row.name);
        let file = target.join(&row.path);
        let bytes = std::fs::metadata(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display())).len();
        rows.push((row.name.clone(), bytes, row.budget));
    }
    match weigh(&rows) {
        Ok(table) => println!("{table}"),
        Err(table) => panic!("over budget:\n{table}"),
    }
}

#[test]
fn a_row_over_its_budget_fails_with_the_table() {
    let row = |bytes| vec![("fits".to_owned(), 5, 10), ("tight".to_owned(), bytes, 1000)];
    assert!(weigh(&row(1000)).is_ok());
    let table = weigh(&row(1001)).unwrap_err();
    assert!(table.contains("tight") && table.contains("1001") && table.contains("-1"), "{table}");
}
