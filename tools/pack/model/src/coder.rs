//! Binary arithmetic coding, 32 bits wide, without carries.

/// Splits the interval from `low` to `high` at the probability (65536ths) of a one.
fn split(low: u32, high: u32, probability: u32) -> u32 {
    low + (((high - low) as u64 * probability as u64) >> 16) as u32
}

/// Writes bits.
pub struct Encoder {
    low: u32,
    high: u32,
}

impl Default for Encoder {
    fn default() -> Self {
        Self { low: 0, high: !0 }
    }
}

impl Encoder {
    /// Encodes one bit; finished bytes go to `out`.
    pub fn encode(&mut self, bit: u32, probability: u32, mut out: impl FnMut(u8)) {
        let middle = split(self.low, self.high, probability);
        if bit != 0 {
            self.high = middle;
        } else {
            self.low = middle + 1;
        }
        while (self.low ^ self.high) >> 24 == 0 {
            out((self.high >> 24) as u8);
            self.low <<= 8;
            self.high = self.high << 8 | 255;
        }
    }

    /// The byte that ends the stream; the decoder takes zeros after it.
    pub fn finish(&self) -> u8 {
        // low <= (top of high) followed by zeros <= high, since their first bytes differ.
        (self.high >> 24) as u8
    }
}

/// Reads bits.
pub struct Decoder<'a> {
    low: u32,
    high: u32,
    value: u32,
    rest: &'a [u8],
}

impl<'a> Decoder<'a> {
    /// Starts at the first byte of `rest`.
    pub fn new(rest: &'a [u8]) -> Self {
        let mut decoder = Self { low: 0, high: !0, value: 0, rest };
        for _ in 0..4 {
            decoder.shift();
        }
        decoder
    }

    fn shift(&mut self) {
        let mut byte = 0;
        if let [first, rest @ ..] = self.rest {
            byte = *first;
            self.rest = rest;
        }
        self.value = self.value << 8 | byte as u32;
    }

    /// Decodes one bit.
    pub fn decode(&mut self, probability: u32) -> u32 {
        let middle = split(self.low, self.high, probability);
        let bit = (self.value <= middle) as u32;
        if bit != 0 {
            self.high = middle;
        } else {
            self.low = middle + 1;
        }
        while (self.low ^ self.high) >> 24 == 0 {
            self.low <<= 8;
            self.high = self.high << 8 | 255;
            self.shift();
        }
        bit
    }
}
