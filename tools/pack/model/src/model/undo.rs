//! Going back to an earlier place in the text, for the packer, which compares ways to go on (feature `undo`). The unpacker
//! is without it.

#[cfg(feature = "undo")]
pub use log::Undo;
#[cfg(not(feature = "undo"))]
pub use nothing::Undo;

#[cfg(feature = "undo")]
mod log {
    use super::super::{CONTEXTS, Model};
    use crate::features::Features;
    use crate::mix::{Mixers, Weights};
    use crate::vector::Words;
    use alloc::boxed::Box;
    use alloc::vec::Vec;

    /// What was there before, since the first mark, if there is one.
    pub struct Undo(Option<Box<Log>>);

    /// What is large, by the places that changed, in the order in which they did.
    #[derive(Default)]
    struct Log {
        marks: Vec<Mark>,
        heads: Vec<(u32, u32)>,
        lines: Vec<(u32, [u32; 16])>,
        cells: Vec<(Words, Words)>,
        weights: Vec<(u32, Weights)>,
    }

    /// What is small, as it was at a mark, and the lengths of the lists of a [`Log`].
    struct Mark {
        words: [u32; 6],
        hashes: [u32; CONTEXTS],
        features: Features,
        lengths: [usize; 4],
    }

    impl Log {
        fn lengths(&self) -> [usize; 4] {
            [self.heads.len(), self.lines.len(), self.cells.len(), self.weights.len()]
        }
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
        pub fn weights(&mut self, rows: &Words, mixers: &Mixers) {
            if let Some(log) = &mut self.0 {
                log.weights.extend(rows.map(|row| (row, mixers.weights[row as usize])));
            }
        }
    }

    impl Model {
        /// Marks a place between two bytes, to which [`Self::back_to_mark`] goes back.
        pub fn mark(&mut self) {
            let words = [self.position, self.class, self.match_at, self.match_length, self.predicted, self.place];
            let (hashes, features) = (self.hashes, self.features.clone());
            let log = self.undo.0.get_or_insert_default();
            let lengths = log.lengths();
            log.marks.push(Mark { words, hashes, features, lengths });
        }

        /// Forgets all bytes since the last mark, but for what they jump to. The mark stays.
        pub fn back_to_mark(&mut self) {
            let Some(log) = &mut self.undo.0 else { return };
            let Some(mark) = log.marks.last() else { return };
            [self.position, self.class, self.match_at, self.match_length, self.predicted, self.place] = mark.words;
            self.hashes = mark.hashes;
            self.features = mark.features.clone();
            let [heads, lines, cells, weights] = mark.lengths;
            for (at, head) in log.heads.drain(heads..).rev() {
                self.heads[at as usize] = head;
            }
            let all = self.cells.0.as_chunks_mut::<16>().0;
            for (at, line) in log.lines.drain(lines..).rev() {
                all[at as usize] = line;
            }
            for (at, cells) in log.cells.drain(cells..).rev() {
                for (at, cell) in at.into_iter().zip(cells) {
                    self.cells.0[at as usize] = cell;
                }
            }
            for (row, weights) in log.weights.drain(weights..).rev() {
                self.mixers.weights[row as usize] = weights;
            }
        }

        /// Forgets the last mark, and no byte.
        pub fn unmark(&mut self) {
            let Some(log) = &mut self.undo.0 else { return };
            log.marks.pop();
            if log.marks.is_empty() {
                self.undo = Undo::ZERO;
            }
        }
    }
}

#[cfg(not(feature = "undo"))]
mod nothing {
    use crate::mix::Mixers;
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
        pub fn weights(&mut self, _rows: &Words, _mixers: &Mixers) {}
    }
}
