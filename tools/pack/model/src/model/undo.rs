//! Going back to an earlier place in the text, for the packer, which compares ways to go on (feature `undo`). The unpacker
//! is without it.

#[cfg(feature = "undo")]
pub use log::Undo;
#[cfg(not(feature = "undo"))]
pub use nothing::Undo;

#[cfg(feature = "undo")]
mod log {
    use super::super::{CONTEXTS, MIXERS, Model};
    use crate::features::Features;
    use crate::mix::{Layer, VECTORS};
    use crate::vector::{Floats, Words};
    use alloc::boxed::Box;
    use alloc::vec::Vec;

    /// What was there before, since the last mark, if there is one.
    pub struct Undo(Option<Box<Log>>);

    /// What is small, as it was at the mark; what is large by the places that changed, in the order in which they did.
    struct Log {
        words: [u32; 6],
        hashes: [u32; CONTEXTS],
        features: Features,
        heads: Vec<(u32, u32)>,
        lines: Vec<(u32, [u32; 16])>,
        cells: Vec<(Words, Words)>,
        first: Vec<(usize, u32, [Floats; VECTORS])>,
        last: Vec<(usize, u32, Floats)>,
    }

    impl Undo {
        /// Without a mark.
        pub const ZERO: Self = Self(None);

        /// The head of a list of matches, before it changes.
        pub fn head(&mut self, at: u32, head: u32) {
            if let Some(log) = &mut self.0 {
                log.heads.push((at, head));
            }
        }

        /// A line that the next four bits may change.
        pub fn line(&mut self, at: u32, line: &[u32; 16]) {
            if let Some(log) = &mut self.0 {
                log.lines.push((at, *line));
            }
        }

        /// Other cells, before they learn.
        pub fn cells(&mut self, at: &[Words], cells: &[Words]) {
            if let Some(log) = &mut self.0 {
                log.cells.extend(at.iter().copied().zip(cells.iter().copied()));
            }
        }

        /// The weights in use, before they learn.
        pub fn weights(&mut self, rows: &Words, first: &Layer, last: &Layer) {
            if let Some(log) = &mut self.0 {
                let row = |layer: &Layer, mixer: usize| layer.weights[mixer][rows[mixer] as usize];
                log.first.extend((0..MIXERS[0]).map(|mixer| (mixer, rows[mixer], row(first, mixer))));
                log.last.extend((0..MIXERS[1]).map(|mixer| (mixer, rows[mixer], row(last, mixer)[0])));
            }
        }
    }

    impl Model {
        /// Marks a place between two bytes, to which [`Self::back_to_mark`] goes back.
        pub fn mark(&mut self) {
            let words = [self.position, self.class, self.match_at, self.match_length, self.predicted, self.place];
            let (hashes, features) = (self.hashes, self.features.clone());
            match &mut self.undo.0 {
                // Memory is kept.
                Some(log) => {
                    (log.words, log.hashes, log.features) = (words, hashes, features);
                    log.heads.clear();
                    log.lines.clear();
                    log.cells.clear();
                    log.first.clear();
                    log.last.clear();
                }
                none => {
                    let (heads, lines, cells, first, last) = Default::default();
                    *none = Some(Box::new(Log { words, hashes, features, heads, lines, cells, first, last }));
                }
            }
        }

        /// Forgets all bytes since the mark, but for what they jump to.
        pub fn back_to_mark(&mut self) {
            let Some(log) = &mut self.undo.0 else { return };
            [self.position, self.class, self.match_at, self.match_length, self.predicted, self.place] = log.words;
            self.hashes = log.hashes;
            self.features = log.features.clone();
            for (at, head) in log.heads.drain(..).rev() {
                self.heads[at as usize] = head;
            }
            let lines = self.cells.0.as_chunks_mut::<16>().0;
            for (at, line) in log.lines.drain(..).rev() {
                lines[at as usize] = line;
            }
            for (at, cells) in log.cells.drain(..).rev() {
                for (at, cell) in at.into_iter().zip(cells) {
                    self.cells.0[at as usize] = cell;
                }
            }
            for (mixer, row, weights) in log.first.drain(..).rev() {
                self.first.weights[mixer][row as usize] = weights;
            }
            for (mixer, row, weights) in log.last.drain(..).rev() {
                self.last.weights[mixer][row as usize][0] = weights;
            }
        }
    }
}

#[cfg(not(feature = "undo"))]
mod nothing {
    use crate::mix::Layer;
    use crate::vector::Words;

    /// Takes no note.
    pub struct Undo;

    impl Undo {
        /// The only one.
        pub const ZERO: Self = Self;

        /// See the packer's.
        #[inline(always)]
        pub fn head(&mut self, _at: u32, _head: u32) {}

        /// See the packer's.
        #[inline(always)]
        pub fn line(&mut self, _at: u32, _line: &[u32; 16]) {}

        /// See the packer's.
        #[inline(always)]
        pub fn cells(&mut self, _at: &[Words], _cells: &[Words]) {}

        /// See the packer's.
        #[inline(always)]
        pub fn weights(&mut self, _rows: &Words, _first: &Layer, _last: &Layer) {}
    }
}
