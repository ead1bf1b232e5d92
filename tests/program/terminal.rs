//! Playing in a terminal, on a pseudo-terminal of `script` (util-linux).

use crate::paprsek;
use std::fs;
use std::io::{Read, Write};
use std::process::{ChildStdin, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};
use testkit::{Tool, needs};

const ENTER: &str = "\x1b[?1049h\x1b[?25l";
const LEAVE: &str = "\x1b[0m\x1b[?25h\x1b[?1049l";

/// Plays in a terminal, presses keys once something shows, and gives what it printed.
fn play(words: &str, term: &str, keys: &[u8]) -> String {
    act(words, term, |keyboard, _| keyboard.write_all(keys).unwrap())
}

/// The same with whatever is to be done then, by the keyboard or to the process of that number.
fn act(words: &str, term: &str, then: impl FnOnce(&mut ChildStdin, &str)) -> String {
    let directory = tempfile::tempdir().unwrap();
    let number = directory.path().join("number");
    let line = format!(
        "stty rows 12 cols 40; sh -c 'echo $$ >{}; exec {} {words}'; echo \"exit $?\"; stty -a",
        number.display(),
        paprsek().get_program().display()
    );
    let mut script = Command::new("script");
    script.args(["-qec", &line, "/dev/null"]).env("TERM", term).env("SHELL", "/bin/sh");
    script.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    let mut child = script.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    // Kept to the end: a closed input would be an end of file typed into the terminal.
    let mut keyboard = child.stdin.take().unwrap();
    let mut screen = child.stdout.take().unwrap();
    let (mut printed, mut buffer, mut then) = (Vec::new(), [0; 4096], Some(then));
    loop {
        let count = screen.read(&mut buffer).unwrap();
        if count == 0 {
            break;
        }
        printed.extend_from_slice(&buffer[..count]);
        if printed.len() > 20_000
            && let Some(then) = then.take()
        {
            then(&mut keyboard, fs::read_to_string(&number).unwrap().trim());
        }
    }
    child.wait().unwrap();
    String::from_utf8(printed).unwrap()
}

/// The terminal is left as it was, and the exit code is 0.
#[track_caller]
fn is_whole(printed: &str) {
    is_put_back(printed, 0);
}

/// The terminal is left as it was, and the exit code is that.
#[track_caller]
fn is_put_back(printed: &str, code: i32) {
    let rest = printed.strip_prefix(ENTER).unwrap_or_else(|| panic!("{:?}", printed.get(..200)));
    let (played, after) = rest.split_once(LEAVE).expect("the screen is not put back");
    assert!(played.contains("\x1b[12;1H") && !played.contains("\x1b[13;1H"), "not the size of the terminal");
    assert!(played.matches('▀').count() >= 12 * 40);
    // After a word of the shell's, if any.
    assert!(after.contains(&format!("exit {code}\r\n")), "{after}");
    // Lines, echo, Ctrl-C and Ctrl-S have their meaning again.
    for mode in ["icanon", "echo", "isig", "ixon"] {
        assert!(after.split_whitespace().any(|word| word == mode), "{after}");
    }
}

#[test]
fn a_range_plays_and_ends() {
    if !needs(&[Tool::Script]) {
        return;
    }
    let began = Instant::now();
    is_whole(&play("lumen --to 1", "xterm-256color", b""));
    assert!(began.elapsed() >= Duration::from_secs(1));
}

#[test]
fn keys_end_it() {
    if !needs(&[Tool::Script]) {
        return;
    }
    for keys in [&b"\x03"[..], b"\x1b", b"q"] {
        is_whole(&play("lumen", "xterm-256color", keys));
    }
}

#[test]
fn ctrl_s_stops_nothing() {
    if !needs(&[Tool::Script]) {
        return;
    }
    is_whole(&act("lumen", "xterm-256color", |keyboard, _| {
        keyboard.write_all(b"\x13").unwrap();
        // What is under way then does not count.
        sleep(Duration::from_secs(1));
        keyboard.write_all(b"\x03").unwrap();
    }));
}

#[test]
fn a_signal_puts_the_terminal_back_and_ends_it() {
    if !needs(&[Tool::Script]) {
        return;
    }
    for (signal, number) in [("HUP", 1), ("INT", 2), ("TERM", 15)] {
        let printed = act("lumen", "xterm-256color", |_, process| {
            assert!(Command::new("kill").args(["-s", signal, process]).status().unwrap().success());
        });
        is_put_back(&printed, 128 + number);
    }
}

#[test]
fn a_signal_ends_it_while_the_terminal_takes_nothing() {
    if !needs(&[Tool::Script]) {
        return;
    }
    let printed = act("lumen", "xterm-256color", |_, process| {
        // Longer than any buffer has room.
        sleep(Duration::from_secs(1));
        assert!(Command::new("kill").args(["-s", "TERM", process]).status().unwrap().success());
        let began = Instant::now();
        while Command::new("kill").args(["-0", process]).stderr(Stdio::null()).status().unwrap().success() {
            assert!(began.elapsed() < Duration::from_secs(10), "it waits for the terminal");
            sleep(Duration::from_millis(50));
        }
    });
    assert!(printed.contains("exit 143"));
}

#[test]
fn a_terminal_without_colour_gets_the_benchmark() {
    if !needs(&[Tool::Script]) {
        return;
    }
    let printed = play("lumen --size 16x9", "dumb", b"");
    assert!(printed.starts_with("paprsek: no display"), "{printed}");
    assert!(printed.contains("fps median") && !printed.contains('\x1b'), "{printed}");
}
