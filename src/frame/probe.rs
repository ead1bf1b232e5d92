//! How one pixel of a frame came to be, in words.

use super::encode::encode;
use super::renderer::{Options, Renderer};
use super::scene::Scene;
use super::tile::Tile;
use fearless_simd::{Level, dispatch};
use std::fmt::Write;

/// Tells how the pixel at column `x` and row `y` of a frame of `width` x `height` pixels comes to be: what each layer
/// makes of it and why, and its code. One eye, whatever the options say of two. Panics where there is no such pixel.
pub fn probe(
    renderer: &Renderer,
    scene: &Scene,
    time: f64,
    options: &Options,
    (width, height): (usize, usize),
    (x, y): (usize, usize),
) -> String {
    assert!(x < width && y < height, "a pixel of the frame");
    let mut spec = renderer.spec(time, options.quality, (width, height));
    spec.values = options.values;
    let mut picture = (scene.picture)(&spec);
    for layer in &mut picture.layers {
        layer.prepare(renderer.workers(), renderer.cache());
    }
    let (level, count) = (renderer.level(), picture.layers.len());
    let mut tile = Tile::at(x / Tile::SIZE, y / Tile::SIZE, width, height);
    for layer in &picture.layers {
        layer.foresee(level, &mut tile);
    }
    let at = y % Tile::SIZE * Tile::SIZE + x % Tile::SIZE;
    let mut text = format!("{} at {time} s, {width}x{height}, pixel {x},{y}\n", scene.name);
    for (index, layer) in picture.layers.iter().enumerate() {
        tile.solids_matter = index + 1 < count;
        layer.draw(level, &mut tile);
        let _ = write!(text, "{}: light {}", layer.name(), light(&tile, at));
        if tile.solids_matter && tile.inv_depth[at] > 0.0 {
            let (depth, covered) = (1.0 / tile.inv_depth[at], tile.coverage[at] * 100.0);
            let _ = write!(text, ", solids at {depth:.3} m over {covered:.0} %");
        }
        text.push('\n');
        for line in layer.explain(level, &tile, x, y) {
            let _ = writeln!(text, "  {line}");
        }
    }
    let mut code = [0];
    let (r, g, b) = (&tile.red[at..=at], &tile.green[at..=at], &tile.blue[at..=at]);
    dispatch!(Level::baseline(), simd => encode(simd, picture.transfer, x as u32, y as u32, r, g, b, &mut code));
    let [_, red, green, blue] = code[0].to_be_bytes();
    let _ = writeln!(text, "code {red} {green} {blue}, {:?}", picture.transfer);
    text
}

/// The light of a pixel as words.
fn light(tile: &Tile, at: usize) -> String {
    format!("{:.4} {:.4} {:.4}", tile.red[at], tile.green[at], tile.blue[at])
}
