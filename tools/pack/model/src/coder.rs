//! Binary arithmetic decoding; the packer has the encoder.

/// A number that is coded in bits, as far as it is known.
pub struct Decoder {
    range: u32,
    /// How far into the range the coded number is.
    value: u32,
}

impl Decoder {
    /// Before the first bit: a range of one, so that the first coded bits are read as all others are.
    pub const START: Self = Self { range: 1, value: 0 };

    /// Decodes one bit, which is a one with this probability (65536ths). `append` gives a number with the
    /// next coded bit behind its lowest one.
    pub fn decode(&mut self, probability: u32, mut append: impl FnMut(u32) -> u32) -> u32 {
        while self.range >> 31 == 0 {
            self.value = append(self.value);
            self.range <<= 1;
        }
        let split = ((self.range as u64 * probability as u64) >> 16) as u32;
        let bit = self.value < split;
        if bit {
            self.range = split;
        } else {
            self.range -= split;
            self.value -= split;
        }
        bit as u32
    }
}
