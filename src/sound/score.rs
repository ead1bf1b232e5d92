//! A score, and its samples from any number on.

use super::note::{Note, add};
use super::room::{REACH, Room};
use super::samples::{Block, Pair, RATE, code};
use crate::simd::block::BLOCK;
use crate::simd::level;
use fearless_simd::{Level, dispatch};

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
            for before in number.saturating_sub(REACH)..number {
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
                dispatch!(self.level, simd => add(simd, note, number, &mut ears, &mut sent));
            }
        }
        (ears, sent)
    }
}
