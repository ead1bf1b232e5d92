//! Pictures of the page, for whoever looks at them: every scene as it plays, and the page's states in windows of several
//! sizes. `cargo run -p page --example shots -- DIR`.

#[path = "../tests/page/chrome.rs"]
mod chrome;
#[path = "../tests/page/site.rs"]
mod site;

use site::open;
use std::{env, fs, path::PathBuf};

fn main() {
    let directory = PathBuf::from(env::args().nth(1).expect("a directory for the pictures"));
    fs::create_dir_all(&directory).unwrap();
    let Some((mut chrome, _turn)) = open(1280, 720) else { return };
    let scenes = chrome.evaluate("paprsek.player.description.scenes.map(({ scene }) => scene)");
    for scene in scenes.as_array().unwrap() {
        let scene = scene.as_str().unwrap();
        chrome.evaluate(&format!(
            "paprsek.player.choose('{scene}'); paprsek.player.go(0.4 * paprsek.player.scene.duration)"
        ));
        chrome.evaluate("globalThis.before = paprsek.player.time");
        chrome.until(&format!("paprsek.player.shownScene === '{scene}' && paprsek.player.shownTime > before + 1.5"));
        fs::write(directory.join(format!("{scene}.png")), chrome.screenshot()).unwrap();
    }
    chrome.evaluate(
        "paprsek.player.choose('snowfall'); paprsek.player.go(17); paprsek.player.pause(); paprsek.controls.turn(true)",
    );
    for (name, width, height) in
        [("wide", 1280, 720), ("phone", 390, 844), ("landscape", 844, 390), ("narrow", 200, 400)]
    {
        chrome.size(width, height);
        chrome.until("paprsek.player.atRest");
        fs::write(directory.join(format!("parameters-{name}.png")), chrome.screenshot()).unwrap();
    }
    chrome.evaluate("paprsek.controls.turn(false); document.getElementById('help').showModal()");
    fs::write(directory.join("help-narrow.png"), chrome.screenshot()).unwrap();
    chrome.size(960, 600);
    fs::write(directory.join("help.png"), chrome.screenshot()).unwrap();
    println!("{}", directory.display());
}
