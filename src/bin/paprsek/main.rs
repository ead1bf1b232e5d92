//! The executable of the intro: reads the command line, then plays, captures, measures or prints.
//!
//! Imports of the files beside this one run down only: window, terminal and playing stand on captures, the clock and
//! the command line, and those on `io.rs` and `text.rs`, which read and write without the standard library's machinery.

mod args;
#[cfg(feature = "full")]
mod bench;
mod capture;
mod clock;
mod governor;
mod io;
#[cfg(feature = "full")]
mod parameters;
#[cfg(feature = "full")]
mod pixel;
mod play;
#[cfg(feature = "minifb")]
mod raw;
mod sound;
#[cfg(all(unix, feature = "terminal"))]
mod terminal;
mod text;
mod window;

use args::{Args, Mode};
use io::{complain, print};
use paprsek::{cuts, scenes};
use std::process::ExitCode;
use text::{SPACES, fill};

/// Exit codes: something failed, or the command line is wrong.
const FAILED: u8 = 1;
const BAD_USAGE: u8 = 2;

fn main() -> ExitCode {
    let (code, why) = match Args::from_env() {
        // Leaked, because the thread that renders uses the arguments as long as the process lives.
        Ok(args) => match run(Box::leak(Box::new(args))) {
            Ok(()) => return ExitCode::SUCCESS,
            Err(why) => (FAILED, why),
        },
        Err(why) => (BAD_USAGE, why),
    };
    complain(&why);
    ExitCode::from(code)
}

/// Does what was asked for. An error is one line without the program's name, here and in every other file.
fn run(args: &'static Args) -> Result<(), Vec<u8>> {
    match &args.mode {
        Mode::Play => play(args),
        #[cfg(feature = "full")]
        Mode::Bench { json } => bench::run(args, *json),
        Mode::Capture(target) if !cfg!(without = "capture") => {
            // Sound first: it takes a second, and a name that will not do is told before the frames are there.
            #[cfg(feature = "full")]
            args.sound.map_or(Ok(()), |file| sound::save(args, file))?;
            capture::run(args, target)
        }
        Mode::Capture(_) => Ok(()),
        #[cfg(feature = "full")]
        Mode::Sound(file) => sound::save(args, file),
        Mode::Print(text) => print(text.as_bytes()),
        Mode::List if cuts::SCENES => list(),
        Mode::List => Ok(()),
        #[cfg(feature = "full")]
        Mode::Pixel(pixel) => pixel::run(args, *pixel),
        #[cfg(feature = "full")]
        Mode::Parameters { json } => parameters::list(args.scene, *json),
    }
}

/// Plays in a window; without a display in a terminal that shows colour; without either it runs the benchmark, so that
/// something useful happens on any machine. The 64 kB build has the window alone.
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

/// Prints the name of each scene and what it shows.
#[inline(never)]
fn list() -> Result<(), Vec<u8>> {
    for scene in scenes::ALL {
        let name = scene.name.as_bytes();
        print(&fill("%% %\n", &[name, &SPACES[name.len()..], scene.about.as_bytes()]))?;
    }
    Ok(())
}
