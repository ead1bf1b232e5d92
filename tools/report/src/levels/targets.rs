//! Where each level runs, and how its program is built.

use super::output;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Runs a program in node.
const WASI: &str = include_str!("wasi.mjs");

/// What is only checked: the target, and what cargo is told of it. On macOS minifb compiles Objective-C, for which a Linux
/// machine has no headers.
pub const CHECKS: [(&str, &str); 6] = [
    ("x86_64-pc-windows-gnu", "--lib --bins"),
    ("x86_64-pc-windows-msvc", "--lib --bins"),
    ("aarch64-unknown-linux-gnu", "--lib --bins"),
    ("aarch64-apple-darwin", "--lib --no-default-features --features full,rayon"),
    ("x86_64-apple-darwin", "--lib --no-default-features --features full,rayon"),
    ("wasm32-unknown-unknown", "--lib --no-default-features --features full"),
];

/// A level on a machine, made up or not.
pub struct Run {
    /// The level's name, which the program must say too.
    pub level: &'static str,
    /// For the reader.
    pub place: String,
    /// What the program is asked for.
    asked: &'static str,
    target: Target,
    /// Whether it takes seconds per frame.
    slow: bool,
}

/// How the program is built and started.
#[derive(Clone, Copy)]
enum Target {
    /// As the report itself is.
    Host,
    /// The same under qemu, which makes up that processor.
    Emulated(&'static str),
    /// aarch64 under qemu. musl brings its own C library, so that nothing beside Rust is needed.
    Arm,
    /// WebAssembly in node, with these features of the processor.
    Wasm(&'static str),
}

/// Every run; if quick, those that cost seconds.
pub fn runs(quick: bool) -> Vec<Run> {
    let mut runs = Vec::new();
    if cfg!(target_arch = "x86_64") {
        let here = testkit::levels();
        for level in ["avx512", "avx2", "sse4.2", "sse2"].into_iter().filter(|_| !quick) {
            // What this machine lacks, an emulator below may have.
            if here.iter().any(|(name, _)| *name == level) {
                runs.push(Run { level, place: "this machine".into(), asked: level, target: Target::Host, slow: false });
            }
        }
        for (level, processor) in [("avx2", "Haswell"), ("sse4.2", "Nehalem"), ("sse2", "qemu64")] {
            let place = format!("qemu-x86_64 as {processor}");
            runs.push(Run { level, place, asked: "best", target: Target::Emulated(processor), slow: true });
        }
        runs.retain(|run| !quick || run.level == "sse2");
    }
    runs.push(Run {
        level: "neon",
        place: "qemu-aarch64, musl".into(),
        asked: "best",
        target: Target::Arm,
        slow: true,
    });
    for (level, features) in [("simd128", "+simd128"), ("scalar", "-simd128")] {
        let place = "node, wasm32-wasip1".to_string();
        runs.push(Run { level, place, asked: "best", target: Target::Wasm(features), slow: quick });
    }
    runs
}

impl Run {
    /// What the program prints of every `slow`th frame, or of every frame where that takes no time; or what is missing.
    pub fn printed(&self, slow: usize) -> Result<String, String> {
        let every = if self.slow { slow } else { 1 }.to_string();
        let mut command = match self.target {
            Target::Host => Command::new(build(None, "")?),
            Target::Emulated(processor) => {
                let mut qemu = tool("qemu-x86_64", "qemu-user")?;
                qemu.args(["-cpu", processor]).arg(build(None, "")?);
                qemu
            }
            Target::Arm => {
                let mut qemu = tool("qemu-aarch64", "qemu-user")?;
                qemu.arg(build(Some("aarch64-unknown-linux-musl"), "")?);
                qemu
            }
            Target::Wasm(features) => {
                let mut node = tool("node", "nodejs")?;
                let program = build(Some("wasm32-wasip1"), &format!("-Ctarget-feature={features}"))?;
                let script = program.with_file_name("wasi.mjs");
                fs::write(&script, WASI).map_err(|error| format!("{}: {error}", script.display()))?;
                node.arg("--no-warnings").arg(script).arg(program);
                node
            }
        };
        output(command.args([self.asked, &every]))
    }
}

/// A program of the system, or which package brings it.
fn tool(name: &str, package: &str) -> Result<Command, String> {
    let path = env::var_os("PATH").unwrap_or_default();
    let found = env::split_paths(&path).any(|directory| directory.join(name).is_file());
    if found { Ok(Command::new(name)) } else { Err(format!("{name} is missing (apt install {package})")) }
}

/// Whether Rust has a target's standard library.
fn installed(target: &str) -> Result<(), String> {
    let root = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let there = Path::new(root.trim()).join("lib/rustlib").join(target).join("lib").is_dir();
    if there { Ok(()) } else { Err(format!("the target is missing (rustup target add {target})")) }
}

/// Builds the program that prints the table, for a target or for this machine.
fn build(target: Option<&str>, flags: &str) -> Result<PathBuf, String> {
    let mut cargo = Command::new("cargo");
    cargo.args(["build", "--release", "--quiet", "--package", "frames"]);
    let mut folder = PathBuf::from(env::var_os("CARGO_TARGET_DIR").unwrap_or("target".into()));
    if let Some(target) = target {
        installed(target)?;
        // Rust's own linker: a cross compiler is not needed.
        cargo.args(["--target", target]).env("CARGO_TARGET_AARCH64_UNKNOWN_LINUX_MUSL_LINKER", "rust-lld");
        folder.push(target);
    }
    if !flags.is_empty() {
        cargo.env("RUSTFLAGS", flags);
    }
    output(&mut cargo)?;
    let suffix =
        if target.is_some_and(|target| target.starts_with("wasm")) { ".wasm" } else { env::consts::EXE_SUFFIX };
    Ok(folder.join("release").join(format!("frames{suffix}")))
}

/// Whether the library, and the program where the arguments name it, pass `cargo check`.
pub fn check(target: &str, arguments: &str) -> Result<(), String> {
    installed(target)?;
    let check = ["check", "--quiet", "--package", "paprsek", "--target", target];
    output(Command::new("cargo").args(check).args(arguments.split(' '))).map(drop)
}
