//! The same bytes as the native build: the table of kept frames, in the browser.

use crate::site::open;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// How a frame is hashed, a function of JavaScript.
pub const HASH: &str = include_str!("hash.js");
/// The native frames: scene, seconds, quality, size, eyes, hash.
const KEPT: &str = include_str!("../../../../tests/frames/frames.txt");
/// From row to row of the quick test: 23 rows per scene in turns of four qualities, so that every scene has each of them.
pub const STEP: usize = 3;

/// Every `step`th of the kept frames with one eye: what is asked for, and its hash.
pub fn kept(step: usize) -> Vec<(Value, &'static str)> {
    let lines = KEPT.lines().filter(|line| line.split(' ').nth(4) == Some("one"));
    let rows: Vec<_> = lines.step_by(step).map(row).collect();
    let name = |row: &Value, word: &str| row[word].as_str().unwrap().to_owned();
    let seen: BTreeSet<_> = rows.iter().map(|(row, _)| (name(row, "name"), name(row, "quality"))).collect();
    assert!(rows.len() > 100 && seen.len() == 18 * 4, "{} frames, {} scenes and qualities", rows.len(), seen.len());
    rows
}

fn row(line: &'static str) -> (Value, &'static str) {
    let words: Vec<_> = line.split(' ').collect();
    let [name, time, quality, size, _, hash] = words[..] else { panic!("{line}") };
    let (width, height) = size.split_once('x').unwrap();
    let number = |word: &str| word.parse::<f64>().unwrap();
    let (width, height) = (number(width), number(height));
    (json!({ "name": name, "time": number(time), "quality": quality, "width": width, "height": height }), hash)
}

/// Bands of a frame by all workers, put together as the player does for a frame at rest.
#[test]
fn the_page_s_frames_are_the_native_ones() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    chrome.evaluate("paprsek.player.pause()");
    chrome.evaluate(&format!(
        "globalThis.frameHash = async row => {{
            const {{ scenes, qualities }} = paprsek.player.description;
            const scene = scenes.findIndex(({{ scene }}) => scene === row.name);
            const request = {{ ...row, scene, quality: qualities.indexOf(row.quality) }};
            return ({HASH})((await paprsek.player.render(request)).data);
        }}; 0"
    ));
    let mut differ = Vec::new();
    for (row, hash) in kept(STEP) {
        if chrome.evaluate(&format!("frameHash({row})")) != hash {
            differ.push(row.to_string());
        }
    }
    assert!(differ.is_empty(), "{differ:#?}");
    assert_eq!(chrome.errors, [""; 0]);
}
