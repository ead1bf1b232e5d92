//! The program from outside: command line, captures, window and terminal.
//!
//! Tests the executable that cargo builds, or the one that `PAPRSEK` names, such as the packed intro.

mod command_line;
#[cfg(target_os = "linux")]
mod display;
#[cfg(target_os = "linux")]
mod fake;
#[cfg(feature = "full")]
mod parameters;
#[cfg(target_os = "linux")]
mod sound;
#[cfg(all(target_os = "linux", feature = "terminal"))]
mod terminal;
#[cfg(target_os = "linux")]
mod window;

use std::process::Command;
use testkit::run;

/// The executable, without a display.
fn paprsek() -> Command {
    run::paprsek(env!("CARGO_BIN_EXE_paprsek"))
}

/// The same by a shell that does something before, in the process that becomes the executable.
fn after(deed: &str) -> Command {
    run::after(deed, paprsek())
}
