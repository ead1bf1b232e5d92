//! Samples: how many there are in a second, in a block, and as codes.

use crate::simd::block::BLOCK;
use crate::simd::hash::{STEP, pcg};

/// Samples per second and ear.
pub const RATE: u32 = 44_100;

/// What is added to the number of a sample for the second number of its dither.
const DITHER: u32 = 1 << 31;

/// What all is louder than its notes say.
const LOUDNESS: f32 = 1.15;

/// A sample of the left and one of the right ear.
pub type Pair = [i16; 2];

/// The samples of a block for one ear. 1 is the loudest that a file can hold.
pub(super) type Block = [f32; BLOCK];

/// The 16-bit code of a sample. Dither of two codes' width with triangular density leaves no distortion of quiet sounds
/// `[Lipshitz92]`; silence stays silent.
pub(super) fn code(x: f32, number: u32) -> i16 {
    if x == 0.0 {
        return 0;
    }
    let random = |n: u32| (pcg(n) >> 8) as f32 * STEP;
    let dither = random(number) - random(number ^ DITHER);
    let code = soft(x * LOUDNESS) * 32_766.0 + dither;
    // Rounded to the nearest: truncated above 0.
    ((code + 32_768.5) as i32 - 32_768) as i16
}

/// A sample that stays within -1 and 1: as it is while it is quiet, and flat at 1.5 times the loudest.
fn soft(x: f32) -> f32 {
    let x = x.clamp(-1.5, 1.5);
    x - x * x * x * (4.0 / 27.0)
}
