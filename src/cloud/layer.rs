//! Clouds as a layer of a picture.

use super::cells;
use super::imposter_cache::ImposterCache;
#[cfg(feature = "full")]
use super::inspect;
use super::seen::SeenClouds;
use super::voxels::Voxels;
use super::world::{Cloud, CloudLight};
use crate::cuts;
#[cfg(feature = "full")]
use crate::frame::inspect::{Aspect, each};
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::settings::CloudSettings;
use crate::view::View;
use fearless_simd::Level;
use glam::Vec3A;
use std::sync::Arc;

/// Clouds before an eye: a layer after the solids and before the sky.
pub struct CloudLayer {
    clouds: SeenClouds,
}

impl CloudLayer {
    /// The layer of clouds, in any order, in clear air and in the full light of the sun.
    pub fn new(clouds: Vec<Cloud>, light: CloudLight, view: &View, settings: &CloudSettings) -> CloudLayer {
        CloudLayer { clouds: SeenClouds::new(clouds, light, view, settings) }
    }

    /// The same with detail below a voxel from a [`table`](super::grain::table), for clouds that one flies through.
    pub fn with_grain(mut self, table: &Arc<Voxels>) -> CloudLayer {
        self.clouds.add_grain(table);
        self
    }

    /// The same in air of which `range` metres let 1/e of a cloud's light through, and which has the linear light
    /// `light` of a unit direction itself.
    pub fn in_air(mut self, range: f32, light: impl Fn(Vec3A) -> Vec3A) -> CloudLayer {
        self.clouds.add_air(range, light);
        self
    }

    /// The same in the shadow of clouds, which may be the layer's own. A quarter of the sun's light is left in the
    /// deepest shadow.
    pub fn shaded_by(mut self, clouds: &[Cloud]) -> CloudLayer {
        self.clouds.shade(clouds);
        self
    }
}

impl Layer for CloudLayer {
    fn prepare(&mut self, workers: &Workers, cache: &Cache) {
        if cuts::IMPOSTERS && self.clouds.settings.imposter > 0.0 {
            cache.get::<ImposterCache>().lock().prepare(&mut self.clouds, workers);
        }
    }

    fn foresee(&self, level: Level, tile: &mut Tile) {
        cells::foresee(level, &self.clouds, tile);
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        cells::draw(level, &self.clouds, tile);
        Stats::default()
    }

    #[cfg(feature = "full")]
    fn inspect(&self, aspect: Aspect, _: Level, tile: &mut Tile) -> Option<Vec<f32>> {
        let clouds = &self.clouds;
        let near = clouds.near(tile);
        match aspect {
            Aspect::Clouds => Some(each(tile, |_, _| near.len() as f32)),
            Aspect::CloudSteps => {
                let (eye, opaque) = (clouds.view.camera().eye, clouds.settings.built().opaque);
                Some(each(tile, |x, y| {
                    let (d, limit) = inspect::ray(clouds, tile, x, y);
                    near.iter().map(|seen| inspect::steps(seen, eye, d, limit, opaque)).sum::<u32>() as f32
                }))
            }
            Aspect::Imposters => Some(each(tile, |x, y| inspect::imposters(clouds, &near, tile, x, y).0 as f32)),
            Aspect::ImposterAge => Some(each(tile, |x, y| inspect::imposters(clouds, &near, tile, x, y).1)),
            _ => None,
        }
    }

    #[cfg(feature = "full")]
    fn explain(&self, _: Level, tile: &Tile, x: usize, y: usize) -> Vec<String> {
        inspect::explain(&self.clouds, tile, x, y)
    }
}
