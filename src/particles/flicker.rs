//! How the light of a fire wavers.

use crate::simd::hash::rnd;
use crate::timeline::ease;

/// Random numbers a second of each of four waves. No ratio of two is simple, so that they never beat in step.
const RATES: [f64; 4] = [2.3, 3.7, 6.1, 9.7];

/// Knots after which a wave comes round: in 320 days and more.
const ROUND: u32 = 1 << 28;

/// A fire's light at `time` seconds over the most that it may be: from `least` to 1, `(1 + least) / 2` in the mean.
///
/// The mean of four waves, each of which eases from one random number to the next at a rate of its own; so it has neither
/// jumps nor kinks. Fires of different `seed`, below 256, know nothing of each other.
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
