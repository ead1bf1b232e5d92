//! Surfaces of triangles.

use glam::Vec3;

/// What a face is painted with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paint {
    /// Share of the light that is scattered back, linear.
    pub albedo: Vec3,
    /// The world's texture that the albedo is multiplied by, if any.
    pub texture: Option<u8>,
    /// Share of the sky that is mirrored where the surface is grazed; a twentieth of it where it is met straight.
    pub gloss: f32,
}

/// A triangle, counter-clockwise from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Face {
    /// Indices of its points.
    pub corners: [u16; 3],
    /// Index of its paint.
    pub paint: u16,
}

/// A surface of triangles, all smooth or all flat. Large surfaces are cut into several, which are culled one by one.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Where the corners are, metres: at most 65,536.
    pub points: Vec<Vec3>,
    /// Normals at the points, of any length; none where every face is flat.
    pub normals: Vec<Vec3>,
    /// The triangles.
    pub faces: Vec<Face>,
    /// The paints that faces name.
    pub paints: Vec<Paint>,
}

impl Mesh {
    /// Middle and radius of a ball around all points: that of their bounding box.
    pub fn bound(&self) -> (Vec3, f32) {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for &p in &self.points {
            // In this order what is not a number is left out.
            (low, high) = (p.min(low), p.max(high));
        }
        (0.5 * (low + high), 0.5 * low.distance(high))
    }
}
