//! The predictor: the probability of the next bit, given all before.

#![allow(unsafe_code)]

mod undo;

use crate::features::{self, Features, Targets, hash};
use crate::mix::{Mixers, stretch};
use crate::slot;
use crate::vector::{Words, gather, put_floats, put_words, scatter, words};
use core::arch::x86_64::*;
use undo::Undo;

/// Contexts of a byte, in groups of eight. The unpacker's time goes with it.
pub const CONTEXTS: usize = 8 * GROUPS;
const GROUPS: usize = 2;
/// Groups of slots: those of the contexts, those of their histories, and a last one that needs no hash.
const SLOTS: usize = 2 * GROUPS + 1;
/// The mixers learn nothing from errors up to this, in 65536ths, which are half of all: a tenth of the time.
const LEAST_ERROR: u32 = 512;
/// Longest text, in bytes.
pub const MOST: usize = 1 << 22;
/// Bytes that a match must have in common at first.
const MATCH_MIN: u32 = 5;
/// Lines of sixteen cells, slots for four bits of a byte in one context: the first cell holds a check, the others are a tree
/// of bits.
const LINE_BITS: u32 = 20;
/// The cells behind them: what followed histories, by the place of the byte ([`Model::kind`]) and its half, then the last group.
const HISTORIES: u32 = 16 << LINE_BITS;
const OTHERS: u32 = HISTORIES + 64 * 256 * CONTEXTS as u32;
const CELLS: usize = OTHERS as usize + (1 << 16);

/// The cells, each of whose lines is a line of the processor's cache too.
#[repr(align(64))]
struct Cells([u32; CELLS]);

/// Which features make each context, in code and in data.
pub type Sets = [[u32; CONTEXTS]; 2];

/// The model at work on one text, and all its memory. It starts as zeros; then comes [`Self::start`].
/// What is used most is first, where the unpacker reaches it with short instructions. Eight words come before the vectors, so
/// that none of them lies in two lines of the processor's cache; that, and cells in such lines, saves a seventh of the time.
#[repr(C)]
pub struct Model {
    /// Bits of the current byte below a leading one.
    partial: u32,
    /// Their number.
    bit: u32,
    /// Bytes coded so far.
    position: u32,
    /// 0 while the current byte is an instruction's, 1 while it is not.
    class: u32,
    /// Index in a line of the current bit's slot.
    node: u32,
    place: u32,
    /// The byte predicted by the match, with 256 added, or 0.
    predicted: u32,
    /// The probability of the current bit.
    p: u32,
    /// The slots of the current bit, and where they are. What is not used of the last group is the first line's check, which
    /// spoils that line: 7 bytes less than places of their own.
    slots: [Words; SLOTS],
    at: [Words; SLOTS],
    /// Hashes of the contexts: their top bits are the line, all of them the check.
    hashes: [u32; CONTEXTS],
    /// Where the lines in use start.
    lines: [Words; GROUPS],
    /// Where the histories of each context are.
    bases: [Words; GROUPS],
    /// The weights that each mixer uses.
    rows: Words,
    /// Where the instructions start and end, and the first one's address.
    pub code: [u32; 3],
    match_at: u32,
    match_length: u32,
    sets: Sets,
    features: Features,
    mixers: Mixers,
    heads: [u32; 1 << 16],
    targets: Targets,
    text: [u8; MOST],
    cells: Cells,
    undo: Undo,
}

impl Model {
    /// Before the first bit and before [`Self::start`].
    pub const ZERO: Self = Self {
        partial: 0,
        bit: 0,
        position: 0,
        code: [0; 3],
        class: 0,
        node: 0,
        match_at: 0,
        match_length: 0,
        predicted: 0,
        place: 0,
        p: 0,
        slots: [[0; 8]; SLOTS],
        at: [[0; 8]; SLOTS],
        hashes: [0; CONTEXTS],
        lines: [[0; 8]; GROUPS],
        bases: [[0; 8]; GROUPS],
        rows: [0; 8],
        sets: [[0; CONTEXTS]; 2],
        features: Features::ZERO,
        mixers: Mixers::ZERO,
        heads: [0; 1 << 16],
        targets: [false; MOST],
        text: [0; MOST],
        cells: Cells([0; CELLS]),
        undo: Undo::ZERO,
    };

    /// Makes ready for a text whose bytes from `code[0]` to `code[1]` are instructions, the first of them at the
    /// address `code[2]`. Once, after zeros, where the processor has AVX2 and FMA.
    pub fn start(&mut self, sets: &Sets, code: [u32; 3]) {
        self.sets = *sets;
        self.code = code;
        self.features.origin = code[2].wrapping_sub(code[0]);
        self.partial = 1;
        for (i, base) in self.bases.as_flattened_mut().iter_mut().enumerate() {
            *base = HISTORIES + 256 * i as u32;
        }
        self.mixers.start();
        self.contexts();
    }

    fn byte(&self, at: u32) -> u32 {
        self.text[at as usize & (MOST - 1)] as u32
    }

    /// The `n`th byte before the current one; zeros precede the text.
    fn back(&self, n: u32) -> u32 {
        self.byte(self.position.wrapping_sub(n))
    }

    /// Follows or looks up the match and hashes the contexts of the next byte.
    fn contexts(&mut self) {
        let (at, [start, end, _]) = (self.position, self.code);
        self.class = !(at >= start && at < end) as u32;
        let mut h = 0;
        // Here and below in the forms that take the fewest bytes: an inclusive range asks twice whether it is at its end.
        for i in 1..MATCH_MIN + 1 {
            h = hash(h, self.back(i));
        }
        let head = &mut self.heads[(h >> 16) as usize];
        let found = *head;
        self.undo.head(h >> 16, found);
        *head = self.position;
        if self.match_length != 0 && self.byte(self.match_at) == self.back(1) {
            self.match_at += 1;
            self.match_length += 1;
        } else {
            self.match_at = found;
            self.match_length = 0;
            // Position 0 would match itself.
            while found != 0
                && self.match_length < 32
                && self.byte(found.wrapping_sub(self.match_length + 1)) == self.back(self.match_length + 1)
            {
                self.match_length += 1;
            }
        }
        self.predicted = if self.match_length != 0 { self.byte(self.match_at) | 256 } else { 0 };
        self.features.f[30] = self.predicted;
        self.place = self.features.place(self.class == 0) | self.class << 5;
        for (i, (&set, h)) in self.sets[self.class as usize & 1].iter().zip(&mut self.hashes).enumerate() {
            *h = i as u32 | self.class << 6;
            let mut rest = set;
            while rest != 0 {
                let j = rest.trailing_zeros();
                rest &= rest - 1;
                *h = hash(*h, self.features.f[j as usize & 31].wrapping_add(j << 24));
            }
        }
    }

    /// Takes the byte's bits so far into the hashes, and has the lines of the next four fetched while the model still learns
    /// from the last one: a fourteenth of the time. Those beside them are looked at too where they are another context's: a
    /// twentieth.
    fn fetch(&mut self) {
        let cells = self.cells.0.as_chunks::<16>().0;
        for hash in &mut self.hashes {
            *hash = features::hash(*hash, self.partial);
            let at = (*hash >> (32 - LINE_BITS)) as usize;
            // SAFETY: nothing is read.
            unsafe {
                _mm_prefetch::<_MM_HINT_T0>((&raw const cells[at]).cast());
                _mm_prefetch::<_MM_HINT_T0>((&raw const cells[at ^ 1]).cast());
            }
        }
    }

    /// Finds the lines of the next four bits.
    #[target_feature(enable = "avx2,fma")]
    #[inline(never)]
    fn look_up(&mut self) {
        let (lines, (cells, _)) = (self.lines.as_flattened_mut(), self.cells.0.as_chunks_mut::<16>());
        for (&check, line) in self.hashes.iter().zip(lines) {
            let mut at = check >> (32 - LINE_BITS);
            if cells[at as usize][0] != check {
                // The line beside it may be this context's, or know less.
                let other = &cells[at as usize ^ 1];
                if other[0] == check || slot::count(other[1]) < slot::count(cells[at as usize][1]) {
                    at ^= 1;
                }
            }
            let cells = &mut cells[at as usize];
            self.undo.line(at, cells);
            if cells[0] != check {
                for half in cells.as_chunks_mut::<8>().0 {
                    put_words(_mm256_setzero_si256(), half);
                }
                cells[0] = check;
            }
            *line = at * 16;
        }
    }

    /// Probability, in 65536ths, that the next bit is a one: neither 0 nor 65536.
    pub fn predict(&mut self) -> u32 {
        // SAFETY: whoever starts a model has seen that the processor has AVX2 and FMA, and with them POPCNT.
        unsafe { self.predict_avx2() }
    }

    /// Learns the bit, which by then is behind: what is needed of it was kept.
    pub fn update(&mut self, bit: u32) {
        self.step(bit);
        // SAFETY: as above.
        unsafe { self.update_avx2(bit) };
    }

    #[target_feature(enable = "avx2,fma,popcnt")]
    #[inline(never)]
    fn predict_avx2(&mut self) -> u32 {
        if self.bit & 3 == 0 {
            self.look_up();
            self.node = 1;
        }
        let [matched, long, order0, ..] = &mut self.at[2 * GROUPS];
        (*matched, *long) = (OTHERS, OTHERS);
        if self.predicted << self.bit >> 8 == self.partial {
            *matched += self.match_length.min(31) * 2 + (self.predicted << self.bit >> 7 & 1);
            if self.match_length > 9 {
                *long = *matched + 64;
            }
        }
        *order0 = (OTHERS + 128) + (self.partial | self.place << 8);

        let mut known = 0;
        for i in 0..SLOTS {
            if i < GROUPS {
                let at = _mm256_or_si256(words(&self.lines[i]), _mm256_set1_epi32(self.node as i32));
                put_words(at, &mut self.at[i]);
            }
            // SAFETY: all are within: `look_up` has taken the lines' numbers from LINE_BITS bits, `node` is below 16, the
            // place and its half are below 64, a history is of eight bits, and the last group is just above, or 0 where it is
            // not used.
            let slots = unsafe { gather(&self.cells.0, &self.at[i]) };
            let p = slot::centred(slots);
            put_words(slots, &mut self.slots[i]);
            put_floats(stretch(p), &mut self.mixers.inputs[i]);
            if i < GROUPS {
                let n = slot::counts(slots);
                let unseen = _mm256_castsi256_ps(_mm256_cmpeq_epi32(n, _mm256_setzero_si256()));
                known += 8 - _mm256_movemask_ps(unseen).count_ones();
                let linear = _mm256_mullo_epi32(p, _mm256_min_epi32(n, _mm256_set1_epi32(20)));
                put_floats(_mm256_cvtepi32_ps(_mm256_slli_epi32::<5>(linear)), &mut self.mixers.inputs[SLOTS + i]);
                let place =
                    _mm256_set1_epi32(((self.place & 31 | (self.bit & 4) << 3) * (256 * CONTEXTS) as u32) as i32);
                let at = _mm256_add_epi32(_mm256_add_epi32(slot::histories(slots), words(&self.bases[i])), place);
                put_words(at, &mut self.at[GROUPS + i]);
            }
        }

        let (f, class) = (&self.features.f, self.class << 8);
        // Each mixer has 2048.
        self.rows = [
            // The opcode, before it is known the last instruction's.
            if class != 0 {
                f[29]
            } else if f[8] != 0 {
                f[8] & 1023
            } else {
                f[12] & 1023 | 1024
            },
            self.place | self.bit << 6 | (self.predicted & 256) << 1 | 1 << 11,
            f[0] | class | 2 << 11,
            self.partial | (self.place & 7) << 8 | 3 << 11,
            known | self.place << 5 | 4 << 11,
            f[6] & 127 | self.bit << 7 | class << 2 | 5 << 11,
            f[12] & 1023 | (self.bit & 4) << 8 | 6 << 11,
            f[1] | (self.place & 7) << 8 | 7 << 11,
        ];
        self.mixers.mix(&self.rows);
        // Truncated, 1 to 65535, as what is squashed is clamped.
        self.p = _mm_cvttss_si32(_mm_set_ss(self.mixers.result[0] * 65536.0)) as u32;
        self.p
    }

    #[target_feature(enable = "avx2,fma")]
    fn update_avx2(&mut self, bit: u32) {
        if (bit << 16).abs_diff(self.p) > LEAST_ERROR {
            self.undo.weights(&self.rows, &self.mixers);
            self.mixers.learn(&self.rows, bit);
        }
        self.undo.cells(&self.at[GROUPS..], &self.slots[GROUPS..]);
        for (slots, at) in self.slots.iter().zip(&self.at) {
            // SAFETY: they were read from there.
            unsafe { scatter(slot::learned(words(slots), bit), &mut self.cells.0, at) };
        }
    }

    /// Goes on to the next bit, and after eight to the next byte.
    fn step(&mut self, bit: u32) {
        self.partial = self.partial << 1 | bit;
        self.node = self.node << 1 | bit;
        self.bit += 1;
        if self.bit == 8 {
            let byte = self.partial as u8;
            (self.partial, self.bit) = (1, 0);
            self.text[self.position as usize & (MOST - 1)] = byte;
            self.position += 1;
            let code = self.class == 0;
            self.features.push(byte, self.position, code, &mut self.targets);
            self.contexts();
        }
        if self.bit & 3 == 0 {
            self.fetch();
        }
    }

    /// Bytes coded so far.
    pub fn position(&self) -> usize {
        self.position as usize
    }

    /// What was coded so far, zeros behind.
    pub fn text(&mut self) -> &mut [u8; MOST] {
        &mut self.text
    }

    /// What the model takes the next byte for: in code its field ([`crate::parse`]), with 16 added in relative
    /// numbers and after them; in data 32 or more.
    pub fn kind(&self) -> u32 {
        self.place
    }
}
