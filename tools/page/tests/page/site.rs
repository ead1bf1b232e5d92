//! The page, built and served, and a browser with it.
#![allow(dead_code, reason = "the tests and the examples each use some of it")]

use crate::chrome::Chrome;
use page::{build, root, serve::Server};
use std::env;
use std::path::PathBuf;
use std::process::Command;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use testkit::{Tool, needs};

/// The directory of the page, which is built once for all tests; `None` where the test is left out.
pub fn site() -> Option<&'static PathBuf> {
    static SITE: OnceLock<PathBuf> = OnceLock::new();
    if !build::has_target() {
        testkit::left_out("Rust's target wasm32-unknown-unknown", "libstd-rust-dev-wasm32");
        return None;
    }
    Some(SITE.get_or_init(|| {
        let target = build::target();
        let out = target.join("web");
        build::build(&target, &out).unwrap();
        out
    }))
}

/// The native program: the one that the environment's `PAPRSEK` names, or ours, which is built once for all tests.
pub fn program() -> &'static PathBuf {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        if let Some(program) = env::var_os("PAPRSEK") {
            return program.into();
        }
        let mut cargo = Command::new(env!("CARGO"));
        let built = cargo.args(["build", "--release", "--bin", "paprsek"]).current_dir(root()).status().unwrap();
        assert!(built.success());
        build::target().join("release/paprsek")
    })
}

/// The page's address: it is served by a thread of the tests.
pub fn address() -> Option<&'static str> {
    static ADDRESS: OnceLock<String> = OnceLock::new();
    let site = site()?;
    Some(ADDRESS.get_or_init(|| {
        let server = Server::new(site, 0).unwrap();
        let address = format!("http://{}/", server.address().unwrap());
        thread::spawn(|| server.run());
        address
    }))
}

/// An empty browser of that many CSS pixels. There is one at a time, so that each has all cores. `None` where the test is
/// left out.
pub fn start(width: u32, height: u32) -> Option<(Chrome, MutexGuard<'static, ()>)> {
    static TURN: Mutex<()> = Mutex::new(());
    if !needs(&[Tool::Chromium]) {
        return None;
    }
    address()?;
    let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    Some((Chrome::start(width, height), turn))
}

/// A browser with the page in it, which has shown its first frame.
pub fn open(width: u32, height: u32) -> Option<(Chrome, MutexGuard<'static, ()>)> {
    let (mut chrome, turn) = start(width, height)?;
    show(&mut chrome);
    Some((chrome, turn))
}

/// Opens the page, and waits for its first frame.
pub fn show(chrome: &mut Chrome) {
    chrome.open(address().expect("the page"));
    chrome.until("globalThis.paprsek?.firstFrame > 0");
}
