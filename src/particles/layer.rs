//! Particles as a layer of a picture.

use super::blend::{blend, draw};
use super::chunk::Chunk;
use super::emitter::Emitter;
use super::screen::Screen;
#[cfg(feature = "full")]
use super::sprite::Sprite;
use super::sprite::{LIGHT, PASSES, PLANES};
#[cfg(feature = "full")]
use crate::frame::inspect::{Aspect, each};
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::settings::ParticleSettings;
use crate::view::View;
use fearless_simd::{Level, Simd, dispatch};
use glam::Vec3A;

/// Sprites of a pixel that are told of one by one, nearest first.
#[cfg(feature = "full")]
const NAMED: usize = 5;

/// The exposure of light that is added, where nothing else is asked for.
const EXPOSURE: f32 = 1.6;

/// Particles before an eye: the last layer of a picture, or the last but for the fade.
pub struct ParticleLayer {
    emitters: Vec<Emitter>,
    screen: Screen,
    /// Made by `prepare`.
    chunks: Vec<Chunk>,
    /// See [`ParticleLayer::colored`] and [`ParticleLayer::exposed`].
    color: Vec3A,
    exposure: f32,
    /// The planes that sprites change: the first, and the one after the last.
    planes: (usize, usize),
    /// Whether solids hide particles.
    solids: bool,
}

impl ParticleLayer {
    /// The layer of flakes alone, or of fires and writing. Within a layer their order does not matter.
    ///
    /// Fires have the detail of the settings. Writing is in front of all that is there.
    pub fn new(mut emitters: Vec<Emitter>, view: &View, settings: &ParticleSettings) -> ParticleLayer {
        // Sparks let all of the light behind pass; with black in place of the rest it keeps its bits.
        let (mut planes, mut solids, mut color) = ((LIGHT, PLANES), true, Vec3A::ZERO);
        for emitter in &mut emitters {
            match emitter {
                Emitter::Snow(_) => (planes, color) = ((PASSES, LIGHT), Vec3A::ONE),
                Emitter::Fire(fire) => *fire = fire.detailed(view, settings.built().detail),
                Emitter::Strokes(_) => solids = false,
            }
        }
        let (screen, chunks) = (Screen::new(view), Vec::new());
        ParticleLayer { emitters, screen, chunks, color, exposure: EXPOSURE, planes, solids }
    }

    /// The same with flakes of a colour, linear light, which takes the place of the light that they take; white
    /// without.
    pub fn colored(self, color: Vec3A) -> ParticleLayer {
        ParticleLayer { color, ..self }
    }

    /// The same where of added light x the share `1 - exp(-exposure x)` is seen; 1.6 without.
    #[cfg(feature = "full")]
    pub fn exposed(self, exposure: f32) -> ParticleLayer {
        ParticleLayer { exposure, ..self }
    }

    /// The same over layers without solids, whose depth is not read.
    #[cfg(feature = "full")]
    pub fn without_solids(self) -> ParticleLayer {
        ParticleLayer { solids: false, ..self }
    }

    /// The number of sprites that are drawn, once the layer is prepared.
    #[cfg(feature = "full")]
    pub fn drawn(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.sprites.len()).sum()
    }

    /// The sprites that are listed for the tile at that pixel.
    #[cfg(feature = "full")]
    fn listed(&self, x: usize, y: usize) -> Vec<Sprite> {
        let number = (y / Tile::SIZE) as u32 * self.screen.columns + (x / Tile::SIZE) as u32;
        let mut list = Vec::new();
        self.chunks.iter().for_each(|chunk| chunk.list(number, &mut list));
        list
    }

    /// Draws a tile's sprites.
    #[inline(always)]
    fn draw_in<S: Simd>(&self, simd: S, tile: &mut Tile) {
        let number = (tile.y / Tile::SIZE) as u32 * self.screen.columns + (tile.x / Tile::SIZE) as u32;
        let mut list = Vec::new();
        for chunk in &self.chunks {
            chunk.list(number, &mut list);
        }
        if list.is_empty() {
            return;
        }
        let (first, end) = self.planes;
        let mut planes = vec![[0.0; Tile::AREA]; end];
        planes[PASSES].fill(1.0);
        let solids = self.solids && tile.inv_depth.iter().any(|inv_depth| *inv_depth > 0.0);
        for sprite in &list {
            draw(simd, sprite, tile, solids, &mut planes[first..], first);
        }
        blend(simd, &planes, self.color, self.exposure, tile);
    }
}

impl Layer for ParticleLayer {
    fn prepare(&mut self, workers: &Workers, _: &Cache) {
        Chunk::add_all(&self.emitters, &mut self.chunks);
        let (emitters, screen, level) = (&self.emitters, &self.screen, workers.level());
        workers.each(self.chunks.iter_mut(), |chunk| chunk.fill(level, emitters, screen));
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        dispatch!(level, simd => self.draw_in(simd, tile));
        Stats::default()
    }

    #[cfg(feature = "full")]
    fn inspect(&self, aspect: Aspect, _: Level, tile: &mut Tile) -> Option<Vec<f32>> {
        let list = self.listed(tile.x, tile.y);
        match aspect {
            Aspect::Particles => Some(each(tile, |_, _| list.len() as f32)),
            Aspect::Sprites => Some(each(tile, |x, y| list.iter().filter(|sprite| sprite.covers(x, y)).count() as f32)),
            _ => None,
        }
    }

    #[cfg(feature = "full")]
    fn explain(&self, _: Level, _: &Tile, x: usize, y: usize) -> Vec<String> {
        let list = self.listed(x, y);
        let mut over: Vec<_> = list.iter().filter(|sprite| sprite.covers(x, y)).collect();
        over.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        let mut lines = vec![format!("{} sprites of the tile, {} over the pixel", list.len(), over.len())];
        for sprite in over.iter().take(NAMED) {
            let [_, red, green, blue] = sprite.ink;
            lines.push(format!(
                "sprite {:.3} m away: takes {:.3} of the light behind where it is densest, adds {red:.4} {green:.4} {blue:.4}",
                sprite.depth, sprite.alpha
            ));
        }
        lines
    }
}
