//! The show, part by part: speed, error, and whether anything pops. Writes `show.md`, in about twelve minutes on two cores.

mod error;
pub mod parts;
mod pops;
mod speed;

use crate::machine;
use crate::options::{Common, Result};
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes::INTRO;
use paprsek::settings::Quality;

const THREADS: usize = 2;

/// How much is measured. Sizes are width and height, pixels.
struct Effort {
    /// Size of frames that are timed.
    timed: (usize, usize),
    /// Every how many frames of the film one is timed.
    every: usize,
    /// Size of frames that are compared with the reference, which takes up to a minute each.
    compared: (usize, usize),
    /// Seconds of a shot per compared frame, at most.
    piece: f64,
    /// Size of frames whose change is measured.
    changing: (usize, usize),
    /// The most pairs of frames of a shot.
    pairs: usize,
    /// The number of a part's pairs, beside the largest change, that are held against the reference.
    candidates: usize,
}

const FULL: Effort = Effort {
    timed: (1280, 720),
    every: 1,
    compared: (640, 360),
    piece: 10.0,
    changing: (320, 180),
    pairs: usize::MAX,
    candidates: 2,
};
const QUICK: Effort = Effort {
    timed: (480, 270),
    every: 60,
    compared: (64, 36),
    piece: 60.0,
    changing: (64, 36),
    pairs: 15,
    candidates: 1,
};

/// The show at a time, seconds.
fn render(renderer: &mut Renderer, (width, height): (usize, usize), time: f64, quality: &Quality) -> Frame {
    let mut frame = Frame::new(width, height);
    renderer.render(&INTRO, time, quality, &mut frame);
    frame
}

/// Measures every part, and writes `show.md`.
pub fn run(options: &Common) -> Result {
    let (effort, out) = (if options.quick { QUICK } else { FULL }, &options.out);
    let parts = parts::all()?;
    let mut renderer = Renderer::new(THREADS)?;
    let (machine, (width, height)) = (machine::machine(), effort.timed);
    let mut text = format!(
        "# The show\n\n\
         Written by `{}`; not edited by hand.\n\n\
         {machine}; {width}x{height}, {THREADS} threads unless said otherwise. Seconds are those of the show.\n",
        options.command("show"),
    );
    let mut add = |table: String| {
        println!("{table}");
        text += &format!("\n{table}");
    };
    add(speed::report(&parts, &effort));
    for report in [error::report, pops::report] {
        add(report(&mut renderer, &parts, &effort));
    }
    std::fs::create_dir_all(out)?;
    let file = out.join("show.md");
    std::fs::write(&file, text)?;
    println!("{}", file.display());
    Ok(())
}
