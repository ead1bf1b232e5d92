//! Compiles the module and puts the page together.

use crate::root;
use std::env;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// Whether Rust has the standard library of the module's target.
pub fn has_target() -> bool {
    let rustc = Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]).output();
    rustc.is_ok_and(|said| Path::new(String::from_utf8_lossy(&said.stdout).trim()).is_dir())
}

/// Where cargo builds.
pub fn target() -> PathBuf {
    root().join(env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from))
}

/// Builds the page into a directory, which holds nothing else afterwards. Gives the bytes of its files.
pub fn build(target: &Path, out: &Path) -> Result<u64, Box<dyn Error>> {
    if !has_target() {
        return Err(format!("Rust lacks the module's target: rustup target add {TARGET}").into());
    }
    let cargo = env::var_os("CARGO").unwrap_or("cargo".into());
    // Not RUSTFLAGS, which would replace these.
    let mut command = Command::new(cargo);
    command.env_remove("RUSTFLAGS").env("CARGO_ENCODED_RUSTFLAGS", "-Ctarget-feature=+simd128");
    command.args(["build", "--release", "--package", "paprsek-web", "--target", TARGET, "--target-dir"]).arg(target);
    if !command.current_dir(root()).status()?.success() {
        return Err("the module does not build".into());
    }
    if out.exists() {
        // Whatever else is there is not ours to delete.
        if fs::read_dir(out)?.next().is_some() && !out.join("paprsek.wasm").is_file() {
            return Err(format!("{} has other files in it", out.display()).into());
        }
        fs::remove_dir_all(out)?;
    }
    fs::create_dir_all(out)?;
    let module = target.join(TARGET).join("release/paprsek_web.wasm");
    let mut bytes = fs::copy(module, out.join("paprsek.wasm"))?;
    for entry in fs::read_dir(root().join("web/page"))? {
        let file = entry?;
        bytes += fs::copy(file.path(), out.join(file.file_name()))?;
    }
    Ok(bytes)
}
