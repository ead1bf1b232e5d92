//! The sound of the show to look at: its levels and its spectrum over time, and how loud each part is.

use crate::options::{Common, Result};
use ebur128::{EbuR128, Mode};
use image::{Rgb, RgbImage};
use paprsek::scenes::INTRO;
use paprsek::scenes::show::intro::PARTS;
use paprsek::scenes::show::score::score;
use paprsek::sound::{Pair, RATE};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::fmt::Write;
use std::fs;
use std::sync::Arc;
use std::time::Instant;

/// Columns of the picture per second.
const COLUMNS: usize = 5;
/// Rows of the levels of each ear, and of the spectrum.
const LEVELS: u32 = 50;
const ROWS: u32 = 200;
/// Samples of a spectrum: 0.19 s, so that lines are 5.4 Hz apart.
const WINDOW: usize = 1 << 13;
/// The lowest and the highest frequency shown, hertz.
const LOWEST: f64 = 40.0;
const HIGHEST: f64 = 16_000.0;
/// The faintest that is shown, decibels below the loudest sine.
const FAINTEST: f64 = 100.0;

/// Writes `sound.png` and `sound.md`.
pub fn run(options: &Common) -> Result {
    let length = INTRO.duration as usize * RATE as usize;
    let (mut samples, began) = (vec![[0; 2]; length], Instant::now());
    score().samples(0, &mut samples);
    let each = began.elapsed().as_secs_f64() / INTRO.duration;
    fs::create_dir_all(&options.out)?;
    picture(&samples).save(options.out.join("sound.png"))?;
    let mut text = format!(
        "# The sound of the show\n\nWritten by `{}`; not edited by hand.\n\n![Levels and spectrum](sound.png)\n\n\
         Above the levels of the left and the right ear, below the spectrum of both from {LOWEST} Hz to {} kHz by the \
         logarithm, as far as {FAINTEST} dB below the loudest sine; the lines are where parts begin. A second takes {:.1} ms \
         of one core of {} here.\n\n| from, s | LUFS | peak, dB |\n|--:|--:|--:|\n",
        options.command("sound"),
        HIGHEST / 1000.0,
        each * 1000.0,
        crate::machine::machine(),
    );
    let ends = PARTS.iter().skip(1).map(|part| part.0).chain([INTRO.duration]);
    for (from, to) in PARTS.iter().map(|part| part.0).zip(ends) {
        row(&mut text, &from.to_string(), &samples[at(from)..at(to)])?;
    }
    row(&mut text, "all", &samples)?;
    fs::write(options.out.join("sound.md"), text)?;
    Ok(())
}

/// The number of the sample at a time.
fn at(time: f64) -> usize {
    (time * f64::from(RATE)) as usize
}

/// Loudness `[EBU128]` and true peak of a piece.
fn row(text: &mut String, name: &str, samples: &[Pair]) -> Result {
    let mut meter = EbuR128::new(2, RATE, Mode::I | Mode::TRUE_PEAK)?;
    meter.add_frames_i16(samples.as_flattened())?;
    let peak = meter.true_peak(0)?.max(meter.true_peak(1)?);
    writeln!(text, "| {name} | {:.1} | {:.1} |", meter.loudness_global()?, 20.0 * peak.log10())?;
    Ok(())
}

/// The levels, and the spectrum below them.
fn picture(samples: &[Pair]) -> RgbImage {
    let step = RATE as usize / COLUMNS;
    let columns = samples.len() / step;
    let mut picture = RgbImage::from_pixel(columns as u32, 2 * LEVELS + ROWS, Rgb([12, 12, 16]));
    let fft = FftPlanner::new().plan_fft_forward(WINDOW);
    for (x, piece) in samples.chunks_exact(step).enumerate() {
        for ear in 0..2 {
            let (least, most) = piece.iter().fold((0, 0), |(least, most), s| (least.min(s[ear]), most.max(s[ear])));
            let row = |code: i16| ((0.5 - f64::from(code) / 65_536.0) * f64::from(LEVELS - 1)) as u32;
            for y in row(most)..=row(least) {
                picture.put_pixel(x as u32, ear as u32 * LEVELS + y, Rgb([150, 190, 230]));
            }
        }
        let spectrum = spectrum(samples, (x * step + step / 2).saturating_sub(WINDOW / 2), &fft);
        for y in 0..ROWS {
            // From the row's lowest frequency to its highest, the loudest line.
            let line = |y: u32| {
                let frequency = LOWEST * (HIGHEST / LOWEST).powf(1.0 - f64::from(y) / f64::from(ROWS));
                frequency / f64::from(RATE) * WINDOW as f64
            };
            let (from, to) = (line(y + 1) as usize, line(y) as usize);
            let loudest = spectrum[from..=to].iter().copied().fold(f64::MIN, f64::max);
            let shade = colorous::INFERNO.eval_continuous((1.0 + loudest / FAINTEST).clamp(0.0, 1.0));
            picture.put_pixel(x as u32, 2 * LEVELS + y, Rgb([shade.r, shade.g, shade.b]));
        }
    }
    for (start, _) in PARTS {
        for y in 0..picture.height() {
            picture.put_pixel((start * COLUMNS as f64) as u32, y, Rgb([110, 110, 110]));
        }
    }
    picture
}

/// Decibels below the loudest sine of each line of the spectrum of both ears from a sample on, under Hann's window.
fn spectrum(samples: &[Pair], first: usize, fft: &Arc<dyn Fft<f64>>) -> Vec<f64> {
    let mut lines: Vec<_> = (0..WINDOW)
        .map(|i| {
            let [left, right] = samples.get(first + i).map_or([0.0; 2], |pair| pair.map(f64::from));
            let hann = 0.5 - 0.5 * (i as f64 / WINDOW as f64 * std::f64::consts::TAU).cos();
            Complex::new((left + right) / 65_536.0 * hann, 0.0)
        })
        .collect();
    fft.process(&mut lines);
    // A sine's line has a quarter of the window's length.
    lines[..WINDOW / 2].iter().map(|line| 20.0 * (line.norm() / (WINDOW as f64 / 4.0) + 1e-12).log10()).collect()
}
