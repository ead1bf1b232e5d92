//! Small objects, small shadows: squares of the corner grid that must be cut, whatever their corners say.
//!
//! A body whose picture is smaller than a square can hide between its corners, and the rim of a larger one can bulge
//! into a square between two of them by up to its sagitta `size^2 / (8 radius)`. Both are excluded by cutting the
//! squares under the body's picture to `sqrt(2 radius)` pixels, where the sagitta is a quarter of a pixel. The same
//! holds for a body's shadow, found by following the light's ray through its centre, and for its mirror image in a plane.

use super::packet::View;
use super::shape::Shape;
use super::world::{Source, World};
use glam::Vec3;

/// Edge of the blocks that the guard distinguishes, pixels.
const BLOCK: usize = 8;

/// For each block of the picture the largest square that may be interpolated there.
pub struct Guard {
    columns: usize,
    finest: Vec<u8>,
}

impl Guard {
    /// The guard of a view of `world`, for a picture of that many pixels.
    pub fn new(world: &World, view: &View, width: usize, height: usize) -> Guard {
        let (columns, rows) = (width.div_ceil(BLOCK), height.div_ceil(BLOCK));
        let mut guard = Guard { columns, finest: vec![u8::MAX; columns * rows] };
        let eye = view.camera().eye;
        for (index, body) in world.objects.iter().enumerate() {
            let (center, radius) = body.shape.bound();
            if !radius.is_finite() {
                continue;
            }
            guard.protect(view, center, radius);
            for mirror in &world.objects {
                if let Shape::Plane { normal, offset } = mirror.shape
                    && mirror.material.reflectance.max_element() > 0.0
                    && normal.dot(eye) > offset
                {
                    guard.protect(view, center - normal * (2.0 * (normal.dot(center) - offset)), radius);
                }
            }
            if !body.casts_shadow {
                continue;
            }
            for light in &world.lights {
                let (from, direction) = match light.source {
                    Source::Point(p) => (p, (center - p).normalize_or(Vec3::NEG_Y)),
                    Source::Directional(d) => (center, -d),
                };
                if let Some((point, slant)) = receiver(world, index, center, direction) {
                    let grown = match light.source {
                        Source::Point(_) => (point - from).length() / (center - from).length().max(1e-6),
                        Source::Directional(_) => 1.0,
                    };
                    guard.protect(view, point, radius * grown * slant);
                }
            }
        }
        guard
    }

    /// The largest square, in pixels, that may be interpolated at a pixel.
    #[inline(always)]
    pub fn finest(&self, x: usize, y: usize) -> usize {
        self.finest[(y / BLOCK) * self.columns + x / BLOCK] as usize
    }

    /// Cuts the squares under the picture of a ball.
    fn protect(&mut self, view: &View, center: Vec3, radius: f32) {
        let Some((x, y, metre)) = view.project(center) else { return };
        let pixels = radius * metre;
        let finest = (2.0 * pixels).sqrt().max(1.0);
        if finest >= BLOCK as f32 {
            return;
        }
        let finest = 1 << finest.log2() as u32;
        let rows = self.finest.len() / self.columns.max(1);
        let range = |c: f32, end: usize| {
            let block = |v: f32| (v / BLOCK as f32).floor().clamp(-1.0, end as f32);
            let (low, high) = (block(c - pixels - 1.0), block(c + pixels + 1.0));
            (low.max(0.0) as usize, (high + 1.0).clamp(0.0, end as f32) as usize)
        };
        let ((x0, x1), (y0, y1)) = (range(x, self.columns), range(y, rows));
        for row in y0..y1 {
            for block in &mut self.finest[row * self.columns..][x0.min(x1)..x1] {
                *block = (*block).min(finest);
            }
        }
    }
}

/// Where the centre of a body's shadow falls, and how much longer than wide it is there (at most 8).
fn receiver(world: &World, caster: usize, from: Vec3, direction: Vec3) -> Option<(Vec3, f32)> {
    use super::scalar;
    let (index, t) = scalar::nearest(world, from, direction, |i| i != caster)?;
    let point = from + direction * t;
    let slope = world.objects[index].shape.normal_at(point).dot(direction).abs();
    Some((point, 1.0 / slope.max(0.125)))
}
