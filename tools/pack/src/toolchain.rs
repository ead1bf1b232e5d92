//! A Rust toolchain that has the sources of its standard library, which is built anew for size.

use crate::library;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest compiler that knows `-Cpanic=immediate-abort`: minor version.
const OLDEST: u32 = 92;

/// Cargo and the compiler.
#[derive(Debug)]
pub struct Toolchain {
    /// The directory that `rustc --print sysroot` names.
    pub sysroot: PathBuf,
}

impl Toolchain {
    /// The first that will do: rustup's, a nightly before the others, then Debian's.
    pub fn find() -> Result<Toolchain, String> {
        let rustup = |words: &[&str]| said(Command::new("rustup").args(words)).unwrap_or_default();
        let list = rustup(&["toolchain", "list"]);
        let mut names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
        names.sort_by_key(|name| !name.starts_with("nightly"));
        let homes = names.iter().map(|name| rustup(&["run", name, "rustc", "--print", "sysroot"]).into());
        homes.chain(["/usr".into()]).find_map(Toolchain::at).ok_or_else(|| {
            format!(
                "no Rust 1.{OLDEST} or later with the sources of its standard library; one of these installs it: \
                 `rustup toolchain install nightly --component rust-src`, or as root on Debian 12 \
                 `apt install rustc-web cargo-web rust-web-src`"
            )
        })
    }

    /// The toolchain at `sysroot`, if it will do.
    fn at(sysroot: PathBuf) -> Option<Toolchain> {
        library::sources(&sysroot).join("std/Cargo.toml").exists().then_some(())?;
        let version = said(Command::new(sysroot.join("bin/rustc")).arg("--version"))?;
        (minor(&version)? >= OLDEST).then_some(Toolchain { sysroot })
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

/// What a command prints, where it succeeds.
fn said(command: &mut Command) -> Option<String> {
    let output = command.env_remove("RUSTUP_TOOLCHAIN").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

/// The minor version of `rustc 1.96.0 (ac68faa20 2026-05-25)`.
fn minor(version: &str) -> Option<u32> {
    version.strip_prefix("rustc 1.")?.split('.').next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_read() {
        assert_eq!(minor("rustc 1.96.0 (ac68faa20 2026-05-25)"), Some(96));
        assert_eq!(minor("rustc 1.100.0-nightly (59807616e 2026-12-14)"), Some(100));
        assert_eq!(minor("cargo 1.96.0"), None);
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
