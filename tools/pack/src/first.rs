//! Codes the second stage of the unpacker for the first one (`stub/src/first.s`), which must be small above all:
//! each context counts zeros and ones, and the sums of all counts, those of longer contexts weighing more, are the
//! odds (as in Mentor's Crinkler, after Mahoney's PAQ1). 5.6 kB take 3.3 and 311 bytes of decoder.
//!
//! Tried: twice the weight for a context that has seen one kind of bit only, 0.5 % less but for 10 bytes of decoder;
//! halved counts rounded down, 5 % more; products of odds instead of sums, 1 % more; a quarter of the table, 2 % more;
//! LZMA without a header, 10 % more; the full model, 14 % less, but its 4 kB would have to come first.

use crate::encoder::Encoder;
use crate::rewrite::search::Price;
use pack_model::first::{CONTEXTS, MULTIPLIER, PRIOR, TABLE_BITS};
use std::array;

/// The hash of the bits so far below a leading one and of those bytes before that the first of `contexts` names, and the
/// weight of their counts. All of `contexts`, those that come after it too, tell it from others.
fn hash(contexts: u64, partial: usize, before: &[u8]) -> (u32, u32) {
    let step = |h: u32, byte: u32| (h ^ byte).wrapping_mul(MULTIPLIER);
    let named = (0..8usize).filter(|i| contexts << i & 128 != 0);
    let byte = |i| before.len().checked_sub(i + 1).map_or(0, |at| before[at] as u32);
    let start = (step(contexts as u32, partial as u32), 3);
    named.fold(start, |(h, weight), i| (step(h, byte(i)), 3 * weight))
}

/// The model: counts of zeros and ones in each context, and what has been coded.
pub struct Counts {
    pairs: Vec<[u16; 2]>,
    text: Vec<u8>,
    /// Pairs as they were before each change since the first mark.
    undo: Vec<(usize, [u16; 2])>,
    /// The lengths of that and of the text at each mark.
    marks: Vec<[usize; 2]>,
}

impl Default for Counts {
    fn default() -> Self {
        Self { pairs: vec![[0; 2]; 1 << TABLE_BITS], text: Vec::new(), undo: Vec::new(), marks: Vec::new() }
    }
}

impl Counts {
    /// Learns a byte; gives `each` bit with the odds of a zero against a one.
    fn learn(&mut self, byte: u8, mut each: impl FnMut(bool, [u32; 2])) {
        let mut partial = 1;
        for i in (0..8).rev() {
            let bit = (byte >> i & 1) as usize;
            let found: [_; 8] = array::from_fn(|i| hash(CONTEXTS >> (8 * i), partial, &self.text));
            let mut sums = [PRIOR; 2];
            for (hash, weight) in found {
                let pair = self.pairs[(hash >> (32 - TABLE_BITS)) as usize];
                sums = [0, 1].map(|i| sums[i] + pair[i] as u32 * weight);
            }
            each(bit == 1, sums);
            // As the decoder does, from the last context to the first, some of which may share a pair.
            for (hash, _) in found.into_iter().rev() {
                let at = (hash >> (32 - TABLE_BITS)) as usize;
                let pair = &mut self.pairs[at];
                if !self.marks.is_empty() {
                    self.undo.push((at, *pair));
                }
                pair[bit] += 1;
                pair[1 - bit] = pair[1 - bit].div_ceil(2);
            }
            partial = partial << 1 | bit;
        }
        self.text.push(byte);
    }
}

impl Price for Counts {
    fn mark(&mut self) {
        self.marks.push([self.undo.len(), self.text.len()]);
    }

    fn back_to_mark(&mut self) {
        let Some(&[changes, length]) = self.marks.last() else { return };
        for (at, pair) in self.undo.drain(changes..).rev() {
            self.pairs[at] = pair;
        }
        self.text.truncate(length);
    }

    fn unmark(&mut self) {
        self.marks.pop();
        if self.marks.is_empty() {
            self.undo.clear();
        }
    }

    fn price(&mut self, bytes: impl Iterator<Item = u8>) -> f64 {
        let mut bits = 0.0;
        for byte in bytes {
            self.learn(byte, |bit, odds| bits -= (odds[bit as usize] as f64 / (odds[0] + odds[1]) as f64).log2());
        }
        bits
    }
}

/// Codes `text`.
pub fn compress(text: &[u8]) -> Vec<u8> {
    let (mut counts, mut encoder) = (Counts::default(), Encoder::default());
    for &byte in text {
        counts.learn(byte, |bit, odds| encoder.encode(bit, odds));
    }
    encoder.finish()
}
