//! The page's speed beside the native program's, measured in turn, scene by scene: the table of `docs/performance.md`.
//! `cargo run -p page --example speed`, on an otherwise idle machine.

#[path = "../tests/page/chrome.rs"]
mod chrome;
#[path = "../tests/page/site.rs"]
mod site;

use chrome::Chrome;
use page::{build, root};
use serde_json::Value;
use site::open;
use std::process::Command;

/// Rounds, of each of which the ratio is kept.
const ROUNDS: usize = 3;

/// Frames per second of whole frames by all workers, as the player renders them: at the instants of the program's benchmark,
/// of 640x360 at `fast`, after some that count for nothing.
const PAGE: &str = "(async name => {
    const { player } = paprsek, { description, pool } = player;
    const common = {
        scene: description.scenes.findIndex(({ scene }) => scene === name), quality: 0,
        width: 640, height: 360, values: [], first: 0, last: 360,
    };
    let number = 0;
    const frame = () => new Promise((done, failed) => pool.first({ ...common, time: 2 + 0.05 * (number++ % 60), done, failed }));
    const run = async until => {
        let frames = 0;
        // One more than there are workers, so that none waits for the page.
        const lane = async () => { while (until(frames)) { await frame(); frames += 1; } };
        const began = performance.now();
        await Promise.all(Array.from({ length: pool.workers + 1 }, lane));
        return (1000 * frames) / (performance.now() - began);
    };
    const warm = performance.now() + 1000;
    await run(frames => frames < 8 || performance.now() < warm);
    number = 0;
    const end = performance.now() + 1500;
    return run(frames => frames < 30 || performance.now() < end);
})";

/// The same by the program, whose threads share a frame: the median's inverse.
fn native(scene: &str) -> f64 {
    let mut program = Command::new(build::target().join("release/paprsek"));
    program.args([scene, "--bench", "--json", "--simd", "sse4.2", "--size", "640x360", "--quality", "fast"]);
    let said = program.output().unwrap();
    let line: Value = serde_json::from_slice(&said.stdout).unwrap();
    line["fps_median"].as_f64().unwrap()
}

fn page(chrome: &mut Chrome, scene: &str) -> f64 {
    chrome.evaluate(&format!("{PAGE}('{scene}')")).as_f64().unwrap()
}

fn main() {
    let Some((mut chrome, _turn)) = open(640, 400) else { return };
    let cargo = Command::new(env!("CARGO")).args(["build", "--release"]).current_dir(root()).status().unwrap();
    assert!(cargo.success());
    let first = chrome.evaluate("paprsek.firstFrame");
    chrome.evaluate("paprsek.player.pause()");
    chrome.until("paprsek.player.atRest");
    println!(
        "first frame {first:.0} ms after the module's arrival, {} workers",
        chrome.evaluate("paprsek.player.pool.workers")
    );
    println!("\n| scene | page, fps | native at SSE4.2, fps | ratio |\n|---|--:|--:|--:|");
    let scenes = chrome.evaluate("paprsek.player.description.scenes.map(({ scene }) => scene)");
    for scene in scenes.as_array().unwrap() {
        let scene = scene.as_str().unwrap();
        let mut rounds: Vec<_> = (0..ROUNDS).map(|_| (native(scene), page(&mut chrome, scene))).collect();
        rounds.sort_by(|a, b| (a.1 / a.0).total_cmp(&(b.1 / b.0)));
        let (native, page) = rounds[ROUNDS / 2];
        println!("| `{scene}` | {page:.0} | {native:.0} | {:.2} |", page / native);
    }
}
