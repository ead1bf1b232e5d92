//! In which order functions and data lie: one that packs well, and that follows from what they are. No name, no place
//! in a source file and no order of the compiler's has a part in it.

pub mod fold;
pub mod likeness;
pub mod mark;

use crate::pieces::{Kind, Piece, Pieces, Target};
use likeness::Likeness;
use std::cmp::Reverse;

/// What makes functions follow each other. None is best for all programs, so the packer tries some.
#[derive(Clone, Copy, Debug)]
pub struct Taste {
    /// Instructions of the longest runs that functions are compared by.
    pub longest: usize,
    /// What is left of a function's pull on those to come when one more has been placed: the packer's model remembers
    /// what it saw last best.
    pub kept: f64,
}

/// Those that are tried.
pub const TASTES: [Taste; 9] = {
    let mut all = [Taste { longest: 0, kept: 0.0 }; 9];
    let mut i = 0;
    while i < all.len() {
        all[i] = Taste { longest: [3, 4, 5][i % 3], kept: [0.84, 0.87, 0.90][i / 3] };
        i += 1;
    }
    all
};

/// All that `main` leads to, in order.
pub fn order(pieces: &Pieces, taste: Taste) -> Vec<usize> {
    let marks = mark::marks(pieces, |_, _| 0);
    let mut roots: Vec<usize> = (0..pieces.all.len()).filter(|&i| is_root(&pieces.all[i])).collect();
    roots.sort_by_key(|&i| (pieces.all[i].kind, marks[i]));
    let mut code: Vec<usize> = reached(pieces, &roots, |_| true);
    code.retain(|&i| pieces.all[i].kind == Kind::Code);
    code.sort_by_key(|&i| (Reverse(pieces.all[i].bytes.len()), marks[i]));
    let mut order = chain(pieces, &code, taste);
    let users: Vec<usize> = order.iter().chain(&roots).copied().collect();
    let mut data = reached(pieces, &users, |piece| piece.kind != Kind::Code);
    data.sort_by_key(|&i| place(&pieces.all[i]));
    order.extend(data);
    order
}

/// What the program starts at.
fn is_root(piece: &Piece) -> bool {
    piece.name == "main" || piece.kind == Kind::Start
}

/// What `from` leads to, in the order of the references that do; without what is not `wanted`, and what only that
/// leads to.
fn reached(pieces: &Pieces, from: &[usize], wanted: impl Fn(&Piece) -> bool) -> Vec<usize> {
    let mut seen = vec![false; pieces.all.len()];
    let mut found = Vec::new();
    for &start in from {
        let mut open = vec![start];
        while let Some(i) = open.pop() {
            let piece = &pieces.all[i];
            if std::mem::replace(&mut seen[i], true) {
                continue;
            }
            let kept = wanted(piece);
            if kept {
                found.push(i);
            }
            if kept || i == start {
                open.extend(piece.references.iter().rev().filter_map(|reference| match reference.to {
                    Target::Piece(to) if wanted(&pieces.all[to]) => Some(to),
                    _ => None,
                }));
            }
        }
    }
    found
}

/// Functions, from the first one on: each the one that is most like those just before it.
fn chain(pieces: &Pieces, code: &[usize], taste: Taste) -> Vec<usize> {
    let likeness = Likeness::of(code.iter().map(|&i| &pieces.all[i]), taste.longest);
    let mut pull = vec![0.0; code.len()];
    let mut open: Vec<usize> = (0..code.len()).collect();
    let mut order = Vec::new();
    while !open.is_empty() {
        // Of equals the first, and that is at the start the largest.
        let next = (0..open.len()).rev().max_by(|&a, &b| f64::total_cmp(&pull[open[a]], &pull[open[b]]));
        let next = open.remove(next.expect("some are open"));
        order.push(code[next]);
        for &other in &open {
            pull[other] = pull[other] * taste.kept + likeness.between(next, other);
        }
    }
    order
}

/// Where data lies. Sections start at the largest alignment, so that there are no gaps; in each alignment tables and
/// texts come first, then constants of functions by their values, then what holds addresses.
fn place(piece: &Piece) -> (Reverse<u64>, bool, usize, Vec<u8>) {
    let value = match piece.kind {
        Kind::Constant if piece.pooled => piece.bytes.iter().rev().copied().collect(),
        _ => Vec::new(),
    };
    (Reverse(piece.align), !piece.references.is_empty(), value.len(), value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pieces::Reference;

    /// A function: its bytes, and what it refers to.
    fn code(name: &str, bytes: &[u8], to: &[usize]) -> Piece {
        let references = to.iter().enumerate();
        let references =
            references.map(|(i, &to)| Reference { at: i as u64, kind: 2, to: Target::Piece(to), addend: -4 });
        let references = references.collect();
        Piece { name: name.into(), kind: Kind::Code, bytes: bytes.into(), align: 1, references, pooled: false }
    }

    fn constant(value: u32) -> Piece {
        let bytes = value.to_le_bytes().to_vec();
        Piece { name: ".cst4".into(), kind: Kind::Constant, bytes, align: 4, references: vec![], pooled: true }
    }

    /// Additions to registers: functions alike share some.
    fn additions(numbers: &[u8]) -> Vec<u8> {
        numbers.iter().flat_map(|&n| [0x83, 0xc0 | n & 7, n]).chain([0xc3]).collect()
    }

    fn program() -> Pieces {
        let all = vec![
            code("main", &additions(&[1, 2, 3, 4, 5, 6, 7, 8]), &[1, 2, 3, 4, 6]),
            code("blue", &additions(&[70, 71, 72, 73, 74]), &[5]),
            code("red", &additions(&[30, 31, 32, 33, 34, 35]), &[6, 4]),
            code("azure", &additions(&[70, 71, 72, 73, 75]), &[6]),
            code("ruby", &additions(&[30, 31, 32, 33, 36, 37]), &[5]),
            constant(9),
            constant(5),
            code("nobody's", &additions(&[1]), &[5]),
        ];
        Pieces { all, imports: vec![] }
    }

    fn names(pieces: &Pieces) -> Vec<(String, Vec<u8>)> {
        order(pieces, TASTES[4])
            .into_iter()
            .map(|i| (pieces.all[i].name.clone(), pieces.all[i].bytes.clone()))
            .collect()
    }

    /// The same program with its pieces in another order and with other names.
    fn shuffled(pieces: &Pieces, to: &[usize], rename: impl Fn(&str) -> String) -> Pieces {
        let mut all = pieces.all.clone();
        for (from, &to) in to.iter().enumerate() {
            let mut piece = pieces.all[from].clone();
            if piece.name != "main" {
                piece.name = rename(&piece.name);
            }
            all[to] = piece;
        }
        for reference in all.iter_mut().flat_map(|piece| &mut piece.references) {
            if let Target::Piece(piece) = &mut reference.to {
                *piece = to[*piece];
            }
        }
        Pieces { all, imports: vec![] }
    }

    #[test]
    fn what_is_alike_lies_together_and_constants_rise() {
        let order = names(&program());
        let place = |name: &str| order.iter().position(|(n, _)| n == name).unwrap();
        assert_eq!(place("blue").abs_diff(place("azure")), 1);
        assert_eq!(place("red").abs_diff(place("ruby")), 1);
        assert_eq!(order[5..], [(".cst4".into(), vec![5, 0, 0, 0]), (".cst4".into(), vec![9, 0, 0, 0])]);
    }

    #[test]
    fn a_new_function_goes_beside_its_likes() {
        let old: Vec<_> = names(&program()).into_iter().map(|(name, _)| name).collect();
        let mut program = program();
        program.all.push(code("scarlet", &additions(&[30, 31, 32, 33, 36, 38]), &[]));
        let new = program.all.len() - 1;
        program.all[0].references.push(Reference { at: 9, kind: 2, to: Target::Piece(new), addend: -4 });
        let mut order: Vec<_> = names(&program).into_iter().map(|(name, _)| name).collect();
        let at = order.iter().position(|name| name == "scarlet").unwrap();
        assert!([at - 1, at + 1].iter().any(|&i| ["red", "ruby"].contains(&&*order[i])), "{order:?}");
        order.remove(at);
        assert_eq!(order, old);
    }

    #[test]
    fn what_nobody_needs_is_left_out() {
        assert!(names(&program()).iter().all(|(name, _)| name != "nobody's"));
    }

    #[test]
    fn neither_names_nor_the_order_before_have_a_part() {
        let program = program();
        let contents = |pieces: &Pieces| names(pieces).into_iter().map(|(_, bytes)| bytes).collect::<Vec<_>>();
        let right = contents(&program);
        for to in [[7, 6, 5, 4, 3, 2, 1, 0], [3, 1, 4, 0, 5, 2, 7, 6]] {
            assert_eq!(contents(&shuffled(&program, &to, |name| format!("{}{name}", name.len() % 3))), right);
        }
    }

    #[test]
    fn equals_are_one_but_variables_stay() {
        let variable =
            |name: &str| Piece { name: name.into(), kind: Kind::Zero, align: 4, pooled: false, ..constant(0) };
        let mut pieces = program();
        pieces.all[2] = code("one", &additions(&[1]), &[6]);
        pieces.all[3] = code("two", &additions(&[1]), &[6]);
        pieces.all[1] = code("left", &additions(&[2]), &[5]);
        pieces.all[4] = code("right", &additions(&[2]), &[7]);
        (pieces.all[5], pieces.all[7]) = (variable("a"), variable("b"));
        fold::fold(&mut pieces);
        let order = names(&pieces);
        let there = |name: &str| order.iter().any(|(n, _)| n == name);
        assert_eq!(["one", "two", "left", "right", "a", "b"].map(there), [true, false, true, true, true, true]);
    }

    #[test]
    fn twins_lie_by_what_they_lead_to() {
        let mut program = program();
        program.all[3].bytes = program.all[1].bytes.clone();
        let constants = |pieces: &Pieces| -> Vec<_> {
            let read = |i: usize| match pieces.all[i].references.first()?.to {
                Target::Piece(to) => Some(pieces.all[to].bytes.clone()),
                Target::Import(_) => None,
            };
            order(pieces, TASTES[4]).into_iter().map(read).collect()
        };
        let turned = shuffled(&program, &[7, 6, 5, 4, 3, 2, 1, 0], str::to_owned);
        assert_eq!(constants(&turned), constants(&program));
    }
}
