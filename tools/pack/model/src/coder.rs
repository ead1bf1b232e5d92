//! Binary arithmetic decoding; the packer has the encoder.

/// Reads bits, the lowest of each byte first.
pub struct Decoder<'a> {
    range: u32,
    /// How far into the range the coded number is.
    value: u32,
    /// Number of the next coded bit.
    at: usize,
    bytes: &'a [u8],
}

impl<'a> Decoder<'a> {
    /// Starts at the first byte of `bytes`; zeros follow the last.
    pub fn new(bytes: &'a [u8]) -> Self {
        // A range of one, so that the first bits are read as all others are.
        Self { range: 1, value: 0, at: 0, bytes }
    }

    /// Decodes one bit, which is a one with this probability (65536ths).
    pub fn decode(&mut self, probability: u32) -> u32 {
        while self.range >> 31 == 0 {
            let byte = self.bytes.get(self.at >> 3).map_or(0, |&byte| byte as u32);
            self.value = self.value << 1 | byte >> (self.at & 7) & 1;
            self.range <<= 1;
            self.at += 1;
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
