//! The error of a picture against the truth, by several metrics, since none of them is a judge by itself: PSNR, SSIM
//! `[Wang04]`, FLIP `[Andersson20]`, and the share of bad pixels.

use crate::picture::rgb;
use image::RgbImage;
use image_compare::{Algorithm, rgb_similarity_structure};
use paprsek::frame::Frame;
use testkit::flip::{self, flip};
use testkit::metrics::{Difference, psnr};

/// The error of a picture, or the mean over several pictures.
#[derive(Clone, Copy, Debug, Default)]
pub struct Error {
    /// Mean square over pixels and channels, codes of 255, from which RMSE and PSNR follow.
    pub square: f64,
    /// Mean structural similarity of blocks of 8x8 pixels, of the worst channel.
    pub ssim: f64,
    /// FLIP at the default viewing distance, the mean over the pixels.
    pub flip: f64,
    /// FLIP, the 99th percentile of the pixels.
    pub flip99: f64,
    /// Share of the pixels that are off by more than 8 codes of 255 in a channel.
    pub bad: f64,
}

impl Error {
    /// The error of `picture` against `truth`, which have the same size.
    pub fn between(picture: &Frame, truth: &Frame) -> Error {
        let Difference { mean_square: square, bad, .. } = Difference::between(picture, truth);
        let mut flips = flip(picture, truth);
        let (picture, truth) = (rgb(picture), rgb(truth));
        let ssim = rgb_similarity_structure(&Algorithm::MSSIMSimple, &truth, &picture).expect("equal sizes").score;
        let mean = flip::mean(&flips);
        let place = flips.len() * 99 / 100;
        let (_, flip99, _) = flips.select_nth_unstable_by(place, f32::total_cmp);
        Error { square, ssim, flip: mean, flip99: f64::from(*flip99), bad }
    }

    /// The mean of several pictures' errors. Squares are averaged before the root, so that PSNR is that of all pixels together.
    pub fn mean(errors: &[Error]) -> Error {
        let mean = |of: fn(&Error) -> f64| errors.iter().map(of).sum::<f64>() / errors.len() as f64;
        Error {
            square: mean(|e| e.square),
            ssim: mean(|e| e.ssim),
            flip: mean(|e| e.flip),
            flip99: mean(|e| e.flip99),
            bad: mean(|e| e.bad),
        }
    }

    /// Root of the mean square, codes of 255.
    pub fn rmse(&self) -> f64 {
        self.square.sqrt()
    }

    /// Peak signal-to-noise ratio, decibels; infinite for equal pictures.
    pub fn psnr(&self) -> f64 {
        psnr(self.square)
    }
}

/// FLIP as a picture, black where nothing is seen to yellow at 1.
pub fn flip_map(picture: &Frame, truth: &Frame) -> RgbImage {
    let colours = flip(picture, truth).into_iter().flat_map(|flip| {
        let colour = colorous::MAGMA.eval_continuous(f64::from(flip.clamp(0.0, 1.0)));
        [colour.r, colour.g, colour.b]
    });
    let (width, height) = (truth.width as u32, truth.height as u32);
    RgbImage::from_raw(width, height, colours.collect()).expect("three bytes per pixel")
}
