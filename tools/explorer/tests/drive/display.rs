//! A display of the test's own, and the explorer on it.

use std::collections::BTreeMap;
use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};
use tempfile::TempDir;
use testkit::{Tool, needs};

/// Longest wait for anything, on a loaded machine.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// An explorer on a virtual display; both end with the test.
pub struct Explorer {
    pub xvfb: Child,
    pub child: Child,
    number: String,
    /// One at a time: a script's pauses are as long as they seem only where nothing else runs.
    _turn: MutexGuard<'static, ()>,
    /// Where the explorer writes its files and its states.
    pub out: TempDir,
}

/// What a line of the explorer's states says, by name.
pub type State = BTreeMap<String, String>;

impl Explorer {
    /// Starts both and waits for the first picture; `None` where the machine lacks what it takes.
    pub fn start(words: &[&str]) -> Option<Explorer> {
        Explorer::start_by(&[], words)
    }

    /// The same, where a command line of its own starts the explorer, whose words are appended.
    pub fn start_by(by: &[&str], words: &[&str]) -> Option<Explorer> {
        if !needs(&[Tool::Xvfb, Tool::Xdotool, Tool::Xlib]) {
            return None;
        }
        static TURN: Mutex<()> = Mutex::new(());
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        let mut xvfb = Command::new("Xvfb");
        xvfb.args(["-displayfd", "1", "-screen", "0", "1400x800x24", "-nolisten", "tcp", "-noreset"]);
        let mut xvfb = xvfb.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().unwrap();
        let mut number = String::new();
        BufReader::new(xvfb.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let number = format!(":{}", number.trim());
        let out = TempDir::new().unwrap();
        let mut all = by.iter().copied().chain([env!("CARGO_BIN_EXE_explorer")]);
        let mut explorer = Command::new(all.next().expect("a program"));
        explorer.args(all).args(words).arg("--out").arg(out.path()).arg("--state").arg(out.path().join("states"));
        explorer.env("DISPLAY", &number).env_remove("WAYLAND_DISPLAY");
        let child = explorer.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let explorer = Explorer { xvfb, child, number, _turn: turn, out };
        explorer.expect("a picture", |state| state.contains_key("scene"));
        // To the upper left corner, so that places in the window are places on the screen. Keys go to where the mouse is.
        explorer.xdotool("search --name explorer windowmove 0 0 mousemove 310 20");
        Some(explorer)
    }

    /// Presses keys and moves the mouse.
    pub fn xdotool(&self, words: &str) {
        let output = Command::new("xdotool").args(words.split(' ')).env("DISPLAY", &self.number).output().unwrap();
        assert!(output.status.success(), "xdotool {words}: {}", String::from_utf8_lossy(&output.stderr));
    }

    /// What the last line says; nothing before there is one.
    pub fn state(&self) -> State {
        let text = fs::read_to_string(self.out.path().join("states")).unwrap_or_default();
        // The last one may not be complete yet.
        let complete = text.rfind('\n').map_or("", |end| &text[..end]);
        let last = complete.lines().last().unwrap_or_default();
        let (line, words) = last.split_once(" words=").unwrap_or_default();
        let pairs = line.split(' ').filter_map(|word| word.split_once('='));
        let mut state: State = pairs.map(|(name, value)| (name.to_owned(), value.to_owned())).collect();
        if !words.is_empty() {
            state.insert("words".into(), words.to_owned());
        }
        state
    }

    /// Waits until the state is as it should be, and gives it.
    #[track_caller]
    pub fn expect(&self, what: &str, holds: impl Fn(&State) -> bool) -> State {
        let began = Instant::now();
        loop {
            let state = self.state();
            if holds(&state) {
                return state;
            }
            assert!(began.elapsed() < PATIENCE, "no {what}: {state:?}");
            sleep(Duration::from_millis(20));
        }
    }

    /// A file that the explorer has written, by the end of its name.
    pub fn written(&self, end: &str) -> Option<std::path::PathBuf> {
        let entries = fs::read_dir(self.out.path()).unwrap();
        entries.map(|entry| entry.unwrap().path()).find(|path| path.to_string_lossy().ends_with(end))
    }

    /// Waits for such a file.
    #[track_caller]
    pub fn file(&self, end: &str) -> std::path::PathBuf {
        let began = Instant::now();
        loop {
            if let Some(path) = self.written(end) {
                return path;
            }
            assert!(began.elapsed() < PATIENCE, "no file {end}");
            sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Explorer {
    fn drop(&mut self) {
        for child in [&mut self.child, &mut self.xvfb] {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// A number of a state.
pub fn number(state: &State, name: &str) -> f64 {
    state[name].parse().unwrap()
}

/// The numbers of a state's list.
pub fn numbers(state: &State, name: &str) -> Vec<f64> {
    state[name].split(',').map(|word| word.parse().unwrap()).collect()
}

/// The plain program, built if need be.
pub fn paprsek() -> Command {
    let explorer = Path::new(env!("CARGO_BIN_EXE_explorer"));
    let directory = explorer.parent().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut build = Command::new(env!("CARGO"));
    build.args(["build", "--quiet", "--package", "paprsek", "--bin", "paprsek"]).current_dir(root);
    build.arg("--target-dir").arg(directory.parent().unwrap());
    if directory.ends_with("release") {
        build.arg("--release");
    }
    assert!(build.status().unwrap().success());
    Command::new(directory.join("paprsek"))
}
