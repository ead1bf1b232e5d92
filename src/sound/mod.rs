//! Sound in closed form: a sample is a function of its number and of the score, whatever was played before it.
//!
//! A [`Score`] is a list of [`Note`]s, each played by a [`Voice`] of two operators of frequency modulation
//! `[Chowning73]` and hashed noise. Notes are evaluated in blocks of [`BLOCK`] samples, which start at multiples of it:
//! amplitudes and modulation are computed at a block's ends and run along lines between them, phases are whole numbers
//! and exact. So no sample depends on where one starts to listen.
//!
//! Echo and room are sums of what sounded before (`room.rs`), not recursions: what a sample takes of them is evaluated
//! anew after a jump, and kept while one listens on.

mod note;
mod room;
mod voice;

pub use crate::simd::block::BLOCK;
pub use note::Note;
pub use voice::Voice;

use crate::simd::hash::{STEP, pcg};
use crate::simd::level;
use fearless_simd::{Level, dispatch};
use room::Room;

/// Samples per second and ear.
pub const RATE: u32 = 44_100;

/// What is added to the number of a sample for the second number of its dither.
const DITHER: u32 = 1 << 31;

/// What all is louder than its notes say.
const LOUDNESS: f32 = 1.15;

/// A sample of the left and one of the right ear.
pub type Pair = [i16; 2];

/// The samples of a block for one ear. 1 is the loudest that a file can hold.
type Block = [f32; BLOCK];

/// Notes, and how they sound where they are played.
#[derive(Clone, Debug)]
pub struct Score {
    notes: Vec<Note>,
    /// The number of blocks until the last note has ended.
    length: u64,
    room: Room,
    /// The block that was evaluated last, and its number, of which the room has heard all up to it.
    last: ([Block; 2], u64),
    level: Level,
}

impl Score {
    /// A score of these notes, in any order, that ends after `seconds`.
    pub fn new(mut notes: Vec<Note>, seconds: f64) -> Score {
        notes.sort_by_key(|note| note.start);
        let length = (seconds * f64::from(RATE) / BLOCK as f64) as u64;
        Score { notes, length, room: Room::new(), last: ([[0.0; BLOCK]; 2], u64::MAX), level: level::best() }
    }

    /// The same score, evaluated at a SIMD level that this machine has. The level does not change a sample.
    pub fn at_level(self, level: Level) -> Score {
        Score { level, ..self }
    }

    /// The notes by their starts.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Samples from number `first` on: those of the whole, wherever it is cut. Past the end they are 0.
    pub fn samples(&mut self, first: u64, out: &mut [Pair]) {
        let mut number = first;
        let mut rest = out;
        while !rest.is_empty() {
            let (block, skip) = (number / BLOCK as u64, number as usize % BLOCK);
            let count = rest.len().min(BLOCK - skip);
            let (piece, after) = rest.split_at_mut(count);
            let ears = if block < self.length { self.block(block) } else { [[0.0; BLOCK]; 2] };
            for (i, pair) in (skip..).zip(piece) {
                *pair = ears.map(|ear| code(ear[i], number as u32));
                number += 1;
            }
            rest = after;
        }
    }

    /// A block of both ears.
    fn block(&mut self, number: u64) -> [Block; 2] {
        if number == self.last.1 {
            return self.last.0;
        }
        if number != self.last.1.wrapping_add(1) {
            self.room.clear();
            for before in number.saturating_sub(room::REACH)..number {
                let (_, sent) = self.dry(before);
                self.room.send(&sent);
            }
        }
        let (mut ears, sent) = self.dry(number);
        self.room.send(&sent);
        self.room.add(&mut ears);
        self.last = (ears, number);
        ears
    }

    /// A block of the notes alone, and what of them goes to the room.
    fn dry(&self, number: u64) -> ([Block; 2], Block) {
        let (mut ears, mut sent) = ([[0.0; BLOCK]; 2], [0.0; BLOCK]);
        for note in self.notes.iter().take_while(|note| note.start <= number) {
            if number < note.end() {
                dispatch!(self.level, simd => note::add(simd, note, number, &mut ears, &mut sent));
            }
        }
        (ears, sent)
    }
}

/// The 16-bit code of a sample. Dither of two codes' width with triangular density leaves no distortion of quiet sounds
/// `[Lipshitz92]`; silence stays silent.
fn code(x: f32, number: u32) -> i16 {
    if x == 0.0 {
        return 0;
    }
    let random = |n: u32| (pcg(n) >> 8) as f32 * STEP;
    let dither = random(number) - random(number ^ DITHER);
    let code = soft(x * LOUDNESS) * 32_766.0 + dither;
    // Rounded to the nearest: truncated above 0.
    ((code + 32_768.5) as i32 - 32_768) as i16
}

/// A sample that stays within -1 and 1: as it is while it is quiet, and flat at 1.5 times the loudest.
fn soft(x: f32) -> f32 {
    let x = x.clamp(-1.5, 1.5);
    x - x * x * x * (4.0 / 27.0)
}
