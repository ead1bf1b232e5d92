//! A pinhole camera, and the eyes of a stereo pair beside it.
//!
//! The world is right-handed with y up; lengths are metres.

use crate::angle;
use crate::cuts;
use crate::vector::{cross, unit};
use glam::Vec3A;

/// A pinhole camera.
///
/// The ray through the screen's point (`px`, `py`) leaves `eye` along `forward + (px + shift) * right + py * up`. The
/// screen is two units high; (0, 0) is its middle.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Where rays start, metres.
    pub eye: Vec3A,
    /// Unit vector along the view axis.
    pub forward: Vec3A,
    /// Direction to the right of the picture, as long as half of its height is at a distance of one metre.
    pub right: Vec3A,
    /// Direction to the top of the picture, as long as `right`.
    pub up: Vec3A,
    /// How far the picture is shifted to the right of the view axis, halves of its height: 0 but for the two eyes of a
    /// stereo pair.
    pub shift: f32,
}

/// Where an eye is beside a camera, and where its picture is aimed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eye {
    /// Metres to the right of the camera.
    pub offset: f32,
    /// Metres along the view axis at which both eyes of a pair see a thing at the same place of their pictures. Above
    /// 0.
    pub convergence: f32,
}

impl Eye {
    /// The place of the camera itself.
    pub const MIDDLE: Eye = Eye { offset: 0.0, convergence: 1.0 };
}

/// A pair of eyes beside a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stereo {
    /// Metres between the eyes, 0 or more.
    pub eye_distance: f32,
    /// Metres along the view axis, as in [`Eye::convergence`].
    pub convergence: f32,
}

impl Stereo {
    /// The left eye for a `side` of -1/2, the right eye for 1/2.
    pub fn eye(self, side: f32) -> Eye {
        Eye { offset: side * self.eye_distance, convergence: self.convergence }
    }
}

impl Camera {
    /// A camera at `eye` that looks at `target`, with a vertical field of view of `fov` radians and rolled by `roll`
    /// radians.
    ///
    /// The axes are never degenerate: where `eye` equals `target` the camera looks along -z, and where it looks
    /// straight down (up) the top of its picture is towards -z (+z).
    pub fn look_at(eye: Vec3A, target: Vec3A, fov: f32, roll: f32) -> Camera {
        let forward = (target - eye).try_normalize().unwrap_or(Vec3A::NEG_Z);
        let side = cross(forward, Vec3A::Y);
        let right = if side.length_squared() > 1e-12 { unit(side) } else { Vec3A::X };
        let up = cross(right, forward);
        let scale = angle::tan(0.5 * fov);
        let (sin, cos) = angle::sin_cos(roll);
        Camera {
            eye,
            forward,
            right: (right * cos + up * sin) * scale,
            up: (up * cos - right * sin) * scale,
            shift: 0.0,
        }
    }

    /// The camera moved to an eye. [`Eye::MIDDLE`] leaves it as it is.
    ///
    /// The axes of a pair stay parallel and their pictures are shifted. Were the axes turned to meet instead, the two
    /// eyes would see most points at different heights.
    pub fn at(self, eye: Eye) -> Camera {
        if !cuts::STEREO {
            return self;
        }
        let metre = eye.offset / self.right.length();
        Camera { eye: self.eye + self.right * metre, shift: self.shift - metre / eye.convergence, ..self }
    }
}
