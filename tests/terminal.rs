//! Playing in a terminal, on a pseudo-terminal of `script` (util-linux).
#![cfg(target_os = "linux")]

mod program;

use program::paprsek;
use std::io::{Read, Write};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const ENTER: &str = "\x1b[?1049h\x1b[?25l";
const LEAVE: &str = "\x1b[0m\x1b[?25h\x1b[?1049l";

/// Plays in a terminal, presses keys once something shows, and gives what it printed.
fn play(words: &str, term: &str, keys: &[u8]) -> String {
    let line = format!("stty rows 12 cols 40; '{}' {words}; echo \"exit $?\"", paprsek().get_program().display());
    let mut script = Command::new("script");
    script.args(["-qec", &line, "/dev/null"]).env("TERM", term).env("SHELL", "/bin/sh");
    script.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let mut child = script
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("install util-linux and bsdutils: script runs a program in a terminal");
    // Kept to the end: a closed input would be an end of file typed into the terminal.
    let mut keyboard = child.stdin.take().unwrap();
    let mut screen = child.stdout.take().unwrap();
    let (mut printed, mut buffer, mut pressed) = (Vec::new(), [0; 4096], keys.is_empty());
    loop {
        let count = screen.read(&mut buffer).unwrap();
        if count == 0 {
            break;
        }
        printed.extend_from_slice(&buffer[..count]);
        if !pressed && printed.len() > 20_000 {
            keyboard.write_all(keys).unwrap();
            pressed = true;
        }
    }
    child.wait().unwrap();
    String::from_utf8(printed).unwrap()
}

/// The terminal is left as it was, and the exit code is 0.
#[track_caller]
fn is_whole(printed: &str) {
    let rest = printed.strip_prefix(ENTER).unwrap_or_else(|| panic!("{:?}", printed.get(..200)));
    let (played, after) = rest.split_once(LEAVE).expect("the screen is not put back");
    assert!(played.contains("\x1b[12;1H") && !played.contains("\x1b[13;1H"), "not the size of the terminal");
    assert!(played.matches('▀').count() >= 12 * 40);
    assert_eq!(after.trim(), "exit 0");
}

#[test]
fn a_range_plays_and_ends() {
    let began = Instant::now();
    is_whole(&play("lumen --to 1", "xterm-256color", b""));
    assert!(began.elapsed() >= Duration::from_secs(1));
}

#[test]
fn keys_end_it() {
    for keys in [&b"\x03"[..], b"\x1b", b"q"] {
        is_whole(&play("lumen", "xterm-256color", keys));
    }
}

#[test]
fn a_terminal_without_colour_gets_the_benchmark() {
    let printed = play("lumen --size 16x9", "dumb", b"");
    assert!(printed.starts_with("paprsek: no display"), "{printed}");
    assert!(printed.contains("fps median") && !printed.contains('\x1b'), "{printed}");
}
