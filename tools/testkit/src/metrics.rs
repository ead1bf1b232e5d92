//! How far a picture is from the true one: metrics over 8-bit codes, as a viewer gets them.
//!
//! No single number is a judge. The mean square (and RMSE and PSNR, which are made of it) spreads a few wrong pixels over the
//! whole picture; [`Difference::bad`] counts those; [`ssim`] weighs structure, which neither sees.

use paprsek::frame::Frame;

/// A pixel counts as bad when a channel is off by more than this many codes: what a viewer may see in one pixel alone.
pub const BAD: u8 = 8;

/// The difference of two pictures of the same size.
#[derive(Clone, Copy, Debug, Default)]
pub struct Difference {
    /// Mean square over pixels and channels, codes of 255.
    pub mean_square: f64,
    /// Share of the pixels that are off by more than [`BAD`] codes in a channel.
    pub bad: f64,
    /// The largest difference of a channel, codes.
    pub largest: u8,
}

impl Difference {
    /// Of two pictures of the same size.
    pub fn between(a: &Frame, b: &Frame) -> Difference {
        assert_eq!((a.width, a.height), (b.width, b.height), "pictures of different sizes");
        let pairs = || a.pixels.iter().zip(&b.pixels).map(|(a, b)| (channels(*a), channels(*b)));
        let square = |(a, b): ([u8; 3], [u8; 3])| (0..3).map(|k| u64::from(a[k].abs_diff(b[k])).pow(2)).sum::<u64>();
        let pixels = a.pixels.len() as f64;
        Difference {
            mean_square: pairs().map(square).sum::<u64>() as f64 / (3.0 * pixels),
            bad: bad_pixels(a, b) as f64 / pixels,
            largest: gaps(a, b).into_iter().max().unwrap_or(0),
        }
    }

    /// Root of the mean square, codes of 255.
    pub fn rmse(&self) -> f64 {
        self.mean_square.sqrt()
    }

    /// Peak signal-to-noise ratio in decibels; infinite for equal pictures.
    pub fn psnr(&self) -> f64 {
        psnr(self.mean_square)
    }
}

/// Peak signal-to-noise ratio in decibels of a mean square of 8-bit codes; infinite for 0.
pub fn psnr(mean_square: f64) -> f64 {
    10.0 * (255.0 * 255.0 / mean_square).log10()
}

/// Red, green and blue of a `0RGB` pixel.
pub fn channels(pixel: u32) -> [u8; 3] {
    let [_, red, green, blue] = pixel.to_be_bytes();
    [red, green, blue]
}

/// The largest difference of each pixel's channels, codes.
pub fn gaps(a: &Frame, b: &Frame) -> Vec<u8> {
    let gap = |(a, b): ([u8; 3], [u8; 3])| (0..3).map(|k| a[k].abs_diff(b[k])).max().unwrap_or(0);
    a.pixels.iter().zip(&b.pixels).map(|(a, b)| gap((channels(*a), channels(*b)))).collect()
}

/// The number of pixels that are off by more than [`BAD`] codes in a channel.
pub fn bad_pixels(a: &Frame, b: &Frame) -> usize {
    gaps(a, b).iter().filter(|gap| **gap > BAD).count()
}

/// Structural similarity of luminance with a uniform window: the mean over blocks of 8x8 pixels, 1 for equal pictures.
///
/// Z. Wang et al., "Image quality assessment: from error visibility to structural similarity", 2004.
pub fn ssim(a: &Frame, b: &Frame) -> f64 {
    const BLOCK: usize = 8;
    const PIXELS: f64 = (BLOCK * BLOCK) as f64;
    let luminance = |pixel: u32| {
        let [red, green, blue] = channels(pixel).map(f64::from);
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    };
    let (c1, c2) = ((0.01 * 255f64).powi(2), (0.03 * 255f64).powi(2));
    let (mut sum, mut blocks) = (0.0, 0.0);
    for y in (0..=a.height - BLOCK).step_by(BLOCK) {
        for x in (0..=a.width - BLOCK).step_by(BLOCK) {
            let mut moments = [0.0; 5];
            for at in (0..BLOCK * BLOCK).map(|i| (y + i / BLOCK) * a.width + x + i % BLOCK) {
                let (a, b) = (luminance(a.pixels[at]), luminance(b.pixels[at]));
                for (moment, value) in moments.iter_mut().zip([a, b, a * a, b * b, a * b]) {
                    *moment += value / PIXELS;
                }
            }
            let [a, b, aa, bb, ab] = moments;
            let (va, vb, covariance) = (aa - a * a, bb - b * b, ab - a * b);
            sum += (2.0 * a * b + c1) * (2.0 * covariance + c2) / ((a * a + b * b + c1) * (va + vb + c2));
            blocks += 1.0;
        }
    }
    sum / blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(codes: [u8; 64]) -> Frame {
        Frame { width: 8, height: 8, pixels: codes.iter().map(|code| u32::from(*code) * 0x01_0101).collect() }
    }

    #[test]
    fn equal_pictures_have_no_difference() {
        let frame = grey(std::array::from_fn(|i| 3 * i as u8));
        let difference = Difference::between(&frame, &frame);
        assert_eq!((difference.mean_square, difference.bad, difference.largest), (0.0, 0.0, 0));
        assert_eq!((difference.psnr(), ssim(&frame, &frame)), (f64::INFINITY, 1.0));
    }

    #[test]
    fn one_wrong_pixel_of_64_is_counted_in_every_metric() {
        let (truth, mut wrong) = (grey([100; 64]), grey([100; 64]));
        wrong.pixels[9] = 0x0064_6c4c;
        let difference = Difference::between(&wrong, &truth);
        // 8 codes in green, 24 in blue.
        assert_eq!(difference.mean_square, (64.0 + 576.0) / (3.0 * 64.0));
        assert_eq!((difference.bad, difference.largest), (1.0 / 64.0, 24));
        assert!((difference.psnr() - 20.0 * (255.0 / difference.rmse()).log10()).abs() < 1e-9);
        assert!(ssim(&wrong, &truth) < 1.0);
        // A gap of 8 codes alone is not bad.
        wrong.pixels[9] = 0x0064_6c64;
        assert_eq!(bad_pixels(&wrong, &truth), 0);
    }
}
