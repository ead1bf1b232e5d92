//! The packed intro: 64 kB that play what the plain build plays.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;
use testkit::run::{self, fails, succeeds};

/// The packed intro, built once by `tools/pack`; `None` where its tests are to be skipped.
fn intro() -> Option<PathBuf> {
    static INTRO: OnceLock<Option<PathBuf>> = OnceLock::new();
    INTRO.get_or_init(build).clone()
}

fn build() -> Option<PathBuf> {
    if std::env::var_os("PAPRSEK_SKIP_INTRO").is_some() {
        return None;
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let target = root.join(option_env!("CARGO_TARGET_DIR").unwrap_or("target"));
    let mut pack = Command::new(env!("CARGO"));
    pack.current_dir(root).args(["run", "--quiet", "--package", "pack", "--target-dir"]).arg(&target);
    let output = pack.env("CARGO_TARGET_DIR", &target).output().unwrap();
    assert!(output.status.success(), "{}or set PAPRSEK_SKIP_INTRO=1", String::from_utf8_lossy(&output.stderr));
    Some(target.join("intro/paprsek"))
}

/// What a capture to stdout gives.
fn capture(mut program: Command, words: &[&str]) -> Vec<u8> {
    succeeds(program.args(words).args(["--capture", "-"]).output().unwrap())
}

#[test]
fn it_shows_the_plain_build_s_pictures() {
    let Some(intro) = intro() else { return };
    let show = ["--from", "1", "--to", "154", "--fps", "0.1", "--size", "160x90"];
    let fade = ["--from", "20.6", "--to", "21.4", "--fps", "25", "--size", "160x90"];
    let runs = [show.to_vec(), fade.to_vec(), [&show[..], &["--quality", "fast"]].concat()];
    for words in runs {
        let frames = capture(Command::new(&intro), &words);
        assert!(frames.len() >= 10 * 160 * 90 * 3);
        // One SIMD level gives the bytes of any other.
        assert!(frames == capture(run::paprsek(env!("CARGO_BIN_EXE_paprsek")), &words), "{words:?} differs");
    }
}

#[test]
fn it_needs_the_c_library_and_no_new_one() {
    let Some(intro) = intro() else { return };
    // As it was linked: the packer leaves out what the loader does not ask for, versions and the length of names.
    let linked = intro.with_file_name("build/x86_64-unknown-linux-gnu/release/paprsek.ordered");
    let readelf = |what: &str| {
        let mut readelf = Command::new("readelf");
        let output = readelf.args(["--wide", "--use-dynamic", what]).arg(&linked).output().expect("install binutils");
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
