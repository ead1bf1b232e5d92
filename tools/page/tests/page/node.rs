//! The module in node, without a page.

use crate::bytes::{HASH, STEP, kept};
use crate::site::site;
use serde_json::Value;
use std::fs;
use std::process::Command;
use testkit::{Tool, needs};

const HASHES: &str = include_str!("hashes.mjs");

/// Whole frames of one instance, which renders scene after scene.
fn frames_are_the_native_ones(step: usize) {
    if !needs(&[Tool::Node]) {
        return;
    }
    let Some(site) = site() else { return };
    let directory = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = directory.path().join(name);
        fs::write(&path, text).unwrap();
        path
    };
    let kept = kept(step);
    let rows: Vec<&Value> = kept.iter().map(|(row, _)| row).collect();
    let mut node = Command::new("node");
    node.arg(write("hashes.mjs", HASHES));
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
    let differ: Vec<_> = kept.iter().zip(hashes).filter(|((_, kept), found)| kept != found).collect();
    assert!(differ.is_empty(), "{differ:#?}");
}

#[test]
fn the_module_s_frames_are_the_native_ones() {
    frames_are_the_native_ones(STEP);
}

#[test]
#[ignore = "long: run by .ci/run"]
fn all_of_the_module_s_frames_are_the_native_ones() {
    frames_are_the_native_ones(1);
}
