//! Frames per second on N threads.

use crate::args::{Args, When};
use crate::canvas;
use crate::number::figure;
use crate::output::{SPACES, add, print};
use paprsek::scenes::{self, Scene};
use paprsek::tile::{Frame, Renderer};
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

/// The figures of a scene.
const NAMES: [&[u8]; 8] =
    [b"frames", b"fps_median", b"fps_p1", b"ms_median", b"samples", b"width", b"height", b"threads"];
/// Those that the table has a column for, and the head of the table.
const COLUMNS: usize = 5;
const HEAD: &[u8] = b"\nscene                  frames  fps_median      fps_p1   ms_median     samples\n";

/// What the frames of one scene took.
struct Times {
    /// Milliseconds of each frame, ascending.
    ms: Vec<f64>,
    /// Eye rays of all frames.
    samples: u64,
}

/// Times the scene of `args`, or every scene, and prints each result when it is known.
pub fn run(args: &Args, json: bool) -> Result<(), Vec<u8>> {
    let mut renderer = Renderer::new(args.threads)?;
    let mut frame = canvas::frame(args.size)?;
    let (width, height) = args.size;
    let (simd, quality) = (renderer.simd().as_bytes(), args.quality_name.as_bytes());
    let mut headed = false;
    for scene in args.scene.map_or(scenes::ALL, slice::from_ref) {
        let times = time(&mut renderer, scene, args, &mut frame);
        let count = times.ms.len();
        // Of an even number of frames the mean of the middle two.
        let median = 0.5 * (times.ms[(count - 1) / 2] + times.ms[count / 2]);
        // Slower than 99 % of all.
        let slow = times.ms[count * 99 / 100];
        let samples = times.samples as f64 / (count * width * height) as f64;
        let (threads, name) = (renderer.threads(), scene.name.as_bytes());
        let [count, width, height, threads] = [count, width, height, threads].map(|number| number as f64);
        let figures = [count, 1000.0 / median, 1000.0 / slow, median, samples, width, height, threads].map(figure);
        let mut text = Vec::new();
        if json {
            add(&mut text, &[b"{\"scene\":\"", name, b"\",\"simd\":\"", simd, b"\",\"quality\":\"", quality, b"\""]);
            for (name, figure) in NAMES.iter().zip(&figures) {
                add(&mut text, &[b",\"", name, b"\":", figure]);
            }
            add(&mut text, &[b"}\n"]);
        } else {
            let [.., width, height, threads] = &figures;
            if !headed {
                add(
                    &mut text,
                    &[width, b"x", height, b", ", threads, b" threads, ", simd, b", quality ", quality, HEAD],
                );
                headed = true;
            }
            add(&mut text, &[name, &SPACES[name.len()..]]);
            for figure in &figures[..COLUMNS] {
                add(&mut text, &[&SPACES[figure.len() + 4..], figure]);
            }
            add(&mut text, &[b"\n"]);
        }
        print(&text)?;
    }
    Ok(())
}

fn time(renderer: &mut Renderer, scene: &Scene, args: &Args, frame: &mut Frame) -> Times {
    let (start, end) = match args.when {
        When::At(at) => (at, at),
        When::Range(from, to) => (from, to.unwrap_or(scene.duration)),
        When::Whole => (if scene.duration > START { START } else { 0.0 }, scene.duration),
    };
    // Counted in steps: the remainder of a float is long division in software.
    let steps = ((end - start) / STEP).ceil().max(1.0) as usize;
    let mut render = |number: usize| {
        // Through the range, and from its start again.
        let instant = start + (number % steps) as f64 * STEP;
        let began = Instant::now();
        let stats = renderer.render_eyes(scene, instant, &args.quality, args.stereo, frame);
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
