//! A probability that learns, and the last bits it saw, in 32 bits: from the top, 19 bits of probability
//! (its highest bit inverted, so that all-zero memory means one half), 5 of count, 8 of history.

/// The count stops here: later bits move the probability by 1 / (LIMIT + 1.2).
const LIMIT: i32 = 30;

/// 65536 / (n + 1.2), by count.
const RATES: [u16; 32] = {
    let mut rates = [0; 32];
    let mut n = 0;
    while n < 32 {
        rates[n] = (655_360 / (10 * n + 12)) as u16;
        n += 1;
    }
    rates
};

/// Probability of a one, in 65536ths.
pub fn probability(slot: u32) -> i32 {
    (slot >> 16) as i32 ^ 0x8000
}

/// The last seven bits below a leading one, fewer at first; 0 before the first bit.
pub fn history(slot: u32) -> usize {
    (slot & 255) as usize
}

/// A slot of this probability (65536ths) as if after `count` bits.
pub fn with(probability: i32, count: u32) -> u32 {
    ((probability ^ 0x8000) as u32) << 16 | count << 8
}

/// Learns one bit.
pub fn update(slot: &mut u32, bit: u32) {
    let (p, n, h) = ((*slot >> 13) as i32 ^ 0x4_0000, (*slot >> 8 & 31) as i32, *slot & 255);
    let p = p + ((((0x7_ffff & -(bit as i32)) - p) as i64 * RATES[n as usize & 31] as i64) >> 16) as i32;
    let n = n + (n < LIMIT) as i32;
    // The bit that falls out of eight goes on as the leading one.
    let h = h.max(1) << 1 | bit;
    let h = (h | h >> 1 & 128) & 255;
    *slot = ((p ^ 0x4_0000) as u32) << 13 | (n as u32) << 8 | h;
}
