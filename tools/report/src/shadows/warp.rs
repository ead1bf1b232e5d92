//! One shadow map through a perspective: a light-space perspective shadow map `[Wimmer04]`.

use super::set::Set;
use glam::{Vec3A, Vec4};
use paprsek::raster::Projection;

/// A warped map of `size` texels for what a set's camera sees between the ends of its range. Its w is the distance from a
/// point behind the eye, along the view axis as the sun sees it; so heights towards the sun divided by w are affine in the
/// map.
pub fn warped(set: &Set, towards: Vec3A, size: u32) -> Projection {
    let (camera, (near, far)) = (&set.camera, set.range);
    let view = camera.forward;
    let along = (view - towards * view.dot(towards)).try_normalize().unwrap_or(Vec3A::X);
    let right = towards.cross(along);
    let sine = view.cross(towards).length().max(0.05);
    let aspect = set.size.0 as f32 / set.size.1 as f32;
    let mut corners = Vec::new();
    for depth in [near, far] {
        for (x, y) in [(-aspect, -1.0), (aspect, -1.0), (-aspect, 1.0), (aspect, 1.0)] {
            corners.push(camera.eye + (camera.forward + camera.right * x + camera.up * y) * depth);
        }
    }
    let (first, last) = bounds(corners.iter().map(|p| p.dot(along)));
    // The authors' best distance of the near plane, for a view that looks across the light.
    let depth = last - first;
    let end = near + depth * sine;
    let start = (near + (near * end).sqrt()) / sine;
    let middle = camera.eye.dot(right);
    let distance = |p: Vec3A| p.dot(along) - first + start;
    let (left, rest) = bounds(corners.iter().map(|p| (p.dot(right) - middle) / distance(*p)));
    // Lookups need some texels around them, so a border is left free.
    let (edge, size_f) = (4.0, size as f32);
    let inner = size_f - 2.0 * edge;
    let w = along.extend(start - first);
    let x = right.extend(-middle) * (inner / (rest - left)) + w * (edge - left * inner / (rest - left));
    let share = inner / (1.0 / start - 1.0 / (start + depth));
    // y is affine in 1 / w, from the first end at 1 / start to the last.
    let y = w * (share / start + edge) - Vec4::W * share;
    Projection { rows: [x, y, towards.extend(0.0), w], size: [size; 2], texel: 1.0 / x.truncate().length() }
}

fn bounds(values: impl Iterator<Item = f32>) -> (f32, f32) {
    values.fold((f32::MAX, f32::MIN), |(low, high), value| (low.min(value), high.max(value)))
}
