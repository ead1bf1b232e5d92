//! Files that comments and documents name: they exist.

use super::root;
use std::fs;
use std::path::Path;

/// Where paths from the checkout's root begin.
const TOP: [&str; 7] = ["src/", "tests/", "tools/", "benches/", "docs/", "examples/", "web/"];

/// The sources and documents below a directory.
fn texts(directory: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(directory).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            texts(&path, found);
        } else if path.extension().is_some_and(|kind| kind == "rs" || kind == "md") {
            found.push(path.strip_prefix(root()).unwrap().to_str().unwrap().to_owned());
        }
    }
}

/// The paths between backticks in a text. What has a blank or a placeholder in it is no path.
fn named(text: &str) -> impl Iterator<Item = &str> {
    let quoted = text.split('`').filter(|word| TOP.iter().any(|top| word.starts_with(top)));
    quoted.filter(|word| word.bytes().all(|b| b.is_ascii_alphanumeric() || b"/._-".contains(&b)))
}

#[test]
fn files_that_are_named_exist() {
    let mut files: Vec<String> = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"].map(str::to_owned).into();
    for directory in ["src", "docs", "benches", "examples"] {
        texts(&root().join(directory), &mut files);
    }
    let mut seen = 0;
    for file in &files {
        let text = fs::read_to_string(root().join(file)).unwrap();
        for path in named(&text) {
            assert!(root().join(path).exists(), "{file} names {path}");
            seen += 1;
        }
    }
    assert!(seen > 20, "{seen} paths in {} files", files.len());
    assert_eq!(named("see `src/lib.rs` and `src/ x`, `other/a.rs`").collect::<Vec<_>>(), ["src/lib.rs"]);
}
