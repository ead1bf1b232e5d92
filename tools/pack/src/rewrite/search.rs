//! Tries orders, and has the model say what each costs.

use super::instruction::{FLAGS, Op, UNITS};
use super::window::{MOST, Window};
use iced_x86::InstructionInfoFactory;
use pack_model::model::Model;

/// How often all changes of a window are tried, unless none is any good.
const ROUNDS: usize = 3;
/// A way is given up that is so many bits behind the best one where both go on alike: half of the time.
const BEHIND: f64 = 1.5;
/// Bits that a change must save, so that rounding does not make one.
const LEAST: f64 = 1e-6;

/// A model that says what bytes cost, and can go back.
pub trait Price {
    /// Bits that `bytes` are coded in, which the model learns.
    fn price(&mut self, bytes: impl Iterator<Item = u8>) -> f64;
    /// Marks this place, beside those that are marked.
    fn mark(&mut self);
    /// Goes back to the last place that was marked.
    fn back_to_mark(&mut self);
    /// Forgets the last mark.
    fn unmark(&mut self);
}

impl Price for Model {
    fn price(&mut self, bytes: impl Iterator<Item = u8>) -> f64 {
        let mut bits = 0.0;
        for byte in bytes {
            let mut product = 1.0;
            for i in (0..8).rev() {
                let bit = byte as u32 >> i & 1;
                let one = self.predict();
                product *= f64::from(if bit != 0 { one } else { 65536 - one });
                self.update(bit);
            }
            bits += 8.0 * 16.0 - product.log2();
        }
        bits
    }

    fn mark(&mut self) {
        Model::mark(self);
    }

    fn back_to_mark(&mut self) {
        Model::back_to_mark(self);
    }

    fn unmark(&mut self) {
        Model::unmark(self);
    }
}

/// Codes all instructions with the model, in the order that costs least as far as it was found; appends their bytes to
/// `code`.
pub(super) fn search(model: &mut impl Price, mut ops: Vec<Op>, code: &mut Vec<u8>) {
    let mut factory = InstructionInfoFactory::new();
    let flags = live_flags(&ops);
    let stays = |op: &Op| op.fixed || op.starts_block;
    let mut at = 0;
    while at < ops.len() {
        let mut kept = 1;
        if !ops[at].fixed {
            let rest = &ops[at + 1..];
            let end = at + 1 + rest.iter().position(stays).unwrap_or(rest.len()).min(MOST - 1);
            let window = best(model, &mut factory, &ops[at..end], flags[end - 1], ops.get(end));
            // A block that goes on is cut in the middle of the window: the next one begins there.
            kept = if ops.get(end).is_none_or(stays) { end - at } else { (end - at) / 2 };
            for (op, new) in ops[at..end].iter_mut().zip(window) {
                *op = new;
                op.starts_block = false;
            }
        }
        for op in &ops[at..at + kept] {
            model.price(op.bytes.iter().copied());
            code.extend(&op.bytes);
        }
        at += kept;
    }
}

/// For each instruction whether flags are looked at after it, as far as the block says.
fn live_flags(ops: &[Op]) -> Vec<bool> {
    const ALL: u32 = (1 << (UNITS - FLAGS)) - 1;
    let mut live = vec![true; ops.len()];
    // Flags that are looked at before they are written.
    let mut wanted = ALL;
    for (k, op) in ops.iter().enumerate().rev() {
        if op.ends_flags {
            wanted = 0;
        } else if op.fixed || ops.get(k + 1).is_none_or(|next| next.starts_block) {
            wanted = ALL;
        }
        live[k] = wanted != 0;
        let flags = |uses: &[(u8, u8)]| {
            uses.iter().filter(|u| u.1 >= FLAGS as u8).fold(0, |bits, u| bits | 1 << (u.1 as usize - FLAGS))
        };
        wanted = wanted & !flags(&op.writes) | flags(&op.reads);
    }
    live
}

/// The instructions of a window in an order, and as variants, that the model codes in fewer bits, with the one that follows.
///
/// ```text
/// for each place of the window
///     try variants of the instruction there
///     try orders in which a run of instructions that starts there changes places with the run behind it
///     code the instruction that the best way has there
/// ```
fn best(
    model: &mut impl Price,
    factory: &mut InstructionInfoFactory,
    ops: &[Op],
    flags_live: bool,
    next: Option<&Op>,
) -> Vec<Op> {
    let window = Window::new(ops, flags_live);
    let mut order: Vec<usize> = (0..ops.len()).collect();
    let mut ops = ops.to_vec();
    let (end, last) = (ops.len(), ops.len() + usize::from(next.is_some()));
    // Bits up to each place: of the best way as yet, and of another one.
    let (mut least, mut other) = (vec![f64::INFINITY; last + 1], Vec::new());
    least[0] = 0.0;
    for _ in 0..ROUNDS {
        let before = least[last];
        model.mark();
        for place in 0..end {
            model.mark();
            // Does a way that is another one up to `alike` take fewer bits?
            let mut better = |ops: &[Op], order: &[usize], alike: usize| {
                other.clone_from(&least);
                for (at, op) in (place..).zip(order[place..].iter().map(|&k| &ops[k]).chain(next)) {
                    other[at + 1] = other[at] + model.price(op.bytes.iter().copied());
                    if at >= alike && other[at + 1] > least[at + 1] + BEHIND {
                        other[last] = f64::INFINITY;
                        break;
                    }
                }
                model.back_to_mark();
                let better = other[last] < least[last] - LEAST;
                if better {
                    std::mem::swap(&mut least, &mut other);
                }
                better
            };
            if place == 0 && before == f64::INFINITY {
                better(&ops, &order, 0);
            }
            let k = order[place];
            for variant in ops[k].variants(factory) {
                let old = std::mem::replace(&mut ops[k], variant);
                if !better(&ops, &order, place + 1) {
                    ops[k] = old;
                }
            }
            for alike in place + 2..end + 1 {
                for middle in place + 1..alike {
                    let mut moved = order.clone();
                    moved[place..alike].rotate_left(middle - place);
                    if window.allows(&ops, &moved) && better(&ops, &moved, alike) {
                        order = moved;
                    }
                }
            }
            model.unmark();
            model.price(ops[order[place]].bytes.iter().copied());
        }
        model.back_to_mark();
        model.unmark();
        if least[last] == before {
            break;
        }
    }
    order.into_iter().map(|k| ops[k].clone()).collect()
}
