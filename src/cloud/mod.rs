//! Clouds: cubes of voxels, lit by the sun, through which rays are cast.
//!
//! A cloud is drawn after solids and before the sky: what it hides counts as covered, so the sky fills what is left.

mod cells;
pub mod field;
mod imposter;
pub mod march;
pub mod shadow;
pub mod shape;
pub mod sunlight;
pub mod voxels;

use crate::cuts::BENCH;
use crate::frame::{Cache, Layer, Stats, Tile, Workers};
use crate::settings::CloudSettings;
use crate::view::Camera;
use crate::view::View;
use fearless_simd::{Level, dispatch};
use glam::Vec3;
use imposter::Imposter;
use march::{Cloud, Look};
use std::sync::Arc;

/// Clouds before a camera, as a layer of a picture.
pub struct CloudLayer {
    /// Nearest first.
    clouds: Vec<Seen>,
    look: Look,
    view: View,
    quality: CloudSettings,
}

/// A cloud as it is seen from where the eye is.
struct Seen {
    cloud: Cloud,
    distance: f32,
    /// Steps through the cube.
    steps: f32,
    /// The share of its light that comes through the air, and the light that air adds to what is hidden.
    fades: f32,
    veil: Vec3,
    /// The share of the sun's light that comes to it.
    sunlit: f32,
    /// Pictures that stand for it, and their weights; the rest to 1 is the cloud itself.
    imposters: Vec<(Arc<Imposter>, f32)>,
    direct: f32,
}

impl CloudLayer {
    /// The layer for clouds in any order. The air between has the light `haze` of a direction, and leaves 1/e of a
    /// cloud's own at `range` metres.
    pub fn new(
        clouds: Vec<Cloud>,
        look: Look,
        haze: impl Fn(Vec3) -> Vec3,
        range: f32,
        view: View,
        quality: CloudSettings,
    ) -> CloudLayer {
        let Camera { eye, forward, .. } = *view.camera();
        let mut seen: Vec<Seen> = Vec::new();
        for cloud in clouds {
            let way = cloud.centre - eye;
            if way.dot(forward) < -ROOT * cloud.size {
                continue;
            }
            let distance = way.length();
            let fades = (-distance / range).exp();
            let veil = haze(way / distance.max(1e-3)) * (1.0 - fades);
            let pixels = 2.0 * cloud.size / (distance * view.pixel());
            let steps = (quality.steps as f32).min((pixels * quality.detail).max(8.0).ceil());
            let at = seen.iter().position(|other| other.distance > distance).unwrap_or(seen.len());
            let unlit = Seen { cloud, distance, steps, fades, veil, sunlit: 1.0, imposters: Vec::new(), direct: 1.0 };
            seen.insert(at, unlit);
        }
        CloudLayer { clouds: seen, look, view, quality }
    }

    /// Takes from the clouds the sun's light that others keep from them, down to a quarter: air and clouds send some on.
    pub fn shade(&mut self, others: &[Cloud]) {
        let mut points = Vec::new();
        for seen in &self.clouds {
            points.push(seen.cloud.centre);
        }
        for (seen, share) in self.clouds.iter_mut().zip(shadow::shares(others, self.look.towards, &points)) {
            seen.sunlit = 0.25 + 0.75 * share;
        }
    }

    /// The clouds that rays through a tile may meet, nearest first.
    fn near(&self, tile: &Tile) -> Vec<&Seen> {
        let (x, y) = (tile.x as u32 as f32, tile.y as u32 as f32);
        let ray = |dx: f32, dy: f32| self.view.ray(x + dx * Tile::SIZE as f32, y + dy * Tile::SIZE as f32).normalize();
        let axis = ray(0.5, 0.5);
        let mut cos = 1.0f32;
        for (dx, dy) in [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            cos = cos.min(ray(dx, dy).dot(axis));
        }
        let sin = (1.0 - cos * cos).sqrt();
        // A ball around the cube against a cone around the tile.
        let meets = |seen: &&Seen| {
            let way = seen.cloud.centre - self.view.camera().eye;
            let along = way.dot(axis);
            let across = (way.length_squared() - along * along).max(0.0).sqrt();
            across * cos - along * sin <= ROOT * seen.cloud.size
        };
        self.clouds.iter().filter(meets).collect()
    }
}

/// From a cube's middle to its corner, halves of its edge.
const ROOT: f32 = 1.732_051;

impl Layer for CloudLayer {
    fn prepare(&mut self, workers: &Workers, _cache: &Cache) {
        if BENCH && self.quality.imposter > 0.0 {
            imposter::prepare(self, workers);
        }
    }

    fn draw(&self, level: Level, tile: &mut Tile) -> Stats {
        let near = self.near(tile);
        if !near.is_empty() {
            dispatch!(level, simd => cells::draw(simd, self, &near, tile));
        }
        Stats::default()
    }
}
