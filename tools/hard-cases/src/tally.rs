//! What a walk has come to.

use std::fmt::{Display, Formatter};
use std::fs::OpenOptions;
use std::io::Write;
use std::time::Instant;

/// How much more work than either neighbour a frame may be.
pub const SPIKE: f64 = 2.5;
/// Samples, and milliseconds, below which a frame is no spike.
pub const FEW: f64 = 200.0;
pub const SHORT: f64 = 0.5;

/// The walks that were kept, a row of a table each.
pub const WALKS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/walks.md");

/// Whether the middle one of three is a spike.
pub fn spike(three: [f64; 3], least: f64) -> bool {
    three[1] > least && three[1] > SPIKE * three[0] && three[1] > SPIKE * three[2]
}

/// Counts of a walk.
pub struct Tally {
    start: Instant,
    /// The request that comes next.
    pub next: u64,
    /// Frames, each another.
    pub frames: u64,
    pixels: u64,
    pub failures: u64,
    /// Frames that were tried again because of their time.
    pub suspects: u64,
    /// Those of them that are spikes at their own size.
    pub spikes: u64,
    /// The most samples of a frame by those of its neighbours.
    pub worst: f64,
}

impl Tally {
    pub fn new(first: u64) -> Tally {
        Tally {
            start: Instant::now(),
            next: first,
            frames: 0,
            pixels: 0,
            failures: 0,
            suspects: 0,
            spikes: 0,
            worst: 0.0,
        }
    }

    /// A request is done.
    pub fn add(&mut self, frames: u64, pixels: u64) {
        self.next += 1;
        let before = self.frames / 2000;
        self.frames += frames;
        self.pixels += pixels;
        if self.frames / 2000 > before {
            println!("{self}");
        }
    }

    pub fn fail(&mut self, what: &str) {
        self.failures += 1;
        println!("{what}");
    }

    /// Adds a row to the walks that were kept.
    pub fn keep(&self, seed: u64, first: u64) -> Result<(), String> {
        let Tally { next, frames, pixels, failures, suspects, spikes, worst, .. } = self;
        let last = next - 1;
        let row = format!(
            "| {seed} | {first} to {last} | {frames} | {pixels} | {worst:.2} | {suspects} | {spikes} | {failures} |\n"
        );
        let file = OpenOptions::new().append(true).create(true).open(WALKS);
        file.and_then(|mut file| file.write_all(row.as_bytes())).map_err(|error| format!("{WALKS}: {error}"))
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut Formatter) -> std::fmt::Result {
        let Tally { start, next, frames, pixels, failures, suspects, spikes, worst } = self;
        write!(
            f,
            "{frames} frames, {pixels} pixels, {failures} failures; at most {worst:.2} times the samples of the neighbours; \
             {suspects} suspected by time, {spikes} of them spikes at their own size; {:.0} s; goes on at --first {next}",
            start.elapsed().as_secs_f64()
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spike_stands_above_both_neighbours() {
        assert!(spike([1.0, 2.6, 1.0], 0.5));
        assert!(!spike([1.0, 2.4, 1.0], 0.5), "too low");
        assert!(!spike([2.0, 2.6, 1.0], 0.5), "a step");
        assert!(!spike([0.1, 0.4, 0.1], 0.5), "too short");
    }
}
