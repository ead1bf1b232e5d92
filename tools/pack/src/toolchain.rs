//! A Rust toolchain that has the sources of its standard library, which is built anew for size.

use crate::library;
use std::iter;
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
    /// All that may do, the likeliest first: those whose library has most of what is cut from it; among such Debian's, with
    /// which the sizes in the documents were measured, then rustup's, a nightly before the others.
    pub fn all() -> Result<Vec<Toolchain>, String> {
        let rustup = |words: &[&str]| said(Command::new("rustup").args(words)).unwrap_or_default();
        let list = rustup(&["toolchain", "list"]);
        let mut names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
        names.sort_by_key(|name| !name.starts_with("nightly"));
        let homes = names.iter().map(|name| rustup(&["run", name, "rustc", "--print", "sysroot"]).into());
        let mut found: Vec<Toolchain> = iter::once("/usr".into()).chain(homes).filter_map(Toolchain::at).collect();
        found.sort_by_cached_key(|toolchain| library::strange(&library::sources(&toolchain.sysroot)));
        if found.is_empty() {
            return Err(format!(
                "no Rust 1.{OLDEST} or later with the sources of its standard library; one of these installs it: \
                 `rustup toolchain install nightly --component rust-src`, or as root on Debian 12 \
                 `apt install rustc-web cargo-web rust-web-src`"
            ));
        }
        Ok(found)
    }

    /// The likeliest.
    pub fn find() -> Result<Toolchain, String> {
        Ok(Toolchain::all()?.swap_remove(0))
    }

    /// What `make` makes with the likeliest toolchain, or with the next one where it fails: a library that is another
    /// than the one that is cut need not compile. Says on stderr what failed.
    pub fn try_each<T>(make: impl FnMut(Toolchain) -> Result<T, String>) -> Result<T, String> {
        first(Toolchain::all()?, make)
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

/// What `make` makes of the first toolchain with which it succeeds; the last one's error where there is none.
fn first<T>(toolchains: Vec<Toolchain>, mut make: impl FnMut(Toolchain) -> Result<T, String>) -> Result<T, String> {
    let mut left = toolchains.len();
    let mut last = Err("no toolchain".into());
    for toolchain in toolchains {
        let name = toolchain.sysroot.display().to_string();
        last = make(toolchain);
        left -= 1;
        match &last {
            Err(why) if left > 0 => eprintln!("pack: {why} with the Rust in {name}; trying the next one"),
            _ => break,
        }
    }
    last
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
    fn the_next_toolchain_is_tried_where_one_fails() {
        let three = || ["/a", "/b", "/c"].map(|sysroot| Toolchain { sysroot: sysroot.into() }).into();
        let mut tried = Vec::new();
        let made = first(three(), |toolchain| {
            tried.push(toolchain.sysroot.clone());
            if toolchain.sysroot.ends_with("b") { Ok(7) } else { Err("cargo failed".into()) }
        });
        assert_eq!((made, tried), (Ok(7), vec![PathBuf::from("/a"), "/b".into()]));
        let failed = first::<()>(three(), |toolchain| Err(toolchain.sysroot.display().to_string()));
        assert_eq!(failed, Err("/c".into()));
    }

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
