//! The command line: what is refused and how, and what the files and figures look like. The 64 kB build has the show
//! alone, without scenes to name and anything to measure.

use crate::{after, paprsek};
#[cfg(feature = "full")]
use paprsek::scenes;
use paprsek::scenes::show::intro::INTRO;
use paprsek::settings::Quality;
#[cfg(feature = "full")]
use paprsek::simd::level;
#[cfg(target_os = "linux")]
use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};
#[cfg(feature = "full")]
use serde_json::Value;
use std::fs::{self, File, OpenOptions};
use std::io::Read;
#[cfg(unix)]
use std::os::{fd::OwnedFd, unix::net::UnixStream};
use std::path::Path;
use std::process::{Output, Stdio};
#[cfg(feature = "full")]
use std::thread::available_parallelism;
#[cfg(unix)]
use std::thread::sleep;
use std::time::Duration;
use testkit::run::{fails, succeeds};

/// Are there scenes to name, and a benchmark?
const MEASURES: bool = cfg!(feature = "full");

fn run(words: &[&str]) -> Output {
    paprsek().args(words).output().unwrap()
}

/// Captures into a new directory, and gives its files in order.
#[track_caller]
fn capture(words: &[&str]) -> Vec<(String, Vec<u8>)> {
    let directory = tempfile::tempdir().unwrap();
    succeeds(paprsek().args(words).arg("--capture").arg(directory.path()).output().unwrap());
    files(directory.path())
}

fn files(directory: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap())
        .map(|entry| (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap()))
        .collect();
    files.sort();
    files
}

#[test]
fn bad_usage_is_one_line_and_exit_2() {
    let lines: &[&str] = &[
        "nosuchscene",
        "lumen lumen",
        "--nosuchoption",
        "-x",
        "-1",
        "--bench=1",
        "--size",
        "--size 0x0",
        "--size 0x5",
        "--size 5x0",
        "--size 16385x1",
        "--size 1x16385",
        "--size 16384x16384",
        "--size 8193x8192",
        "--size 99999999999999999999x9",
        "--size 18446744073709551617x1",
        "--size axb",
        "--size 7",
        "--size 7x",
        "--size x7",
        "--size 7x3x2",
        "--size -7x3",
        "--size +7x3",
        "--size 7.0x3",
        "--size 7X3",
        "--threads",
        "--threads 0",
        "--threads -1",
        "--threads 1025",
        "--threads 1.5",
        "--threads two",
        "--threads +2",
        "--at",
        "--at -1",
        "--at NaN",
        "--at nan",
        "--at inf",
        "--at -inf",
        "--at 1e999",
        "--at soon",
        "--at 1000000000001",
        "--at 20000000000000000",
        "--at 1s",
        "--at --bench",
        "--from -0.5",
        "--from NaN",
        "--to inf",
        "--to -1",
        "--from 5 --to 4",
        "--to 1000000000001",
        "--from 1000000000",
        "--at 1 --from 0",
        "--at 1 --to 2",
        "--at 1 --from 0 --to 2",
        "--fps 0",
        "--fps -30",
        "--fps inf",
        "--fps NaN",
        "--fps 1001",
        "--fps fast",
        "--capture . --fps 1000 --to 1000000",
        "--json",
        "--json --at 1",
        "--bench --capture .",
        "--capture",
        "--capture --at 1",
        "--quality",
        "--quality best",
        "--quality DEFAULT",
        "--capture . --fps 1000 --from 999 --to 1001",
        "--fullscreen=1",
        "--stereo=1",
        "--stereo --size 1x5",
        "--eye-distance 0.07",
        "--convergence 4",
        "--bench --convergence 4 --eye-distance 0.07",
        "--stereo --eye-distance",
        "--stereo --eye-distance -0.1",
        "--stereo --eye-distance NaN",
        "--stereo --eye-distance inf",
        "--stereo --eye-distance 101",
        "--stereo --eye-distance wide",
        "--stereo --convergence",
        "--stereo --convergence 0",
        "--stereo --convergence -5",
        "--stereo --convergence NaN",
        "--stereo --convergence 1e-9",
        "--stereo --convergence 10001",
        "--stereo --convergence 5m",
    ];
    for line in lines {
        let output = run(&line.split(' ').collect::<Vec<_>>());
        let said = fails(&output, 2);
        assert!(output.stdout.is_empty(), "{line}: {said}");
    }
    for words in [&["--size", ""][..], &["--at", ""], &["--capture", ""], &[""], &["two\nlines"], &["--at", "1\r2"]] {
        fails(&run(words), 2);
    }
}

#[cfg(unix)]
#[test]
fn arguments_need_not_be_unicode() {
    use std::os::unix::ffi::OsStrExt;
    let word = std::ffi::OsStr::from_bytes(b"\xff\xfe");
    fails(&paprsek().arg(word).output().unwrap(), 2);
    fails(&paprsek().arg("--size").arg(word).output().unwrap(), 2);
}

#[cfg(feature = "full")]
#[test]
fn an_unknown_name_is_answered_with_the_known_ones() {
    let said = fails(&run(&["nosuchscene"]), 2);
    assert!(scenes::all().iter().all(|scene| said.contains(scene.name)), "{said}");
    let said = fails(&run(&["--quality", "best"]), 2);
    assert!(Quality::NAMES.iter().all(|name| said.contains(name)), "{said}");
}

/// Every level of the machine gives the same bytes; other names are refused.
#[cfg(feature = "full")]
#[test]
fn kernels_run_at_the_level_that_is_asked_for() {
    let still = ["spheres", "--at", "2", "--size", "64x36", "--capture", "-"];
    let usual = succeeds(run(&still));
    for (name, _) in level::all() {
        assert_eq!(succeeds(run(&[&still[..], &["--simd", name]].concat())), usual, "{name}");
        let json = succeeds(run(&["spheres", "--at", "2", "--size", "8x8", "--bench", "--json", "--simd", name]));
        assert!(String::from_utf8(json).unwrap().contains(&format!("\"simd\":\"{name}\"")), "{name}");
    }
    fails(&run(&["spheres", "--simd", "avx3"]), 2);
    fails(&run(&["spheres", "--simd"]), 2);
}

#[test]
fn help_and_version_are_answered() {
    let help = String::from_utf8(succeeds(run(&["--help"]))).unwrap();
    let options = ["--size", "--threads", "--at", "--from", "--to", "--fps", "--capture", "--quality", "--fullscreen"];
    let more = [
        "--bench",
        "--json",
        "--stereo",
        "--eye-distance",
        "--convergence",
        "--list",
        "--version",
        "--parameters",
        "--set",
        "--simd",
    ];
    assert!(options.iter().all(|option| help.contains(option)), "{help}");
    assert!(more.iter().all(|option| help.contains(option) == MEASURES), "{help}");
    assert!(!MEASURES || include_str!("../../docs/usage.md").contains(&*help), "docs/usage.md has another help");
    if MEASURES {
        let version = String::from_utf8(succeeds(run(&["--version"]))).unwrap();
        assert_eq!(version, concat!("paprsek ", env!("CARGO_PKG_VERSION"), "\n"));
    }
}

#[cfg(feature = "full")]
#[test]
fn scenes_are_listed() {
    let list = String::from_utf8(succeeds(run(&["--list"]))).unwrap();
    let names: Vec<_> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(names, scenes::all().iter().map(|scene| scene.name).collect::<Vec<_>>());
}

#[test]
fn every_size_gives_a_whole_picture() {
    for (width, height) in [(1, 1), (7, 3), (16384, 1), (1, 16384), (64, 65)] {
        let files = capture(&["--at", "2", "--size", &format!("{width}x{height}")]);
        let header = format!("P6\n{width} {height}\n255\n");
        assert_eq!(files.len(), 1);
        assert_eq!(files[0].0, "frame-000000.ppm");
        assert!(files[0].1.starts_with(header.as_bytes()));
        assert_eq!(files[0].1.len(), header.len() + 3 * width * height);
    }
}

#[test]
fn an_instant_is_the_same_frame_as_in_a_run() {
    let run = capture(&["--from", "1", "--to", "1.5", "--fps", "10", "--size", "64x36"]);
    let names: Vec<_> = run.iter().map(|file| file.0.as_str()).collect();
    assert_eq!(
        names,
        ["frame-000010.ppm", "frame-000011.ppm", "frame-000012.ppm", "frame-000013.ppm", "frame-000014.ppm"]
    );
    let alone = capture(&["--at", "1.3", "--size", "64x36"]);
    assert_eq!(run[3].1, alone[0].1);
    assert_ne!(run[2].1, run[3].1);
}

#[test]
fn pieces_are_the_whole() {
    // The frame times of the second are no decimals, and 0.7 s is 20.979 frames.
    for (fps, boundaries) in [
        ("10", &["0.3", "0.35", "0.5000001", "0.05", "0.1"][..]),
        ("29.97", &["0.7", "0.03336670003336670", "0.6"]),
        ("1000", &["0.7", "0.701", "0.7005"]),
    ] {
        let (start, end) = if fps == "1000" { ("0.698", "0.703") } else { ("0", "0.8") };
        let piece = |target: &Path, from: &str, to: &str| {
            let words = ["--fps", fps, "--size", "32x18", "--quality", "fast", "--from", from, "--to", to];
            succeeds(paprsek().args(words).arg("--capture").arg(target).output().unwrap())
        };
        let whole = tempfile::tempdir().unwrap();
        piece(whole.path(), start, end);
        let whole = files(whole.path());
        assert!(whole.len() >= 5);
        let stream = Path::new("-");
        let streams = [piece(stream, start, boundaries[0]), piece(stream, boundaries[0], end)].concat();
        assert!(whole.iter().flat_map(|file| &file.1).eq(&streams), "the streams at {fps} a second");
        for &boundary in boundaries {
            let directory = tempfile::tempdir().unwrap();
            // The later piece first, as on another machine.
            piece(directory.path(), boundary, end);
            let later = files(directory.path()).len();
            assert!(later > 0 && later < whole.len());
            piece(directory.path(), start, boundary);
            assert!(files(directory.path()) == whole, "cut at {boundary} at {fps} a second");
        }
    }
}

#[test]
fn the_pieces_of_the_usage_are_the_show() {
    let usage = include_str!("../../docs/usage.md");
    let (_, after) = usage.split_once(" seconds in pieces of ").unwrap();
    let step: usize = after.split(',').next().unwrap().parse().unwrap();
    let (length, count) = (INTRO.duration as usize, INTRO.duration as usize / step);
    assert_eq!(INTRO.duration, (count * step) as f64, "a piece is cut off");
    for text in [
        format!("Its {length} seconds"),
        format!("seq 0 {step} {}", length - step),
        format!("$_ += {step} "),
        format!("--array=0-{} ", count - 1),
        format!("$(({step} * SLURM_ARRAY_TASK_ID))"),
        format!("$((from + {step}))"),
    ] {
        assert!(usage.contains(&text), "{text}");
    }
}

#[test]
fn a_piece_between_two_frames_is_empty() {
    assert_eq!(capture(&["--from", "0.11", "--to", "0.19", "--fps", "10", "--size", "8x8"]), []);
}

#[test]
fn threads_do_not_change_a_byte() {
    for (quality, _) in Quality::NAMED {
        let words = ["--to", "0.1", "--size", "97x55", "--quality", quality, "--threads"];
        let one = capture(&[&words[..], &["1"]].concat());
        assert_eq!(one.len(), 3);
        assert_eq!(one, capture(&[&words[..], &["2"]].concat()));
    }
}

#[cfg(feature = "full")]
#[test]
fn without_a_scene_the_show_plays() {
    let words = ["--at", "2", "--size", "64x36"];
    assert_eq!(capture(&words), capture(&[&["intro"], &words[..]].concat()));
}

#[cfg(feature = "full")]
#[test]
fn two_eyes_see_what_their_distance_lets_them() {
    let words = ["lumen", "--at", "15", "--size", "64x36", "--stereo"];
    let usual = capture(&words);
    // The eyes of the help's defaults.
    assert_eq!(usual, capture(&[&words[..], &["--eye-distance", "0.065", "--convergence", "5"]].concat()));
    let others =
        [["--eye-distance", "0"], ["--eye-distance", "100"], ["--convergence", "0.01"], ["--convergence", "10000"]];
    for other in others {
        assert_ne!(usual, capture(&[&words[..], &other].concat()), "{other:?}");
    }
}

#[test]
fn a_stream_is_the_files_in_a_row() {
    let words = ["--to", "0.2", "--fps", "20", "--size", "33x9"];
    let stream = succeeds(run(&[&words[..], &["--capture", "-"]].concat()));
    assert_eq!(stream, capture(&words).into_iter().flat_map(|file| file.1).collect::<Vec<_>>());
}

#[test]
fn a_capture_makes_its_directories_and_replaces_its_files() {
    let directory = tempfile::tempdir().unwrap();
    let deep = directory.path().join("a/b");
    for at in ["1", "2"] {
        let mut command = paprsek();
        succeeds(command.args(["--size", "16x9", "--at", at, "--capture"]).arg(&deep).output().unwrap());
    }
    assert_eq!(files(&deep), capture(&["--size", "16x9", "--at", "2"]));
}

#[test]
fn a_directory_that_cannot_be_written_is_said() {
    let directory = tempfile::tempdir().unwrap();
    let file = directory.path().join("file");
    File::create(&file).unwrap();
    for target in [&file, &file.join("below"), Path::new("/proc/paprsek"), Path::new("/proc")] {
        let output = paprsek().args(["--at", "1", "--size", "8x8", "--capture"]).arg(target).output().unwrap();
        fails(&output, 1);
    }
    assert_eq!(files(directory.path()), [("file".to_string(), Vec::new())]);
}

#[test]
fn a_frame_that_cannot_be_put_in_place_leaves_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let taken = directory.path().join("frame-000000.ppm");
    fs::create_dir(&taken).unwrap();
    let output = paprsek().args(["--at", "1", "--size", "8x8", "--capture"]).arg(directory.path()).output().unwrap();
    fails(&output, 1);
    assert_eq!(fs::read_dir(directory.path()).unwrap().count(), 1);
}

#[cfg(unix)]
#[test]
fn a_link_that_is_planted_is_not_followed() {
    let directory = tempfile::tempdir().unwrap();
    let (mine, target) = (directory.path().join("mine"), directory.path().join("target"));
    fs::write(&mine, "mine").unwrap();
    fs::create_dir(&target).unwrap();
    // Under the frame's own name, and under that with the number of the process, which anybody can foretell.
    let deed = "ln -s ../mine target/frame-000000.ppm; ln -s ../mine target/frame-000000.ppm.$$";
    let words = ["--at", "1", "--size", "8x8", "--capture", "target"];
    succeeds(after(deed).args(words).current_dir(&directory).output().unwrap());
    assert_eq!(fs::read(&mine).unwrap(), b"mine");
    assert!(capture(&words[..4])[0] == files(&target)[0], "another picture");
    assert!(!fs::symlink_metadata(target.join("frame-000000.ppm")).unwrap().is_symlink());
    assert_eq!(files(&target).len(), 2, "something is left over");
}

/// Kilobytes of addresses that a frame of 64 MB fits into, but not its 48 MB as a file too.
#[cfg(target_os = "linux")]
const ROOM: usize = 100_000;

#[cfg(target_os = "linux")]
#[test]
fn a_file_needs_no_memory_beside_its_frame() {
    let room = format!("ulimit -v {ROOM}");
    let words = ["--at", "1", "--size", "4000x4000", "--quality", "fast", "--threads", "1", "--capture", "-"];
    assert_eq!(succeeds(after(&room).args(words).output().unwrap()).len(), "P6\n4000 4000\n255\n".len() + 48_000_000);
    let words = ["--at", "1", "--size", "8000x8000", "--capture", "-"];
    assert!(fails(&after(&room).args(words).output().unwrap(), 1).contains("no memory"));
}

#[cfg(unix)]
#[test]
fn a_stream_waits_for_a_slow_reader() {
    let (to, mut from) = UnixStream::pair().unwrap();
    // Whoever writes to it is told at once that it is full.
    to.set_nonblocking(true).unwrap();
    let words = ["--at", "1", "--size", "640x360", "--quality", "fast", "--capture", "-"];
    let child = paprsek().args(words).stdout(OwnedFd::from(to)).stderr(Stdio::piped()).spawn().unwrap();
    let mut picture = Vec::new();
    let mut piece = [0; 100_000];
    loop {
        sleep(Duration::from_millis(50));
        match from.read(&mut piece).unwrap() {
            0 => break,
            count => picture.extend_from_slice(&piece[..count]),
        }
    }
    succeeds(child.wait_with_output().unwrap());
    assert!(picture == succeeds(run(&words)));
}

/// The standard library opens `/dev/null` in place of a stream that is closed, before `main`: the plain build looks earlier,
/// and the packed file's library leaves it closed. What cargo builds for the latter does neither.
#[cfg(target_os = "linux")]
#[test]
fn a_closed_stdout_is_said() {
    if !cfg!(feature = "minifb") && std::env::var_os("PAPRSEK").is_none() {
        return;
    }
    let capture = ["--at", "1", "--size", "8x8", "--capture", "-"];
    let all = [&["--help"][..], &capture, &["--list"], &["--version"]];
    for words in if MEASURES { &all[..] } else { &all[..2] } {
        // Whether stdin, whose place it might take, is open or not.
        for deed in ["exec >&-", "exec <&- >&-"] {
            let said = fails(&after(deed).args(*words).output().unwrap(), 1);
            // EBADF, as the system would say.
            assert_eq!(said, "paprsek: cannot write to stdout (os error 9)\n");
        }
        // Nothing is wrong with a stdout that leads nowhere, however it was opened: as shells do, and as callers in Python do.
        for deed in ["exec >/dev/null", "exec 1<>/dev/null", "exec <&- >/dev/null"] {
            assert!(succeeds(after(deed).args(*words).output().unwrap()).is_empty());
        }
        let both = OpenOptions::new().read(true).write(true).open("/dev/null").unwrap();
        succeeds(paprsek().args(*words).stdout(both).output().unwrap());
    }
}

/// Words that capture a pixel of much else to do: shapes of clouds, or a landscape with clouds.
#[cfg(target_os = "linux")]
fn pixel() -> Vec<&'static str> {
    let scene: &[_] = if MEASURES { &["sky-of-clouds", "--at", "1"] } else { &["--at", "40"] };
    [scene, &["--size", "1x1", "--capture", "-", "--threads"]].concat()
}

#[cfg(target_os = "linux")]
#[test]
fn no_more_threads_start_than_there_are_cores() {
    // On one core, where the answer is exact: of more, a thread whose work is done may still be ending beside the next.
    let cores = sched_getaffinity(None).unwrap();
    let mut one = CpuSet::new();
    one.set((0..CpuSet::MAX_CPU).find(|&core| cores.is_set(core)).unwrap());
    // Of this test's thread, and so of the program that it starts.
    sched_setaffinity(None, &one).unwrap();
    let child = paprsek().args(pixel()).arg("1024").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    sched_setaffinity(None, &cores).unwrap();
    let tasks = format!("/proc/{}/task", child.id());
    let mut most = 0;
    // A process that has ended, but that nobody has waited for, has one.
    while fs::read_to_string(format!("/proc/{}/stat", child.id())).is_ok_and(|stat| !stat.contains(") Z ")) {
        most = most.max(fs::read_dir(&tasks).map_or(0, Iterator::count));
        sleep(Duration::from_millis(1));
    }
    let picture = succeeds(child.wait_with_output().unwrap());
    assert_eq!(most, 1, "threads on one core");
    assert!(picture == succeeds(paprsek().args(pixel()).arg("1").output().unwrap()));
}

#[cfg(target_os = "linux")]
#[test]
fn threads_that_cannot_start_are_said_or_not_needed() {
    // Where the standard library is asked how large stacks are, no thread gets so large a one.
    let output = paprsek().args(pixel()).arg("2").env("RUST_MIN_STACK", (1usize << 46).to_string()).output().unwrap();
    if output.status.success() {
        assert!(succeeds(output) == succeeds(paprsek().args(pixel()).arg("1").output().unwrap()));
    } else {
        assert!(fails(&output, 1).contains("threads"));
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_said() {
    let measuring = [&["--list"][..], &["--version"], &["--bench", "--size", "8x8"]];
    let all = [&["--capture", "-", "--at", "1"][..], &["--help"]];
    for words in all.into_iter().chain(measuring.into_iter().filter(|_| MEASURES)) {
        let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
        fails(&paprsek().args(words).stdout(full).output().unwrap(), 1);
    }
    // Nowhere to say it: the exit code is what is left.
    let full = OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = paprsek().arg("--nosuchoption").stderr(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn a_closed_pipe_is_said() {
    let measuring = [&["--bench", "--size", "8x8"][..]];
    let all = [&["--capture", "-", "--size", "640x360"][..]];
    for words in all.into_iter().chain(measuring.into_iter().filter(|_| MEASURES)) {
        let mut command = paprsek();
        let mut child = command.args(words).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut head = [0; 40];
        child.stdout.take().unwrap().read_exact(&mut head).unwrap();
        fails(&child.wait_with_output().unwrap(), 1);
    }
}

#[cfg(feature = "full")]
#[test]
fn a_benchmark_prints_one_object_a_line() {
    let words = ["lumen", "--bench", "--json", "--threads", "2", "--size", "64x36", "--quality", "fast"];
    let lines = String::from_utf8(succeeds(run(&words))).unwrap();
    assert_eq!(lines.lines().count(), 1);
    let row: Value = serde_json::from_str(&lines).unwrap();
    let text = |key: &str| row[key].as_str().unwrap_or_else(|| panic!("{key} in {row}")).to_owned();
    let number = |key: &str| row[key].as_f64().unwrap_or_else(|| panic!("{key} in {row}"));
    assert_eq!((text("scene"), text("quality")), ("lumen".into(), "fast".into()));
    let threads = available_parallelism().unwrap().get().min(2) as f64;
    assert_eq!((number("width"), number("height"), number("threads")), (64.0, 36.0, threads));
    assert!(!text("simd").is_empty() && number("frames") >= 1.0 && number("samples") > 0.0);
    assert!(number("fps_p1") > 0.0 && number("fps_p1") <= number("fps_median"), "{row}");
    // The milliseconds are rounded to three places.
    assert!((1000.0 / number("fps_median") - number("ms_median")).abs() < 0.001, "{row}");
    let stereo = String::from_utf8(succeeds(run(&[&words[..], &["--stereo"]].concat()))).unwrap();
    let stereo: Value = serde_json::from_str(&stereo).unwrap();
    assert!(stereo.as_object().unwrap().keys().eq(row.as_object().unwrap().keys()), "{stereo}");
    assert_eq!((&stereo["width"], &stereo["height"]), (&row["width"], &row["height"]));
}

#[cfg(feature = "full")]
#[test]
fn without_a_scene_every_scene_is_timed() {
    let lines = String::from_utf8(succeeds(run(&["--bench", "--json", "--at", "2", "--size", "8x8"]))).unwrap();
    let rows: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let names: Vec<_> = rows.iter().filter_map(|row| row["scene"].as_str()).collect();
    assert_eq!(names, scenes::all().iter().map(|scene| scene.name).collect::<Vec<_>>());
}

#[cfg(feature = "full")]
#[test]
fn without_a_display_or_a_terminal_the_benchmark_runs() {
    let output = run(&["lumen", "--size", "16x9"]);
    let said = fails(&output, 0);
    assert!(said.contains("no display"), "{said}");
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.lines().any(|line| line.starts_with("lumen ")), "{table}");
}
