//! The cone of eye rays through a rectangle of the picture.

use super::View;
use glam::Vec3A;

/// A cone with its apex at the eye that holds every ray through a rectangle of pixels.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Unit vector along the axis.
    axis: Vec3A,
    /// Cosine and sine of the half angle.
    cosine: f32,
    sine: f32,
}

impl Cone {
    /// The cone of the rays through the square of `2 * half` pixels around the point (`x`, `y`).
    ///
    /// Its axis is the ray through the point, and its angle that of the corner which is farthest from it.
    pub fn new(view: &View, (x, y): (f32, f32), half: f32) -> Cone {
        let axis = view.direction(x, y);
        let mut cosine = 1.0f32;
        for (dx, dy) in [(-half, -half), (half, -half), (-half, half), (half, half)] {
            cosine = cosine.min(axis.dot(view.direction(x + dx, y + dy)));
        }
        Cone { axis, cosine, sine: (1.0 - cosine * cosine).sqrt() }
    }

    /// Whether a ray of the cone may meet a ball: its centre from the eye, and its radius, metres. Never false where one
    /// does: the ball is taken a thousandth larger, and farther, than it is.
    pub fn may_meet(&self, centre: Vec3A, radius: f32) -> bool {
        let along = centre.dot(self.axis);
        let across = centre.distance(self.axis * along);
        // How far the centre lies outside of the cone, unless it is behind the eye. A tile that is much larger than its
        // picture has a cone of more than half of all directions, in which nothing is behind the eye.
        let outside = across * self.cosine - along * self.sine;
        (self.cosine < 0.0 || along >= -radius) && outside <= radius * 1.001 + centre.length() * 1e-3
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::Camera;

    /// A tile of 64 pixels around a picture of 17 rows holds rays more than 90 degrees from its middle's, and clouds that
    /// these met were left out.
    #[test]
    fn what_a_ray_meets_may_be_met() {
        const HALF: f32 = 32.0;
        for (width, height) in [(640, 360), (97, 55), (31, 17), (3, 129), (1, 1)] {
            let camera = Camera::look_at(Vec3A::new(3.0, 2.0, 1.0), Vec3A::ZERO, 1.1, 0.2);
            let view = View::new(camera, width, height);
            let cone = Cone::new(&view, (HALF, HALF), HALF);
            for pixel in 0..64 * 64 {
                let ray = view.ray((pixel % 64) as f32 + 0.5, (pixel / 64) as f32 + 0.5).normalize();
                for distance in [0.1, 10.0, 1e4] {
                    assert!(cone.may_meet(ray * distance, 0.0), "{width}x{height}, pixel {pixel}");
                }
            }
        }
    }
}
