//! A walk of random frames: any scene, time, size, quality, parameters, eye and SIMD level. No pixel may be anything but a
//! finite number before it is encoded, nothing may panic, and no frame may be far more work than its neighbours. Times that
//! are not finite may have light that is none.
//!
//! A request is drawn at four times, a sixtieth of a second apart, by a renderer of one thread: first a frame that fills
//! what is kept from frame to frame, then a frame and its two neighbours. Work is eye rays and shaded fragments, which are
//! counted and the same in every run, and processor time, which other programs disturb. So a frame that takes 2.5 times the
//! time of either neighbour is only suspected. It is cleared where the least of seven more rounds does not say so again, and
//! where the least of three rounds at the size of the show does not: what is done once for a frame of a few pixels, such as
//! lighting one of the six shapes of clouds anew, is a small part of a frame that is shown.

use crate::probe::{Probe, Seen};
use crate::request::{Request, request};
use crate::tally::{FEW, SHORT, Tally, spike};
use cpu_time::ProcessTime;
use paprsek::frame::{Frame, FrameSpec, Renderer, Values};
use std::collections::HashSet;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex};
use testkit::levels;

/// What is walked.
#[derive(Clone, Debug, clap::Args)]
pub struct Options {
    /// Frames to render, none of which has been rendered before in this walk or in one of the same seed that ended where
    /// this one begins.
    #[arg(long, default_value_t = 300)]
    pub frames: u64,
    /// Another seed is another walk.
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// The request to begin with: where a walk before ended, as it says.
    #[arg(long, default_value_t = 0)]
    pub first: u64,
    /// Adds a line to the walks that docs/hard-cases.md shows.
    #[arg(long)]
    pub keep: bool,
}

/// Seconds between neighbours.
const STEP: f64 = 1.0 / 60.0;
/// The frames of a request, in steps from its time; the third is held against the second and the fourth.
const STEPS: [f64; 4] = [-2.0, -1.0, 0.0, 1.0];
/// Rounds that may clear a suspect, at its own size and at that of the show.
const ROUNDS: [usize; 2] = [7, 3];
const SHOWN: (usize, usize) = (1280, 720);

/// The request that is being rendered, for the message of a panic.
static CURRENT: Mutex<String> = Mutex::new(String::new());

/// What drawing a frame took: samples, milliseconds of the processor, and pixels that are no light.
#[derive(Clone, Copy)]
struct Drawn {
    samples: f64,
    milliseconds: f64,
    bad: u64,
}

fn draw(renderer: &mut Renderer, request: &Request, time: f64) -> Drawn {
    let (width, height) = request.size;
    let values: Values = &request.values;
    let seen = Arc::new(Seen::default());
    let mut frame = Frame::new(width, height);
    let start = ProcessTime::now();
    let mut picture = {
        let spec = renderer.spec(time, &request.quality, request.size);
        (request.scene.picture)(&FrameSpec { eye: request.eye, values, ..spec })
    };
    picture.layers.push(Box::new(Probe(seen.clone())));
    let stats = renderer.draw(picture, &mut frame);
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    // A probe that has not seen every pixel could not have seen a bad one.
    let missed = (width * height) as u64 - seen.pixels.load(Ordering::Relaxed);
    Drawn { samples: stats.samples as f64, milliseconds, bad: seen.bad.load(Ordering::Relaxed) + missed }
}

/// The instants of a request, each once.
fn times(request: &Request) -> [f64; 4] {
    STEPS.map(|steps| request.time + steps * STEP)
}

/// Frames that have been seen, by hashes of what was asked for.
#[derive(Default)]
struct Known(HashSet<u64>);

impl Known {
    /// How many of a request's frames are new. Frames of no pixels, and of times that are none, are not.
    fn add(&mut self, request: &Request) -> u64 {
        if request.size.0 * request.size.1 == 0 || !request.time.is_finite() {
            return 0;
        }
        let mut hasher = DefaultHasher::new();
        Request { time: 0.0, ..request.clone() }.text().hash(&mut hasher);
        let new = times(request).map(|time| {
            let mut hasher = hasher.clone();
            time.to_bits().hash(&mut hasher);
            u64::from(self.0.insert(hasher.finish()))
        });
        new.iter().sum()
    }
}

/// What a suspect's third frame and its neighbours take at the least of some rounds, milliseconds.
fn least(renderer: &mut Renderer, request: &Request, rounds: usize) -> [f64; 3] {
    let mut least = [f64::INFINITY; 4];
    for _ in 0..rounds {
        for (least, time) in least.iter_mut().zip(times(request)) {
            *least = least.min(draw(renderer, request, time).milliseconds);
        }
    }
    let [_, three @ ..] = least;
    three
}

/// Walks, and says whether all went well.
pub fn walk(options: &Options) -> bool {
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if let Ok(current) = CURRENT.try_lock() {
            eprintln!("while rendering {current}");
        }
        before(info);
    }));
    let tally = try_walk(options).and_then(|tally| {
        println!("{tally}");
        if options.keep { tally.keep(options.seed, options.first).map(|()| tally) } else { Ok(tally) }
    });
    // The hook as it was before anyone's.
    drop(std::panic::take_hook());
    match tally {
        Ok(tally) => tally.failures == 0,
        Err(error) => {
            eprintln!("{error}");
            false
        }
    }
}

fn try_walk(options: &Options) -> Result<Tally, String> {
    let mut renderers: Vec<Renderer> = Vec::new();
    for (_, level) in levels() {
        renderers.push(Renderer::new(1)?.at_level(level));
    }
    let mut known = Known::default();
    for number in 0..options.first {
        known.add(&request(options.seed, number));
    }
    let mut tally = Tally::new(options.first);
    while tally.frames < options.frames {
        let request = request(options.seed, tally.next);
        if let Ok(mut current) = CURRENT.lock() {
            *current = request.text();
        }
        let renderer = &mut renderers[request.level];
        let [first, three @ ..] = times(&request).map(|time| draw(renderer, &request, time));
        let bad = first.bad + three.iter().map(|drawn| drawn.bad).sum::<u64>();
        // At no time there is a picture of some bytes, which no light is behind.
        if bad > 0 && request.time.is_finite() {
            tally.fail(&format!("{bad} pixels are no light: {}", request.text()));
        }
        let samples = three.map(|drawn| drawn.samples);
        if samples[1] > FEW {
            tally.worst = tally.worst.max(samples[1] / samples[0].max(samples[2]).max(1.0));
        }
        if spike(samples, FEW) {
            tally.fail(&format!("samples {samples:?}: {}", request.text()));
        }
        if spike(three.map(|drawn| drawn.milliseconds), SHORT) {
            tally.suspects += 1;
            if spike(least(renderer, &request, ROUNDS[0]), SHORT) {
                tally.spikes += 1;
                let shown = Request { size: SHOWN, ..request.clone() };
                let least = least(renderer, &shown, ROUNDS[1]);
                if spike(least, SHORT) {
                    tally.fail(&format!("milliseconds {least:.2?}: {}", shown.text()));
                }
            }
        }
        tally.add(known.add(&request), 4 * (request.size.0 * request.size.1) as u64);
    }
    Ok(tally)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slices_of_a_walk_are_the_walk() {
        let (mut whole, mut second) = (Known::default(), Known::default());
        let all: u64 = (0..600).map(|number| whole.add(&request(7, number))).sum();
        let one: u64 = (0..300).map(|number| second.add(&request(7, number))).sum();
        let two: u64 = (300..600).map(|number| second.add(&request(7, number))).sum();
        assert_eq!(one + two, all);
        // Some have no pixels or no time.
        assert!((2000..2400).contains(&all), "{all} frames");
        assert_eq!((0..600).map(|number| second.add(&request(7, number))).sum::<u64>(), 0);
        assert!((0..600).map(|number| second.add(&request(8, number))).sum::<u64>() > 2000);
    }
}
