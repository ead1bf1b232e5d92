//! The executable as it is built and played: what its profile and the packing cost, and how soon the first frame is there.
//!
//! These measurements build programs with cargo and time them as processes, so they see what a user sees. They need a
//! checkout with cargo in the path; those with a window need `Xvfb` as well.

pub mod beside;
pub mod intro_speed;
pub mod opt_level;
pub mod pace;
pub mod start;
mod xvfb;

use crate::options::Result;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Cargo's folder for what it builds.
fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or("target".into(), PathBuf::from)
}

/// Runs a command to its successful end; what it prints to stdout is dropped.
fn run(command: &mut Command) -> Result {
    let status = command.stdout(Stdio::null()).status().map_err(|error| format!("{command:?}: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?}: {status}").into()) }
}

/// What a command prints.
pub fn output(command: &mut Command) -> Result<Vec<u8>> {
    let output = command.output().map_err(|error| format!("{command:?}: {error}"))?;
    if output.status.success() {
        return Ok(output.stdout);
    }
    Err(format!("{command:?}: {}\n{}", output.status, String::from_utf8_lossy(&output.stderr)).into())
}

/// The release build of the executable, in cargo's own folder or another with other settings.
fn build(folder: &Path, settings: &[(&str, &str)]) -> Result<PathBuf> {
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "--release", "--quiet", "--package", "paprsek", "--target-dir"]).arg(folder);
    run(cargo.envs(settings.iter().copied()))?;
    Ok(folder.join("release/paprsek"))
}

/// Builds the packed intro, and returns the folder of it.
fn pack() -> Result<PathBuf> {
    run(Command::new("cargo").args(["run", "--quiet", "--package", "pack"]))?;
    Ok(target().join("intro"))
}

/// A number of kB from `/proc/PID/status`.
fn status(process: u32, field: &str) -> Result<u64> {
    let text = std::fs::read_to_string(format!("/proc/{process}/status"))?;
    let line = text.lines().find_map(|line| line.strip_prefix(field)).ok_or("the process is gone")?;
    Ok(line.split_whitespace().next().ok_or("no number")?.parse()?)
}
