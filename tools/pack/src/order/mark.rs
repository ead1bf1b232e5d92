//! A number for each piece that stands for what it does: its bytes, and what it leads to. Where two have the same one
//! nothing tells them apart but their names.

use crate::pieces::{Piece, Pieces, Target};
use std::collections::HashSet;

/// A hash (FNV-1a, and a last mixing).
pub fn hash(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let step = |h: u64, byte| (h ^ byte as u64).wrapping_mul(0x100_0000_01b3);
    let h = bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, step);
    (h ^ h >> 29).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// The marks of all pieces. `own` is what more a piece is known by, besides its content.
pub fn marks(pieces: &Pieces, own: impl Fn(usize, &Piece) -> u64) -> Vec<u64> {
    let imports: Vec<u64> = pieces.imports.iter().map(|import| hash(import.name.bytes())).collect();
    let first = |(i, piece): (usize, &Piece)| {
        let start = own(i, piece).to_le_bytes().into_iter().chain([piece.kind as u8, piece.align as u8]);
        hash(start.chain(piece.bytes.iter().copied()))
    };
    let mut marks: Vec<u64> = pieces.all.iter().enumerate().map(first).collect();
    let mut kinds = 0;
    // As long as looking one reference further tells any two apart.
    loop {
        let deeper = pieces.all.iter().zip(&marks).map(|(piece, mark)| {
            let references = piece.references.iter().flat_map(|reference| {
                let to = match reference.to {
                    Target::Piece(to) => marks[to],
                    Target::Import(to) => imports[to],
                };
                [reference.at, reference.kind as u64, to, reference.addend as u64]
            });
            hash([*mark].into_iter().chain(references).flat_map(u64::to_le_bytes))
        });
        marks = deeper.collect();
        let now = marks.iter().collect::<HashSet<_>>().len();
        if now == kinds {
            return marks;
        }
        kinds = now;
    }
}
