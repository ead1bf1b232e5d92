//! The intro executable: arguments, then play, bench or capture.

mod args;
mod bench;
mod canvas;
mod capture;
mod clock;
#[cfg(all(unix, feature = "minifb"))]
mod last_word;
mod number;
mod present;
#[cfg(all(unix, feature = "terminal"))]
mod terminal;
mod window;

use args::{Args, Mode};
use paprsek::scenes;
use std::io::{self, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let args = match Args::from_env() {
        Ok(args) => args,
        Err(why) => return fail(2, &why),
    };
    match run(&args) {
        Ok(()) => ExitCode::SUCCESS,
        Err(why) => fail(1, &why),
    }
}

fn run(args: &Args) -> Result<(), String> {
    match &args.mode {
        Mode::Play => play(args),
        Mode::Bench { json } => bench::run(args, *json),
        Mode::Capture(directory) => capture::run(args, directory.as_deref()),
        Mode::Help => print(args::HELP),
        Mode::Version => print(concat!("paprsek ", env!("CARGO_PKG_VERSION"), "\n")),
        Mode::List => print(&scenes::all().iter().map(|s| format!("{:<16} {}\n", s.name, s.about)).collect::<String>()),
    }
}

/// In a window; without one in a terminal that shows colour; without that the benchmark, so that something useful happens anywhere.
fn play(args: &Args) -> Result<(), String> {
    let why = match window::Window::open(args.size) {
        Ok(window) => return present::play(window, args),
        Err(why) => why,
    };
    #[cfg(all(unix, feature = "terminal"))]
    if terminal::shows_colour() {
        return terminal::play(args);
    }
    complain(&format!("no display ({why}): running the benchmark"));
    bench::run(args, false)
}

fn print(text: &str) -> Result<(), String> {
    let mut out = io::stdout().lock();
    let printed = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    printed.map_err(|error| format!("cannot write to stdout: {error}"))
}

fn fail(code: u8, why: &str) -> ExitCode {
    complain(why);
    ExitCode::from(code)
}

/// One line on stderr, whatever the message quotes.
fn complain(why: &str) {
    let line: String = why.chars().map(|c| if c.is_control() { '?' } else { c }).collect();
    // `eprintln!` would panic where stderr cannot be written.
    let _ = io::stderr().write_all(format!("paprsek: {line}\n").as_bytes());
}
