//! A probability that learns, and the last bits it saw, in 32 bits: from the top, 17 bits of probability
//! (its highest bit inverted, so that all-zero memory means one half), 7 of count, 8 of history.

#![allow(unsafe_code)]

/// The count stops here: a text is short, and what it teaches holds to its end.
const LIMIT: i32 = 127;

/// Probability of a one, in 65536ths.
pub fn probability(slot: u32) -> i32 {
    (slot >> 16) as i32 ^ 0x8000
}

/// The last seven bits below a leading one, fewer at first; 0 before the first bit.
pub fn history(slot: u32) -> usize {
    (slot & 255) as usize
}

/// Number of bits seen, as far as it is counted.
pub fn count(slot: u32) -> i32 {
    (slot >> 8) as i32 & LIMIT
}

/// Learns one bit: the `n`th moves the probability by 1 / (n + 1/16).
///
/// Divided as floats, which is exact but for the last bit, the same everywhere, and takes half of the time.
pub fn update(slot: &mut u32, bit: u32) {
    let (p, n, h) = ((*slot >> 15) as i32 ^ 0x1_0000, count(*slot), *slot & 255);
    let step = ((0x1_ffff & -(bit as i32)) - p) as f32 / (n as f32 + 17.0 / 16.0);
    // SAFETY: below 2^17.
    let p = p + unsafe { step.to_int_unchecked::<i32>() };
    let n = n + (n < LIMIT) as i32;
    // The bit that falls out of eight goes on as the leading one.
    let h = h.max(1) << 1 | bit;
    let h = (h | h >> 1 & 128) & 255;
    *slot = ((p ^ 0x1_0000) as u32) << 15 | (n as u32) << 8 | h;
}
