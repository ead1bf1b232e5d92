//! The intro's executable before it is packed: cargo, with everything that makes it small.

use crate::toolchain::Toolchain;
use crate::{library, link};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const TARGET: &str = "x86_64-unknown-linux-gnu";

/// Flags of the compiler, for our code and the standard library alike.
const FLAGS: &[&str] = &[
    // The plain build is where warnings are errors.
    "-Awarnings",
    // A panic ends the process without a word: no messages, no unwinding, no tables for it.
    "-Zunstable-options",
    "-Cpanic=immediate-abort",
    "-Cforce-unwind-tables=no",
    "-Zlocation-detail=none",
    // Functions of the C library are called as our own are: 80 bytes.
    "-Zplt=yes",
    "-Zfmt-debug=none",
    "-Zinline-mir-hint-threshold=40",
    "-Zmutable-noalias=no",
    // One SIMD level, AVX2: what processors have had since 2013 (Intel), 2015 (AMD).
    "-Ctarget-cpu=x86-64-v3",
    "--cfg=disable_dispatch_avx512",
    "--cfg=disable_dispatch_sse4_2",
    "--cfg=disable_dispatch_sse2",
    "--cfg=disable_dispatch_fallback",
    // At a fixed address there is nothing to relocate.
    "-Crelocation-model=static",
    "-Clink-arg=-no-pie",
    "-Clink-arg=-Wl,--build-id=none,-z,norelro,--no-eh-frame-hdr,-z,noseparate-code,--hash-style=sysv",
];

/// Settings of cargo. Line tables are for finding out what the bytes are; they add 34 bytes, which are zeros once packed.
const SETTINGS: &[&str] = &[
    "profile.release.strip=false",
    "profile.release.debug='line-tables-only'",
    // As fast as 3 for half of its bytes, see ARCHITECTURE.md.
    "profile.release.package.paprsek.opt-level=2",
    "profile.release.package.paprsek.strip=false",
];

/// Flags of the renderer and the executable: kernels say themselves what is inlined.
const OWN: &str = "profile.release.package.paprsek.rustflags=['-Cllvm-args=-inlinedefault-threshold=10', \
    '-Cllvm-args=-enable-newgvn'";

/// Settings of LLVM where the whole program is compiled: fewer bytes once packed, a twentieth slower.
const LLVM: &[&str] = &[
    "-regalloc=basic",
    "-disable-block-placement",
    // Instructions in an order that needs few registers, and no later one for a processor's sake: 0.9 kB, no slower.
    "-pre-RA-sched=list-hybrid",
    "-enable-misched=false",
    // Addresses in loops stay what the source has; what is chosen or rare stays where it was. As fast.
    "-mul-constant-optimization=0",
    "-x86-use-vzeroupper=0",
    "-max-store-memcpy=1",
    "-max-speculation-depth=1",
    "-max-store-memset=4",
    "-disable-x86-lea-opt",
    "-disable-lsr",
    "-x86-cmov-converter=false",
    "-enable-shrink-wrap=false",
    "-disable-constant-hoisting",
];

/// Builds the intro of the workspace at `root` below `target`; gives the path of the executable, with symbols.
/// Its code is the same wherever `root` is, as long as `target` is below it at the same place. What [`crate::marginal`]
/// lists can be left out. The order of its parts is what packs best.
pub fn build(root: &Path, toolchain: &Toolchain, target: &Path, without: Option<&str>) -> Result<PathBuf, String> {
    let whole = |path: &Path| {
        let made = fs::create_dir_all(path).and_then(|()| path.canonicalize());
        made.map_err(|error| format!("cannot make {}: {error}", path.display()))
    };
    let (root, target) = (whole(root)?, whole(target)?);
    let library = target.join("library");
    library::cut(&library::sources(&toolchain.sysroot), &library)?;
    let mut cargo = toolchain.cargo(&root);
    // A cargo that knows this no more builds the library as it is, for some more bytes.
    cargo.env("__CARGO_TESTS_ONLY_SRC_ROOT", &library);
    cargo.args(["rustc", "--release", "--locked", "--package", "paprsek", "--bin", "paprsek"]);
    cargo.args(["--no-default-features"]);
    cargo.arg("-Zprofile-rustflags");
    cargo.args(["-Zbuild-std=std,panic_abort", "-Zbuild-std-features=optimize_for_size", "--target", TARGET]);
    cargo.arg("--target-dir").arg(&target);
    for setting in SETTINGS {
        cargo.args(["--config", setting]);
    }
    let left_out = without.map_or(String::new(), |name| format!(", '--cfg', 'without=\"{name}\"'"));
    cargo.args(["--config", &format!("{OWN}{left_out}]")]);
    cargo.env("CARGO_ENCODED_RUSTFLAGS", FLAGS.join("\x1f"));
    // The executable's own files are the shell around the renderer, where size alone counts; and it is linked.
    // Its path starts with a dot so that what was linked before the order was found is linked anew.
    // The linker has no part in FLAGS: cargo names crates by their flags, and no name may depend on a path.
    cargo.args(["--", "-Copt-level=z", "-Clinker=./tools/pack/cc"]);
    // What is linked is the assembly, after `reloads`, which needs the remarks on what is spilled.
    cargo.args(["--emit=asm", "-Zverbose-asm"]);
    cargo.args(LLVM.iter().map(|setting| format!("-Cllvm-args={setting}")));
    run(&mut cargo)?;
    link::link(&target.join(TARGET).join("release/paprsek"))
}

/// Runs cargo, whose own messages go where ours go.
fn run(cargo: &mut Command) -> Result<(), String> {
    let status = cargo.stdout(Stdio::null()).status().map_err(|error| format!("cannot run cargo: {error}"))?;
    if status.success() { Ok(()) } else { Err("cargo failed".into()) }
}
