//! What lights see: every map of a scene's lights as a grey picture, the nearer the lighter, a light a row.
//!
//! `cargo run --release --example depth -- SCENE TIME [SCENE TIME ...] OUT.png`; that of the README has `day 35`, where the
//! sun is low, and `shadow-cube 2`. From the finest map to the coarsest, or the cube's faces +x -x +y -y +z -z. Black is
//! where nothing is; each map's grey goes from its farthest texel to its nearest.

use image::{GrayImage, Luma, imageops};
use paprsek::frame::cache::lock;
use paprsek::frame::{Frame, Renderer};
use paprsek::raster::RasterMemory;
use paprsek::raster::depth_map::{DepthMap, EMPTY};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::error::Error;

const SIZE: (usize, usize) = (1280, 720);
/// Pixels of a map's picture along an edge, and between two.
const EDGE: usize = 256;
const GAP: usize = 4;
/// Grey of the farthest texel.
const DARKEST: f32 = 24.0;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((out, shots)) = arguments.split_last().filter(|(_, shots)| !shots.is_empty() && shots.len() % 2 == 0)
    else {
        return Err("usage: depth SCENE TIME [SCENE TIME ...] OUT.png".into());
    };
    let mut rows = Vec::new();
    for shot in shots.chunks_exact(2) {
        let scene = scenes::named(&shot[0]).ok_or(format!("there is no scene '{}'", shot[0]))?;
        // A renderer of its own, so that no maps of another scene are kept.
        let mut renderer = Renderer::new(0)?;
        renderer.render(&scene, shot[1].parse()?, &Quality::FAST, &mut Frame::new(SIZE.0, SIZE.1));
        let memory = renderer.cache().get::<RasterMemory>();
        let memory = lock(&memory);
        let mut maps: Vec<_> = memory.maps.iter().collect();
        maps.sort_by_key(|(key, _)| key.slot);
        for (key, map) in maps {
            rows.push((0..key.views.len()).map(|view| grey(map, view)).collect::<Vec<_>>());
        }
    }
    let columns = rows.iter().map(Vec::len).max().filter(|&count| count > 0).ok_or("no light has a map")?;
    let pitch = EDGE + GAP;
    let mut sheet =
        GrayImage::from_pixel((columns * pitch - GAP) as u32, (rows.len() * pitch - GAP) as u32, Luma([96]));
    for (y, row) in rows.iter().enumerate() {
        for (x, picture) in row.iter().enumerate() {
            imageops::replace(&mut sheet, picture, (x * pitch) as i64, (y * pitch) as i64);
        }
    }
    Ok(sheet.save(out)?)
}

/// A view of a map; of several texels in a pixel the mean.
fn grey(map: &DepthMap, view: usize) -> GrayImage {
    let texels = || (0..map.size * map.size).map(|i| map.at(view, i % map.size, i / map.size));
    let there = || texels().filter(|&near| near > EMPTY);
    let (far, near) = (there().fold(f32::MAX, f32::min), there().fold(f32::MIN, f32::max));
    let scale = (255.0 - DARKEST) / (near - far).max(1e-9);
    // Of maps that are smaller than their picture, a texel is several pixels.
    let step = (map.size / EDGE).max(1);
    GrayImage::from_fn(EDGE as u32, EDGE as u32, |x, y| {
        let [left, top] = [x, y].map(|n| n as usize * map.size / EDGE);
        let cell = (0..step * step).map(|i| map.at(view, left + i % step, top + i / step));
        let light: f32 = cell.map(|near| if near > EMPTY { DARKEST + (near - far) * scale } else { 0.0 }).sum();
        Luma([(light / (step * step) as f32).round() as u8])
    })
}
