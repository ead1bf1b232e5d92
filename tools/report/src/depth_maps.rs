//! What lights see: every map of a scene's lights as a grey picture, the nearer the lighter, one row per light.
//!
//! The README's picture has `day 35`, where the sun is low, and `shadow-cube 2`. A row goes from the finest map to the
//! coarsest, or through the faces of a cube: +x -x +y -y +z -z. Texels without a surface are black; the grey of each map goes
//! from its farthest texel to its nearest.

use crate::options::Result;
use image::{GrayImage, Luma, imageops};
use paprsek::frame::{Frame, Renderer};
use paprsek::raster::RasterMemory;
use paprsek::raster::depth_map::{DepthMap, EMPTY};
use paprsek::scenes;
use paprsek::settings::Quality;
use std::path::PathBuf;

const SIZE: (usize, usize) = (1280, 720);
/// Edge of a map's picture, and the gap between two, pixels.
const EDGE: usize = 256;
const GAP: usize = 4;
/// Grey of the farthest texel.
const DARKEST: f32 = 24.0;

/// Whose maps are shown.
#[derive(clap::Args)]
pub struct Options {
    /// Scenes and their seconds: SCENE TIME [SCENE TIME ...].
    #[arg(value_name = "SCENE TIME", default_values = ["day", "35", "shadow-cube", "2"])]
    pub shots: Vec<String>,
    /// The picture.
    #[arg(long, value_name = "FILE", default_value = "docs/depth.png")]
    pub out: PathBuf,
}

impl Default for Options {
    fn default() -> Options {
        let shots = ["day", "35", "shadow-cube", "2"].map(String::from);
        Options { shots: shots.into(), out: "docs/depth.png".into() }
    }
}

/// Writes the picture.
pub fn run(Options { shots, out }: &Options) -> Result {
    if shots.len() % 2 != 0 {
        return Err("each scene needs its time".into());
    }
    let mut rows = Vec::new();
    for shot in shots.chunks_exact(2) {
        let scene = scenes::named(&shot[0]).ok_or(format!("there is no scene '{}'", shot[0]))?;
        // A renderer of its own, so that no maps of another scene are kept.
        let mut renderer = Renderer::new(0)?;
        renderer.render(&scene, shot[1].parse()?, &Quality::FAST, &mut Frame::new(SIZE.0, SIZE.1));
        let memory = renderer.cache().get::<RasterMemory>();
        let memory = memory.lock();
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

/// A view of a map; a pixel shows the mean of its texels.
fn grey(map: &DepthMap, view: usize) -> GrayImage {
    let texels = || (0..map.size * map.size).map(|i| map.at(view, i % map.size, i / map.size));
    let there = || texels().filter(|&near| near > EMPTY);
    let (far, near) = (there().fold(f32::MAX, f32::min), there().fold(f32::MIN, f32::max));
    let scale = (255.0 - DARKEST) / (near - far).max(1e-9);
    // A texel of a map that is smaller than its picture covers several pixels.
    let step = (map.size / EDGE).max(1);
    GrayImage::from_fn(EDGE as u32, EDGE as u32, |x, y| {
        let [left, top] = [x, y].map(|n| n as usize * map.size / EDGE);
        let cell = (0..step * step).map(|i| map.at(view, left + i % step, top + i / step));
        let light: f32 = cell.map(|near| if near > EMPTY { DARKEST + (near - far) * scale } else { 0.0 }).sum();
        Luma([(light / (step * step) as f32).round() as u8])
    })
}
