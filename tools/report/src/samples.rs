//! A frame with a white dot wherever an eye ray was traced, as `[Intro07]` shows it, and the share of the pixels that were.

use crate::options::Result;
use crate::picture;
use paprsek::frame::{Frame, Renderer, Tile};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::path::PathBuf;

/// The frame that is shown.
#[derive(clap::Args)]
pub struct Options {
    /// The scene.
    #[arg(default_value = "spheres")]
    pub scene: String,
    /// Time of the scene, seconds.
    #[arg(default_value_t = 2.0)]
    pub time: f64,
    /// The quality: fast, default, exact or reference.
    #[arg(default_value = "fast")]
    pub quality: String,
    /// The picture.
    #[arg(long, value_name = "FILE", default_value = "docs/samples.png")]
    pub out: PathBuf,
}

impl Default for Options {
    fn default() -> Options {
        Options { scene: "spheres".into(), time: 2.0, quality: "fast".into(), out: "docs/samples.png".into() }
    }
}

/// Writes the picture.
pub fn run(Options { scene, time, quality, out }: &Options) -> Result {
    let scene = scenes::named(scene).ok_or("no such scene")?;
    let (time, quality) = (*time, Quality::named(quality).ok_or("no such quality")?);
    let mut renderer = Renderer::new(0)?;
    let mut frame = Frame::new(1280, 720);
    let stats = renderer.render(&scene, time, &quality, &mut frame);
    let Frame { width, height, pixels } = &mut frame;
    let picture = (scene.picture)(&renderer.spec(time, &quality, (*width, *height)));
    // Darker, so that the dots show.
    for pixel in pixels.iter_mut() {
        *pixel = (*pixel >> 1) & 0x7f7f7f;
    }
    for row in 0..height.div_ceil(Tile::SIZE) {
        for column in 0..width.div_ceil(Tile::SIZE) {
            let mut tile = Tile::at(column, row, *width, *height);
            for layer in &picture.layers {
                for (x, y) in layer.positions(renderer.level(), &mut tile) {
                    if (x as usize) < *width && (y as usize) < *height {
                        pixels[y as usize * *width + x as usize] = 0xffffff;
                    }
                }
            }
        }
    }
    let share = stats.samples as f64 / (*width * *height) as f64;
    picture::rgb(&frame).save(out)?;
    println!("{}: {:.1} % of the pixels traced, 1 in {:.1}: {}", scene.name, 100.0 * share, 1.0 / share, out.display());
    Ok(())
}
