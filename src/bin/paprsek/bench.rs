//! The benchmark: how long frames of a scene take.
//!
//! Frames at even steps through the scene are timed one by one; the median and the slowest hundredth are printed. Each
//! scene gets enough frames and time for a steady median, but no more than some seconds.

use crate::args::Args;
use crate::capture;
use crate::io::print;
use crate::text::{SPACES, digits, figure, fill};
use paprsek::frame::{Frame, Renderer, Scene};
use paprsek::scenes;
use std::slice;
use std::time::Instant;

/// The first instant, seconds: the one that other renderers are measured from too.
const START: f64 = 2.0;
/// Seconds of scene time from frame to frame.
const STEP: f64 = 0.05;
/// Frames that a scene gets at least, unless it reaches [`MAX_TIME`].
const MIN_FRAMES: usize = 30;
/// Time that a scene gets at least, milliseconds.
const MIN_TIME: f64 = 1000.0;
/// Time after which a scene gets no more frames, milliseconds.
const MAX_TIME: f64 = 4000.0;
/// Frames before those that count, which fill the caches and raise the clock of the processor.
const WARM_UP: usize = 2;
/// Time after which warming up ends, milliseconds.
const MAX_WARM_UP_TIME: f64 = MAX_TIME / 4.0;
/// Shortest time of a frame, milliseconds: less than any can take, and not zero, since its inverse is printed.
const MIN_FRAME_TIME: f64 = 1e-3;

/// The line of a scene as JSON.
const JSON: &str = r#"{"scene":"%%","frames":%,"fps_median":%,"fps_p1":%,"ms_median":%,"samples":%,"width":%,"height":%,"threads":%,"simd":"%","quality":"%"}
"#;
/// The line of a scene in the table.
const ROW: &str = "%%       #             #             #             #             #\n";
/// What is printed before the table.
const HEAD: &str = "\
%x%, % threads, %, quality %
scene            frames   fps median       fps p1    ms median      samples
";

/// What the frames of one scene took.
struct Times {
    /// The time of each frame, milliseconds, ascending.
    ms: Vec<f64>,
    /// Samples of all frames.
    samples: u64,
}

/// Times the scene of `args`, or every scene, and prints each result as soon as it is known.
pub fn run(args: &Args, json: bool) -> Result<(), Vec<u8>> {
    let (mut renderer, mut frame) = capture::open(args)?;
    let [width, height, threads] = &[args.size.0, args.size.1, renderer.threads()].map(digits);
    let (simd, quality) = (renderer.simd().as_bytes(), args.quality_name.as_bytes());
    if !json {
        print(&fill(HEAD, &[width, height, threads, simd, quality]))?;
    }
    for scene in args.scene.map_or(scenes::ALL, slice::from_ref) {
        let times = time(&mut renderer, scene, args, &mut frame);
        let count = times.ms.len();
        // For an even number of frames the mean of the middle two.
        let median = 0.5 * (times.ms[(count - 1) / 2] + times.ms[count / 2]);
        // Slower than 99 % of the frames.
        let slow = times.ms[count * 99 / 100];
        let samples = times.samples as f64 / (count * frame.pixels.len()) as f64;
        let [frames, fps, p1, ms, samples] =
            &[count as f64, 1000.0 / median, 1000.0 / slow, median, samples].map(figure);
        let name = scene.name.as_bytes();
        let (template, gap) = if json { (JSON, &[][..]) } else { (ROW, &SPACES[name.len()..]) };
        let words = [name, gap, frames, fps, p1, ms, samples, width, height, threads, simd, quality];
        print(&fill(template, &words))?;
    }
    Ok(())
}

/// Times frames of a scene.
fn time(renderer: &mut Renderer, scene: &Scene, args: &Args, frame: &mut Frame) -> Times {
    let usual = if scene.duration > START { START } else { 0.0 };
    let (start, end) = (args.start.unwrap_or(usual), args.end_of(scene));
    // Counted in steps, because the remainder of a float is long division in software.
    let steps = ((end - start) / STEP).ceil().max(1.0) as usize;
    let mut render = |number: usize| {
        // Through the range, then from its start again.
        let instant = start + (number % steps) as f64 * STEP;
        let began = Instant::now();
        let stats = renderer.render_with(scene, instant, &args.options, frame);
        ((began.elapsed().as_secs_f64() * 1000.0).max(MIN_FRAME_TIME), stats.samples)
    };
    let mut warming = 0.0;
    for _ in 0..WARM_UP {
        if warming < MAX_WARM_UP_TIME {
            warming += render(0).0;
        }
    }
    let mut times = Times { ms: Vec::new(), samples: 0 };
    let mut spent = 0.0;
    while spent < MAX_TIME && (times.ms.len() < MIN_FRAMES || spent < MIN_TIME) {
        let mut place = times.ms.len();
        let (ms, samples) = render(place);
        spent += ms;
        times.samples += samples;
        times.ms.push(ms);
        // Moves it to its place among those before it.
        while place > 0 && times.ms[place - 1] > ms {
            times.ms.swap(place - 1, place);
            place -= 1;
        }
    }
    times
}
