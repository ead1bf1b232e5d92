//! The predictor: the probability of the next bit, given all before.

use crate::features::{Features, hash};
use crate::mix::{Logistic, Weights, all, dot, train};
use crate::slot;

/// Contexts a byte.
pub const CONTEXTS: usize = 15;
/// Inputs of a mixer: two a context, the match, a constant.
const INPUTS: usize = 2 * CONTEXTS + 2;
/// Vectors of inputs.
const VECTORS: usize = INPUTS / 8;
/// Mixers whose results the last one mixes.
const MIXERS: usize = 3;
/// Slots that four bits of a byte in one context need: the first holds a check, the others a tree of bits.
pub type Line = [u32; 16];
/// Lines of the table: 64 MB.
pub const LINES: usize = 1 << LINE_BITS;
const LINE_BITS: u32 = 20;
/// Longest input, in bytes.
pub const MOST: usize = 1 << 22;
/// Bytes that a match must have in common at first.
const MATCH_MIN: usize = 5;

/// Which features make each context, in code and in data.
pub type Sets = [[u32; CONTEXTS]; 2];

/// All that the model remembers besides its table and the text. It starts as zeros.
pub struct State {
    features: Features,
    logistic: Logistic,
    weights: [[[Weights; VECTORS]; 512]; MIXERS],
    last: [[Weights; 1]; 256],
    histories: [[[u32; 256]; CONTEXTS]; 2],
    matches: [u32; 256],
    corrections: [[u32; 32]; 2048],
    heads: [u32; 1 << 16],
    bases: [u32; CONTEXTS],
    lines: [usize; CONTEXTS],
    inputs: [[i16; 8]; VECTORS],
    mixed: [[i16; 8]; 1],
}

impl State {
    /// The state before the first bit.
    pub const ZERO: Self = Self {
        features: Features::ZERO,
        logistic: Logistic::ZERO,
        weights: [[[[0; 2]; VECTORS]; 512]; MIXERS],
        last: [[[0; 2]; 1]; 256],
        histories: [[[0; 256]; CONTEXTS]; 2],
        matches: [0; 256],
        corrections: [[0; 32]; 2048],
        heads: [0; 1 << 16],
        bases: [0; CONTEXTS],
        lines: [0; CONTEXTS],
        inputs: [[0; 8]; VECTORS],
        mixed: [[0; 8]; 1],
    };
}

/// The model at work on one text.
pub struct Model<'a> {
    sets: &'a Sets,
    table: &'a mut [Line; LINES],
    /// What was coded so far, zeros behind.
    text: &'a mut [u8; MOST],
    s: &'a mut State,
    code: (usize, usize),
    /// Bytes coded so far.
    position: usize,
    /// Bits of the current byte below a leading one.
    partial: usize,
    /// Their number.
    bit: u32,
    match_at: usize,
    match_length: usize,
    /// The byte predicted by the match, with 256 added, or 0.
    predicted: usize,
    chosen: [usize; MIXERS],
    place: usize,
    match_slot: usize,
    correction: [usize; 2],
    probability: i32,
}

impl<'a> Model<'a> {
    /// A model for a text whose bytes from `code.0` to `code.1` are instructions. All memory must be zeros.
    pub fn new(
        sets: &'a Sets,
        table: &'a mut [Line; LINES],
        text: &'a mut [u8; MOST],
        s: &'a mut State,
        code: (usize, usize),
    ) -> Self {
        s.logistic.fill();
        s.weights.as_flattened_mut().as_flattened_mut().fill(all(4000));
        s.last.as_flattened_mut().fill(all((16384 / MIXERS) as i16));
        for row in &mut s.corrections {
            for (i, c) in row.iter_mut().enumerate() {
                *c = slot::with(s.logistic.squash((i as i32 * 128 - 1984).clamp(-2047, 2047)), 0);
            }
        }
        let mut model = Self {
            sets,
            table,
            text,
            s,
            code,
            position: 0,
            partial: 1,
            bit: 0,
            match_at: 0,
            match_length: 0,
            predicted: 0,
            chosen: [0; MIXERS],
            place: 0,
            match_slot: 0,
            correction: [0; 2],
            probability: 0,
        };
        model.contexts();
        model
    }

    fn is_code(&self) -> bool {
        self.position >= self.code.0 && self.position < self.code.1
    }

    fn byte(&self, at: usize) -> usize {
        self.text[at & (MOST - 1)] as usize
    }

    /// Follows or looks up the match and hashes the contexts of the next byte.
    fn contexts(&mut self) {
        if self.match_length != 0 && self.byte(self.match_at) == self.byte(self.position.wrapping_sub(1)) {
            self.match_length += 1;
            self.match_at += 1;
        } else {
            self.match_length = 0;
        }
        let mut h = 0;
        for i in 1..=MATCH_MIN {
            h = hash(h, self.byte(self.position.wrapping_sub(i)) as u32);
        }
        let head = &mut self.s.heads[(h >> 16) as usize];
        let found = *head as usize;
        *head = self.position as u32;
        if self.match_length == 0 && found != 0 {
            self.match_at = found;
            while self.match_length < 32
                && self.byte(found.wrapping_sub(self.match_length + 1))
                    == self.byte(self.position.wrapping_sub(self.match_length + 1))
            {
                self.match_length += 1;
            }
        }
        self.predicted = 0;
        if self.match_length != 0 {
            self.predicted = self.byte(self.match_at) | 256;
        }
        let features = &mut self.s.features;
        features.f[30] = self.predicted as u32;
        self.place = features.place();
        let class = !self.is_code() as usize;
        for (i, (&set, base)) in self.sets[class].iter().zip(&mut self.s.bases).enumerate() {
            let mut h = (i + 64 * class) as u32;
            let mut rest = set;
            while rest != 0 {
                let j = rest.trailing_zeros();
                rest &= rest - 1;
                h = hash(h, self.s.features.f[j as usize & 31].wrapping_add(j << 24));
            }
            *base = h;
        }
    }

    /// Finds the lines of the next four bits.
    fn look_up(&mut self) {
        let s = &mut *self.s;
        // Two loops, so that the processor waits for all lines at once.
        let mut found = [0; CONTEXTS];
        for ((base, line), found) in s.bases.iter_mut().zip(&mut s.lines).zip(&mut found) {
            *base = hash(*base, self.partial as u32);
            *line = (*base >> (32 - LINE_BITS)) as usize;
            *found = self.table[*line & (LINES - 1)][0];
        }
        for ((&check, &line), &found) in s.bases.iter().zip(&s.lines).zip(&found) {
            if found != check {
                let line = &mut self.table[line & (LINES - 1)];
                *line = [0; 16];
                line[0] = check;
            }
        }
    }

    /// Index in its line of the current bit's slot.
    fn node(&self) -> usize {
        let bit = self.bit & 3;
        self.partial & ((1 << bit) - 1) | 1 << bit
    }

    /// Probability, in 65536ths, that the next bit is a one.
    pub fn predict(&mut self) -> u32 {
        let bit = self.bit;
        if bit & 3 == 0 {
            self.look_up();
        }
        let node = self.node();
        let class = !self.is_code() as usize;
        let s = &mut *self.s;
        let inputs = s.inputs.as_flattened_mut();
        for (i, line) in s.lines.iter().enumerate() {
            let direct = self.table[line & (LINES - 1)][node & 15];
            let indirect = s.histories[class & 1][i][slot::history(direct)];
            inputs[2 * i] = s.logistic.stretch(slot::probability(direct));
            inputs[2 * i + 1] = s.logistic.stretch(slot::probability(indirect));
        }
        let mut length = 0;
        self.match_slot = 0;
        inputs[INPUTS - 2] = 0;
        inputs[INPUTS - 1] = 256;
        if self.predicted >> (8 - bit & 15) == self.partial {
            length = if self.match_length < 16 { self.match_length } else { (self.match_length / 8 + 14).min(23) };
            self.match_slot = length * 2 + (self.predicted >> (7 - bit & 15) & 1);
            inputs[INPUTS - 2] = s.logistic.stretch(slot::probability(s.matches[self.match_slot & 255]));
        }
        self.chosen = [self.partial | class << 8, self.place | class << 7, length | (bit as usize) << 5];
        for ((mixed, &row), weights) in s.mixed[0].iter_mut().zip(&self.chosen).zip(&s.weights) {
            *mixed = dot(&s.inputs, &weights[row & 511]) as i16;
        }
        let last = dot(&s.mixed, &s.last[(self.place | class << 7) & 255]);
        self.probability = s.logistic.squash(last);
        let p = self.probability;
        p.clamp(16, 65535 - 16) as u32
    }

    /// Learns the bit.
    pub fn update(&mut self, bit: u32) {
        let node = self.node();
        let class = !self.is_code() as usize;
        let s = &mut *self.s;
        let target = (bit << 16) as i32;
        for ((&mixed, &row), weights) in s.mixed[0].iter().zip(&self.chosen).zip(&mut s.weights) {
            let error = (target - s.logistic.squash(mixed as i32)) * 6 >> 4;
            train(&s.inputs, &mut weights[row & 511], error);
        }
        train(&s.mixed, &mut s.last[(self.place | class << 7) & 255], (target - self.probability) * 3 >> 4);
        for (i, line) in s.lines.iter().enumerate() {
            let direct = &mut self.table[line & (LINES - 1)][node & 15];
            slot::update(&mut s.histories[class & 1][i][slot::history(*direct)], bit);
            slot::update(direct, bit);
        }
        if self.match_slot != 0 {
            slot::update(&mut s.matches[self.match_slot & 255], bit);
        }
        self.partial = self.partial << 1 | bit as usize;
        self.bit += 1;
        if self.bit == 8 {
            let byte = self.partial as u8;
            (self.partial, self.bit) = (1, 0);
            self.text[self.position & (MOST - 1)] = byte;
            self.position += 1;
            let code = self.is_code();
            self.s.features.push(byte, self.position, code);
            self.contexts();
        }
    }

    /// Bytes coded so far.
    pub fn position(&self) -> usize {
        self.position
    }

    /// Name-free number of the kind of the next byte, below 256, for statistics.
    pub fn kind(&self) -> usize {
        self.place | (!self.is_code() as usize) << 7
    }
}
