//! Particles that one thread makes at a time, and their sprites listed by tiles.

use super::emitter::{Emitter, emit};
use super::screen::Screen;
use super::sprite::Sprite;
use fearless_simd::{Level, dispatch};

/// Particles per chunk.
const CHUNK: u32 = 8192;

/// The end of a list.
const END: u32 = u32::MAX;

/// A run of an emitter's particles.
pub struct Chunk {
    /// The number of the emitter.
    emitter: usize,
    /// The first particle.
    first: u32,
    /// What is seen of them.
    pub sprites: Vec<Sprite>,
    /// For each tile the first of its links, or [`END`].
    heads: Vec<u32>,
    /// A sprite, and the next link of the same tile.
    links: Vec<(u32, u32)>,
}

impl Chunk {
    /// Adds all particles of emitters, in chunks that are still empty.
    pub fn add_all(emitters: &[Emitter], chunks: &mut Vec<Chunk>) {
        for (emitter, from) in emitters.iter().enumerate() {
            let mut first = 0;
            while first < from.count() {
                chunks.push(Chunk { emitter, first, sprites: Vec::new(), heads: Vec::new(), links: Vec::new() });
                first += CHUNK;
            }
        }
    }

    /// Makes the sprites, and lists them by the tiles that they touch.
    pub fn fill(&mut self, level: Level, emitters: &[Emitter], screen: &Screen) {
        let emitter = &emitters[self.emitter];
        let range = [self.first, emitter.count().min(self.first + CHUNK)];
        dispatch!(level, simd => emit(simd, emitter, range, screen, &mut self.sprites));
        self.heads.resize((screen.columns * screen.rows) as usize, END);
        // From the last to the first, so that lists run from the first on.
        for (number, sprite) in self.sprites.iter().enumerate().rev() {
            let [[x0, x1], [y0, y1]] = screen.tiles(sprite);
            for y in y0..y1 {
                for x in x0..x1 {
                    let head = &mut self.heads[(y * screen.columns + x) as usize];
                    self.links.push((number as u32, *head));
                    *head = self.links.len() as u32 - 1;
                }
            }
        }
    }

    /// Adds the sprites that touch a tile to a list.
    #[inline(always)]
    pub fn list(&self, tile: u32, list: &mut Vec<Sprite>) {
        let mut link = self.heads[tile as usize];
        while let Some(&(sprite, next)) = self.links.get(link as usize) {
            // All are copied before any is drawn: drawn one by one, each was waited for, a third of the whole frame. Field by
            // field, as the 64 kB build copies a whole sprite by a string instruction, which does not read ahead.
            let Sprite { at, axes, reach, depth, edge, alpha, ink, crystal } = self.sprites[sprite as usize];
            list.push(Sprite { at, axes, reach, depth, edge, alpha, ink, crystal });
            link = next;
        }
    }
}
