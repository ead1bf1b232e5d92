//! Every scene's frames are the bytes that they were: what only moves, renames or speeds up code changes none of them.
//!
//! This proves "unchanged", not "right"; the tests with oracles do that. A change that is meant to alter pictures
//! replaces `frames.txt` by the table that the failing test leaves behind, and says why.

use fearless_simd::Level;
use paprsek::frame::Renderer;
use testkit::frames::rows;

fn frames_are_kept_at(levels: &[(&str, Level)]) {
    let kept = include_str!("frames.txt");
    for &(name, level) in levels {
        let mut renderer = Renderer::new(0).unwrap().at_level(level);
        let found: String = rows().iter().map(|row| row.line(&mut renderer) + "\n").collect();
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
