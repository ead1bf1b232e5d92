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
}
