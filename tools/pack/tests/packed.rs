//! Packed programs, run for real. Their source is C, since whoever links Rust has a C compiler.

use pack::{packer, stub};
use std::fs;
use std::ops::Range;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;
use testkit::{Tool, needs};

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

const DAMAGED: &str = "paprsek: this file is damaged\n";
const DAMAGED_EARLY: &str = "paprsek: damaged, or no memory\n";

/// Where the coded second stage and the payload of [`small`] begin. What comes before the former is the code that looks
/// for damage.
fn places() -> [usize; 2] {
    small();
    let packed = packer::pack(&fs::read(work().join("subject")).expect("small() made it"), unpacker());
    let packed = packed.expect("an ordinary program");
    let [one, _] = packer::stages(unpacker()).expect("it is linked well");
    [packed.headers + one.len(), packed.headers + packed.stub]
}

/// Runs a damaged file: it says so in one of those lines, after less than a second of the processor's time, at which the
/// system would end it by a signal.
#[track_caller]
fn is_reported(name: &str, bytes: &[u8], lines: &[&str], what: &str) {
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -t 1; exec \"$0\""]).arg(executable(name, bytes));
    let output = command.output().expect("it starts");
    let said = text(&output.stderr);
    assert!(lines.contains(&&*said), "{what}: {:?} {said}", output.status);
    assert_eq!((output.status.code(), text(&output.stdout)), (CANNOT, String::new()), "{what}");
}

/// One bit in each of so many places, the first and the last among them.
fn bits_are_reported(name: &str, range: Range<usize>, bits: usize, line: &str) {
    for i in 0..bits {
        let mut bytes = small().to_vec();
        let at = range.start + (range.len() - 1) * i / (bits - 1);
        bytes[at] ^= 1 << (i % 8);
        is_reported(name, &bytes, &[line], &format!("byte {at}"));
    }
}

/// The coded second stage but for its last bits, which may be any.
fn second_stage() -> Range<usize> {
    let [second, payload] = places();
    second..payload - 2
}

#[test]
fn damage_is_reported() {
    let whole = small().len();
    bits_are_reported("damaged", places()[1]..whole, 24, DAMAGED);
}

#[test]
fn damage_of_the_unpacker_is_reported() {
    bits_are_reported("damaged_unpacker", second_stage(), 22, DAMAGED_EARLY);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn damage_all_over_the_unpacker_is_reported() {
    bits_are_reported("damaged_all_over", second_stage(), 202, DAMAGED_EARLY);
}

#[test]
fn a_damaged_stretch_is_reported() {
    let whole = small();
    let [second, payload] = places();
    for (from, to) in [
        (second, second + 16),
        (second, payload),
        (second + 600, second + 1100),
        (payload - 300, payload + 300),
        (payload, whole.len()),
        (whole.len() - 4, whole.len()),
        (second, whole.len()),
    ] {
        for value in [0, 0xff] {
            let mut bytes = whole.to_vec();
            bytes[from..to].fill(value);
            is_reported("stretch", &bytes, &[DAMAGED, DAMAGED_EARLY], &format!("{from} to {to} are {value}"));
        }
    }
}

#[test]
fn what_follows_the_file_does_not_matter() {
    for count in [1, 4096, 100_000] {
        let path = executable("followed", &[small(), &vec![0xa5; count]].concat());
        let output = Command::new(path).arg0("name").args(["7", "a b", ""]).env("PACK_TEST", "passed").output();
        check(&output.expect("it runs"), "name");
    }
}

/// qemu, as a processor that it makes up, about to run that program.
fn on_processor(processor: &str, program: &Path) -> Command {
    let mut command = Command::new("qemu-x86_64");
    command.args(["-cpu", processor]).arg(program);
    command
}

#[test]
fn an_old_processor_is_told_from_damage() {
    if !needs(&[Tool::Qemu]) {
        return;
    }
    let path = executable("processor.packed", small());
    // A hypervisor may hide AVX2 alone.
    let hidden = compile("processor.c", "processor", &["-static"]);
    assert!(on_processor("max,-avx2", &hidden).status().expect("qemu runs").success(), "FMA is to be there");
    for processor in ["max,-avx2", "max,-avx2,-fma", "max,-avx", "max,-xsave", "qemu64"] {
        let output = on_processor(processor, &path).output().expect("qemu runs");
        assert_eq!(text(&output.stderr), "paprsek: needs a processor with AVX2\n", "{processor}");
        assert_eq!((output.status.code(), text(&output.stdout)), (CANNOT, String::new()), "{processor}");
    }
}

#[test]
#[ignore = "long: run by .ci/run"]
fn a_processor_that_is_made_up_unpacks_too() {
    if !needs(&[Tool::Qemu]) {
        return;
    }
    let path = executable("made_up.packed", small());
    let mut command = on_processor("max", &path);
    let output = command.args(["7", "a b", ""]).env("PACK_TEST", "passed").output().expect("qemu runs");
    // The last step is a call of the system that older ones do not know; the file is unpacked by then.
    if text(&output.stderr) == "paprsek: no program may run in memory here\n" {
        assert_eq!(output.status.code(), CANNOT);
    } else {
        check(&output, &path.to_string_lossy());
    }
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
fn parts_are_reported(name: &str, packed: &[u8], parts: impl IntoIterator<Item = usize>) {
    for part in parts {
        is_reported(name, &packed[..part], &[DAMAGED_EARLY, DAMAGED], &format!("{part} of {} bytes", packed.len()));
    }
}

#[test]
fn a_part_of_a_file_is_reported() {
    // The first page ends within the second stage.
    let [second, payload] = places();
    let ends = [second, second + 1, second + 600, 4000, 4095, 4096, 4097, payload - 1, payload, payload + 1];
    parts_are_reported("part", small(), ends.into_iter().chain([small().len() - 1]));
}

#[test]
#[ignore = "long: run by .ci/run"]
fn a_part_of_a_large_file_is_reported() {
    let packed = subject("subject_static", &["-static"]);
    parts_are_reported("large_part", &packed, [packed.len() - 1, packed.len() / 2, 12_000, 8192, 4096, 2000]);
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
