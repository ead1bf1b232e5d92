//! Codes the second stage of the unpacker for the first one (`stub/src/first.s`), which must be small above all:
//! each context counts zeros and ones, and the sums of all counts, those of longer contexts weighing more, are the
//! odds (as in Mentor's Crinkler, after Mahoney's PAQ1). 6.1 kB take 4.0 and 284 bytes of decoder.
//!
//! Tried: twice the weight for a context that has seen one kind of bit only, 0.5 % less but for 10 bytes of decoder;
//! halved counts rounded down, 5 % more; products of odds instead of sums, 1 % more; a quarter of the table, 2 % more;
//! LZMA without a header, 10 % more; the full model, 14 % less, but its 4 kB would have to come first.

use crate::encoder::Encoder;
use pack_model::first::{CONTEXTS, MULTIPLIER, PRIOR, TABLE_BITS};

/// The hash of the bits so far below a leading one and of those bytes before that `context` names, and their number.
fn hash(context: u8, partial: usize, before: &[u8]) -> (u32, u32) {
    let step = |h: u32, byte: u32| (h ^ byte).wrapping_mul(MULTIPLIER);
    let named = (0..8usize).filter(|i| context << i & 128 != 0);
    let byte = |i| before.len().checked_sub(i + 1).map_or(0, |at| before[at] as u32);
    (named.fold(step(context as u32, partial as u32), |h, i| step(h, byte(i))), context.count_ones() + 1)
}

/// Codes `text`.
pub fn compress(text: &[u8]) -> Vec<u8> {
    let mut counts = vec![[0u16; 2]; 1 << TABLE_BITS];
    let mut encoder = Encoder::default();
    for (at, byte) in text.iter().enumerate() {
        let mut partial = 1;
        for i in (0..8).rev() {
            let bit = (byte >> i & 1) as usize;
            let found = CONTEXTS.to_le_bytes().map(|context| hash(context, partial, &text[..at]));
            let mut sums = [PRIOR; 2];
            for (hash, weight) in found {
                let pair = counts[(hash >> (32 - TABLE_BITS)) as usize];
                sums = [0, 1].map(|i| sums[i] + ((pair[i] as u32) << weight));
            }
            encoder.encode(bit == 1, sums);
            // As the decoder does, from the last context to the first, some of which may share a pair.
            for (hash, _) in found.into_iter().rev() {
                let pair = &mut counts[(hash >> (32 - TABLE_BITS)) as usize];
                pair[bit] += 1;
                pair[1 - bit] = pair[1 - bit].div_ceil(2);
            }
            partial = partial << 1 | bit;
        }
    }
    encoder.finish()
}
