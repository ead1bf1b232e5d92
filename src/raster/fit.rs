//! What a light has to see: depth maps fitted to what the camera sees.

use super::project::Projection;
use crate::view::Camera;
use glam::Vec3;

/// Parallel projections along -`towards` (unit), one for each of `ends`: the first covers what the camera sees up to that
/// many metres along its axis, the others from a little before there to theirs. `aspect` is the picture's width over its
/// height, `size` the texels along an edge.
///
/// Each is the ball around its part of the view, which stays the same size as the camera turns, and moves by whole texels:
/// as long as the light rests so do the shadows' edges. M. Valient, "Stable rendering of cascaded shadow maps", ShaderX6,
/// 2008.
pub fn cascades(camera: &Camera, aspect: f32, towards: Vec3, ends: &[f32], size: u32) -> Vec<Projection> {
    // The tangent of the angle between the view's axis and its corners, whichever is the farther.
    let wide = aspect + camera.shift.abs();
    let corner2 = camera.up.length_squared() * (1.0 + wide * wide);
    let mut near = 0.0;
    let mut views = Vec::new();
    for &end in ends {
        let begin = 0.9 * near;
        near = end;
        // The ball through the corners of both ends, unless the far end's own is enough.
        let along = (0.5 * (begin + end) * (1.0 + corner2)).min(end);
        let radius = ((end - along) * (end - along) + end * end * corner2).sqrt();
        // Lookups keep off the border.
        let width = 2.0 * radius * size as f32 / (size as f32 - 8.0);
        let mut view = Projection::parallel(towards, camera.eye + camera.forward * along, width, size);
        // Moved until the world's origin lies on a corner of texels.
        for row in &mut view.rows[..2] {
            row.w = row.w.round();
        }
        views.push(view);
    }
    views
}

/// The six faces of the cube around a lamp.
pub fn cube(position: Vec3, size: u32) -> Vec<Projection> {
    let mut views = Vec::new();
    for face in 0..6 {
        views.push(Projection::face(face, position, size));
    }
    views
}
