//! Frames per second on N threads.

use crate::args::{Args, When};
use crate::canvas;
use crate::number::{digits, fixed};
use crate::output::print;
use paprsek::scenes::{self, Scene};
use paprsek::tile::{Frame, Renderer};
use std::slice;
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

/// A figure and what it is called.
type Field<'a> = (&'static str, &'a [u8]);

/// Times the scene of `args`, or every scene, and prints each result when it is known.
pub fn run(args: &Args, json: bool) -> Result<(), Vec<u8>> {
    let mut renderer = Renderer::new(args.threads)?;
    let mut frame = canvas::frame(args.size)?;
    let (width, height) = args.size;
    let setting: [Field<'_>; 5] = [
        ("width", &digits(width)),
        ("height", &digits(height)),
        ("threads", &digits(renderer.threads())),
        ("simd", renderer.simd().as_bytes()),
        ("quality", args.quality_name.as_bytes()),
    ];
    let mut first = !json;
    for scene in args.scene.map_or(scenes::ALL, slice::from_ref) {
        let times = time(&mut renderer, scene, args, &mut frame);
        let count = times.ms.len();
        // Of an even number of frames the mean of the middle two.
        let median = 0.5 * (times.ms[(count - 1) / 2] + times.ms[count / 2]);
        // Slower than 99 % of all.
        let slow = times.ms[count * 99 / 100];
        let found: [Field<'_>; 6] = [
            ("scene", scene.name.as_bytes()),
            ("frames", &digits(count)),
            ("fps_median", &fixed(1000.0 / median)),
            ("fps_p1", &fixed(1000.0 / slow)),
            ("ms_median", &fixed(median)),
            ("samples", &fixed(times.samples as f64 / (count * width * height) as f64)),
        ];
        let mut text = Vec::new();
        if json {
            for (name, value) in found.iter().chain(&setting) {
                let quote: &[u8] = if value[0].is_ascii_digit() { b"" } else { b"\"" };
                let before: &[u8] = if text.is_empty() { b"{\"" } else { b",\"" };
                text.extend([before, name.as_bytes(), b"\":", quote, value, quote].concat());
            }
            text.push(b'}');
        } else {
            if std::mem::take(&mut first) {
                for (name, value) in setting {
                    text.extend([name.as_bytes(), b" ", value, b"  "].concat());
                }
                text.push(b'\n');
                row(&mut text, found.map(|field| field.0.as_bytes()));
                text.push(b'\n');
            }
            row(&mut text, found.map(|field| field.1));
        }
        text.push(b'\n');
        print(&text)?;
    }
    Ok(())
}

/// Adds a row of the table: a name at the left, the others in columns that they end.
fn row(text: &mut Vec<u8>, [name, cells @ ..]: [&[u8]; 6]) {
    let mut end = text.len() + 10;
    text.extend_from_slice(name);
    for cell in cells {
        end += 13;
        text.resize(text.len().max(end - cell.len()), b' ');
        text.extend_from_slice(cell);
    }
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
        times.samples += stats.samples;
        // Never zero, since its inverse is printed: a microsecond is below what a frame can take.
        times.ms.push((frame_began.elapsed().as_secs_f64() * 1000.0).max(1e-3));
        // To its place among those before it.
        let mut place = times.ms.len() - 1;
        while place > 0 && times.ms[place - 1] > times.ms[place] {
            times.ms.swap(place - 1, place);
            place -= 1;
        }
    }
    times
}

/// The instant of a frame: steps through the range, and from its start again.
fn instant(start: f64, end: f64, number: usize) -> f64 {
    // Counted in steps: the remainder of a float is long division in software.
    let steps = ((end - start) / STEP).ceil().max(1.0) as usize;
    start + (number % steps) as f64 * STEP
}
