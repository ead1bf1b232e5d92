//! Writes a frame with a white dot wherever an eye ray was traced, as in the thesis, and says what share of the pixels
//! that is.
//!
//! `cargo run --release --example samples -- [SCENE [SECONDS [QUALITY [FILE.png]]]]`

use paprsek::frame::{Frame, Renderer, Tile};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::error::Error;

#[path = "common/picture.rs"]
mod picture;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let argument = |n: usize, default: &str| arguments.get(n).map_or(default, String::as_str).to_owned();
    let scene = scenes::named(&argument(0, "spheres")).ok_or("no such scene")?;
    let time: f64 = argument(1, "2").parse()?;
    let quality = Quality::named(&argument(2, "fast")).ok_or("no such quality")?;
    let file = argument(3, "samples.png");

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
    picture::rgb(&frame).save(&file)?;
    println!("{}: {:.1} % of the pixels traced, 1 in {:.1}: {file}", scene.name, 100.0 * share, 1.0 / share);
    Ok(())
}
