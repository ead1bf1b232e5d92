//! A score, and its samples from any number on.

use super::note::{Note, add};
use super::room::{REACH, Room};
use super::samples::{Pair, RATE, code};
use crate::simd::block::BLOCK;
use crate::simd::level;
use fearless_simd::{Level, dispatch};
use std::array::from_fn;

/// Notes, and how they sound where they are played.
#[derive(Clone, Debug)]
pub struct Score {
    notes: Vec<Note>,
    /// The number of blocks until the last note has ended.
    length: u32,
    room: Room,
    /// The block that the room has heard all up to.
    next: u32,
    /// The number of the block that [`Score::samples`] took last, and its samples.
    last: Option<(u32, [Pair; BLOCK])>,
    level: Level,
}

impl Score {
    /// A score of these notes, in any order, that ends after `seconds`.
    pub fn new(notes: Vec<Note>, seconds: f64) -> Score {
        let length = (seconds * f64::from(RATE) / BLOCK as f64) as u32;
        Score { notes, length, room: Room::new(), next: 0, last: None, level: level::best() }
    }

    /// The same score, evaluated at a SIMD level that this machine has. The level does not change a sample.
    pub fn at_level(self, level: Level) -> Score {
        Score { level, ..self }
    }

    /// The notes.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// Samples from number `first` on: those of the whole, wherever it is cut. Past the end they are 0.
    pub fn samples(&mut self, first: u64, out: &mut [Pair]) {
        for (number, pair) in (first..).zip(out) {
            // Beyond what blocks are counted to there is nothing, either.
            let block = u32::try_from(number / BLOCK as u64).unwrap_or(u32::MAX);
            if self.last.as_ref().is_none_or(|last| last.0 != block) {
                self.last = Some((block, self.block(block)));
            }
            *pair = self.last.as_ref().map_or([0; 2], |last| last.1[number as usize % BLOCK]);
        }
    }

    /// The samples of a block; past the end they are 0.
    pub fn block(&mut self, number: u32) -> [Pair; BLOCK] {
        if number >= self.length {
            return [[0; 2]; BLOCK];
        }
        // After a jump the room has to hear what came before. Before the first block no note plays.
        let mut at = if number == self.next { number } else { number.wrapping_sub(REACH) };
        loop {
            let (mut ears, mut sent) = ([[0.0; BLOCK]; 2], [0.0; BLOCK]);
            for note in &self.notes {
                if note.start <= at && at < note.end {
                    dispatch!(self.level, simd => add(simd, note, at, &mut ears, &mut sent));
                }
            }
            self.room.play(at, &sent, &mut ears);
            at = at.wrapping_add(1);
            if at == number.wrapping_add(1) {
                self.next = at;
                return from_fn(|i| ears.map(|ear| code(ear[i], number * BLOCK as u32 + i as u32)));
            }
        }
    }
}
