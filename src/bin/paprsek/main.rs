//! The intro executable: arguments, then play, bench or capture.

mod args;
#[cfg(feature = "full")]
mod bench;
mod canvas;
mod capture;
mod clock;
mod governor;
mod io;
mod play;
#[cfg(all(unix, feature = "terminal"))]
mod terminal;
mod text;
mod window;

use args::{Args, BENCH, Mode};
use io::{SPACES, complain, fill, print};
use paprsek::scenes;
use std::process::ExitCode;

fn main() -> ExitCode {
    let (code, why) = match Args::from_env() {
        // For good: what renders needs it as long as the process lives.
        Ok(args) => match run(Box::leak(Box::new(args))) {
            Ok(()) => return ExitCode::SUCCESS,
            Err(why) => (1, why),
        },
        Err(why) => (2, why),
    };
    complain(&why);
    ExitCode::from(code)
}

/// The error is one line without the program's name.
fn run(args: &'static Args) -> Result<(), Vec<u8>> {
    match &args.mode {
        Mode::Play => play(args),
        #[cfg(feature = "full")]
        Mode::Bench { json } => bench::run(args, *json),
        Mode::Capture(target) if !cfg!(without = "capture") => capture::run(args, target),
        Mode::Capture(_) => Ok(()),
        Mode::Print(text) => print(text.as_bytes()),
        Mode::List if BENCH => list(),
        Mode::List => Ok(()),
    }
}

/// In a window; without one in a terminal that shows colour; without that the benchmark, so that something useful happens
/// anywhere. The 64 kB build has the window alone.
#[inline(never)]
fn play(args: &'static Args) -> Result<(), Vec<u8>> {
    let why = match window::Window::open(args.size) {
        Ok(window) => return play::play(window, args),
        Err(why) => why,
    };
    #[cfg(all(unix, feature = "terminal"))]
    if terminal::shows_colour() {
        return Ok(terminal::play(args)?);
    }
    #[cfg(feature = "full")]
    {
        complain(&fill("no display (%): running the benchmark", &[why.as_bytes()]));
        bench::run(args, false)
    }
    #[cfg(not(feature = "full"))]
    Err(fill("no display: %", &[why.as_bytes()]))
}

#[inline(never)]
fn list() -> Result<(), Vec<u8>> {
    for scene in scenes::ALL {
        let name = scene.name.as_bytes();
        print(&fill("%% %\n", &[name, &SPACES[name.len()..], scene.about.as_bytes()]))?;
    }
    Ok(())
}
