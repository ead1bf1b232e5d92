//! Binary arithmetic coding: what both stages of the unpacker decode.

/// Writes bits: a number within an interval that each of them narrows.
pub struct Encoder {
    /// Digits of the interval's start before the last 32. The first is always zero.
    bits: Vec<u8>,
    low: u32,
    range: u32,
}

impl Default for Encoder {
    fn default() -> Self {
        Self { bits: Vec::new(), low: 0, range: 1 << 31 }
    }
}

impl Encoder {
    /// Encodes one bit; the odds are those of a zero against a one.
    pub fn encode(&mut self, bit: bool, [zero, one]: [u32; 2]) {
        let split = (self.range as u64 * one as u64 / (zero + one) as u64) as u32;
        if bit {
            self.range = split;
        } else {
            self.add(split);
            self.range -= split;
        }
        while self.range >> 31 == 0 {
            self.range <<= 1;
            self.shift();
        }
    }

    fn add(&mut self, value: u32) {
        let (low, carry) = self.low.overflowing_add(value);
        self.low = low;
        if carry {
            let last = self.bits.iter().rposition(|&bit| bit == 0).unwrap_or(0);
            self.bits[last] = 1;
            self.bits[last + 1..].fill(0);
        }
    }

    fn shift(&mut self) {
        self.bits.push((self.low >> 31) as u8);
        self.low <<= 1;
    }

    /// All bits, the first one lowest in its byte. Any may follow.
    pub fn finish(mut self) -> Vec<u8> {
        self.add(1 << 30);
        self.shift();
        self.shift();
        self.bits[1..].chunks(8).map(|bits| bits.iter().rev().fold(0, |byte, bit| byte << 1 | bit)).collect()
    }
}
