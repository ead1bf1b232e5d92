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
    /// What the colours stand for; none where no layer knows any number.
    pub range: Option<Range>,
}

/// What the colours of an overlay stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The number of the darkest colour.
    pub least: f32,
    /// The number of the lightest colour: the greatest, or less where only a few pixels have so much.
    pub end: f32,
    /// The greatest number.
    pub most: f32,
    /// The mean.
    pub mean: f32,
}

impl Range {
    /// The range of numbers, those aside that are not finite.
    fn of(numbers: &[f32], logarithmic: bool) -> Option<Range> {
        let mut finite: Vec<f32> = numbers.iter().copied().filter(|number| number.is_finite()).collect();
        let mean = (finite.iter().copied().map(f64::from).sum::<f64>() / finite.len().max(1) as f64) as f32;
        let (least, most) = finite.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), n| (a.min(*n), b.max(*n)));
        // Counts and times begin at 0.
        let least = if logarithmic { least } else { least.min(0.0) };
        if finite.is_empty() {
            return None;
        }
        let place = ((finite.len() as f32 * MANY) as usize).min(finite.len() - 1);
        let many = *finite.select_nth_unstable_by(place, f32::total_cmp).1;
        let rare = !logarithmic && many > least && most - least > 2.0 * (many - least);
        Some(Range { least, end: if rare { many } else { most }, most, mean })
    }
}

/// The share of the pixels whose numbers are told apart at least: a few of many times as much would leave the others all
/// dark.
const MANY: f32 = 0.99;

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
    step >= BORDERED && ((at % width).is_multiple_of(step) || (at / width).is_multiple_of(step))
}

/// The frame in grey, with the overlay's numbers over it.
pub fn coloured(overlay: Overlay, frame: &Frame, numbers: &[f32]) -> Coloured {
    let logarithmic = overlay.is_logarithmic();
    let range = Range::of(numbers, logarithmic);
    let Some(Range { least, end, .. }) = range else {
        // Where no layer knows any number there is the picture to see.
        return Coloured { overlay, pixels: frame.pixels.clone(), range };
    };
    let share = |number: f32| {
        if logarithmic {
            (number / least).ln() / (end / least).ln().max(1e-6)
        } else {
            (number - least) / (end - least).max(1e-9)
        }
    };
    let borders = overlay == Overlay::Aspect(Aspect::Squares);
    let pixel = |(at, (pixel, number)): (usize, (&u32, &f32))| {
        let [_, red, green, blue] = pixel.to_be_bytes().map(f32::from);
        let grey = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
        let over = if number.is_finite() { colour(share(*number)) } else { [0.0; 3] };
        let light = if borders && on_border(at, frame.width, *number) { 0.55 } else { 1.0 };
        let [red, green, blue] = over.map(|over| ((0.25 * grey + 0.75 * over) * light) as u32);
        red << 16 | green << 8 | blue
    };
    Coloured { overlay, pixels: frame.pixels.iter().zip(numbers).enumerate().map(pixel).collect(), range }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_large_numbers_do_not_darken_the_rest() {
        let mut numbers: Vec<f32> = (0..1000).map(|n| (n % 5) as f32).collect();
        let plain = Range::of(&numbers, false).unwrap();
        assert_eq!(plain, Range { least: 0.0, end: 4.0, most: 4.0, mean: 2.0 });
        numbers.extend([84.0, f32::NAN]);
        let range = Range::of(&numbers, false).unwrap();
        assert_eq!((range.least, range.end, range.most), (0.0, 4.0, 84.0));
        assert_eq!(Range::of(&[f32::NAN], false), None);
        // Depths are on a scale of their own.
        let depths = Range::of(&[2.0, 3.0, 5000.0, f32::INFINITY], true).unwrap();
        assert_eq!((depths.least, depths.end), (2.0, 5000.0));
    }

    #[test]
    fn borders_are_drawn_around_squares_that_have_an_inside() {
        let drawn = |edge: f32| (0..16 * 16).filter(|at| on_border(*at, 16, edge)).count();
        assert_eq!([0.5, 1.0, 2.0].map(drawn), [0; 3]);
        // A row and a column of each square.
        assert_eq!([4.0, 8.0, 16.0].map(drawn), [16 * 7, 4 * 15, 31]);
    }
}
