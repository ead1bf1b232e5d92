//! The packed intro: 64 kB that play what the plain build plays.

use crate::{pack, target};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::process::Command;
use testkit::run::{self, fails, succeeds};
use testkit::{Tool, needs};

/// The packed intro; `None` where the test is left out.
fn intro() -> Option<PathBuf> {
    pack().then(|| target().join("intro/paprsek"))
}

/// What a capture to stdout gives.
fn capture(mut program: Command, words: &[&str]) -> Vec<u8> {
    succeeds(program.args(words).args(["--capture", "-"]).output().unwrap())
}

#[test]
#[ignore = "long: run by .ci/run"]
fn it_shows_the_plain_build_s_pictures() {
    let Some(intro) = intro() else { return };
    // At 120 s a byte was another one, since glam fused a cross product where the target could.
    let show = ["--from", "1", "--to", "154", "--fps", "1", "--size", "320x180"];
    let fade = ["--from", "20.6", "--to", "21.4", "--fps", "25", "--size", "160x90"];
    let runs = [show.to_vec(), fade.to_vec(), [&show[..], &["--quality", "fast"]].concat()];
    for words in runs {
        let frames = capture(Command::new(&intro), &words);
        assert!(frames.len() >= 20 * 160 * 90 * 3);
        // One SIMD level gives the bytes of any other.
        assert!(frames == capture(run::paprsek(env!("CARGO_BIN_EXE_paprsek")), &words), "{words:?} differs");
    }
}

#[test]
#[ignore = "long: run by .ci/run"]
fn it_needs_the_c_library_and_no_new_one() {
    if !needs(&[Tool::Readelf]) {
        return;
    }
    let Some(intro) = intro() else { return };
    // As it was linked: the packer leaves out what the loader does not ask for, versions and the length of names.
    let linked = intro.with_file_name("build/x86_64-unknown-linux-gnu/release/paprsek.ordered");
    let readelf = |what: &str| {
        let mut readelf = Command::new("readelf");
        let output = readelf.args(["--wide", "--use-dynamic", what]).arg(&linked).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let dynamic = readelf("--dynamic");
    let needed: Vec<_> = dynamic.lines().filter(|line| line.contains("(NEEDED)")).collect();
    let known = ["[libc.so.6]", "[libm.so.6]", "[ld-linux-x86-64.so.2]"];
    assert!(!needed.is_empty());
    for line in needed {
        assert!(known.iter().any(|name| line.ends_with(name)), "{line}");
    }
    // Ubuntu 22.04 has glibc 2.35, Debian 12 has 2.36.
    let symbols = readelf("--symbols");
    let minor = |version: &str| version.split(|c: char| !c.is_ascii_digit()).next().unwrap().parse::<u32>().unwrap();
    let newest = symbols.split("@GLIBC_2.").skip(1).map(minor).max().expect("functions of glibc");
    assert!(newest <= 35, "glibc 2.{newest}");
}

#[test]
#[ignore = "long: run by .ci/run"]
fn a_damaged_file_says_so() {
    let Some(intro) = intro() else { return };
    let whole = fs::read(&intro).unwrap();
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("damaged");
    for place in [whole.len() / 4, whole.len() / 2, whole.len() - 5] {
        let mut bytes = whole.clone();
        bytes[place] ^= 4;
        fs::write(&path, &bytes).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        let output = Command::new(&path).arg("--help").output().unwrap();
        assert!(!output.status.success());
        let said = fails(&output, output.status.code().expect("an exit, not a signal"));
        assert!(said.contains("damaged"), "{said}");
    }
}

#[test]
#[ignore = "long: run by .ci/run"]
fn a_processor_without_avx2_is_told_so() {
    if !needs(&[Tool::Qemu]) {
        return;
    }
    let Some(intro) = intro() else { return };
    // The tests of the packer have more of them.
    let output = Command::new("qemu-x86_64").args(["-cpu", "max,-avx2"]).arg(&intro).arg("--help").output().unwrap();
    assert_eq!(fails(&output, 126), "paprsek: needs a processor with AVX2\n");
}
