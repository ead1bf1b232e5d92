//! A note, and its samples in a block.

use super::samples::{Block, RATE};
use super::voice::Voice;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::hash::{STEP, wide};
use crate::simd::lanes::{F, STEPS, U, float};
use crate::simd::math::smooth;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// The blocks of a second.
const BLOCKS: f32 = RATE as f32 / BLOCK as f32;
/// The unit of what moves a phase, as a part of a turn: phases themselves are in units of 2^-32 turns.
const FINE: f32 = 16_777_216.0;
const FINE_BITS: u32 = 8;

/// A note: what is played, when, and where it is heard.
#[derive(Clone, Copy, Debug)]
pub struct Note {
    /// The block that it starts with.
    pub start: u32,
    /// The first block after it.
    pub end: u32,
    /// How long it is held, seconds.
    pub held: f32,
    /// Its frequency, hertz.
    pub pitch: f32,
    /// Its amplitude for the left and the right ear.
    pub gain: [f32; 2],
    /// How it sounds.
    pub voice: &'static Voice,
}

impl Note {
    /// A note that starts after `start` seconds, to the nearest block: at most 0.73 ms beside it.
    pub fn new(start: f32, held: f32, pitch: f32, gain: [f32; 2], voice: &'static Voice) -> Note {
        let start = (start * BLOCKS + 0.5) as u32;
        let end = start.saturating_add(((held + voice.release) * BLOCKS) as u32).saturating_add(1);
        Note { start, end, held, pitch, gain, voice }
    }

    /// The number of its noise: noises of notes that start at different times differ.
    fn seed(&self) -> u32 {
        self.start & 255
    }

    /// What it has where its block `number` begins, counted from its own start: as [`Voice::at`] has it, with gusts.
    fn at(&self, number: u32) -> [f32; 3] {
        let t = number as f32 / BLOCKS;
        let mut at = self.voice.at(t, self.held);
        at[0] *= self.voice.gust(self.seed(), t);
        at
    }
}

/// Phase per sample of a frequency in hertz.
fn step(pitch: f32) -> u32 {
    // Modulo 2^32, as phases are.
    (f64::from(pitch) * (4_294_967_296.0 / f64::from(RATE))) as i64 as u32
}

/// Adds block `number` of a note to both ears, and to what goes to the room.
#[simd]
pub(super) fn add<S: Simd>(simd: S, note: &Note, number: u32, ears: &mut [Block; 2], sent: &mut Block) {
    let Note { voice, pitch, gain, .. } = *note;
    let from = number - note.start;
    // What is at the block's ends.
    let ends = [note.at(from), note.at(from + 1)];
    let numbers = U::<S>::from_slice(simd, &STEPS[..F::<S>::LEN]);
    for i in 0..BLOCK / F::<S>::LEN {
        let within = numbers + (i * F::<S>::LEN) as u32;
        let n = within + from * BLOCK as u32;
        let x = float(simd, within) * (1.0 / BLOCK as f32);
        // Written out: lane operations in a closure are not always inlined, and then each is a call.
        let level = x * (ends[1][0] - ends[0][0]) + ends[0][0];
        let index = x * (ends[1][1] - ends[0][1]) + ends[0][1];
        let ahead = x * (ends[1][2] - ends[0][2]) + ends[0][2];
        let mut tone = F::<S>::splat(simd, 0.0);
        let rough = if voice.noise > 0.0 { roughness(simd, note, from, within) * level } else { level };
        for ear in 0..2 {
            if ear == 0 || voice.detune != 0.0 {
                let pitch = pitch * (1.0 + if ear == 0 { voice.detune } else { -voice.detune });
                let modulator = n * U::<S>::splat(simd, step(pitch * voice.ratio));
                let swing = (sine(simd, modulator) * index + ahead) * FINE;
                let swing = swing.to_int::<S::i32s>().bitcast::<U<S>>() << FINE_BITS;
                let phase = n * U::<S>::splat(simd, step(pitch)) + swing;
                tone = sine(simd, phase) * rough;
            }
            let sound = tone * gain[ear];
            store(load::<_, F<S>>(simd, &ears[ear], i) + sound, &mut ears[ear], i);
            store(load::<_, F<S>>(simd, sent, i) + sound * voice.room, sent, i);
        }
    }
}

/// What noise multiplies samples `within` block `from` of a note by.
#[inline(always)]
fn roughness<S: Simd>(simd: S, note: &Note, from: u32, within: U<S>) -> F<S> {
    let voice = note.voice;
    // Random numbers per sample, and those before the block, in units of 2^-24.
    let step = step(voice.colour) >> 8;
    let before = u64::from(from) * BLOCK as u64 * u64::from(step);
    let place = within * U::<S>::splat(simd, step) + (before as u32 & 0xff_ffff);
    let number = (place >> 24) + (before >> 24) as u32;
    let a = float(simd, wide(simd, note.seed(), number, 0)) * STEP;
    let b = float(simd, wide(simd, note.seed(), number + 1, 0)) * STEP;
    // A smooth way from one to the next.
    let noise = a + (b - a) * smooth(simd, float(simd, place & 0xff_ffff) * STEP);
    (noise * 2.0 - 1.0) * voice.noise + (1.0 - voice.noise)
}

/// Sines of phases, off by less than 2e-6: the best odd polynomial of degree 7 on a quarter of a turn.
#[inline(always)]
fn sine<S: Simd>(simd: S, phase: U<S>) -> F<S> {
    // From -1 to 1 in a turn.
    let x = float(simd, phase) * (1.0 / 2_147_483_648.0);
    let y = x.abs();
    let z = y.min(F::<S>::splat(simd, 1.0) - y);
    let q = z * z;
    let sine = z * (q * (q * (q * -0.554_636_1 + 2.541_899) - 5.167_143) + 3.141_582);
    sine.copysign(x)
}
