//! Views of lights: shadow maps fitted to what the camera sees.

use super::project::Projection;
use crate::view::Camera;
use glam::Vec3A;

/// Cascaded shadow maps of a sun in the direction `towards` (unit): parallel projections of `size` x `size` texels, the
/// finest first. The first covers what the camera sees up to `ends[0]` metres along its axis, each other one from a
/// little before the end of its predecessor to its own. `aspect` is the picture's width over its height.
///
/// Each map holds the ball around its slice of the view frustum, whose size stays the same when the camera turns, and
/// moves by whole texels: while the light rests, so do the edges of shadows `[Valient08]`.
pub fn cascades(camera: &Camera, aspect: f32, towards: Vec3A, ends: &[f32], size: u32) -> Vec<Projection> {
    // Squared tangent of the angle between the view's axis and the farther of its corners.
    let wide = aspect + camera.shift.abs();
    let corner2 = camera.up.length_squared() * (1.0 + wide * wide);
    let mut near = 0.0;
    let mut views = Vec::new();
    for &end in ends {
        let begin = 0.9 * near;
        near = end;
        // The ball through the corners of both ends, unless the ball over the far end alone holds the slice.
        let along = (0.5 * (begin + end) * (1.0 + corner2)).min(end);
        let radius = ((end - along) * (end - along) + end * end * corner2).sqrt();
        // Lookups keep off the border: four texels wider on each side.
        let width = 2.0 * radius * size as f32 / (size as f32 - 8.0);
        let mut view = Projection::parallel(towards, camera.eye + camera.forward * along, width, size);
        // Shifted until the world's origin lies on a corner of texels.
        for row in &mut view.rows[..2] {
            row.w = row.w.round();
        }
        views.push(view);
    }
    views
}

/// The six faces of the cube around a lamp at `position`, `size` x `size` texels each, in the order +x, -x, +y, -y, +z,
/// -z.
pub fn cube(position: Vec3A, size: u32) -> Vec<Projection> {
    let mut views = Vec::new();
    for face in 0..6 {
        views.push(Projection::face(face, position, size));
    }
    views
}
