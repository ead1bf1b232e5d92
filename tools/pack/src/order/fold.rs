//! Functions and constants that are the same are one.

use super::mark::marks;
use crate::pieces::{Kind, Pieces, Target};
use std::collections::HashMap;

/// Has all that leads to one of several equals lead to the same of them. Variables are never equal.
pub fn fold(pieces: &mut Pieces) {
    let variable = |kind| !matches!(kind, Kind::Code | Kind::Constant);
    let marks = marks(pieces, |i, piece| if variable(piece.kind) { i as u64 + 1 } else { 0 });
    let mut first = HashMap::new();
    let same: Vec<usize> = marks.iter().enumerate().map(|(i, &mark)| *first.entry(mark).or_insert(i)).collect();
    for reference in pieces.all.iter_mut().flat_map(|piece| &mut piece.references) {
        if let Target::Piece(to) = &mut reference.to {
            *to = same[*to];
        }
    }
}
