//! Runs the executable and judges how it ends.

use std::process::{Child, Command, Output};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The executable, without a display: cargo's, whose path the caller knows as `CARGO_BIN_EXE_paprsek`, or the one that the
/// environment's `PAPRSEK` names, such as the packed intro.
pub fn paprsek(ours: &str) -> Command {
    let mut command = Command::new(std::env::var_os("PAPRSEK").unwrap_or(ours.into()));
    command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    command
}

/// The same by a shell that does something before, in the process that becomes the executable.
pub fn after(deed: &str, program: Command) -> Command {
    let mut shell = Command::new("sh");
    shell.args(["-c", &format!("{deed}; exec \"$0\" \"$@\"")]).arg(program.get_program());
    shell.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
    shell
}

/// Asserts the exit code and one line of the program's own on stderr, and gives the line.
#[track_caller]
pub fn fails(output: &Output, code: i32) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{said}");
    assert!(said.starts_with("paprsek: ") && said.ends_with('\n') && said.lines().count() == 1, "{said}");
    assert!(!said.contains("panicked"), "{said}");
    said
}

/// Asserts success and silence on stderr, and gives stdout.
#[track_caller]
pub fn succeeds(output: Output) -> Vec<u8> {
    assert_eq!((output.status.code(), &*String::from_utf8_lossy(&output.stderr)), (Some(0), ""));
    output.stdout
}

/// Waits for the end, but not for ever.
#[track_caller]
pub fn ending(mut child: Child, patience: Duration) -> Output {
    let began = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if began.elapsed() > patience {
            let _ = child.kill();
            panic!("still playing after {patience:?}");
        }
        sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap()
}
