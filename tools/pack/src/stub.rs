//! Builds the unpacker.

use crate::toolchain::{Toolchain, run};
use crate::{elf, rewrite};
use object::{Object, ObjectSymbol};
use std::path::Path;
use std::process::Command;

/// The linked unpacker, built in a directory of its own below `place`.
pub fn unpacker(toolchain: &Toolchain, place: &Path) -> Result<Vec<u8>, String> {
    let work = place.join(format!("unpacker-{}", std::process::id()));
    std::fs::create_dir_all(&work).map_err(|error| format!("{}: {error}", work.display()))?;
    let stub = build(&toolchain.rustc(), Path::new(env!("CARGO_MANIFEST_DIR")), &work);
    // What is left there harms nobody.
    let _ = std::fs::remove_dir_all(&work);
    stub
}

/// Compiles and links the unpacker with this `rustc` (1.89 or later; stable does) in the directory `work`, from the
/// sources in `sources`, which is this crate's own directory. Returns the linked ELF file.
pub fn build(rustc: &Path, sources: &Path, work: &Path) -> Result<Vec<u8>, String> {
    let library = work.join("libpack_model.rlib");
    let linked = work.join("stub.elf");
    run(Command::new(rustc)
        .args(COMMON)
        .args(["--crate-name=pack_model", "--crate-type=rlib", "-Cembed-bitcode=yes"])
        .arg(sources.join("model/src/lib.rs"))
        .arg("-o")
        .arg(&library))?;
    let script = format!("-Clink-arg=-Wl,-T,{}", sources.join("stub/stub.ld").display());
    run(Command::new(rustc)
        .args(COMMON)
        .args(["--crate-name=pack_stub", "--crate-type=bin", "-Clto=fat", &script])
        .args(["-nostartfiles", "-nostdlib", "-static", "-no-pie"].map(|arg| format!("-Clink-arg={arg}")))
        .args(["--build-id=none", "--gc-sections"].map(|arg| format!("-Clink-arg=-Wl,{arg}")))
        .arg("--extern")
        .arg(format!("pack_model={}", library.display()))
        .arg(sources.join("stub/src/lib.rs"))
        .arg("-o")
        .arg(&linked))?;
    let stub = std::fs::read(&linked).map_err(|error| format!("{}: {error}", linked.display()))?;
    rewrite_second(stub)
}

/// The unpacker with a second stage that is coded in fewer bits.
fn rewrite_second(mut stub: Vec<u8>) -> Result<Vec<u8>, String> {
    let segments = elf::segments(&stub)?;
    let code = symbol(&stub, "second")?..symbol(&stub, "second_data")?;
    let second = segments.into_iter().find(|s| s.kind == 1 && s.address == code.start).ok_or("no second stage")?;
    rewrite::rewrite_alone(&mut stub[second.file], code)?;
    Ok(stub)
}

/// The address that has this name.
fn symbol(stub: &[u8], name: &str) -> Result<u64, String> {
    let file = object::File::parse(stub).map_err(|error| error.to_string())?;
    let symbol = file.symbol_by_name(name).ok_or_else(|| format!("the unpacker has no {name}"))?;
    Ok(symbol.address())
}

/// For any x86-64 processor, so that the unpacker can say on an old one that the program will not run.
/// Level `z` costs 25 bytes more, as the second stage is coded, and is as fast; 2 costs 0.8 kB more, and constants
/// that are aligned.
///
/// Settings of LLVM as for the intro: 183 bytes less. The eight after `-disable-constant-hoisting` save 115 of 3,771 more,
/// the last of them with functions that nobody calls then, for copying and filling memory. Of each of thirty others nothing
/// is to be had.
const COMMON: [&str; 21] = [
    "--edition=2024",
    "--target=x86_64-unknown-linux-gnu",
    "-Copt-level=s",
    "-Cpanic=abort",
    "-Ccodegen-units=1",
    "-Crelocation-model=static",
    "-Cforce-unwind-tables=no",
    "-Cdebug-assertions=off",
    "-Cllvm-args=-regalloc=basic",
    "-Cllvm-args=-pre-RA-sched=list-hybrid",
    "-Cllvm-args=-enable-misched=false",
    "-Cllvm-args=-enable-load-pre=false",
    "-Cllvm-args=-disable-constant-hoisting",
    "-Cllvm-args=-mul-constant-optimization=0",
    "-Cllvm-args=-x86-use-vzeroupper=0",
    "-Cllvm-args=-enable-newgvn",
    "-Cllvm-args=-disable-licm-promotion",
    "-Cllvm-args=-disable-machine-licm",
    "-Cllvm-args=-max-store-memset=1",
    "-Cllvm-args=-bonus-inst-threshold=0",
    "-Cllvm-args=-disable-loop-idiom-all",
];
