//! A Rust toolchain that has the sources of its standard library, which is built anew for size.

use crate::library;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The release whose library [`library`] cuts. With another one sizes would not be those of the documents, nor stand still.
const RELEASE: &str = "1.96.0";

/// Cargo and the compiler.
#[derive(Debug)]
pub struct Toolchain {
    /// The directory that `rustc --print sysroot` names.
    pub sysroot: PathBuf,
}

impl Toolchain {
    /// Debian's, or one of rustup's.
    pub fn find() -> Result<Toolchain, String> {
        let rustup = |words: &[&str]| said(Command::new("rustup").args(words)).unwrap_or_default();
        let list = rustup(&["toolchain", "list"]);
        let names = list.lines().filter_map(|line| line.split_whitespace().next());
        let homes = names.map(|name| rustup(&["run", name, "rustc", "--print", "sysroot"]).into());
        [PathBuf::from("/usr")].into_iter().chain(homes).find_map(Toolchain::at).ok_or_else(|| {
            format!(
                "no Rust {RELEASE} with the sources of its standard library; one of these installs it: \
                 `rustup toolchain install {RELEASE} --component rust-src`, or as root on Debian 12 \
                 `apt install rustc-web cargo-web rust-web-src`"
            )
        })
    }

    /// The toolchain at `sysroot`, if it will do.
    fn at(sysroot: PathBuf) -> Option<Toolchain> {
        library::sources(&sysroot).join("std/Cargo.toml").exists().then_some(())?;
        let version = said(Command::new(sysroot.join("bin/rustc")).arg("--version"))?;
        is_release(&version).then_some(Toolchain { sysroot })
    }

    /// The compiler.
    pub fn rustc(&self) -> PathBuf {
        self.sysroot.join("bin/rustc")
    }

    /// Cargo, in that directory and with nothing of this process's Rust in its environment: neither what `cargo run`
    /// sets for us, nor what the user has set for other builds.
    pub fn cargo(&self, directory: &Path) -> Command {
        let mut cargo = Command::new(self.sysroot.join("bin/cargo"));
        cargo.current_dir(directory);
        for (name, _) in std::env::vars_os() {
            if name.to_str().is_some_and(leaks) {
                cargo.env_remove(name);
            }
        }
        // The flags are unstable; a release does them too when asked in this way.
        cargo.env("RUSTC", self.rustc()).env("RUSTC_BOOTSTRAP", "1");
        cargo
    }
}

/// Would a variable of that name change what is built? Where crates are kept and fetched from does not.
fn leaks(name: &str) -> bool {
    let ours = ["CARGO", "RUST", "CFLAGS", "DEP_", "OUT_DIR"].iter().any(|prefix| name.starts_with(prefix));
    let kept = ["CARGO_HOME", "CARGO_NET_", "CARGO_HTTP_", "CARGO_REGISTR", "RUSTUP_HOME"];
    ours && !kept.iter().any(|prefix| name.starts_with(prefix))
}

/// Runs a tool. What it complains of is the error.
pub fn run(tool: &mut Command) -> Result<(), String> {
    let output = tool.output().map_err(|error| format!("{:?}: {error}", tool.get_program()))?;
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

/// What a command prints, where it succeeds.
fn said(command: &mut Command) -> Option<String> {
    let output = command.env_remove("RUSTUP_TOOLCHAIN").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

/// Is that what the compiler of [`RELEASE`] says of itself, whoever built it?
fn is_release(version: &str) -> bool {
    version.split_whitespace().nth(1) == Some(RELEASE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_releases_will_not_do() {
        assert!(is_release("rustc 1.96.0 (ac68faa20 2026-05-25) (built from a source tarball)"));
        for version in
            ["rustc 1.96.1 (ac68faa20 2026-06-25)", "rustc 1.96.0-nightly (59807616e 2026-04-01)", "rustc", ""]
        {
            assert!(!is_release(version), "{version}");
        }
    }

    #[test]
    fn variables_of_other_builds_are_kept_out() {
        for name in
            ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_TARGET_DIR", "RUSTUP_TOOLCHAIN", "CARGO", "CFLAGS_x"]
        {
            assert!(leaks(name), "{name}");
        }
        for name in ["PATH", "HOME", "CARGO_HOME", "RUSTUP_HOME", "CARGO_NET_OFFLINE", "CC"] {
            assert!(!leaks(name), "{name}");
        }
    }
}
