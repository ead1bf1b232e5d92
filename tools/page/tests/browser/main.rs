//! The page in a real browser: what it shows, what its keys do, and what it survives.

mod chrome;

use chrome::Chrome;
use std::process::{Child, Command, Stdio};
use std::io::{BufRead, BufReader};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// The page's address: it is built and served once for all tests.
fn address() -> &'static str {
    static ADDRESS: OnceLock<(String, Child)> = OnceLock::new();
    &ADDRESS.get_or_init(|| {
        let page = env!("CARGO_BIN_EXE_page");
        let built = Command::new(page).arg("build").output().unwrap();
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        let mut server = Command::new(page).args(["serve", "--port", "0"]).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut line).unwrap();
        (line.trim().to_owned(), server)
    }).0
}

fn one_at_a_time() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

#[test]
fn try_out() {
    let _turn = one_at_a_time();
    let mut chrome = Chrome::start(1280, 800);
    chrome.open(address());
    chrome.until("globalThis.paprsek?.firstFrame > 0");
    println!("{}", chrome.evaluate("paprsek.firstFrame"));
    std::thread::sleep(std::time::Duration::from_secs(9));
    println!("{}", chrome.evaluate("document.getElementById('figures').textContent"));
    println!("{:?}", chrome.errors);
    std::fs::write("/tmp/page/shot.b64", chrome.screenshot()).unwrap();
}
