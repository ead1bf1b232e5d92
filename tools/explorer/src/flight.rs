//! Arcade flight: the stick turns the aeroplane at once, and it goes where its nose points.

use glam::{DMat3, DVec3, dvec3};
use paprsek::view::Pose;

/// Speeds, metres per second: least, largest, and at the start.
const SPEEDS: [f64; 3] = [20.0, 250.0, 80.0];
/// Degrees per second that the full stick pitches and rolls.
const RATES: [f64; 2] = [45.0, 90.0];
/// Degrees per second that a bank of 90 degrees turns the heading.
const TURN: f64 = 40.0;
/// Steepest climb and dive, degrees.
const STEEPEST: f64 = 80.0;
/// Share of the bank that is left after a second without stick.
const LEVELS: f64 = 0.3;
/// Where the eye is: metres ahead of the aeroplane's middle and above it. The pilot's, and behind.
const EYES: [[f64; 2]; 2] = [[7.0, 0.0], [-22.0, 5.0]];
/// Share of the way to the aeroplane's attitude that is left for the eye behind after a second.
const LAG: f64 = 0.05;

/// The stick and the throttle: -1 to 1 each.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stick {
    /// Nose up.
    pub up: f64,
    /// Roll to the right.
    pub right: f64,
    /// Faster.
    pub faster: f64,
}

/// An aeroplane in flight.
#[derive(Clone, Copy, Debug)]
pub struct Flight {
    /// Where it is and how it is turned. Its field of view is the camera's.
    pub plane: Pose,
    /// Metres per second.
    pub speed: f64,
    /// Whether the eye is the pilot's; otherwise it is behind.
    pub first_person: bool,
    /// Where the eye behind looks: it follows the aeroplane softly.
    behind: Pose,
}

impl Flight {
    /// A flight that starts there, with the eye behind.
    pub fn new(plane: Pose) -> Flight {
        Flight { plane, speed: SPEEDS[2], first_person: false, behind: plane }
    }

    /// Flies on for so many seconds.
    pub fn fly(&mut self, stick: Stick, seconds: f64) {
        let [pitch, roll] = RATES;
        let plane = &mut self.plane;
        self.speed = (self.speed * (1.0 + stick.faster * seconds)).clamp(SPEEDS[0], SPEEDS[1]);
        // A wing that is raised turns towards the other one.
        let turn = -plane.roll.to_radians().sin() * TURN;
        plane.heading = (plane.heading + turn * seconds + 180.0).rem_euclid(360.0) - 180.0;
        plane.pitch = (plane.pitch + stick.up * pitch * seconds).clamp(-STEEPEST, STEEPEST);
        plane.roll = (plane.roll - stick.right * roll * seconds).clamp(-85.0, 85.0);
        if stick.right == 0.0 {
            plane.roll *= LEVELS.powf(seconds);
        }
        plane.eye += axes(plane).1 * (self.speed * seconds);
        let left = LAG.powf(seconds);
        let towards = |old: f64, new: f64| new + ((old - new + 180.0).rem_euclid(360.0) - 180.0) * left;
        self.behind.heading = towards(self.behind.heading, plane.heading);
        self.behind.pitch = towards(self.behind.pitch, plane.pitch);
        self.behind.roll = towards(self.behind.roll, 0.5 * plane.roll);
    }

    /// The camera.
    pub fn camera(&self) -> Pose {
        let fov = self.plane.fov;
        let from = if self.first_person { self.plane } else { self.behind };
        let [ahead, above] = EYES[usize::from(!self.first_person)];
        let (up, forward) = axes(&from);
        Pose { eye: self.plane.eye + forward * ahead + up * above, fov, ..from }
    }
}

/// Unit vectors upwards and ahead.
fn axes(pose: &Pose) -> (DVec3, DVec3) {
    let turn = pose.turn();
    let axes = DMat3::from_cols(turn.x_axis.as_dvec3(), turn.y_axis.as_dvec3(), turn.z_axis.as_dvec3());
    (axes * DVec3::Y, axes * dvec3(0.0, 0.0, -1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn level(heading: f64) -> Pose {
        Pose { eye: dvec3(0.0, 500.0, 0.0), heading, pitch: 0.0, roll: 0.0, fov: 50.0 }
    }

    #[test]
    fn it_goes_where_its_nose_points() {
        let mut flight = Flight::new(level(90.0));
        for _ in 0..100 {
            flight.fly(Stick::default(), 0.01);
        }
        assert!((flight.plane.eye - dvec3(SPEEDS[2], 500.0, 0.0)).length() < 0.1, "{flight:?}");
        flight.first_person = true;
        assert!((flight.camera().eye.x - SPEEDS[2] - EYES[0][0]).abs() < 0.1);
    }

    #[test]
    fn a_bank_to_the_right_turns_to_the_right_and_the_stick_climbs() {
        let mut flight = Flight::new(level(0.0));
        for _ in 0..50 {
            flight.fly(Stick { right: 1.0, up: 0.5, faster: 0.0 }, 0.01);
        }
        assert!(flight.plane.roll < -30.0 && flight.plane.heading > 5.0, "{flight:?}");
        assert!(flight.plane.pitch > 5.0 && flight.plane.eye.y > 500.0 && flight.plane.eye.x > 0.0, "{flight:?}");
    }
}
