//! The predictor: the probability of the next bit, given all before.

use crate::features::{Features, hash};
use crate::mix::{Logistic, Vector, dot, train};
use crate::slot;

/// Contexts of a byte, as many as a vector holds. The unpacker's time goes with it.
pub const CONTEXTS: usize = 16;
/// Inputs of a mixer: three vectors of the contexts, one of the match and a constant.
const VECTORS: usize = 4;
/// Their weights at first.
const WEIGHTS: [i16; VECTORS] = [1000, 300, 1300, 1500];
/// Mixers whose results the last ones mix.
const MIXERS: usize = 6;
/// Sets of weights of each, one of which is chosen for each bit.
const ROWS: usize = 2048;
/// Mixers of those results. Their own results are averaged.
const LAST: usize = 3;
/// Slots for four bits of a byte in one context: the first holds a check, the others are a tree of bits.
type Line = [u32; 16];
const LINE_BITS: u32 = 20;
const LINES: u32 = 1 << LINE_BITS;
/// Longest text, in bytes.
pub const MOST: usize = 1 << 22;
/// Bytes that a match must have in common at first.
const MATCH_MIN: u32 = 5;
/// What a mixer's error is scaled by, in 16ths: the first mixers' and the last one's.
const RATES: [i32; 2] = [6, 3];

/// Which features make each context, in code and in data.
pub type Sets = [[u32; CONTEXTS]; 2];

/// The model at work on one text, and all its memory. It starts as zeros; then comes [`Self::start`].
/// What is used most is first, where the unpacker reaches it with short instructions.
#[repr(C)]
pub struct Model {
    /// Bits of the current byte below a leading one.
    partial: u32,
    /// Their number.
    bit: u32,
    /// Bytes coded so far.
    position: u32,
    code: [u32; 3],
    /// 0 while the current byte is an instruction's, 1 while it is not.
    class: u32,
    /// Index in a line of the current bit's slot.
    node: u32,
    match_at: u32,
    match_length: u32,
    /// The byte predicted by the match, with 256 added, or 0.
    predicted: u32,
    match_slot: u32,
    chosen: [u32; MIXERS],
    chosen_last: [u32; LAST],
    place: u32,
    results: [i32; LAST],
    mixed: [Vector; 1],
    inputs: [Vector; VECTORS],
    /// Hashes of the contexts: their top bits are the line, all of them the check.
    hashes: [u32; CONTEXTS],
    /// The lines in use.
    lines: [u32; CONTEXTS],
    sets: Sets,
    features: Features,
    logistic: Logistic,
    weights: [[[Vector; VECTORS]; ROWS]; MIXERS],
    last: [[[Vector; 1]; ROWS]; LAST],
    /// What followed histories, by the place of the byte ([`Self::kind`]).
    histories: [[[u32; 256]; CONTEXTS]; 64],
    matches: [u32; 64],
    heads: [u32; 1 << 16],
    text: [u8; MOST],
    table: [Line; LINES as usize],
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
        match_slot: 0,
        chosen: [0; MIXERS],
        chosen_last: [0; LAST],
        place: 0,
        results: [0; LAST],
        mixed: [[0; 16]; 1],
        inputs: [[0; 16]; VECTORS],
        hashes: [0; CONTEXTS],
        lines: [0; CONTEXTS],
        sets: [[0; CONTEXTS]; 2],
        features: Features::ZERO,
        logistic: Logistic::ZERO,
        weights: [[[[0; 16]; VECTORS]; ROWS]; MIXERS],
        last: [[[[0; 16]; 1]; ROWS]; LAST],
        histories: [[[0; 256]; CONTEXTS]; 64],
        matches: [0; 64],
        heads: [0; 1 << 16],
        text: [0; MOST],
        table: [[0; 16]; LINES as usize],
    };

    /// Makes ready for a text whose bytes from `code[0]` to `code[1]` are instructions, the first of them at the
    /// address `code[2]`. Once, after zeros, where the processor has AVX2.
    /// The text begins with `primer`, instructions that both sides have: they teach, and need not be coded.
    pub fn start(&mut self, sets: &Sets, primer: &[u8], code: [u32; 3]) {
        self.sets = *sets;
        self.code = [0, !0, 0];
        self.partial = 1;
        self.logistic.fill();
        for (i, weights) in self.weights.as_flattened_mut().as_flattened_mut().iter_mut().enumerate() {
            weights.fill(WEIGHTS[i % VECTORS]);
        }
        self.last.as_flattened_mut().as_flattened_mut().as_flattened_mut().fill((16384 / MIXERS) as i16);
        self.contexts();
        for &byte in primer {
            for i in (0..8).rev() {
                self.predict();
                self.update(byte as u32 >> i & 1);
            }
        }
        self.code = code;
        self.features.origin = code[2].wrapping_sub(code[0]);
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
        self.class = !(self.position >= self.code[0] && self.position < self.code[1]) as u32;
        let follows = self.match_length != 0 && self.byte(self.match_at) == self.back(1);
        self.match_at += 1;
        self.match_length += 1;
        let mut h = 0;
        for i in 1..=MATCH_MIN {
            h = hash(h, self.back(i));
        }
        let head = &mut self.heads[(h >> 16) as usize];
        let found = *head;
        *head = self.position;
        if !follows {
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
        self.predicted = 0;
        if self.match_length != 0 {
            self.predicted = self.byte(self.match_at) | 256;
        }
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

    /// Finds the lines of the next four bits.
    #[inline(never)]
    fn look_up(&mut self) {
        // Two loops, so that the processor waits for all lines at once. The first keeps the checks it finds.
        for i in 0..CONTEXTS {
            self.hashes[i] = hash(self.hashes[i], self.partial);
            self.lines[i] = self.table[(self.hashes[i] >> (32 - LINE_BITS)) as usize][0];
        }
        for i in 0..CONTEXTS {
            let check = self.hashes[i];
            let mut at = check >> (32 - LINE_BITS);
            if self.lines[i] != check {
                // The line beside it may be this context's, or know less.
                let other = &self.table[(at ^ 1) as usize];
                if other[0] == check || slot::count(other[1]) < slot::count(self.table[at as usize][1]) {
                    at ^= 1;
                }
                let line = &mut self.table[at as usize];
                if line[0] != check {
                    line.fill(0);
                    line[0] = check;
                }
            }
            self.lines[i] = at;
        }
    }

    /// Probability, in 65536ths, that the next bit is a one. What can be squashed keeps away from 0 and 1.
    #[inline(never)]
    pub fn predict(&mut self) -> u32 {
        if self.bit & 3 == 0 {
            self.look_up();
            self.node = 1;
        }
        let [direct, certain, indirect, more] = &mut self.inputs;
        let histories = &self.histories[self.place as usize & 63];
        let mut known = 0;
        for i in 0..CONTEXTS {
            let slot = self.table[(self.lines[i] & (LINES - 1)) as usize][self.node as usize & 15];
            let (p, n) = (slot::probability(slot), slot::count(slot));
            known += (n != 0) as u32;
            direct[i] = self.logistic.stretch(p);
            certain[i] = (((p - 0x8000) * n.min(12)) >> 9) as i16;
            indirect[i] = self.logistic.stretch(slot::probability(histories[i][slot::history(slot)]));
        }
        self.match_slot = 0;
        if self.predicted << self.bit >> 8 == self.partial {
            self.match_slot = self.match_length.min(31) * 2 + (self.predicted << self.bit >> 7 & 1);
        }
        // Slot 0 never learns, so it is even odds.
        more[0] = self.logistic.stretch(slot::probability(self.matches[self.match_slot as usize & 63]));
        more[1] = 1024;
        more[2] = if self.match_length > 9 { more[0] } else { 0 };
        let (f, class) = (&self.features.f, self.class << 8);
        self.chosen = [
            self.partial | self.predicted & 256,
            self.place | self.bit << 6,
            f[0] | class,
            known | self.place << 5,
            f[6] & 127 | self.bit << 7 | class << 2,
            // The opcode, before it is known the last instruction's.
            if class != 0 {
                f[29]
            } else if f[8] != 0 {
                f[8] & 1023
            } else {
                f[12] & 1023 | 1024
            },
        ];
        self.chosen_last = [self.chosen[1], self.chosen[MIXERS - 1], f[0] | class];
        for ((mixed, &row), weights) in self.mixed[0].iter_mut().zip(&self.chosen).zip(&self.weights) {
            *mixed = dot(&self.inputs, &weights[row as usize & (ROWS - 1)]) as i16;
        }
        for ((result, &row), last) in self.results.iter_mut().zip(&self.chosen_last).zip(&self.last) {
            *result = dot(&self.mixed, &last[row as usize & (ROWS - 1)]);
        }
        self.logistic.squash(self.results.iter().sum::<i32>() / LAST as i32) as u32
    }

    /// Learns the bit.
    #[inline(never)]
    pub fn update(&mut self, bit: u32) {
        let target = (bit << 16) as i32;
        for ((&mixed, &row), weights) in self.mixed[0].iter().zip(&self.chosen).zip(&mut self.weights) {
            let error = ((target - self.logistic.squash(mixed as i32)) * RATES[0]) >> 4;
            train(&self.inputs, &mut weights[row as usize & (ROWS - 1)], error);
        }
        for ((&result, &row), last) in self.results.iter().zip(&self.chosen_last).zip(&mut self.last) {
            let error = ((target - self.logistic.squash(result)) * RATES[1]) >> 4;
            train(&self.mixed, &mut last[row as usize & (ROWS - 1)], error);
        }
        for i in 0..CONTEXTS {
            let slot = &mut self.table[(self.lines[i] & (LINES - 1)) as usize][self.node as usize & 15];
            slot::update(&mut self.histories[self.place as usize & 63][i][slot::history(*slot)], bit);
            slot::update(slot, bit);
        }
        if self.match_slot != 0 {
            slot::update(&mut self.matches[self.match_slot as usize & 63], bit);
        }
        self.partial = self.partial << 1 | bit;
        self.node = self.node << 1 | bit;
        self.bit += 1;
        if self.bit == 8 {
            let byte = self.partial as u8;
            (self.partial, self.bit) = (1, 0);
            self.text[self.position as usize & (MOST - 1)] = byte;
            self.position += 1;
            let code = self.class == 0;
            self.features.push(byte, self.position, code);
            self.contexts();
        }
    }

    /// Bytes known so far, with the primer.
    pub fn position(&self) -> usize {
        self.position as usize
    }

    /// The primer and what was coded so far, zeros behind.
    pub fn text(&mut self) -> &mut [u8; MOST] {
        &mut self.text
    }

    /// What the model takes the next byte for: in code its field ([`crate::parse`]), with 16 added in relative
    /// numbers and after them; in data 32 or more.
    pub fn kind(&self) -> u32 {
        self.place
    }
}
