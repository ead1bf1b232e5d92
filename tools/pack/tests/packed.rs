//! Packed programs, run for real. Their source is C, since whoever links Rust has a C compiler.

use pack::{packer, stub};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// mmap, memfd_create and execveat.
const MMAP: &str = "9";
const MEMFD_CREATE: &str = "319";
const EXECVEAT: &str = "322";
const CANNOT: Option<i32> = Some(126);

fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn work() -> &'static Path {
    Path::new(env!("CARGO_TARGET_TMPDIR"))
}

fn compile(source: &str, out: &str, options: &[&str]) -> PathBuf {
    let out = work().join(out);
    let status = Command::new("cc").args(options).arg(here().join("tests").join(source)).arg("-o").arg(&out).status();
    assert!(status.expect("cc runs").success(), "cc fails on {source}");
    out
}

/// A file to run; it was written by another process, so that no child of this one may hold it open for writing.
fn executable(name: &str, bytes: &[u8]) -> PathBuf {
    let (plain, path) = (work().join(format!("{name}.bytes")), work().join(name));
    fs::write(&plain, bytes).expect("the work directory is writable");
    let status = Command::new("cp").arg(&plain).arg(&path).status();
    assert!(status.expect("cp runs").success());
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).expect("own file");
    path
}

fn unpacker() -> &'static [u8] {
    static STUB: OnceLock<Vec<u8>> = OnceLock::new();
    STUB.get_or_init(|| {
        let work = work().join("stub");
        fs::create_dir_all(&work).expect("the work directory is writable");
        stub::build(Path::new("rustc"), here(), &work).expect("the unpacker compiles")
    })
}

fn subject(name: &str, options: &[&str]) -> Vec<u8> {
    let file = fs::read(compile("subject.c", name, options)).expect("just written");
    packer::pack(&file, unpacker()).expect("an ordinary program").bytes
}

fn small() -> &'static [u8] {
    static PACKED: OnceLock<Vec<u8>> = OnceLock::new();
    PACKED.get_or_init(|| subject("subject", &["-O2", "-no-pie"]))
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn check(output: &Output, name: &str) {
    assert_eq!(text(&output.stdout), format!("arguments: [{name}] [7] [a b] []\nenvironment: passed\n"));
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(7), String::new()));
}

#[test]
fn arguments_environment_and_status_pass_through() {
    for (name, options) in [("plain", vec!["-no-pie"]), ("pie", vec!["-O2", "-pie", "-fPIE"])] {
        let path = executable(&format!("{name}.packed"), &subject(name, &options));
        let output = Command::new(path).arg0("other name").args(["7", "a b", ""]).env("PACK_TEST", "passed").output();
        check(&output.expect("it runs"), "other name");
    }
}

#[test]
fn where_no_program_may_run_in_memory_it_says_so() {
    for number in [MEMFD_CREATE, EXECVEAT] {
        let refuse = compile("refuse.c", &format!("refuse_{number}"), &[]);
        let path = executable(&format!("refused_{number}.packed"), small());
        let output = Command::new(refuse).arg(number).arg(&path).output().expect("it runs");
        assert_eq!(output.status.code(), CANNOT);
        assert_eq!(text(&output.stderr), "paprsek: no program may run in memory here\n");
    }
}

#[test]
fn where_nothing_can_be_written_it_says_so() {
    let path = executable("nothing.packed", small());
    let script = "trap '' XFSZ; ulimit -f 0; exec \"$0\"";
    let output = Command::new("sh").arg("-c").arg(script).arg(path).output().expect("it runs");
    assert_eq!(output.status.code(), CANNOT);
    assert!(text(&output.stderr).starts_with("paprsek: no program may run"), "{}", text(&output.stderr));
}

#[test]
fn damage_is_reported() {
    let whole = small();
    // What comes before the payload is the code that looks for damage.
    let start = packer::pack(&fs::read(work().join("subject")).expect("small() made it"), unpacker());
    let start = start.map(|p| p.headers + p.stub).expect("an ordinary program");
    for i in 0..24 {
        let mut bytes = whole.to_vec();
        let at = start + (bytes.len() - 1 - start) * i / 23;
        bytes[at] ^= 1 << (i % 8);
        let output = Command::new(executable("damaged", &bytes)).output().expect("it starts");
        assert_eq!(text(&output.stderr), "paprsek: this file is damaged\n", "byte {at}");
        assert_eq!(output.status.code(), CANNOT);
    }
}

/// So many bits all over the second stage, as it is coded.
fn damages_the_unpacker(bits: usize) {
    let whole = small();
    let packed = packer::pack(&fs::read(work().join("subject")).expect("small() made it"), unpacker());
    let packed = packed.expect("an ordinary program");
    let [one, _] = packer::stages(unpacker()).expect("it is linked well");
    let coded = packed.headers + one.len()..packed.headers + packed.stub;
    for i in 0..bits {
        let mut bytes = whole.to_vec();
        // The last bits coded may be any.
        let at = coded.start + (coded.len() - 3) * i / (bits - 1);
        bytes[at] ^= 1 << (i % 8);
        let path = executable(&format!("damaged_unpacker_{bits}"), &bytes);
        let began = Instant::now();
        let output = Command::new(path).output().expect("it starts");
        assert_eq!(text(&output.stderr), "paprsek: damaged, or no memory\n", "byte {at}");
        assert_eq!(output.status.code(), CANNOT);
        assert!(began.elapsed() < Duration::from_secs(5), "byte {at} took {:?}", began.elapsed());
    }
}

#[test]
fn damage_of_the_unpacker_is_reported() {
    damages_the_unpacker(22);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn damage_all_over_the_unpacker_is_reported() {
    damages_the_unpacker(202);
}

#[test]
fn where_there_is_no_memory_it_says_so() {
    let path = executable("memory.packed", small());
    let mut little = Command::new("sh");
    little.arg("-c").arg("ulimit -v 50000; exec \"$0\"").arg(&path);
    let mut refused = Command::new(compile("refuse.c", "refuse_mmap", &["-static"]));
    refused.arg(MMAP).arg(&path);
    for mut command in [little, refused] {
        let output = command.output().expect("it runs");
        assert_eq!(output.status.code(), CANNOT);
        assert_eq!(text(&output.stderr), "paprsek: damaged, or no memory\n");
    }
}

/// What lies beyond the last page of a file cannot be read at all.
fn parts_are_reported(packed: &[u8], parts: &[usize]) {
    for &part in parts {
        let output = Command::new(executable("part", &packed[..part])).output().expect("it starts");
        assert_eq!(text(&output.stderr), "paprsek: this file is damaged\n", "{part} of {} bytes", packed.len());
        assert_eq!(output.status.code(), CANNOT);
    }
}

#[test]
fn a_part_of_a_file_is_reported() {
    parts_are_reported(small(), &[small().len() - 1]);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn a_part_of_a_large_file_is_reported() {
    let packed = subject("subject_static", &["-static"]);
    parts_are_reported(&packed, &[packed.len() - 1, packed.len() / 2, 12_000]);
}

#[test]
fn bad_input_is_an_error() {
    let file = fs::read(compile("subject.c", "bad", &[])).expect("just written");
    assert!(packer::pack(b"", unpacker()).is_err());
    assert!(packer::pack(b"#!/bin/sh\n", unpacker()).is_err());
    for end in (0..2000).step_by(61) {
        assert!(packer::pack(&file[..end], unpacker()).is_err(), "cut after {end} bytes");
    }
    // Each byte of the headers at its worst: whatever comes of it, no panic.
    for at in 0..64 + 56 * 4 {
        let mut bytes = file.clone();
        bytes[at] = 255;
        let _ = pack::elf::trim(&bytes);
    }
}
