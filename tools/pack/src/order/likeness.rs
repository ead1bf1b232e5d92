//! How alike two functions are: by the runs of instructions that both have.

use super::mark::hash;
use crate::pieces::Piece;
use iced_x86::{Decoder, DecoderOptions, OpKind};
use std::collections::BTreeMap;

/// How much of a function's own weight is taken off what it shares, so that large ones are not like all others.
const SHARE: f64 = 0.3;

/// The hashes of a function's runs of up to `longest` instructions, without the addresses in them; sorted, each once.
pub fn runs(piece: &Piece, longest: usize) -> Vec<u64> {
    let mut decoder = Decoder::new(64, &piece.bytes, DecoderOptions::NONE);
    let mut words = Vec::new();
    while decoder.can_decode() {
        let at = decoder.position();
        let instruction = decoder.decode();
        // How far a jump goes changes with whatever it skips.
        words.push(match instruction.op0_kind() {
            OpKind::NearBranch64 => instruction.mnemonic() as u64,
            _ => hash(piece.bytes[at..decoder.position()].iter().copied()),
        });
    }
    let run = |run: &[u64]| hash(run.iter().flat_map(|word| word.to_le_bytes()));
    let mut all: Vec<u64> = (1..=longest).flat_map(|length| words.windows(length).map(run)).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Functions by their runs, of which those tell most that few functions have.
pub struct Likeness {
    /// Of each function its runs, and what each of them weighs.
    runs: Vec<Vec<(u64, f64)>>,
    /// What the weights of a function make.
    scales: Vec<f64>,
}

impl Likeness {
    /// Of these functions.
    pub fn of<'a>(functions: impl Iterator<Item = &'a Piece>, longest: usize) -> Likeness {
        let runs: Vec<Vec<u64>> = functions.map(|piece| runs(piece, longest)).collect();
        let mut owners = BTreeMap::new();
        for run in runs.iter().flatten() {
            *owners.entry(*run).or_insert(0.0) += 1.0;
        }
        let count = runs.len() as f64;
        let weighed = |run: u64| (run, f64::ln(count / owners[&run]));
        let runs: Vec<Vec<_>> = runs.into_iter().map(|own| own.into_iter().map(weighed).collect()).collect();
        let sum = |own: &Vec<(u64, f64)>| own.iter().map(|(_, weight)| weight).sum::<f64>();
        // A function of nothing rare has no likes.
        let scales = runs.iter().map(|own| sum(own).max(f64::MIN_POSITIVE).powf(-SHARE)).collect();
        Likeness { runs, scales }
    }

    /// How alike two of them are; 0 where they have nothing in common.
    pub fn between(&self, a: usize, b: usize) -> f64 {
        let (mut left, mut right) = (&self.runs[a][..], &self.runs[b][..]);
        let mut shared = 0.0;
        while let ([(x, weight), after @ ..], [(y, _), after_y @ ..]) = (left, right) {
            if x == y {
                shared += weight;
            }
            if x <= y {
                left = after;
            }
            if y <= x {
                right = after_y;
            }
        }
        if shared > 0.0 { shared * self.scales[a] * self.scales[b] } else { 0.0 }
    }
}
