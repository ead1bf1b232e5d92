//! The time of frames.

use super::parts::Part;
use super::{Effort, THREADS};
use crate::machine;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes::INTRO;
use paprsek::settings::Quality;
use std::time::Instant;
use testkit::median;

/// Frames per second of the film.
const FPS: f64 = 30.0;
/// Goals in frames per second: for the median frame, and for the slowest hundredth.
const GOALS: [f64; 2] = [60.0, 30.0];

/// The cost of a part's frames.
struct Cost {
    /// Milliseconds of each frame, and the time that it shows, seconds.
    frames: Vec<(f64, f64)>,
    /// The number of eye rays and fragments of all frames.
    samples: u64,
}

/// The table of all parts, as Markdown.
pub fn report(parts: &[Part], effort: &Effort) -> String {
    let [median, slow] = GOALS;
    let mut text = format!(
        "## Speed\n\n\
         Each part is played from its start to its end, every frame of a film at {FPS} frames per second, first at \
         `default`, then at `fast`. What is kept from frame to frame is kept here too, and what is made when a part first \
         comes is part of its first frame. The slowest hundredth is slower than 99 % of the frames. Goals are {median} frames \
         per second in the median and {slow} in the slowest hundredth; what falls short is **bold**. Samples are eye rays \
         or, for triangles, shaded fragments.\n\n\
         | part | quality | SIMD level | frames | fps, median | fps, slowest hundredth | slowest frame, ms | at, s | samples per pixel |\n\
         |---|---|---|--:|--:|--:|--:|--:|--:|\n"
    );
    for part in parts {
        for (name, quality) in [("default", Quality::DEFAULT), ("fast", Quality::FAST)] {
            for (simd, level) in machine::levels() {
                let mut renderer = Renderer::new(THREADS).expect("threads can be started").at_level(level);
                let cost = play(&mut renderer, part, &quality, effort);
                text += &row(&format!("{} | {name} | {simd}", part.name()), cost, effort);
            }
        }
        eprintln!("{}: timed", part.name());
    }
    text
}

/// Renders a part, frame after frame.
fn play(renderer: &mut Renderer, part: &Part, quality: &Quality, effort: &Effort) -> Cost {
    let mut frame = Frame::new(effort.timed.0, effort.timed.1);
    let mut cost = Cost { frames: Vec::new(), samples: 0 };
    for number in part.frames(FPS).step_by(effort.every) {
        let time = number as f64 / FPS;
        let began = Instant::now();
        cost.samples += renderer.render(&INTRO, time, quality, &mut frame).samples;
        cost.frames.push((began.elapsed().as_secs_f64() * 1e3, time));
    }
    cost
}

fn row(what: &str, Cost { mut frames, samples }: Cost, effort: &Effort) -> String {
    frames.sort_by(|a, b| a.0.total_cmp(&b.0));
    let count = frames.len();
    let (worst, at) = frames[count - 1];
    let median = median(frames.iter().map(|frame| frame.0).collect());
    let [median, slow] = [(median, GOALS[0]), (frames[count * 99 / 100].0, GOALS[1])].map(|(ms, goal)| {
        let fps = 1e3 / ms;
        if fps < goal { format!("**{fps:.1}**") } else { format!("{fps:.1}") }
    });
    let samples = samples as f64 / (count * effort.timed.0 * effort.timed.1) as f64;
    format!("| {what} | {count} | {median} | {slow} | {worst:.1} | {at:.2} | {samples:.3} |\n")
}
