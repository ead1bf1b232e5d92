//! Films of the show's parts against the reference by ColorVideoVDP `[Mantiuk24]`, which sees flicker and popping, as stills
//! do not.

use crate::options::{Common, Result};
use crate::show::parts;
use colorvideovdp::{Color, Cvvdp, DisplayModel, Geometry, Image, Options, Photometry};
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes::INTRO;
use paprsek::settings::Quality;
use std::fmt::Write;
use std::fs;
use std::time::Instant;

/// How much is filmed.
struct Effort {
    size: (usize, usize),
    /// Frames of a film, which begins in the middle of its part's longest shot.
    frames: usize,
}

const FULL: Effort = Effort { size: (256, 144), frames: 12 };
const QUICK: Effort = Effort { size: (64, 36), frames: 3 };
/// Frames per second.
const FPS: f64 = 30.0;
/// Pixels per degree: those of FLIP.
const PER_DEGREE: f64 = 67.0;

/// Films every part at `fast` and `default`, and writes `films.md`.
pub fn run(options: &Common) -> Result {
    let Effort { size, frames } = if options.quick { QUICK } else { FULL };
    let (width, height) = size;
    // A desktop's display: 200 cd/m2, contrast 1000, in a room of 250 lux of which the panel reflects 0.5 %.
    let light = Photometry::new(200.0, 1000.0, 250.0, 0.005, 1.0)?;
    let display = DisplayModel::new("desktop", light, Geometry::from_ppd([width, height], PER_DEGREE)?, "sRGB")?;
    let judge = Cvvdp::new(display, Options::default())?;
    let mut renderer = Renderer::new(0)?;
    let mut text = format!(
        "# Films\n\nWritten by `{}`; not edited by hand.\n\n\
         {frames} frames at {FPS} per second and {width}x{height}, from the middle of the longest shot of each part, against \
         the same film at `reference`, by ColorVideoVDP {} on a display of {PER_DEGREE} pixels per degree and 200 cd/m2. JOD \
         are just-objectionable differences: 10 is no visible difference, and one JOD less is seen by three of four \
         observers. **film** sees flicker and popping; **stills** is the least JOD of a frame judged alone. A film far below \
         its stills flickers.\n\n\
         | part | from, s | quality | film, JOD | stills, JOD | metric, s |\n|---|--:|---|--:|--:|--:|\n",
        options.command("films"),
        Cvvdp::MODEL_VERSION,
    );
    for part in parts::all()? {
        let shots = part.shots();
        let longest = shots.iter().max_by(|a, b| (a.end - a.start).total_cmp(&(b.end - b.start))).expect("a shot");
        let from = 0.5 * (longest.start + longest.end);
        let mut film = |quality: &Quality| -> Result<Vec<Image>> {
            let mut frame = Frame::new(width, height);
            let frames = (0..frames).map(|number| {
                renderer.render(&INTRO, from + number as f64 / FPS, quality, &mut frame);
                let codes = frame.to_rgb().into_iter().map(|code| f32::from(code) / 255.0).collect();
                Ok(Image::new(width, height, 3, codes)?)
            });
            frames.collect()
        };
        let truth = film(&Quality::REFERENCE)?;
        for (name, quality) in [("default", Quality::DEFAULT), ("fast", Quality::FAST)] {
            let ours = film(&quality)?;
            let began = Instant::now();
            let jod = judge.predict_video(&ours, &truth, FPS as f32, Color::Srgb)?.jod;
            let seconds = began.elapsed().as_secs_f64();
            let mut least = f32::INFINITY;
            for (ours, truth) in ours.iter().zip(&truth).step_by(5) {
                least = least.min(judge.predict_image(ours, truth, Color::Srgb)?.jod);
            }
            writeln!(text, "| {} | {from:.2} | {name} | {jod:.2} | {least:.2} | {seconds:.1} |", part.name())?;
        }
        eprintln!("{}: filmed", part.name());
    }
    fs::create_dir_all(&options.out)?;
    fs::write(options.out.join("films.md"), &text)?;
    println!("{text}");
    Ok(())
}
