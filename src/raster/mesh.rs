//! Surfaces of triangles: points with normals, faces that join them, and what faces are painted with.

use glam::Vec3A;

/// What a face is painted with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    /// Diffuse reflectance, linear, 0 to 1.
    pub albedo: Vec3A,
    /// Index of the texture of the world that multiplies the albedo, 0 to 14; `None` for a plain colour.
    pub texture: Option<u8>,
    /// Share of the sky that is mirrored at grazing incidence, 0 to 1. A twentieth of it is mirrored at normal incidence. The
    /// surface is level where the albedo's green is 1/20, and tilted by what is more or less: so a texture makes waves.
    pub gloss: f32,
}

/// A triangle, counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Indices of its points.
    pub corners: [u16; 3],
    /// Index of its paint.
    pub paint: u16,
}

/// A surface of triangles, either smooth or flat throughout.
///
/// Bodies are culled whole, so a large surface is best cut into several meshes.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Positions of the corners, metres: at most 65,536.
    pub points: Vec<Vec3A>,
    /// Normals at the points, of any length. Empty where every face is flat.
    pub normals: Vec<Vec3A>,
    /// The triangles: at most 8,192.
    pub faces: Vec<Face>,
    /// The paints that faces refer to.
    pub paints: Vec<Paint>,
}

impl Mesh {
    /// Centre and radius of a bounding sphere: the one around the bounding box. Coordinates that are NaN are left out.
    pub fn bound(&self) -> (Vec3A, f32) {
        let (mut low, mut high) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
        for &p in &self.points {
            // In this order `min` and `max` drop a NaN.
            (low, high) = (p.min(low), p.max(high));
        }
        (0.5 * (low + high), 0.5 * low.distance(high))
    }
}
