//! The pinhole camera of the bench scenes, right-handed, y up; and the eyes of a stereo pair beside it.

use crate::cuts::BENCH;
use glam::Vec3;

/// A pinhole camera. Rays leave `eye` along `forward + (px + shift) * right + py * up`.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Position, metres.
    pub eye: Vec3,
    /// Unit view direction.
    pub forward: Vec3,
    /// Direction to the right, scaled to half the picture's height at distance one.
    pub right: Vec3,
    /// Direction up, scaled like `right`.
    pub up: Vec3,
    /// How far the lens is shifted to the right, halves of the picture's height: 0 but for the two eyes of a stereo pair.
    pub shift: f32,
}

/// An eye beside a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Metres to the right of the camera.
    pub offset: f32,
    /// Metres along the view axis, above 0, at which every eye sees a thing at the same place of its picture.
    pub convergence: f32,
}

impl Eye {
    /// The camera's own place.
    pub const MIDDLE: Eye = Eye { offset: 0.0, convergence: 1.0 };
}

/// Two eyes beside a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stereo {
    /// Metres between the eyes, 0 or more.
    pub eye_distance: f32,
    /// As in [`Eye`].
    pub convergence: f32,
}

impl Stereo {
    /// The left eye for a `side` of -1/2, the right one for 1/2.
    pub fn eye(self, side: f32) -> Eye {
        Eye { offset: side * self.eye_distance, convergence: self.convergence }
    }
}

impl Camera {
    /// Looks from `eye` to `target` with a vertical field of view `fov` in radians, rolled by `roll` radians.
    ///
    /// Never degenerate: where `eye` equals `target` it looks along -z, and where the view is vertical
    /// the screen's up is -z (looking down) or +z (looking up).
    pub fn look_at(eye: Vec3, target: Vec3, fov: f32, roll: f32) -> Camera {
        let forward = (target - eye).try_normalize().unwrap_or(Vec3::NEG_Z);
        let side = forward.cross(Vec3::Y);
        let right = if side.length_squared() > 1e-12 { side.normalize() } else { Vec3::X };
        let up = right.cross(forward);
        let scale = (0.5 * fov).tan();
        let (sin, cos) = roll.sin_cos();
        Camera {
            eye,
            forward,
            right: (right * cos + up * sin) * scale,
            up: (up * cos - right * sin) * scale,
            shift: 0.0,
        }
    }

    /// The camera moved to an eye; itself for [`Eye::MIDDLE`].
    ///
    /// The axis stays parallel and the lens is shifted: of axes that meet each eye would see the same point at another
    /// height.
    pub fn at(self, eye: Eye) -> Camera {
        if !BENCH {
            return self;
        }
        let metre = eye.offset / self.right.length();
        Camera { eye: self.eye + self.right * metre, shift: self.shift - metre / eye.convergence, ..self }
    }
}
