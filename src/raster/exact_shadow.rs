//! Shadows without a depth map: a point is tested against every triangle in the light's view that may hide it.
//!
//! The exact way beside [`super::depth_map`]: between the point and the light there are no texels, and only as much bias
//! as the snapping of corners needs. Bins serve as the acceleration structure.

use super::context::ShadeContext;
use super::id::parts;
use super::queue::{FragmentQueue, POINTS};
use super::rasters::LightView;
use super::triangle::SUB;
use crate::frame::Tile;
use crate::simd::block::Block3;
use crate::vector::cross;
use glam::Vec3A;

/// Whether a point at pixel coordinates (`x`, `y`) of a light's view and at that depth is hidden by a triangle. The point
/// has to lie within the view.
pub fn hides(view: &LightView, x: f32, y: f32, inv_depth: f32) -> bool {
    let tile = [x, y].map(|n| (n / Tile::SIZE as f32) as usize);
    let (sx, sy) = (x as f64 * SUB as f64, y as f64 * SUB as f64);
    let inside = |&(a, b, c): &(i32, i32, i64)| a as f64 * sx + b as f64 * sy + c as f64 >= 0.0;
    view.at(tile)
        .flat_map(|mesh| mesh.in_tile(tile))
        .any(|(_, t)| t.edges.iter().all(inside) && t.inv_depth(x, y) > inv_depth)
}

/// The points of a queue's fragments, lifted from their flat faces to the smooth surface that the normals at the corners
/// describe `[Hanika21]`.
///
/// Light falls off with the interpolated normal, and shadow with the flat face: where the two turn from the light at
/// different places, whole faces of a coarse mesh would lie in their own shadow, cut off along their edges.
pub fn lifted(context: &ShadeContext, queue: &FragmentQueue) -> Block3 {
    let mut points = queue.places[POINTS];
    for (i, &id) in queue.id[0].iter().enumerate() {
        let (number, triangle) = parts(id);
        let body = &context.world.bodies[context.raster.bodies[number].0];
        if body.mesh.normals.is_empty() {
            continue;
        }
        let face = &body.mesh.faces[context.raster.meshes[number].triangles[triangle].face as usize];
        let index = face.corners.map(usize::from);
        let corners = index.map(|i| body.place.transform_point3a(body.mesh.points[i]));
        let normals = index.map(|i| body.place.transform_vector3a(body.mesh.normals[i]).normalize_or_zero());
        let point = Vec3A::from_array([0, 1, 2].map(|axis| queue.places[POINTS][axis][i]));
        let up = above(point, corners, normals);
        for axis in 0..3 {
            points[axis][i] += up[axis];
        }
    }
    points
}

/// How far the smooth surface lies above a point of a flat face: the mean, by barycentric weights, of the ways up to the
/// planes of the corners' normals.
fn above(point: Vec3A, corners: [Vec3A; 3], normals: [Vec3A; 3]) -> Vec3A {
    let [a, b, c] = corners;
    let area = cross(b - a, c - a);
    let share = |from: Vec3A, to: Vec3A| cross(from - point, to - point).dot(area) / area.length_squared();
    let weights = [share(b, c), share(c, a), share(a, b)];
    let mut up = Vec3A::ZERO;
    for k in 0..3 {
        let below = (corners[k] - point).dot(normals[k]).max(0.0);
        up += normals[k] * (below * weights[k].clamp(0.0, 1.0));
    }
    if up.is_finite() { up } else { Vec3A::ZERO }
}
