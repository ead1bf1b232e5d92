//! The sky as a layer of a picture: the dome, stars, and the discs of sun and moon.

use super::cells::{self, Cells};
use super::disc::{self, Disc};
use super::dome::Dome;
use super::stars::{self, Star};
use crate::frame::{Layer, Stats, Tile};
use crate::settings::SkySettings;
use crate::view::View;
use fearless_simd::{Level, dispatch};

/// The sky of an instant in a view.
pub struct SkyLayer {
    dome: Dome,
    view: View,
    cells: Cells,
    behind: bool,
    discs: [Disc; 2],
    stars: Vec<Star>,
}

impl SkyLayer {
    /// A layer that fills every pixel, whatever was drawn before it.
    pub fn new(dome: Dome, view: &View, settings: &SkySettings) -> SkyLayer {
        let discs = [dome.sun_disc(view.camera().forward), dome.moon_disc()];
        let mut stars = Vec::new();
        if !cfg!(without = "stars") {
            stars = dome.stars(view);
        }
        SkyLayer { dome, view: *view, cells: Cells::new(view, settings), behind: false, discs, stars }
    }

    /// The same sky behind what was drawn before it: it fills what solids have left of each pixel.
    #[inline(always)] // A call would copy the layer once more.
    pub fn behind(self) -> SkyLayer {
        SkyLayer { behind: true, ..self }
    }
}

impl Layer for SkyLayer {
    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        if !self.behind {
            // What the sky is added to is read, so it must be there.
            tile.solids_matter = true;
            tile.clear();
        }
        dispatch!(level, simd => cells::fill(simd, &self.dome, &self.view, &self.cells, tile));
        if !cfg!(without = "stars") {
            stars::draw(&self.stars, tile);
        }
        for disc in self.discs.iter().filter(|_| !cfg!(without = "discs")) {
            dispatch!(level, simd => disc::draw(simd, disc, &self.view, tile));
        }
        Stats::default()
    }

    #[cfg(feature = "full")]
    fn explain(&self, _: Level, tile: &Tile, x: usize, y: usize) -> Vec<String> {
        let d = self.view.direction(x as f32 + 0.5, y as f32 + 0.5);
        let (light, open) = (self.dome.radiance(d), 1.0 - tile.coverage[(y - tile.y) * Tile::SIZE + (x - tile.x)]);
        let seen = if self.behind {
            format!("{:.0} % of it behind solids and clouds", 100.0 - open * 100.0)
        } else {
            "all of it".into()
        };
        let degrees = |cosine: f32| f64::from(cosine.clamp(-1.0, 1.0)).acos().to_degrees();
        let up = 90.0 - degrees(d.y);
        let [sun, moon] = [self.dome.sky.sun, self.dome.sky.moon].map(|disc| degrees(d.dot(disc)));
        vec![
            format!("direction {up:.2} degrees above the horizon, {sun:.2} from the sun, {moon:.2} from the moon"),
            format!("light of the air there {:.4} {:.4} {:.4}, {seen}", light.x, light.y, light.z),
        ]
    }
}
