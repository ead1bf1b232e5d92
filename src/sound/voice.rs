//! What a note sounds like.

use crate::simd::hash::rnd;
use std::f32::consts::LN_2;

/// An instrument, after Chowning `[Chowning73]`: a sine whose phase is moved by another, times noise. The rows of a score begin with [`Voice::SINE`].
#[derive(Clone, Copy, Debug)]
pub struct Voice {
    /// How long a note takes to come, seconds.
    pub attack: f32,
    /// How fast it fades while it is held, halvings per second.
    pub fade: f32,
    /// How long it takes to go once it is let go, seconds.
    pub release: f32,
    /// Frequency of the modulator over that of the note.
    pub ratio: f32,
    /// How far the modulator moves the phase at first, turns.
    pub index: f32,
    /// How fast it moves it less, halvings per second.
    pub dulling: f32,
    /// What each ear's pitch differs from the note's, as a part of its frequency.
    pub detune: f32,
    /// Turns by which the phase of a note gets ahead in all, because it starts higher.
    pub fall: f32,
    /// How fast it comes down, halvings per second.
    pub falling: f32,
    /// The share of noise in what the tone is multiplied by: at 1 it is a band of noise about its pitch.
    pub noise: f32,
    /// Random numbers of the noise per second: the band is about as wide, in hertz.
    pub colour: f32,
    /// Random numbers per second of the noise's own loudness.
    pub gusts: f32,
    /// How much it is quieter where such a number is 0 than where it is 1; above 1 it is silent in between.
    pub gustiness: f32,
    /// The share that goes to the room.
    pub room: f32,
}

impl Voice {
    /// A sine.
    pub const SINE: Voice = Voice {
        attack: 0.003,
        fade: 1.0,
        release: 0.02,
        ratio: 1.0,
        index: 0.0,
        dulling: 0.0,
        detune: 0.0,
        fall: 0.0,
        falling: 0.0,
        noise: 0.0,
        colour: 44_100.0,
        gusts: 0.0,
        gustiness: 0.0,
        room: 0.3,
    };

    /// What a note has `t` seconds after its start, if it is held for `held` seconds: its amplitude, how far the
    /// modulator moves the phase, and how far the phase has got ahead, both in turns.
    pub(super) fn at(&self, t: f32, held: f32) -> [f32; 3] {
        let comes = (t / self.attack).clamp(0.0, 1.0);
        let goes = (1.0 - (t - held) / self.release).clamp(0.0, 1.0);
        [
            comes * goes * goes * exp2(-self.fade * t),
            self.index * exp2(-self.dulling * t),
            self.fall * (1.0 - exp2(-self.falling * t)),
        ]
    }

    /// What gusts multiply the amplitude by `t` seconds after the start of a note with noise `seed`.
    pub(super) fn gust(&self, seed: u32, t: f32) -> f32 {
        let place = t * self.gusts;
        let number = place as u32;
        let [a, b] = [rnd(seed, number, 1), rnd(seed, number + 1, 1)];
        (1.0 + (a + (b - a) * (place - number as f32) - 1.0) * self.gustiness).max(0.0)
    }
}

/// 2 to the power of `x`, for `x` of at most 0, off by less than 1e-6 of it; 0 below -126. Of no library, so that it has
/// the same bits everywhere.
#[inline(never)] // Called in several places, never in a hot loop.
pub fn exp2(x: f32) -> f32 {
    let x = x.max(-127.0);
    // Towards 0, so that the fraction is of the sign of `x`.
    let whole = x as i32;
    let f = x - whole as f32;
    let fraction = 1.0
        + f * (LN_2
            + f * (0.240_224_4 + f * (0.055_490_76 + f * (0.009_579_18 + f * (0.001_274_748 + f * 0.000_109_023_2)))));
    fraction * f32::from_bits(((whole + 127) << 23) as u32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the polynomial, 1e-8, and of rounding it.
    const OFF: f32 = 1e-6;

    #[test]
    fn powers_are_those_of_f64() {
        for n in 0..100_000 {
            let x = n as f32 * -1.2e-3;
            let exact = f64::from(x).exp2();
            assert!((f64::from(exp2(x)) / exact - 1.0).abs() < f64::from(OFF), "{x}: {} {exact}", exp2(x));
        }
        assert_eq!(exp2(0.0), 1.0);
        assert_eq!(exp2(-1e9), exp2(-127.0));
    }
}
