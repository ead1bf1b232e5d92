//! What the source and its products must keep to: budgets of bytes, the packed intro, and floors of modules.

mod budget;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod inlined;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod intro;
mod layering;
mod paths;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

/// The package's directory.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Where cargo builds.
fn target() -> PathBuf {
    root().join(option_env!("CARGO_TARGET_DIR").unwrap_or("target"))
}

/// What cargo says to that in this workspace.
fn cargo(words: &[&str]) -> Output {
    let target = target();
    let mut cargo = Command::new(env!("CARGO"));
    // Words of the program that is run come last.
    let program = words.iter().position(|word| *word == "--").unwrap_or(words.len());
    cargo.current_dir(root()).args(&words[..program]).arg("--quiet").arg("--target-dir").arg(&target);
    cargo.args(&words[program..]);
    cargo.env("CARGO_TARGET_DIR", &target).output().expect("cargo runs")
}

/// Packs the intro, once for all tests. Without a Rust that has the sources of its standard library the calling test is left out,
/// and this is false.
fn pack() -> bool {
    static PACKED: OnceLock<Output> = OnceLock::new();
    let output = PACKED.get_or_init(|| cargo(&budget::PACK));
    let said = String::from_utf8_lossy(&output.stderr);
    let lacks_sources = said.starts_with("pack: no Rust 1.");
    if lacks_sources {
        let what = "Rust 1.96.0 with the sources of its standard library";
        testkit::left_out(what, "rustc-web cargo-web rust-web-src");
    } else {
        assert!(output.status.success(), "{said}");
    }
    !lacks_sources
}
