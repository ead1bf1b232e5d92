//! Keys of the camera: recorded where one stands, played as the show plays its tables, and written as rows of these.

use glam::Vec3A;
use paprsek::timeline::{Key, sample};
use paprsek::view::{Camera, Pose};
use std::fmt::Write;

/// How far ahead of the eye the target of a key is, metres.
const AHEAD: f32 = 10.0;

/// A table of keys: seconds of the scene; eye and target, metres; the vertical field of view, degrees. A table has no
/// roll.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Keyframes(Vec<Key<8>>);

impl Keyframes {
    /// The keys, in the order of their times.
    pub fn keys(&self) -> &[Key<8>] {
        &self.0
    }

    /// Adds a key, in place of one of the same time.
    pub fn add(&mut self, time: f64, pose: &Pose) {
        let camera = pose.camera();
        let target = camera.eye + camera.forward * AHEAD;
        let round = |number: f32| (number * 1000.0).round() / 1000.0;
        let [eye, target] = [camera.eye, target].map(|place| place.to_array().map(round));
        let [x, y, z] = eye;
        let [tx, ty, tz] = target;
        let key = [round(time as f32), x, y, z, tx, ty, tz, round(pose.fov as f32)];
        self.0.retain(|other| other[0] != key[0]);
        self.0.push(key);
        self.0.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }

    /// Moves a key to another time. Two keys never have the same.
    pub fn put(&mut self, number: usize, time: f64) {
        let time = (time * 1000.0).round() as f32 / 1000.0;
        if self.0.iter().all(|key| key[0] != time) {
            self.0[number][0] = time;
            self.0.sort_by(|a, b| a[0].total_cmp(&b[0]));
        }
    }

    /// Takes a key away.
    pub fn delete(&mut self, number: usize) {
        self.0.remove(number);
    }

    /// Where the camera is at a time; none without keys.
    pub fn pose(&self, time: f64) -> Option<Pose> {
        if self.0.is_empty() {
            return None;
        }
        let [_, x, y, z, tx, ty, tz, fov] = sample(&self.0, time);
        let camera = Camera::look_at(Vec3A::new(x, y, z), Vec3A::new(tx, ty, tz), fov.to_radians(), 0.0);
        Some(Pose { fov: fov.into(), ..Pose::of(&camera) })
    }

    /// The rows of a table of the show, such as `SHOTS` of `torches.rs`, times from the first key on.
    pub fn rows(&self) -> String {
        let mut text = String::new();
        let start = self.0.first().map_or(0.0, |key| key[0]);
        for [time, x, y, z, tx, ty, tz, fov] in &self.0 {
            let time = ((time - start) * 1000.0).round() / 1000.0;
            let _ = writeln!(text, "key({time:?}, [{x:?}, {y:?}, {z:?}], [{tx:?}, {ty:?}, {tz:?}], {fov:?}),");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    fn pose(x: f64, heading: f64) -> Pose {
        Pose { eye: dvec3(x, 2.0, -3.0), heading, pitch: 10.0, roll: 0.0, fov: 50.0 }
    }

    #[test]
    fn a_key_is_where_one_stood() {
        let mut keys = Keyframes::default();
        assert_eq!(keys.pose(1.0), None);
        keys.add(4.0, &pose(8.0, 90.0));
        keys.add(2.0, &pose(0.0, 0.0));
        for (time, truth) in [(2.0, pose(0.0, 0.0)), (4.0, pose(8.0, 90.0)), (9.0, pose(8.0, 90.0))] {
            let at = keys.pose(time).unwrap();
            assert!((at.eye - truth.eye).length() < 2e-3 && (at.heading - truth.heading).abs() < 0.02, "{at:?}");
            assert!((at.pitch - 10.0).abs() < 0.02 && at.fov == 50.0);
        }
        // In the middle of two keys, by symmetry.
        assert!((keys.pose(3.0).unwrap().eye.x - 4.0).abs() < 1e-3);
        keys.put(1, 6.0);
        assert!(keys.pose(4.0).unwrap().eye.x < 5.0);
        keys.put(1, 2.0);
        assert_eq!(keys.keys()[1][0], 6.0);
        assert_eq!(keys.rows().lines().nth(1), Some("key(4.0, [8.0, 2.0, -3.0], [17.848, 3.736, -3.0], 50.0),"));
        keys.delete(0);
        assert_eq!(keys.keys().len(), 1);
    }
}
