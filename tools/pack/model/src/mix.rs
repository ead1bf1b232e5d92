//! The logistic domain and the mixer. Mixing there and its learning rule: Mahoney's PAQ7 (2005).

/// Stretched probabilities lie within plus and minus this; 256 is a factor of e in the odds.
const STRETCH: i32 = 2047;

/// The logistic function and its inverse, tabled.
pub struct Logistic {
    /// Probability in 65536ths, by stretched value plus 2048.
    squash: [u16; 4096],
    /// Stretched value, by probability in 4096ths.
    stretch: [i16; 4096],
}

impl Logistic {
    /// Unusable before [`Self::fill`].
    pub const ZERO: Self = Self { squash: [0; 4096], stretch: [0; 4096] };

    /// Integrates dp = p (1 - p) dx from p = 1/2 on, in Euler's steps. Their error does not matter:
    /// the curve need not be the logistic exactly, only the same on both sides.
    pub fn fill(&mut self) {
        let mut p = 1u64 << 31;
        for x in 0..2048 {
            let high = (p >> 16) as u16;
            self.squash[2048 + x] = high;
            self.squash[2047 - x] = !high;
            p += (p * ((1 << 32) - p)) >> 40;
        }
        let mut x = 0;
        for p in 0..4096 {
            while x < 4094 && (self.squash[(x + 1) & 4095] >> 4) as usize <= p {
                x += 1;
            }
            self.stretch[p] = x as i16 - 2047;
        }
    }

    /// Probability in 65536ths of a stretched value, 1 to 65535 + 1 exclusive.
    pub fn squash(&self, x: i32) -> i32 {
        self.squash[(x + 2048) as usize & 4095] as i32
    }

    /// Stretched value of a probability in 65536ths.
    pub fn stretch(&self, p: i32) -> i16 {
        self.stretch[(p >> 4) as usize & 4095]
    }
}

/// The sum of `inputs`, each with its weight (16384 is one), clamped to what can be squashed.
pub fn dot<const N: usize>(inputs: &[i16; N], weights: &[i16; N]) -> i32 {
    let sum = inputs.iter().zip(weights).fold(0i32, |sum, (&x, &w)| sum.wrapping_add(x as i32 * w as i32));
    (sum >> 14).clamp(-STRETCH, STRETCH)
}

/// Moves the weights against the error (65536ths of a probability, scaled by the rate to 16 bits).
pub fn train<const N: usize>(inputs: &[i16; N], weights: &mut [i16; N], error: i32) {
    for (&x, w) in inputs.iter().zip(weights) {
        *w = w.saturating_add(((x as i32 * error + 0x8000) >> 16) as i16);
    }
}
