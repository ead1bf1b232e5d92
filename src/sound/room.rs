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
pub const REACH: u32 = ((CLOSE + FAR) * RATE as f32) as u32 / BLOCK as u32 + 3;

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
        let far = [1, 2].map(|ear| taps(ear, FAR_COUNT, FAR, FADE, LOUDNESS));
        Room { close: taps(0, CLOSE_COUNT, CLOSE, 1.0, 1.0), far, sent: Delay::new(), diffuse: Delay::new() }
    }

    /// Takes what is sent in block `number`, after that of [`REACH`] blocks before it, and adds what is heard meanwhile.
    pub fn play(&mut self, number: u32, sent: &Block, ears: &mut [Block; 2]) {
        let at = number as usize * BLOCK;
        self.sent.put(at, sent);
        let mut diffuse = [0.0; BLOCK];
        for &(delay, gain) in &self.close {
            self.sent.add(at.wrapping_sub(delay), gain, &mut diffuse);
            // The mean with the sample before it, so that what is heard again is duller.
            self.sent.add(at.wrapping_sub(delay + 1), gain, &mut diffuse);
        }
        self.diffuse.put(at, &diffuse);
        for ((ear, taps), (delay, gain)) in ears.iter_mut().zip(&self.far).zip(ECHO) {
            for &(delay, gain) in taps {
                self.diffuse.add(at.wrapping_sub(delay), gain, ear);
            }
            self.sent.add(at.wrapping_sub((delay * RATE as f32) as i32 as usize), gain, ear);
        }
    }
}

impl Default for Room {
    fn default() -> Room {
        Room::new()
    }
}

/// Reflections within `seconds`, one in each of as many equal pieces of that time, which fade to 2^-`fade`.
fn taps(seed: u32, count: u32, seconds: f32, fade: f32, loudness: f32) -> Vec<Tap> {
    let tap = |k: u32| {
        let x = (k as f32 + rnd(seed, k, 0)) / count as f32;
        let sign = if rnd(seed, k, 1) < 0.5 { -1.0 } else { 1.0 };
        let gain = exp2(-fade * x) * sign * loudness / (count as f32).sqrt();
        ((x * seconds * RATE as f32) as i32 as usize, gain)
    };
    (0..count).map(tap).collect()
}

/// The last samples of a sound, in a ring.
#[derive(Clone, Debug)]
struct Delay(Vec<f32>);

impl Delay {
    /// Samples of the ring: a power of two, more than reach back.
    const RING: usize = 1 << 17;

    fn new() -> Delay {
        // Twice, so that a block that begins anywhere in the ring is in one piece.
        Delay(vec![0.0; 2 * Delay::RING])
    }

    /// Keeps a block that begins with sample `at`, modulo 2^64.
    fn put(&mut self, at: usize, block: &Block) {
        for turn in [0, Delay::RING] {
            self.0[at % Delay::RING + turn..][..BLOCK].copy_from_slice(block);
        }
    }

    /// Adds a block that begins with sample `at`.
    #[inline(never)]
    fn add(&self, at: usize, gain: f32, out: &mut Block) {
        for (out, before) in out.iter_mut().zip(&self.0[at % Delay::RING..]) {
            *out += before * gain;
        }
    }
}
