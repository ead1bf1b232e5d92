//! Inputs made of others, where no fuzzer makes them: the same ones for the same seed.

/// Numbers that are odd somewhere.
const ODD: [u8; 8] = [0, 1, 0x7f, 0x80, 0xff, b'-', b'.', b'\n'];
/// Longest input.
const LONGEST: usize = 4096;

/// A sequence of numbers without a pattern (SplitMix64).
pub struct Random(pub u64);

impl Random {
    /// The next number.
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// The next number below `end`.
    pub fn below(&mut self, end: usize) -> usize {
        (self.word() % end as u64) as usize
    }
}

/// An input that is like one of these, or of two, or like none.
pub fn mutant(random: &mut Random, these: &[Vec<u8>]) -> Vec<u8> {
    let mut input = match random.below(8) {
        0 => (0..random.below(400)).map(|_| random.word() as u8).collect(),
        _ if these.is_empty() => Vec::new(),
        _ => these[random.below(these.len())].clone(),
    };
    for _ in 0..=random.below(6) {
        let (at, length) = (random.below(input.len() + 1), 1 + random.below(16));
        let end = (at + length).min(input.len());
        match random.below(6) {
            0 if at < input.len() => input[at] ^= 1 << random.below(8),
            1 if at < input.len() => input[at] = random.word() as u8,
            2 if at < input.len() => input[at] = ODD[random.below(ODD.len())],
            3 => drop(input.drain(at..end)),
            4 => {
                let more: Vec<u8> = input[at..end].to_vec();
                input.splice(at..at, more);
            }
            _ if !these.is_empty() => {
                let other = &these[random.below(these.len())];
                let from = random.below(other.len() + 1);
                input.splice(at..end, other[from..].iter().copied().take(4 * length));
            }
            _ => {}
        }
    }
    input.truncate(LONGEST);
    input
}
