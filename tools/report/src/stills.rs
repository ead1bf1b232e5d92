//! Makes the stills of the README: a contact sheet of the show, and the pictures of each part.
//!
//! It takes 15 seconds on two cores. Frames are those that `--capture` writes at 1280x720 and `default`, scaled down where a
//! picture has smaller stills. The same revision makes the same bytes, so after a change to a scene `git status` shows which
//! pictures are outdated.

use crate::options::Result;
use crate::picture;
use image::codecs::png::{CompressionType, FilterType as RowFilter, PngEncoder};
use image::imageops::{self, FilterType};
use image::{Rgb, RgbImage};
use paprsek::frame::Scene;
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::scenes::show::intro;
use paprsek::settings::Quality;
use std::fs::File;
use std::path::{Path, PathBuf};

const SIZE: (usize, usize) = (1280, 720);
/// The gap between two stills, pixels, and its colour.
const GAP: u32 = 4;
const DARK: Rgb<u8> = Rgb([16, 16, 16]);

/// A picture: its file name, the scene, the instants in reading order (seconds), the size of a still (pixels), and the number
/// of stills per row.
type Sheet<'a> = (&'a str, Scene, &'a [f64], (u32, u32), u32);

const DAY: &[f64] = &[2.5, 6.25, 20.0, 36.25, 40.0, 47.5, 122.5, 126.25, 140.0, 156.25, 160.0, 167.5];
const SHEETS: [Sheet; 8] = [
    ("lumen.png", scenes::show::lumen::LUMEN, &[14.0], (1280, 720), 1),
    ("dawn.png", scenes::show::lumen::LUMEN, &[9.2], (960, 540), 1),
    ("dance.png", scenes::show::lumen::LUMEN, &[43.9], (960, 540), 1),
    ("sunset.png", scenes::show::lumen::LUMEN, &[51.5], (960, 540), 1),
    ("day.png", scenes::show::day::DAY, DAY, (336, 189), 3),
    ("clouds.png", scenes::show::clouds::CLOUDS, &[1.8, 10.0, 28.0, 45.0], (640, 360), 2),
    ("snowfall.png", scenes::show::snowfall::SNOWFALL, &[5.0, 12.0, 16.0, 26.0], (640, 360), 2),
    ("torches.png", scenes::show::torches::TORCHES, &[2.0, 7.0, 14.0, 25.0], (640, 360), 2),
];

/// Seconds from one still of the contact sheet to the next, and the least distance to a cut, where the show is dark.
const STEP: f64 = 5.0;
const MARGIN: f64 = 1.0;

/// Where the stills go.
#[derive(clap::Args)]
pub struct Options {
    /// Draw small frames and scale them up: to see that the report works.
    #[arg(long)]
    pub quick: bool,
    /// Directory of the stills.
    #[arg(long, value_name = "DIR", default_value = "docs")]
    pub out: PathBuf,
}

/// Writes all stills.
pub fn run(options: &Options) -> Result {
    let size = if options.quick { (SIZE.0 / 4, SIZE.1 / 4) } else { SIZE };
    let mut renderer = Renderer::new(0)?;
    let show = show();
    let contact: Sheet = ("show.png", scenes::INTRO, &show, (304, 171), 5);
    for sheet in [contact].iter().chain(&SHEETS) {
        let file = options.out.join(sheet.0);
        save(&draw(&mut renderer, sheet, size), &file).map_err(|error| format!("{}: {error}", file.display()))?;
        println!("{}: {} at {:?} s", file.display(), sheet.1.name, sheet.2);
    }
    Ok(())
}

/// The instants of the contact sheet, seconds: even steps, moved away from cuts and from the end. At 5 s the title is whole.
fn show() -> Vec<f64> {
    let end = scenes::INTRO.duration;
    let cuts: Vec<f64> = intro::PARTS[1..].iter().map(|&(start, _)| start).chain([end]).collect();
    let away = |instant: f64| {
        let near = cuts.iter().find(|&cut| (instant - cut).abs() < MARGIN);
        near.map_or(instant, |cut| if instant < *cut { cut - MARGIN } else { cut + MARGIN })
    };
    (1..).map(|n| f64::from(n) * STEP).take_while(|&instant| instant < end).map(away).collect()
}

fn draw(
    renderer: &mut Renderer,
    &(_, scene, instants, (width, height), columns): &Sheet,
    size: (usize, usize),
) -> RgbImage {
    let rows = (instants.len() as u32).div_ceil(columns);
    let mut sheet = RgbImage::from_pixel(columns * (width + GAP) - GAP, rows * (height + GAP) - GAP, DARK);
    let mut frame = Frame::new(size.0, size.1);
    for (n, &instant) in (0..).zip(instants) {
        renderer.render(&scene, instant, &Quality::DEFAULT, &mut frame);
        let still = imageops::resize(&picture::rgb(&frame), width, height, FilterType::Lanczos3);
        let (x, y) = (n % columns * (width + GAP), n / columns * (height + GAP));
        imageops::replace(&mut sheet, &still, x.into(), y.into());
    }
    sheet
}

/// Writes a picture, compressed as well as the crate can, since pictures are in the repository. It is not buffered, since a
/// buffer loses the last error when it is dropped.
pub fn save(picture: &RgbImage, file: &Path) -> Result {
    let encoder = PngEncoder::new_with_quality(File::create(file)?, CompressionType::Best, RowFilter::Adaptive);
    Ok(picture.write_with_encoder(encoder)?)
}
