//! The native frames as the table of kept frames has them, and node's.
#![allow(dead_code, reason = "the tests and the example each use some of it")]

use paprsek::{Frame, Quality, Renderer, scenes};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;
use testkit::frames::hash;

/// How a frame is hashed, a function of JavaScript.
pub const HASH: &str = include_str!("hash.js");
/// The native frames: scene, seconds, quality, size, eyes, hash.
const KEPT: &str = include_str!("../../../../tests/frames/frames.txt");
/// From row to row of the tests; `cargo run -p page --example hashes` takes each. A scene has 23 rows in turns of four
/// qualities, so that every scene still has each of them.
pub const STEP: usize = 3;
const SCRIPT: &str = include_str!("hashes.mjs");

/// Every `step`th of the kept frames with one eye: what is asked for, and its hash.
pub fn kept(step: usize) -> Vec<(Value, String)> {
    let lines = KEPT.lines().filter(|line| line.split(' ').nth(4) == Some("one"));
    let rows: Vec<_> = lines.step_by(step).map(row).collect();
    let name = |row: &Value, word: &str| row[word].as_str().unwrap().to_owned();
    let seen: BTreeSet<_> = rows.iter().map(|(row, _)| (name(row, "name"), name(row, "quality"))).collect();
    assert!(rows.len() > 100 && seen.len() == 18 * 4, "{} frames, {} scenes and qualities", rows.len(), seen.len());
    rows
}

fn row(line: &str) -> (Value, String) {
    let words: Vec<_> = line.split(' ').collect();
    let [name, time, quality, size, _, hash] = words[..] else { panic!("{line}") };
    let (width, height) = size.split_once('x').unwrap();
    let number = |word: &str| word.parse::<f64>().unwrap();
    let (width, height) = (number(width), number(height));
    (
        json!({ "name": name, "time": number(time), "quality": quality, "width": width, "height": height }),
        hash.to_owned(),
    )
}

/// Frames of every scene that are large enough for what is rounded otherwise somewhere to meet a pixel that shows it: what
/// is asked for, and the native hash.
pub fn large() -> Vec<(Value, String)> {
    const INSTANTS: usize = 6;
    const GOLDEN: f64 = 0.618_033_988_749_895;
    let mut renderer = Renderer::new(0).unwrap();
    let mut rows = Vec::new();
    for scene in scenes::all() {
        for instant in 0..INSTANTS {
            let time = (scene.duration * (GOLDEN * (instant + 1) as f64).fract() * 1000.0).round() / 1000.0;
            let quality = ["fast", "default"][instant % 2];
            let mut frame = Frame::new(640, 360);
            renderer.render(scene, time, &Quality::named(quality).unwrap(), &mut frame);
            let row = json!({ "name": scene.name, "time": time, "quality": quality, "width": 640, "height": 360 });
            rows.push((row, format!("{:016x}", hash(&frame))));
        }
    }
    rows
}

/// The rows whose frames differ in node: whole frames of one instance, which renders scene after scene.
pub fn differing<'a>(site: &Path, kept: &'a [(Value, String)]) -> Vec<(&'a Value, String)> {
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = directory.path().join(name);
        fs::write(&path, text).unwrap();
        path
    };
    let rows: Vec<&Value> = kept.iter().map(|(row, _)| row).collect();
    let mut node = Command::new("node");
    node.arg(write("hashes.mjs", SCRIPT));
    // Node takes this ending for a module.
    node.arg(write("module.mjs", &fs::read_to_string(site.join("module.js")).unwrap()));
    node.arg(site.join("paprsek.wasm"));
    node.arg(write("rows.json", &serde_json::to_string(&rows).unwrap()));
    node.arg(write("hash.js", HASH));
    let output = node.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let printed = String::from_utf8(output.stdout).unwrap();
    let hashes: Vec<_> = printed.lines().collect();
    assert_eq!(hashes.len(), kept.len());
    let pairs = kept.iter().zip(hashes).filter(|((_, hash), found)| hash != found);
    pairs.map(|((row, _), found)| (row, found.to_owned())).collect()
}
