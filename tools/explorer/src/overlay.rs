//! Overlays: a number per pixel of what the algorithms do, in colours over the picture in grey.

use fearless_simd::Level;
use paprsek::frame::inspect::{Aspect, each};
use paprsek::frame::{Frame, Layer, Tile};
use std::time::Duration;

/// What is shown over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Overlay {
    /// The time that a tile takes, microseconds.
    Time,
    /// The distance of solids along the view axis, metres.
    Depth,
    /// The share of the pixel that solids and clouds cover.
    Coverage,
    /// What layers tell.
    Aspect(Aspect),
}

impl Overlay {
    /// All overlays.
    pub fn all() -> Vec<Overlay> {
        let own = [Overlay::Time, Overlay::Depth, Overlay::Coverage];
        own.into_iter().chain(Aspect::ALL.map(|row| Overlay::Aspect(row.0))).collect()
    }

    /// The next overlay, or the one before; none after the last.
    pub fn next(now: Option<Overlay>, by: i32) -> Option<Overlay> {
        let all = Overlay::all();
        let place = now.and_then(|now| all.iter().position(|each| *each == now)).map_or(0, |place| place as i32 + 1);
        let next = (place + by).rem_euclid(all.len() as i32 + 1);
        (next > 0).then(|| all[next as usize - 1])
    }

    /// Its name, and what the number is.
    pub fn about(self) -> (&'static str, &'static str) {
        match self {
            Overlay::Time => ("tile times", "microseconds of the tile"),
            Overlay::Depth => ("depth", "metres to solids"),
            Overlay::Coverage => ("coverage", "share covered by solids and clouds"),
            Overlay::Aspect(aspect) => {
                let row = Aspect::ALL.iter().find(|row| row.0 == aspect);
                row.map_or(("", ""), |row| (row.1, row.2))
            }
        }
    }

    /// The numbers of a tile that all layers have drawn in that time; none where no layer knows any.
    pub fn numbers(self, layers: &[Box<dyn Layer>], level: Level, tile: &mut Tile, time: Duration) -> Option<Vec<f32>> {
        let at = |tile: &Tile, x: usize, y: usize| (y - tile.y) * Tile::SIZE + x - tile.x;
        match self {
            Overlay::Time => Some(each(tile, |_, _| time.as_secs_f32() * 1e6)),
            Overlay::Depth => Some(each(tile, |x, y| 1.0 / tile.inv_depth[at(tile, x, y)])),
            Overlay::Coverage => Some(each(tile, |x, y| tile.coverage[at(tile, x, y)])),
            Overlay::Aspect(aspect) => {
                let mut sum: Option<Vec<f32>> = None;
                for layer in layers {
                    if let Some(numbers) = layer.inspect(aspect, level, tile) {
                        let sum = sum.get_or_insert_with(|| vec![0.0; numbers.len()]);
                        sum.iter_mut().zip(numbers).for_each(|(sum, number)| *sum += number);
                    }
                }
                sum
            }
        }
    }

    /// Whether its colours go by the logarithm.
    fn is_logarithmic(self) -> bool {
        matches!(self, Overlay::Depth | Overlay::Aspect(Aspect::Squares))
    }
}

/// A picture in the colours of an overlay.
pub struct Coloured {
    /// The overlay.
    pub overlay: Overlay,
    /// The pixels.
    pub pixels: Vec<u32>,
    /// The least and the greatest number, and the mean; none where no layer knows any.
    pub range: Option<[f32; 3]>,
}

/// Colours of the scale from the least number to the greatest, evenly apart: from dark blue over green to light yellow,
/// lighter all the way, so that they are told apart without colours too.
const SCALE: [[f32; 3]; 6] = [
    [48.0, 18.0, 92.0],
    [62.0, 74.0, 158.0],
    [38.0, 130.0, 142.0],
    [64.0, 184.0, 112.0],
    [172.0, 216.0, 60.0],
    [254.0, 244.0, 150.0],
];

/// The colour of a share of the scale, `0RGB`.
pub fn colour(share: f32) -> [f32; 3] {
    let along = share.clamp(0.0, 1.0) * (SCALE.len() - 1) as f32;
    let from = (along as usize).min(SCALE.len() - 2);
    std::array::from_fn(|k| SCALE[from][k] + (SCALE[from + 1][k] - SCALE[from][k]) * (along - from as f32))
}

/// Edge of the smallest square of the tracer whose border is drawn, pixels: smaller ones would be all border.
const BORDERED: usize = 4;

/// Whether a pixel is on the upper or left border of a square with that edge. Squares lie on multiples of their edges.
fn on_border(at: usize, width: usize, edge: f32) -> bool {
    let step = edge as usize;
    step >= BORDERED && (at % width % step == 0 || at / width % step == 0)
}

/// The frame in grey, with the overlay's numbers over it.
pub fn coloured(overlay: Overlay, frame: &Frame, numbers: &[f32]) -> Coloured {
    let finite = || numbers.iter().copied().filter(|number| number.is_finite());
    let (least, most) = finite().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), n| (a.min(n), b.max(n)));
    let known = least <= most;
    // Counts and times begin at 0.
    let base = if overlay.is_logarithmic() { least } else { least.min(0.0) };
    let share = |number: f32| {
        if overlay.is_logarithmic() {
            (number / base).ln() / (most / base).ln().max(1e-6)
        } else {
            (number - base) / (most - base).max(1e-9)
        }
    };
    let borders = overlay == Overlay::Aspect(Aspect::Squares);
    let pixel = |(at, (pixel, number)): (usize, (&u32, &f32))| {
        let [_, red, green, blue] = pixel.to_be_bytes().map(f32::from);
        let grey = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        let over = if number.is_finite() { colour(share(*number)) } else { [0.0; 3] };
        let light = if borders && on_border(at, frame.width, *number) { 0.45 } else { 1.0 };
        let [red, green, blue] = over.map(|over| ((0.25 * grey + 0.75 * over) * light) as u32);
        red << 16 | green << 8 | blue
    };
    let mean = finite().map(f64::from).sum::<f64>() / (finite().count().max(1)) as f64;
    Coloured {
        overlay,
        pixels: frame.pixels.iter().zip(numbers).enumerate().map(pixel).collect(),
        range: known.then_some([base, most, mean as f32]),
    }
}
