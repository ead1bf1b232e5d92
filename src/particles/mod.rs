//! Particles: closed forms of time and a number, drawn as soft sprites over what is there.
//!
//! One flow: [`snow`] or [`fire`] (where particle `i` is now) -> [`sprite`] (what it is on the screen) -> lists by tile ->
//! planes of light and of what is left of the light behind -> the picture.
//! Nothing is stored from frame to frame, so nothing is emitted, recycled or in step with frames.

pub mod fire;
pub mod flicker;
pub mod snow;
pub mod sprite;
pub mod strokes;

use crate::cuts::BENCH;
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::simd::lanes::{F, STEPS, U, V3};
use crate::view::View;
use fearless_simd::{Level, dispatch, prelude::*};
use fearless_simd_macros::simd;
use fire::Fire;
use glam::Vec3;
use snow::Snow;
use sprite::{Crystal, LIGHT, PASSES, Screen, Sprite, blend, draw, sort};
use strokes::Strokes;

/// Particles of a vector.
pub struct Batch<S: Simd> {
    /// From the emitter's origin, metres: the eye for flakes, the world's for fires.
    pub at: V3<S>,
    /// Metres.
    pub radius: F<S>,
    /// Light, premultiplied, where a sprite's weight is 1.
    pub light: V3<S>,
    /// Share of the light behind that it takes there.
    pub alpha: F<S>,
    /// Cosine and sine of its turn on the screen, and how much narrower than long it looks.
    pub turn: [F<S>; 3],
    /// Half of its way while the shutter is open, metres.
    pub streak: V3<S>,
}

/// Where particles come from.
pub enum Emitter {
    /// Flakes around the eye.
    Snow(Snow),
    /// Flames, sparks or smoke.
    Fire(Fire),
    /// Writing.
    Strokes(Strokes),
}

/// Particles that a job makes at a time.
const CHUNK: u32 = 8192;

/// What a job has made.
struct Chunk {
    emitter: usize,
    first: u32,
    sprites: Vec<Sprite>,
    /// For each tile the first of its links, or [`END`].
    heads: Vec<u32>,
    /// A sprite and the next link of the same tile.
    links: Vec<(u32, u32)>,
}

/// No link.
const END: u32 = u32::MAX;

/// Particles before a camera, as a layer of a picture: the last one.
pub struct ParticleLayer {
    emitters: Vec<Emitter>,
    screen: Screen,
    chunks: Vec<Chunk>,
    /// What takes the place of the light that sprites take.
    color: Vec3,
    /// Of the light that they add `1 - exp(-exposure light)` is seen, as on film, and it bleaches what is behind.
    exposure: f32,
    /// Which planes sprites change.
    planes: (usize, usize),
    /// What flakes are from close by.
    pub crystal: Crystal,
    /// Do solids hide them?
    solids: bool,
}

impl ParticleLayer {
    /// Flakes of one colour alone.
    #[cfg(feature = "full")]
    pub fn snow(flakes: Vec<Snow>, color: Vec3, view: &View, width: usize, height: usize) -> ParticleLayer {
        ParticleLayer::new(flakes.into_iter().map(Emitter::Snow).collect(), color, 0.0, view, width, height)
    }

    /// Fires alone.
    #[cfg(feature = "full")]
    pub fn fire(fires: Vec<Fire>, exposure: f32, view: &View, width: usize, height: usize) -> ParticleLayer {
        ParticleLayer::new(fires.into_iter().map(Emitter::Fire).collect(), Vec3::ZERO, exposure, view, width, height)
    }

    /// Flakes of one `color` in any order; or flames, sparks and writing in any order, or, if there is smoke, all of them
    /// from far to near. Writing is before all that is there.
    pub fn new(
        emitters: Vec<Emitter>,
        color: Vec3,
        exposure: f32,
        view: &View,
        width: usize,
        height: usize,
    ) -> ParticleLayer {
        let (mut planes, mut solids) = ((LIGHT, LIGHT + 3), true);
        for emitter in &emitters {
            match emitter {
                Emitter::Snow(_) => planes = (PASSES, LIGHT),
                Emitter::Fire(fire) if BENCH && fire.flame.alpha > 0.0 => planes.0 = PASSES,
                Emitter::Fire(_) => {}
                Emitter::Strokes(_) => solids = false,
            }
        }
        let screen = Screen::new(view, width, height);
        ParticleLayer { emitters, screen, chunks: Vec::new(), color, exposure, planes, crystal: Crystal::STAR, solids }
    }

    /// The same where no layer before it has solids: their depth is not read.
    #[cfg(feature = "full")]
    pub fn without_solids(self) -> ParticleLayer {
        ParticleLayer { solids: false, ..self }
    }

    /// Sprites that are drawn, once it is prepared.
    #[cfg(feature = "full")]
    pub fn drawn(&self) -> usize {
        self.chunks.iter().map(|chunk| chunk.sprites.len()).sum()
    }

    /// Draws a tile's sprites.
    #[inline(always)]
    fn draw_in<S: Simd>(&self, simd: S, tile: &mut Tile) {
        let number = (tile.y / Tile::SIZE) as u32 * self.screen.columns + (tile.x / Tile::SIZE) as u32;
        let mut list = Vec::new();
        for chunk in &self.chunks {
            let mut link = chunk.heads[number as usize];
            while let Some(&(sprite, next)) = chunk.links.get(link as usize) {
                // Copied together: else each would be waited for as it is drawn, a third of the whole frame.
                list.push(chunk.sprites[sprite as usize]);
                link = next;
            }
        }
        if list.is_empty() {
            return;
        }
        let (first, end) = self.planes;
        if BENCH && end - first > 3 {
            sort(&mut list);
        }
        let mut planes = vec![[0.0; Tile::AREA]; end];
        planes[PASSES].fill(1.0);
        let solids = self.solids && tile.inv_depth.iter().any(|c| *c > 0.0);
        for sprite in &list {
            draw(simd, sprite, &self.crystal, tile, solids, &mut planes[first..], first);
        }
        blend(simd, &planes, self.color, self.exposure, tile);
    }
}

impl Layer for ParticleLayer {
    fn prepare(&mut self, workers: &Workers, _cache: &Cache) {
        for (emitter, from) in self.emitters.iter().enumerate() {
            let mut first = 0;
            while first < from.count() {
                self.chunks.push(Chunk { emitter, first, sprites: Vec::new(), heads: Vec::new(), links: Vec::new() });
                first += CHUNK;
            }
        }
        let (emitters, screen, level) = (&self.emitters, &self.screen, workers.level());
        workers.each(self.chunks.iter_mut(), |chunk| {
            let emitter = &emitters[chunk.emitter];
            dispatch!(level, simd => emit(simd, emitter, chunk.first, screen, &mut chunk.sprites));
            chunk.sort(screen);
        });
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        dispatch!(level, simd => self.draw_in(simd, tile));
        Stats::default()
    }
}

impl Chunk {
    /// Lists sprites by the tiles that they touch: from the last to the first, so that lists run from the first on.
    fn sort(&mut self, screen: &Screen) {
        self.heads.resize((screen.columns * screen.rows) as usize, END);
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
}

impl Emitter {
    /// Particles that there are, seen or not.
    fn count(&self) -> u32 {
        match self {
            Emitter::Snow(snow) => snow.count(),
            Emitter::Fire(fire) => fire.count(),
            Emitter::Strokes(strokes) => strokes.count(),
        }
    }
}

/// Adds the sprites of a lot, from its first particle on, that the screen shows.
#[simd]
fn emit<S: Simd>(simd: S, emitter: &Emitter, first: u32, screen: &Screen, sprites: &mut Vec<Sprite>) {
    let end = emitter.count().min(first + CHUNK);
    let lanes = F::<S>::LEN as u32;
    let mut i = first;
    while i < end {
        let numbers = U::<S>::from_slice(simd, &STEPS[..F::<S>::LEN]) + i;
        let (batch, lens, eye) = match emitter {
            Emitter::Snow(snow) => (snow.batch(simd, numbers), &snow.flakes.lens, Vec3::ZERO),
            Emitter::Fire(fire) => (fire.batch(simd, numbers), &fire.lens, screen.eye),
            Emitter::Strokes(strokes) => (strokes.batch(simd, numbers), &strokes.lens, Vec3::ZERO),
        };
        let last = (1 << lanes.min(end - i)) - 1;
        screen.push(simd, batch, lens, eye, last, sprites);
        i += lanes;
    }
}
