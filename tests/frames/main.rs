//! Every scene's frames are the bytes that they were: what only moves, renames or speeds up code changes none of them.
//!
//! This proves "unchanged", not "right"; the tests with oracles do that. A change that is meant to alter pictures
//! replaces `frames.txt` by the table that the failing test leaves behind, and says why.

use fearless_simd::Level;
use paprsek::frame::{Frame, Options, Renderer};
use paprsek::scenes;
use paprsek::settings::Quality;
use paprsek::view::Stereo;
use std::fmt::Write;

/// Shares of a scene's length at which it is rendered.
const INSTANTS: [f64; 5] = [0.03, 0.27, 0.48, 0.71, 0.94];

/// The frame's pixels by FNV-1a, 64 bits (Fowler, Noll and Vo).
fn hash(frame: &Frame) -> u64 {
    let bytes = frame.pixels.iter().flat_map(|pixel| pixel.to_le_bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ byte as u64).wrapping_mul(0x0100_0000_01b3))
}

/// A line per frame: scene, time, quality, size, one eye or two; then the hash.
fn table(renderer: &mut Renderer) -> String {
    let mut table = String::new();
    let pair = Some(Stereo { eye_distance: 0.065, convergence: 8.0 });
    for scene in scenes::all() {
        let mut line = |share: f64, name: &str, (width, height), stereo| {
            let time = (share * scene.duration * 100.0).round() / 100.0;
            let mut frame = Frame::new(width, height);
            let quality = &Quality::named(name).unwrap();
            let options = Options { quality, stereo, ..Options::default() };
            renderer.render_with(scene, time, &options, &mut frame);
            let eyes = if stereo.is_some() { "two" } else { "one" };
            writeln!(table, "{} {time} {name} {width}x{height} {eyes} {:016x}", scene.name, hash(&frame)).unwrap();
        };
        for share in INSTANTS {
            line(share, "fast", (160, 90), None);
            line(share, "default", (160, 90), None);
            line(share, "exact", (97, 55), None);
            line(share, "reference", (31, 17), None);
        }
        for size in [(1, 1), (65, 1), (3, 129)] {
            line(0.6, "default", size, None);
        }
        line(0.35, "default", (131, 66), pair);
    }
    table
}

fn frames_are_kept_at(levels: &[(&str, Level)]) {
    let kept = include_str!("frames.txt");
    for &(name, level) in levels {
        let found = table(&mut Renderer::new(0).unwrap().at_level(level));
        let changed: Vec<_> = found.lines().filter(|line| !kept.lines().any(|k| k == *line)).collect();
        let path = concat!(env!("CARGO_TARGET_TMPDIR"), "/frames.txt");
        std::fs::write(path, &found).unwrap();
        let gone = kept.lines().count() as i64 - found.lines().count() as i64;
        assert!(changed.is_empty() && gone == 0, "{name}: {gone} lines gone, changed, see {path}: {changed:#?}");
    }
}

/// At every level; in a build without `--release`, which takes minutes for that, at the best one.
#[test]
fn every_frame_is_what_it_was() {
    let levels = testkit::levels();
    frames_are_kept_at(if cfg!(debug_assertions) { &levels[..1] } else { &levels });
}

#[test]
#[ignore = "long: run by .ci/run"]
fn every_frame_is_what_it_was_at_lower_levels() {
    frames_are_kept_at(&testkit::levels()[1..]);
}
