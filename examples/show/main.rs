//! The show, part by part: speed, error, and whether anything pops. Writes `show.md`.
//!
//! `cargo run --release --example show -- [--quick] [--out DIR]`, DIR `docs/report`: some ten minutes on two cores.
//! `--quick` shows in seconds that it works; its figures are rough.

#[path = "../common/difference.rs"]
mod difference;
mod error;
#[path = "../common/likeness.rs"]
mod likeness;
#[path = "../common/machine.rs"]
mod machine;
mod parts;
mod pops;
mod speed;

use lexopt::{Arg, Parser, ValueExt};
use paprsek::quality::Quality;
use paprsek::scenes::INTRO;
use paprsek::tile::{Frame, Renderer};
use std::error::Error;
use std::path::PathBuf;

const THREADS: usize = 2;

/// How much is measured.
struct Effort {
    /// Pixels in a row, and rows, of frames that are timed, and of those that are compared: the reference takes long.
    full: (usize, usize),
    half: (usize, usize),
    /// Every how many frames of the film one is timed.
    every: usize,
    /// Seconds of a shot for each instant that is compared with the reference.
    piece: f64,
    /// Pairs of frames of each shot whose change is measured, and changes of a part that are held against the reference's.
    pairs: usize,
    candidates: usize,
}

const FULL: Effort =
    Effort { full: (1280, 720), half: (640, 360), every: 1, piece: 6.0, pairs: usize::MAX, candidates: 3 };
const QUICK: Effort = Effort { full: (480, 270), half: (64, 36), every: 60, piece: 60.0, pairs: 15, candidates: 1 };

/// The show at a second.
fn render(renderer: &mut Renderer, (width, height): (usize, usize), time: f64, quality: &Quality) -> Frame {
    let mut frame = Frame::new(width, height);
    renderer.render(&INTRO, time, quality, &mut frame);
    frame
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut effort, mut quick, mut out) = (FULL, "", PathBuf::from("docs/report"));
    let mut parser = Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Arg::Long("quick") => (effort, quick) = (QUICK, " -- --quick"),
            Arg::Long("out") => out = parser.value()?.parse()?,
            other => return Err(other.unexpected().into()),
        }
    }
    let parts = parts::all()?;
    let mut renderer = Renderer::new(THREADS)?;
    let (machine, simd, (width, height)) = (machine::machine(), renderer.simd(), effort.full);
    let head = format!(
        "# The show\n\n\
         Written by `cargo run --release --example show{quick}`; not edited by hand.\n\n\
         {machine}; {width}x{height}, {THREADS} threads, SIMD level {simd} unless said otherwise. Seconds are the show's.\n"
    );
    let reports = [speed::report, error::report, pops::report];
    let tables = reports.map(|report| report(&mut renderer, &parts, &effort));
    std::fs::create_dir_all(&out)?;
    let file = out.join("show.md");
    std::fs::write(&file, format!("{head}\n{}", tables.join("\n")))?;
    println!("{}", file.display());
    Ok(())
}
