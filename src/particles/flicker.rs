//! How the light wavers that a fire throws on other things.
//!
//! As in `[Fire08]` it is noise over time. The mean of four waves is taken, each of which eases from one random number
//! to the next at a rate of its own: so it has neither jumps nor kinks. `tests/particles/flicker.rs` has the formula in `f64`.

use crate::simd::hash::rnd;
use crate::timeline::ease;

/// Random numbers per second of each of four waves. No ratio of two is simple, so they never beat in step.
const RATES: [f64; 4] = [2.3, 3.7, 6.1, 9.7];

/// Knots after which a wave starts again: 320 days at the fastest rate.
const ROUND: u32 = 1 << 28;

/// The share that a fire's light has at `time` seconds of the most that it may have: from `least` to 1, and
/// `(1 + least) / 2` in the mean. Fires of different `seed`, below 256, are independent.
pub fn flicker(seed: u32, time: f64, least: f32) -> f32 {
    let mut sum = 0.0;
    for (wave, rate) in RATES.into_iter().enumerate() {
        let knots = rate * time;
        let last = knots.floor();
        let number = last as i64 as u32;
        let [from, to] = [number, number.wrapping_add(1)].map(|n| rnd(seed, n % ROUND, wave as u32));
        sum += from + (to - from) * ease(last, last + 1.0, knots);
    }
    least + (1.0 - least) * (0.25 * sum)
}
