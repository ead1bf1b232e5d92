//! How much two pictures differ.

use paprsek::frame::Frame;

/// A pixel counts as off when a channel is, by more than this many codes: what a viewer may see in one pixel alone.
pub const OFF: u8 = 8;

/// The difference of two pictures of the same size.
#[derive(Clone, Copy, Debug)]
pub struct Difference {
    /// Mean square over pixels and channels, codes of 255.
    pub square: f64,
    /// Share of the pixels that are off.
    pub off: f64,
}

impl Difference {
    /// Of two pictures of the same size.
    pub fn between(ours: &Frame, truth: &Frame) -> Difference {
        let (mut square, mut off) = (0u64, 0u64);
        for (a, b) in ours.pixels.iter().zip(&truth.pixels) {
            let gaps = [0, 1, 2].map(|k| a.to_be_bytes()[k + 1].abs_diff(b.to_be_bytes()[k + 1]));
            square += gaps.iter().map(|gap| u64::from(*gap).pow(2)).sum::<u64>();
            off += u64::from(gaps.iter().any(|gap| *gap > OFF));
        }
        let pixels = ours.pixels.len() as f64;
        Difference { square: square as f64 / (3.0 * pixels), off: off as f64 / pixels }
    }
}

/// Peak signal to noise, decibels, of a mean square of 8-bit codes; infinite for equal pictures.
pub fn psnr(square: f64) -> f64 {
    10.0 * (255.0 * 255.0 / square).log10()
}
