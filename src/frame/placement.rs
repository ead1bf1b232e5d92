//! Values that put a scene's camera and its aeroplane elsewhere. Every scene takes them beside its own parameters; what
//! is not among them stays as the scene has it.

use super::cache::{Cache, keep};
use super::parameter::{Parameter, Values};
use crate::view::{Camera, Pose};
use glam::{Mat3A, Vec3A};

/// Farthest place, metres: beyond it f32 is coarser than a centimetre.
const FAR: f64 = 1e5;
/// Range of headings and rolls, degrees.
const ROUND: (f64, f64) = (-360.0, 360.0);
/// Range of pitches, degrees.
const STEEP: (f64, f64) = (-90.0, 90.0);

/// Where the camera stands, how it is turned, and its field of view. The defaults are those of no scene.
#[rustfmt::skip]
pub const CAMERA: [Parameter; 7] = [
    Parameter::new("camera.x", "m", (-FAR, FAR), 0.0, "the eye's place towards the east"),
    Parameter::new("camera.y", "m", (-FAR, FAR), 0.0, "the eye's height"),
    Parameter::new("camera.z", "m", (-FAR, FAR), 0.0, "the eye's place towards the south"),
    Parameter::new("camera.heading", "degrees", ROUND, 0.0, "where the eye looks, from north towards east"),
    Parameter::new("camera.pitch", "degrees", STEEP, 0.0, "how far above the horizon the eye looks"),
    Parameter::new("camera.roll", "degrees", ROUND, 0.0, "how far the picture's right side is raised"),
    Parameter::new("camera.fov", "degrees", (1.0, 150.0), 50.0, "the vertical field of view"),
];

/// Where the aeroplane is and how it is turned, in scenes that have one.
#[rustfmt::skip]
pub const PLANE: [Parameter; 6] = [
    Parameter::new("plane.x", "m", (-FAR, FAR), 0.0, "the aeroplane's place towards the east"),
    Parameter::new("plane.y", "m", (-FAR, FAR), 0.0, "the aeroplane's height"),
    Parameter::new("plane.z", "m", (-FAR, FAR), 0.0, "the aeroplane's place towards the south"),
    Parameter::new("plane.heading", "degrees", ROUND, 0.0, "where the aeroplane flies, from north towards east"),
    Parameter::new("plane.pitch", "degrees", STEEP, 0.0, "how far the aeroplane's nose is above the horizon"),
    Parameter::new("plane.roll", "degrees", ROUND, 0.0, "how far the aeroplane's right wing is raised"),
];

/// Where the camera and the aeroplane were in the frame that was rendered last. It is only written while a frame is
/// made, and changes none.
#[derive(Clone, Copy, Debug, Default)]
pub struct Placed {
    /// The camera, before it is moved to an eye of a pair.
    pub camera: Option<Pose>,
    /// The aeroplane of a scene that has one.
    pub plane: Option<Pose>,
}
keep!(Placed, Placed { camera: None, plane: None });

/// The numbers of a pose, in the order of the tables.
pub fn numbers(pose: &Pose) -> [f64; 7] {
    [pose.eye.x, pose.eye.y, pose.eye.z, pose.heading, pose.pitch, pose.roll, pose.fov]
}

/// The pose of those numbers.
pub fn pose([x, y, z, heading, pitch, roll, fov]: [f64; 7]) -> Pose {
    Pose { eye: glam::dvec3(x, y, z), heading, pitch, roll, fov }
}

/// A pose with those of its numbers that are among `values` replaced; none where no value is of the `table`.
fn replaced(values: Values, table: &[Parameter], old: Pose) -> Option<Pose> {
    let mut numbers = numbers(&old);
    let mut found = false;
    for (number, parameter) in numbers.iter_mut().zip(table) {
        if let Some(value) = values.iter().find(|value| value.0 == parameter.name) {
            (*number, found) = (value.1, true);
        }
    }
    found.then(|| pose(numbers))
}

/// The camera where `values` put it.
pub fn camera(values: Values, cache: &Cache, own: Camera) -> Camera {
    let old = Pose::of(&own);
    let new = replaced(values, &CAMERA, old);
    cache.get::<Placed>().lock().camera = Some(new.unwrap_or(old));
    // The scene's own, bit for bit, where nothing moves it.
    new.map_or(own, |pose| pose.camera())
}

/// The aeroplane where `values` put it: its place, metres, and its turn.
pub fn plane(values: Values, cache: &Cache, place: Vec3A, turn: Mat3A) -> (Vec3A, Mat3A) {
    let old = Pose::turned(place, turn, CAMERA[6].default);
    let new = replaced(values, &PLANE, old);
    cache.get::<Placed>().lock().plane = Some(new.unwrap_or(old));
    new.map_or((place, turn), |pose| (pose.eye.as_vec3a(), pose.turn()))
}
