//! The context-mixing model that packing and unpacking share: every probability the one computes, the other must compute
//! again, so there is one source of it. No allocation, no `std`; AVX2 and FMA, whose every operation is defined to the last
//! bit.
//!
//! Some contexts, each a subset of a few features of what came before ([`features`]), look up adaptive probabilities
//! (`slot`); eight mixers weigh them, and one weighs the mixers (`mix`). The method is that of Mahoney's PAQ; that a parser of
//! x86 ([`parse`]) sits inside the model, instead of a filter that splits streams, is that of its executable models.
//!
//! Tried, on a program of 339 kB (xz with its x86 filter: 130,810 bytes; zpaq -m5: 115,501):
//!
//! - addresses left relative: 4.7 % more; absolute ones with their highest byte first: 0.1 % more;
//! - the probability of a slot without that of its history, or the other way round: 3 % more each;
//! - 23 contexts chosen by hand: as good as 11 found by search, at twice the time;
//! - a correction by context behind the mixers (SSE), five variants: 0.0 to 0.1 % more;
//! - histories that start at what their bits suggest, instead of even odds: no difference;
//! - one mixer instead of three: 3.3 % more; a fourth one, by the length of the match: 0.05 % less;
//! - without the linear input of each context: 0.4 % more;
//! - a table of 2^18 or 2^22 lines instead of 2^20: 3 % more, 1.2 % less (but 256 MB).
//!
//! Tried on one of 153 kB, which takes 48,834 bytes:
//!
//! - without what the unpacker's own code taught before: 0.4 % more;
//! - a mixer chosen by the opcode or the operands byte instead of the last byte: 0.1 and 0.4 % more; by the length of
//!   the match: 0.2 % more; with the bits of the byte by whether there is a match, instead of code or data: 0.1 % less,
//!   and so it is now;
//! - first mixers that learn faster at first: no difference;
//! - matches of at least 4, 6 or 7 bytes instead of 5: 0.0 to 0.1 % more.
//!
//! Tried on one of 169 kB, which takes 52,066 bytes (55,481 with ten contexts and three mixers):
//!
//! - counts that stop at 30 instead of 127, in slots or in histories: 0.3 and 0.1 % more;
//! - the linear input without regard to the count: 0.15 % more; other weights of it, or of the stretched one: more;
//! - histories together with the count or the probability: no difference, 0.4 % more;
//! - one final mixer instead of three: 0.3 % more; a fourth for the addressing mode or the register: more;
//! - no mixer by the opcode: 0.2 % more; weights of a new row from a row for all: 0.2 % more;
//! - mixers in floating point, a finer logistic table: 0.05 % less, nothing;
//! - a line's neighbour never looked at: 0.7 % more; the older instead of the lesser line replaced: 0.7 % more; four
//!   times the lines: 0.1 % less;
//! - the match by place, or by what it predicts: 0.0 and 0.1 % more;
//! - without the last register: 0.7 % more; without places that are jumped to: 0.7; without the last numbers: 0.6.
//!
//! Tried on one of 232 kB, which takes 61,200 bytes (61,704 with the constants and contexts of before):
//!
//! - 32 contexts, the new ones at random: 0.3 % more, no difference in twice the lines;
//! - a second match, of at least 3 bytes: 63 bytes less, and as much more code; of 8, 12 or 20 bytes: no difference;
//! - the first bit of a slot moves it by 16/17 instead of 4/5: 0.1 % less, so it is now;
//! - functions sorted by name, by size or at random: 0.2, 0.1 and 1.3 % more.
//!
//! Tried on one of 222 kB, which takes 57,585 bytes and is unpacked in 0.58 s, where before mixing was in integers, slots one
//! by one and the curves in tables (57,519 bytes, 0.82 s; the unpacker has 230 bytes more now):
//!
//! - mixers' loops unrolled: 0.54 s, 180 bytes more of unpacker; slots gathered by the instruction for it: no faster;
//! - lines fetched ahead as soon as all but the last bit before them is known: 0.02 s less, 130 bytes more;
//! - half and a quarter of the errors too small to learn from: no difference in bytes; twice: 20 bytes more;
//! - 2^19 lines: 190 bytes more; 2^14, which fit the cache: 4 kB more and 0.12 s less, so that is what memory costs;
//! - without the match's own slots: 0.6 kB more; without its second one for long matches: 52 bytes; further slots by the
//!   last two bytes or opcodes, without a hash: no difference.
//!
//! Tried on one of 229 kB, which takes 61,394 bytes before its instructions are rewritten; instructions were coded as the
//! processor has them, and the unpacker's own code taught before:
//!
//! - VEX's last byte behind the opcode: no difference; with L and pp at its front, so that registers come last: 200 bytes
//!   less; both as one word that is rotated by five bits, whose first byte ends within the opcode: as good, and less code;
//!   by 4, 6, 7 or 8 bits: 190 to 310 more; behind the operands byte: 200 more;
//! - of the operands byte the last register before the middle one: 370 less; that one before the mode: 82 more; the mode
//!   last: 330 more than as it is; in instructions with VEX alone, or without, half of it; not where the middle one is a
//!   part of the opcode: 70 more;
//! - the registers' bits of REX behind the opcode: 260 more; in another order: 3 more; those of VEX behind its map, base and
//!   index in another order, the opcode's bits in another order: 9 less, 1 less to 20 more, 70 more;
//! - L and pp, or W, beside the opcode in its feature: 190 less, and so it is now;
//! - jumps, short of calls, left relative: 30 to 100 more; words of data with their highest byte first: 300 more;
//! - without what the unpacker's own code taught: 220 more, for 150 less of unpacker and a fiftieth of the time: so it is now;
//! - first weights by the kind of input: 35 more than one for all;
//! - a seventh mixer by the opcode before: 80 less; by the last byte but one: 70; by the register named last, by what a
//!   number was before, by the opcode two back: 30 to 50; the first two with half of the byte and its place: 160, for 7 % of
//!   the time, and so it is now; a fourth mixer of these: 6;
//! - histories by the place of the byte and its half: 15 to 30 less; by its place and bit: 145 more;
//! - a slot that was wrong forgets a quarter or half of its count: 150 and 500 more.
//!
//! With vectors and lines where they lie in one line of the processor's cache it is unpacked in 0.84 to 0.87 of the time, for
//! 11 bytes; rows of weights of eight vectors instead of seven: no faster.
//!
//! Tried on one of 222 kB, which takes 62,074 bytes with the unpacker, in 0.53 s:
//!
//! - three mixers of the mixers' results that share their sum and error, instead of an average of three: 31 bytes more, 0.95
//!   of the time; five: 81 less; eight, one for each set in use, whose weights lie behind the mixers' own: 114 less, and no
//!   slower than three, so it is now; these learning 1.7 or 2.5 times as fast: 36 and 144 more;
//! - lines fetched before the model learns from the bit before them, 0.93 of the time, for 4 bytes; not those beside them:
//!   1.06 of that, 22 less; those for both values of that bit side by side, and fetched a bit earlier in the middle of a
//!   byte: 0.96, 170 more;
//! - pages of 2 MB for the first stage too: 0.96, 8 less; its table half or a quarter as large: 24 and 70 more;
//! - lines emptied by vectors: 0.97, 4 less;
//! - the loop over the inputs unrolled where mixers add: 0.97, 45 more; where they learn, too: 0.95, 90 more.
//!
//! Tried on the unpacker, of which 3,438 bytes are coded: slots read and written in loops instead of one by one, 128 bytes
//! less before coding, none after it, and slower; a slot's count by a minimum: 4 bytes more.
#![cfg_attr(not(test), no_std)]

#[cfg(feature = "undo")]
extern crate alloc;

pub mod coder;
pub mod features;
pub mod first;
pub mod form;
mod mix;
pub mod model;
pub mod parse;
mod slot;
pub mod tuned;
mod vector;
