//! Frames per second on N threads.

use crate::args::Args;
use crate::canvas;
use crate::io::{SPACES, fill, print};
use crate::text::{digits, figure};
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use std::slice;
use std::time::Instant;

/// First instant, seconds: the one that the other renderers are measured from.
const START: f64 = 2.0;
/// Seconds of scene time from frame to frame.
const STEP: f64 = 0.05;
/// Frames and milliseconds that a scene is given, and the milliseconds at which it must stop short of them.
const ENOUGH: (usize, f64) = (30, 1000.0);
const LIMIT: f64 = 4000.0;
/// Frames before the clock counts: caches, and clocks of the processor.
const WARM_UP: usize = 2;

/// What is printed about a scene as JSON, and as a row of the table; what is printed before the table.
const JSON: &str = r#"{"scene":"%%","frames":%,"fps_median":%,"fps_p1":%,"ms_median":%,"samples":%,"width":%,"height":%,"threads":%,"simd":"%","quality":"%"}
"#;
const ROW: &str = "%%       #             #             #             #             #\n";
const HEAD: &str = "\
%x%, % threads, %, quality %
scene            frames   fps median       fps p1    ms median      samples
";

/// What the frames of one scene took.
struct Times {
    /// Milliseconds of each frame, ascending.
    ms: Vec<f64>,
    /// Eye rays of all frames.
    samples: u64,
}

/// Times the scene of `args`, or every scene, and prints each result when it is known.
pub fn run(args: &Args, json: bool) -> Result<(), Vec<u8>> {
    let (mut renderer, mut frame) = canvas::open(args)?;
    let [width, height, threads] = &[args.size.0, args.size.1, renderer.threads()].map(digits);
    let (simd, quality) = (renderer.simd().as_bytes(), args.quality_name.as_bytes());
    if !json {
        print(&fill(HEAD, &[width, height, threads, simd, quality]))?;
    }
    for scene in args.scene.map_or(scenes::ALL, slice::from_ref) {
        let times = time(&mut renderer, scene, args, &mut frame);
        let count = times.ms.len();
        // Of an even number of frames the mean of the middle two.
        let median = 0.5 * (times.ms[(count - 1) / 2] + times.ms[count / 2]);
        // Slower than 99 % of all.
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

fn time(renderer: &mut Renderer, scene: &Scene, args: &Args, frame: &mut Frame) -> Times {
    let usual = if scene.duration > START { START } else { 0.0 };
    let (start, end) = (args.start.unwrap_or(usual), args.end(scene));
    // Counted in steps: the remainder of a float is long division in software.
    let steps = ((end - start) / STEP).ceil().max(1.0) as usize;
    let mut render = |number: usize| {
        // Through the range, and from its start again.
        let instant = start + (number % steps) as f64 * STEP;
        let began = Instant::now();
        let stats = renderer.render_with(scene, instant, &args.options, frame);
        // Never zero, since its inverse is printed: a microsecond is below what a frame can take.
        ((began.elapsed().as_secs_f64() * 1000.0).max(1e-3), stats.samples)
    };
    let mut warming = 0.0;
    for _ in 0..WARM_UP {
        if warming < LIMIT / 4.0 {
            warming += render(0).0;
        }
    }
    let mut times = Times { ms: Vec::new(), samples: 0 };
    let mut spent = 0.0;
    while spent < LIMIT && (times.ms.len() < ENOUGH.0 || spent < ENOUGH.1) {
        let mut place = times.ms.len();
        let (ms, samples) = render(place);
        spent += ms;
        times.samples += samples;
        times.ms.push(ms);
        // To its place among those before it.
        while place > 0 && times.ms[place - 1] > ms {
            times.ms.swap(place - 1, place);
            place -= 1;
        }
    }
    times
}
