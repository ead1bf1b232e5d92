//! A number for each piece that stands for what it does: its bytes, and what it leads to. Pieces have the same one
//! where no run of the program could tell them apart.

use crate::pieces::{Pieces, Target};

/// How many references deep pieces are compared.
const DEPTH: usize = 8;

/// A hash (FNV-1a, and a last mixing).
pub fn hash(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let step = |h: u64, byte| (h ^ byte as u64).wrapping_mul(0x100_0000_01b3);
    let h = bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, step);
    (h ^ h >> 29).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// The marks of all pieces.
pub fn marks(pieces: &Pieces) -> Vec<u64> {
    let imports: Vec<u64> = pieces.imports.iter().map(|import| hash(import.name.bytes())).collect();
    let own = |piece: &crate::pieces::Piece| {
        hash([piece.kind as u8, piece.align as u8].into_iter().chain(piece.bytes.iter().copied()))
    };
    let mut marks: Vec<u64> = pieces.all.iter().map(own).collect();
    for _ in 0..DEPTH {
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
    }
    marks
}
