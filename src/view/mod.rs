//! The view of a picture: from pixels to eye rays, and from points in space to pixels.
//!
//! A [`View`] is a [`Camera`] and the size of the picture in pixels. Everything that a renderer asks about the screen is
//! answered here: rays through pixels, the projection of points, the angle of a pixel, and the cone of a tile, by which
//! whole bodies are rejected.

mod camera;
mod cone;
#[cfg(feature = "full")]
mod pose;

pub use camera::{Camera, Eye, Stereo};
pub use cone::Cone;
#[cfg(feature = "full")]
pub use pose::Pose;

use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math::to_f32;
use crate::vector::unit;
use fearless_simd::prelude::*;
use glam::Vec3A;

/// A camera and the size of its picture.
#[derive(Clone, Copy, Debug)]
pub struct View {
    camera: Camera,
    width: usize,
    height: usize,
    /// Screen units per pixel.
    pixel: f32,
    /// The screen's middle from its top left corner, screen units.
    half: (f32, f32),
}

impl View {
    /// The view of a camera on a picture of `width` x `height` pixels.
    pub fn new(camera: Camera, width: usize, height: usize) -> View {
        let pixel = 2.0 / to_f32(height);
        let half = (to_f32(width) / to_f32(height) - camera.shift, 1.0);
        View { camera, width, height, pixel, half }
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Pixels per row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The screen's middle, pixels from its top left corner, and what `right` and `up` times a metre are in pixels at one
    /// metre.
    pub fn screen(&self) -> ((f32, f32), f32) {
        let scale = self.camera.right.length_squared();
        ((self.half.0 / self.pixel, self.half.1 / self.pixel), 1.0 / (scale * self.pixel))
    }

    /// The angle of a pixel in the middle of the view, radians: the widest.
    pub fn pixel(&self) -> f32 {
        self.camera.up.length() * self.pixel
    }

    /// Unit normals, to the inside, of the planes through the eye and the picture's left, right, lower and upper edges.
    pub fn sides(&self) -> [Vec3A; 4] {
        let c = &self.camera;
        let aspect = self.half.0 + c.shift;
        let side = |across: Vec3A, most: f32| {
            let length = across.length();
            unit(across / length + c.forward * (most * length))
        };
        [side(c.right, aspect - c.shift), side(-c.right, aspect + c.shift), side(c.up, 1.0), side(-c.up, 1.0)]
    }

    /// The unnormalised eye rays through points of the picture, in pixels from its top left corner.
    #[inline(always)]
    pub fn rays<S: Simd>(&self, simd: S, x: F<S>, y: F<S>) -> V3<S> {
        let px = x * self.pixel - self.half.0;
        let py = -(y * self.pixel) + self.half.1;
        let c = &self.camera;
        V3::splat(simd, c.forward) + V3::splat(simd, c.right) * Lane(px) + V3::splat(simd, c.up) * Lane(py)
    }

    /// The unit direction of the eye ray through one point of the picture.
    #[inline(never)] // Five calls make a cone: 0.2 kB packed.
    pub fn direction(&self, x: f32, y: f32) -> Vec3A {
        unit(self.ray(x, y))
    }

    /// The unnormalised eye ray through one point of the picture.
    pub fn ray(&self, x: f32, y: f32) -> Vec3A {
        let c = &self.camera;
        c.forward + c.right * (x * self.pixel - self.half.0) + c.up * (self.half.1 - y * self.pixel)
    }

    /// Where a point in space appears, in pixels, and the pixels that a metre takes there; none behind the eye.
    /// Places out of the picture are given too.
    pub fn project(&self, p: Vec3A) -> Option<(f32, f32, f32)> {
        let c = &self.camera;
        let q = p - c.eye;
        let depth = q.dot(c.forward);
        if depth < 1e-3 {
            return None;
        }
        let scale = c.right.length_squared();
        let px = q.dot(c.right) / (scale * depth);
        let py = q.dot(c.up) / (scale * depth);
        let metre = 1.0 / (scale.sqrt() * depth * self.pixel);
        Some(((px + self.half.0) / self.pixel, (self.half.1 - py) / self.pixel, metre))
    }
}
