//! Where a camera stands and how it is turned, as numbers that a person can read and write.

use super::Camera;
use crate::vector::unit;
use glam::{DVec3, Mat3A, Vec3A};

/// Place, angles and field of view of a camera. Angles are in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Where rays start, metres.
    pub eye: DVec3,
    /// From north (-z) towards east (+x).
    pub heading: f64,
    /// Above the horizon.
    pub pitch: f64,
    /// How far the picture's right side is raised.
    pub roll: f64,
    /// The vertical field of view.
    pub fov: f64,
}

impl Pose {
    /// The pose of a camera. Where it looks straight up or down its heading and its roll cannot be told apart, and the
    /// heading is 0.
    pub fn of(camera: &Camera) -> Pose {
        let Camera { eye, forward, right, up, .. } = *camera;
        let scale = right.length() as f64;
        let (heading, pitch, roll) = angles(unit(right), unit(up), forward);
        Pose { eye: eye.as_dvec3(), heading, pitch, roll, fov: (2.0 * scale.atan()).to_degrees() }
    }

    /// The camera of this pose.
    pub fn camera(&self) -> Camera {
        let scale = (0.5 * self.fov.to_radians()).tan() as f32;
        let turn = self.turn();
        Camera {
            eye: self.eye.as_vec3a(),
            forward: -turn.z_axis,
            right: turn.x_axis * scale,
            up: turn.y_axis * scale,
            shift: 0.0,
        }
    }

    /// The turn of something that looks along this pose: from axes to the right, up and astern.
    pub fn turn(&self) -> Mat3A {
        let [heading, pitch, roll] = [self.heading, self.pitch, self.roll].map(f64::to_radians);
        let (sin, cos) = heading.sin_cos();
        let forward = DVec3::new(sin * pitch.cos(), pitch.sin(), -cos * pitch.cos());
        let level = DVec3::new(cos, 0.0, sin);
        let above = level.cross(forward);
        let (sin, cos) = roll.sin_cos();
        let (right, up) = (level * cos + above * sin, above * cos - level * sin);
        Mat3A::from_cols(right.as_vec3a(), up.as_vec3a(), -forward.as_vec3a())
    }

    /// The pose of something at `place`, metres, that is turned like that, with a field of view in degrees.
    pub fn turned(place: Vec3A, turn: Mat3A, fov: f64) -> Pose {
        let (heading, pitch, roll) = angles(turn.x_axis, turn.y_axis, -turn.z_axis);
        Pose { eye: place.as_dvec3(), heading, pitch, roll, fov }
    }
}

/// Heading, pitch and roll, degrees, of three unit vectors.
fn angles(right: Vec3A, up: Vec3A, forward: Vec3A) -> (f64, f64, f64) {
    let [right, up, forward] = [right, up, forward].map(|v| v.as_dvec3());
    let pitch = forward.y.clamp(-1.0, 1.0).asin();
    let heading = if forward.x.hypot(forward.z) > 1e-6 { forward.x.atan2(-forward.z) } else { 0.0 };
    let (sin, cos) = heading.sin_cos();
    let level = DVec3::new(cos, 0.0, sin);
    let roll = (-up.dot(level)).atan2(right.dot(level));
    (heading.to_degrees(), pitch.to_degrees(), roll.to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pose and its camera say the same, and the camera is the one of `look_at`, which is by another formula.
    #[test]
    fn a_pose_is_its_camera() {
        for (heading, pitch, roll) in [(0.0, 0.0, 0.0), (90.0, 10.0, -20.0), (-135.0, -60.0, 170.0), (30.0, 89.0, 5.0)]
        {
            let pose = Pose { eye: DVec3::new(1.0, 2.0, -3.0), heading, pitch, roll, fov: 50.0 };
            let camera = pose.camera();
            let same = Pose::of(&camera);
            for (a, b) in [(heading, same.heading), (pitch, same.pitch), (roll, same.roll), (50.0, same.fov)] {
                assert!((a - b).abs() < 1e-3, "{pose:?} {same:?}");
            }
            let [h, p] = [heading, pitch].map(|angle: f64| angle.to_radians() as f32);
            let ahead = Vec3A::new(h.sin() * p.cos(), p.sin(), -h.cos() * p.cos());
            let look = Camera::look_at(camera.eye, camera.eye + ahead, 50f32.to_radians(), (roll as f32).to_radians());
            assert!((look.right - camera.right).length() < 1e-4, "{pose:?} {look:?} {camera:?}");
            assert!((look.up - camera.up).length() < 1e-4 && (look.forward - camera.forward).length() < 1e-4);
        }
    }
}
