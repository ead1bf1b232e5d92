//! The intro's executable before it is packed: cargo, with everything that makes it small.

use crate::toolchain::Toolchain;
use crate::x11;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const TARGET: &str = "x86_64-unknown-linux-gnu";

/// Flags of the compiler, for our code and the standard library alike.
const FLAGS: &[&str] = &[
    // A panic ends the process without a word: no messages, no unwinding, no tables for it.
    "-Zunstable-options",
    "-Cpanic=immediate-abort",
    "-Cforce-unwind-tables=no",
    "-Zlocation-detail=none",
    "-Zfmt-debug=none",
    // One SIMD level, AVX2: what processors have had since 2013 (Intel), 2015 (AMD).
    "-Ctarget-cpu=x86-64-v3",
    "--cfg=disable_dispatch_avx512",
    "--cfg=disable_dispatch_sse4_2",
    "--cfg=disable_dispatch_sse2",
    "--cfg=disable_dispatch_fallback",
    // Libraries are named below: those that the standard library names define functions that compiler-builtins
    // defines too, and for that the linker would keep 10 kB of them.
    "-Zlink-directives=no",
    "-Clink-arg=-Wl,--as-needed,-lm,-lc",
    // At a fixed address there is nothing to relocate.
    "-Crelocation-model=static",
    "-Clink-arg=-no-pie",
    "-Clink-arg=-Wl,--build-id=none,-z,norelro,--no-eh-frame-hdr,-z,noseparate-code,--hash-style=sysv",
];

/// What the standard library may take from libm: what compiler-builtins has not got.
const MATHS: &str = "acos asin atan atan2 cos cosh erf erfc exp exp2 expm1 hypot log log10 log1p log2 pow sin sincos \
                     sinh tan tanh tgamma lgamma_r";

/// Settings of cargo. Line tables are for finding out what the bytes are; they change none that are packed.
const SETTINGS: &[&str] = &["profile.release.strip=false", "profile.release.debug='line-tables-only'"];

/// Builds the intro of the workspace at `root` below `target`; gives the path of the executable, with symbols.
/// Its code is the same wherever `root` is, as long as `target` is below it at the same place.
pub fn build(root: &Path, toolchain: &Toolchain, target: &Path) -> Result<PathBuf, String> {
    let whole = |path: &Path| {
        let made = fs::create_dir_all(path).and_then(|()| path.canonicalize());
        made.map_err(|error| format!("cannot make {}: {error}", path.display()))
    };
    let (root, target) = (whole(root)?, whole(target)?);
    let crates = target.join("x11-dl");
    x11::cut(&metadata(&root, toolchain)?, &crates)?;
    let libraries = target.join("libraries");
    libm(&libraries)?;
    let mut cargo = toolchain.cargo(&root);
    cargo.args(["rustc", "--release", "--locked", "--package", "paprsek", "--bin", "paprsek"]);
    cargo.args(["--no-default-features", "--features", "x11"]);
    cargo.args(["-Zbuild-std=std,panic_abort", "-Zbuild-std-features=optimize_for_size", "--target", TARGET]);
    cargo.arg("--target-dir").arg(&target);
    for setting in SETTINGS {
        cargo.args(["--config", setting]);
    }
    cargo.arg("--config").arg(format!("paths=[{:?}]", crates.display().to_string()));
    cargo.env("CARGO_ENCODED_RUSTFLAGS", FLAGS.join("\x1f"));
    // minifb's one file in C asks for -O3; the last word counts.
    cargo.env("CFLAGS", "-Os");
    // x11-dl would note where this machine keeps its libraries; the loader knows better on the next.
    cargo.env("PKG_CONFIG", "false");
    // The executable alone, not the library: the shell is to be small, frames are to be fast.
    cargo.args(["--", "-Copt-level=z"]);
    // Cargo names crates by their flags, and by names the linker sorts: so no flag has a path of this machine. The
    // compiler runs in `root`.
    let libraries = libraries.strip_prefix(&root).unwrap_or(&libraries);
    cargo.arg(format!("-Clink-arg=-L{}", libraries.display()));
    run(&mut cargo)?;
    Ok(target.join(TARGET).join("release/paprsek"))
}

/// A libm to link with that has nothing but names, and so none that compiler-builtins has as well: the linker keeps
/// what a library of the system could call, 9 kB packed. The executable then loads the system's own.
fn libm(directory: &Path) -> Result<(), String> {
    let source = directory.join("libm.c");
    let functions: String =
        MATHS.split_whitespace().map(|f| format!("void {f}(void) {{}}\nvoid {f}f(void) {{}}\n")).collect();
    let written = fs::create_dir_all(directory).and_then(|()| fs::write(&source, functions));
    written.map_err(|error| format!("cannot write {}: {error}", source.display()))?;
    let mut cc = Command::new("cc");
    cc.args(["-shared", "-nostdlib", "-fno-builtin", "-w", "-Wl,-soname,libm.so.6", "-o"]);
    run(cc.arg(directory.join("libm.so")).arg(&source)).map(drop)
}

fn metadata(root: &Path, toolchain: &Toolchain) -> Result<String, String> {
    let mut cargo = toolchain.cargo(root);
    cargo.args(["metadata", "--format-version=1", "--locked", "--filter-platform", TARGET]);
    String::from_utf8(run(cargo.stdout(Stdio::piped()))?).map_err(|_| "cargo metadata is not UTF-8".into())
}

/// Runs a tool, whose own messages go where ours go; gives what it printed.
fn run(tool: &mut Command) -> Result<Vec<u8>, String> {
    let name = tool.get_program().display().to_string();
    let said = tool.stderr(Stdio::inherit()).output().map_err(|error| format!("cannot run {name}: {error}"))?;
    if said.status.success() { Ok(said.stdout) } else { Err(format!("{name} failed")) }
}
