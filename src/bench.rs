//! Frames per second on N threads.

use crate::args::{Args, When};
use crate::canvas;
use crate::number::fixed;
use paprsek::scenes::{self, Scene};
use paprsek::tile::{Frame, Renderer};
use std::io::{self, Write};
use std::time::{Duration, Instant};

/// First instant, seconds: the one that the other renderers are measured from.
const START: f64 = 2.0;
/// Seconds of scene time from frame to frame.
const STEP: f64 = 0.05;
/// Frames and time that a scene is given, and the time at which it must stop short of them.
const ENOUGH: (usize, Duration) = (30, Duration::from_secs(1));
const LIMIT: Duration = Duration::from_secs(4);
/// Frames before the clock counts: caches, and clocks of the processor.
const WARM_UP: usize = 2;

/// What the frames of one scene took.
struct Times {
    /// Milliseconds of each frame, ascending.
    ms: Vec<f64>,
    /// Eye rays of all frames.
    samples: u64,
}

impl Times {
    /// Milliseconds of the frame slower than `share` of all.
    fn quantile(&self, share: f64) -> f64 {
        let index = (share * self.ms.len() as f64) as usize;
        self.ms.get(index.min(self.ms.len() - 1)).copied().unwrap_or(0.0)
    }

    /// Of an even number of frames the mean of the middle two.
    fn median(&self) -> f64 {
        let half = self.ms.len() / 2;
        if self.ms.len().is_multiple_of(2) { 0.5 * (self.ms[half - 1] + self.ms[half]) } else { self.ms[half] }
    }
}

/// Times the scene of `args`, or every scene, and prints each result when it is known.
pub fn run(args: &Args, json: bool) -> Result<(), String> {
    let mut renderer = Renderer::new(args.threads)?;
    let mut frame = canvas::frame(args.size)?;
    let (width, height) = args.size;
    let (threads, simd, quality) = (renderer.threads(), renderer.simd(), args.quality_name);
    if !json {
        print(&format!(
            "{width}x{height}, {threads} threads, {simd}, quality {quality}\n\
             {:<16} {:>6} {:>12} {:>12} {:>12} {:>12}\n",
            "scene", "frames", "fps median", "slowest 1 %", "ms median", "samples"
        ))?;
    }
    for scene in args.scene.as_ref().map_or(scenes::all(), std::slice::from_ref) {
        let times = time(&mut renderer, scene, args, &mut frame);
        let (name, frames) = (scene.name, times.ms.len());
        let (median, slow) = (times.median(), times.quantile(0.99));
        let (fps_median, fps_p1, ms) = (fixed(1000.0 / median), fixed(1000.0 / slow), fixed(median));
        let samples = fixed(times.samples as f64 / (frames * width * height) as f64);
        print(&match json {
            true => format!(
                "{{\"scene\":\"{name}\",\"width\":{width},\"height\":{height},\"threads\":{threads},\
                 \"frames\":{frames},\"fps_median\":{fps_median},\"fps_p1\":{fps_p1},\"ms_median\":{ms},\
                 \"simd\":\"{simd}\",\"quality\":\"{quality}\",\"samples\":{samples}}}\n"
            ),
            false => format!("{name:<16} {frames:>6} {fps_median:>12} {fps_p1:>12} {ms:>12} {samples:>12}\n"),
        })?;
    }
    Ok(())
}

fn time(renderer: &mut Renderer, scene: &Scene, args: &Args, frame: &mut Frame) -> Times {
    let (start, end) = match args.when {
        When::At(at) => (at, at),
        When::Range(from, to) => (from, to.unwrap_or(scene.duration)),
        When::Whole => (if scene.duration > START { START } else { 0.0 }, scene.duration),
    };
    let warming = Instant::now();
    for _ in 0..WARM_UP {
        renderer.render_eyes(scene, start, &args.quality, args.stereo, frame);
        if warming.elapsed() >= LIMIT / 4 {
            break;
        }
    }
    let mut times = Times { ms: Vec::new(), samples: 0 };
    let began = Instant::now();
    while began.elapsed() < LIMIT && (times.ms.len() < ENOUGH.0 || began.elapsed() < ENOUGH.1) {
        let instant = instant(start, end, times.ms.len());
        let frame_began = Instant::now();
        let stats = renderer.render_eyes(scene, instant, &args.quality, args.stereo, frame);
        // Never zero, since its inverse is printed: a microsecond is below what a frame can take.
        times.ms.push((frame_began.elapsed().as_secs_f64() * 1000.0).max(1e-3));
        times.samples += stats.samples;
    }
    times.ms.sort_unstable_by(f64::total_cmp);
    times
}

/// The instant of a frame: steps through the range, and from its start again.
fn instant(start: f64, end: f64, number: usize) -> f64 {
    // Counted in steps: the remainder of a float is long division in software.
    let steps = ((end - start) / STEP).ceil().max(1.0) as usize;
    start + (number % steps) as f64 * STEP
}

fn print(text: &str) -> Result<(), String> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())
        .and_then(|()| out.flush())
        .map_err(|error| format!("cannot write to stdout: {error}"))
}
