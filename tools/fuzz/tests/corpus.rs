//! Every target takes the kept inputs and some thousands of mutations of them, on any toolchain. `run` goes further where
//! there is `cargo fuzz`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio, id};
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Longest time that a target may take for all of its inputs, on a loaded machine.
const LONGEST: Duration = Duration::from_secs(300);
/// Most bytes of memory that a target may have, kB. Rendering takes 150 MB, the packer's model 80.
const MEMORY: u32 = 3_000_000;
/// The seed of mutations: the same inputs each time.
const SEED: &str = "20";

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs a target over its kept inputs and `runs` mutations of them. A display and a sound server that only the process itself
/// serves, and an authority file of its own, are there for it.
#[track_caller]
fn replay(target: &str, runs: u32) {
    static NEXT: AtomicU32 = AtomicU32::new(0);
    let number = 1_000_000 + (16 * id() + NEXT.fetch_add(1, Ordering::Relaxed)) % 100_000_000;
    let kept = fs::read_dir(root().join("tools/fuzz/corpus").join(target)).unwrap();
    let kept: BTreeSet<PathBuf> = kept.map(|entry| entry.unwrap().path()).collect();
    assert!(kept.len() >= 3, "{target} has {} kept inputs", kept.len());
    let authority = std::env::temp_dir().join(format!("paprsek-fuzz-{number}"));
    let mut shell = Command::new("sh");
    shell.args(["-c", "ulimit -v $0; exec \"$@\"", &MEMORY.to_string(), env!("CARGO_BIN_EXE_replay"), target]);
    shell.args([&runs.to_string(), SEED]).args(&kept).current_dir(root());
    let sound = authority.with_extension("sound");
    shell.env("DISPLAY", format!(":{number}")).env("XAUTHORITY", &authority);
    shell.env("PULSE_SERVER", format!("unix:{}", sound.display())).stdout(Stdio::piped());
    let (mut child, began) = (shell.spawn().unwrap(), Instant::now());
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if began.elapsed() > LONGEST {
            child.kill().unwrap();
            panic!("{target} takes too long over target/fuzz/{target}-last");
        }
        sleep(Duration::from_millis(20));
    };
    let _ = fs::remove_file(authority);
    let _ = fs::remove_file(sound);
    let _ = fs::remove_file(format!("/tmp/.X11-unix/X{number}"));
    assert!(status.success(), "{target}: {status}, over target/fuzz/{target}-last");
    let mut said = String::new();
    std::io::Read::read_to_string(&mut child.stdout.take().unwrap(), &mut said).unwrap();
    assert_eq!(said, format!("{target}: {} files, {runs} mutations\n", kept.len()));
}

#[test]
fn command_lines_are_refused_or_within_their_ranges() {
    replay("command_line", 8000);
}

#[test]
fn decimals_are_those_of_the_standard_library() {
    replay("numbers", 20_000);
}

#[test]
fn an_x_server_may_say_anything() {
    replay("server", 500);
}

#[test]
fn an_authority_file_may_hold_anything() {
    replay("authority", 500);
}

#[test]
fn a_sound_server_may_say_anything() {
    replay("sound", 500);
}

#[test]
fn payloads_of_any_bytes_end_and_programs_come_back() {
    replay("unpacker", 150);
}

#[test]
fn scripts_do_what_their_statements_mean() {
    replay("scripts", 8000);
}

#[test]
fn meshes_of_any_shape_are_drawn() {
    replay("raster", 400);
}

#[test]
fn worlds_of_any_bodies_are_traced() {
    replay("trace", 400);
}

#[test]
fn snow_and_fire_of_any_numbers_are_drawn() {
    replay("particles", 400);
}

#[test]
fn clouds_of_any_voxels_are_drawn() {
    replay("cloud", 400);
}

#[test]
fn every_target_has_a_test() {
    let here = fs::read_to_string(root().join("tools/fuzz/tests/corpus.rs")).unwrap();
    for (target, _) in fuzz::TARGETS {
        assert!(here.contains(&format!("replay(\"{target}\",")), "{target} is not tested");
        let program = root().join("tools/fuzz/fuzz/fuzz_targets").join(target).with_extension("rs");
        assert!(fs::read_to_string(program).unwrap().contains(&format!("\"{target}\"")));
    }
}
