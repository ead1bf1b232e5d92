//! Echo and room: what sounded before, heard again.
//!
//! Two sums of delayed samples, one behind the other: some tens of reflections within [`CLOSE`] seconds, whose sum is
//! heard again some tens of times within [`FAR`] seconds, ever fainter, at other times by each ear. Delays and signs are
//! hashed: sparse random reflections sound as smooth as dense ones `[Valimaki17]`. Both sums together have as many
//! reflections as the product of their numbers, for the work of their sum.

use super::samples::{Block, RATE};
use super::voice::exp2;
use crate::simd::block::BLOCK;
use crate::simd::hash::rnd;

/// How long the close reflections take, seconds.
const CLOSE: f32 = 0.05;
/// How long the far ones take, seconds.
const FAR: f32 = 1.9;
/// The numbers of reflections.
const CLOSE_COUNT: u32 = 20;
const FAR_COUNT: u32 = 48;
/// How far the far reflections have faded at the end, halvings.
const FADE: f32 = 8.0;
/// Amplitude of the room where all is sent to it.
const LOUDNESS: f32 = 0.24;
/// The echo of each ear: delay in seconds, and amplitude.
const ECHO: [(f32, f32); 2] = [(0.375, 0.3), (0.75, 0.2)];

/// The blocks before one that it has something of.
pub const REACH: u64 = ((CLOSE + FAR) * RATE as f32) as u64 / BLOCK as u64 + 3;

/// A reflection: its delay in samples, and its amplitude.
type Tap = (usize, f32);

/// What was sent to a room, and what it does with it.
#[derive(Clone, Debug)]
pub struct Room {
    close: Vec<Tap>,
    far: [Vec<Tap>; 2],
    /// What was sent, and the same with its close reflections.
    sent: Delay,
    diffuse: Delay,
}

impl Room {
    /// A silent room.
    pub fn new() -> Room {
        let close = taps(0, CLOSE_COUNT, CLOSE, 1.0);
        let far = [1, 2].map(|ear| {
            let mut taps = taps(ear, FAR_COUNT, FAR, FADE);
            for (_, gain) in &mut taps {
                *gain *= LOUDNESS;
            }
            taps
        });
        Room { close, far, sent: Delay::new(), diffuse: Delay::new() }
    }

    /// Forgets what was sent.
    pub fn clear(&mut self) {
        self.sent.clear();
        self.diffuse.clear();
    }

    /// Takes the next block of what is sent.
    pub fn send(&mut self, block: &Block) {
        self.sent.push(block);
        let mut diffuse = [0.0; BLOCK];
        for &tap in &self.close {
            self.sent.add(tap, &mut diffuse);
            // The mean with the sample after it, so that what is heard again is duller.
            self.sent.add((tap.0 + 1, tap.1), &mut diffuse);
        }
        self.diffuse.push(&diffuse);
    }

    /// Adds what is heard of it while its last block is heard.
    pub fn add(&self, ears: &mut [Block; 2]) {
        for ((ear, taps), (delay, gain)) in ears.iter_mut().zip(&self.far).zip(ECHO) {
            for &tap in taps {
                self.diffuse.add(tap, ear);
            }
            self.sent.add(((delay * RATE as f32) as usize, gain), ear);
        }
    }
}

impl Default for Room {
    fn default() -> Room {
        Room::new()
    }
}

/// Reflections within `seconds`, one in each of as many equal pieces of that time, which fade to 2^-`fade`.
fn taps(seed: u32, count: u32, seconds: f32, fade: f32) -> Vec<Tap> {
    let tap = |k: u32| {
        let x = (k as f32 + rnd(seed, k, 0)) / count as f32;
        let sign = if rnd(seed, k, 1) < 0.5 { -1.0 } else { 1.0 };
        let gain = exp2(-fade * x) * sign / (count as f32).sqrt();
        ((x * seconds * RATE as f32) as usize, gain)
    };
    (0..count).map(tap).collect()
}

/// The last blocks of a sound.
#[derive(Clone, Debug)]
struct Delay {
    samples: Vec<f32>,
    /// Where the last block starts.
    last: usize,
}

impl Delay {
    /// Samples that are kept.
    const KEPT: usize = REACH as usize * BLOCK;

    fn new() -> Delay {
        // As many again to go on to, before what is kept is moved to the front.
        Delay { samples: vec![0.0; 2 * Delay::KEPT], last: Delay::KEPT - BLOCK }
    }

    fn clear(&mut self) {
        self.samples.fill(0.0);
    }

    fn push(&mut self, block: &Block) {
        self.last += BLOCK;
        if self.last == self.samples.len() {
            self.samples.copy_within(self.last - Delay::KEPT.., 0);
            self.last = Delay::KEPT;
        }
        self.samples[self.last..][..BLOCK].copy_from_slice(block);
    }

    /// Adds the last block as it was a while before. No delay is longer than what is kept.
    fn add(&self, (delay, gain): Tap, out: &mut Block) {
        for (out, before) in out.iter_mut().zip(&self.samples[self.last - delay..]) {
            *out += before * gain;
        }
    }
}
