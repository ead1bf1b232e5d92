//! What the explorer is set to: scene, time, camera, parameters and settings.

use crate::calendar::months_later;
use crate::flight::{Flight, Stick};
use crate::keyframes::Keyframes;
use crate::keys::Action;
use crate::request::{Request, camera, milliseconds, plane, rounded};
use paprsek::Quality;
use paprsek::frame::knobs::Knob;
use paprsek::frame::placement::Placed;
use paprsek::frame::{Parameter, Scene};
use paprsek::scenes;
use paprsek::view::Pose;

/// Speeds of walking, metres per second: least, largest, and at the start.
const SPEEDS: [f64; 3] = [0.05, 2000.0, 4.0];
/// Degrees that the eye turns per pixel of a picture of 720 rows with a field of view of 50 degrees: the scene follows
/// the mouse.
const DEGREES: f64 = 50.0 / 720.0;

/// Caps of the frame rate, frames per second; 0 for none.
pub const CAPS: [u32; 7] = [10, 15, 24, 30, 60, 120, 0];
/// The cap at first: a usual display's pace.
const DISPLAY: u32 = 60;

/// Everything that can be set.
pub struct Model {
    /// The scene.
    pub scene: Scene,
    /// Seconds of the scene.
    pub time: f64,
    /// Whether time goes on.
    pub playing: bool,
    /// Seconds of the scene per second.
    pub rate: f64,
    /// Name of the quality that the settings started from.
    pub base: &'static str,
    /// The settings.
    pub quality: Quality,
    /// Parameters that have been changed.
    pub values: Vec<(&'static str, f64)>,
    /// Where the camera has been put; none while the scene moves it.
    pub pose: Option<Pose>,
    /// Keys of the camera.
    pub keys: Keyframes,
    /// Whether the camera goes by its keys.
    pub keyed: bool,
    /// The aeroplane, while it is flown.
    pub flight: Option<Flight>,
    /// Metres per second that one walks.
    pub speed: f64,
    /// Where camera and aeroplane were in the frame that is shown.
    pub placed: Placed,
    /// Threads that render; 0 for one per core.
    pub threads: usize,
    /// Name of the SIMD level.
    pub simd: &'static str,
    /// Frames per second at most; 0 for as many as there can be.
    pub cap: u32,
    /// The share of the flakes before they were turned off.
    share: Option<f64>,
}

impl Model {
    /// A scene as it is shown, from its start.
    pub fn new(scene: Scene, threads: usize, simd: &'static str) -> Model {
        Model {
            scene,
            time: 0.0,
            playing: true,
            rate: 1.0,
            base: "default",
            quality: Quality::DEFAULT,
            values: Vec::new(),
            pose: None,
            keys: Keyframes::default(),
            keyed: false,
            flight: None,
            speed: SPEEDS[2],
            placed: Placed::default(),
            threads,
            simd,
            cap: DISPLAY,
            share: None,
        }
    }

    /// The frame to show now.
    pub fn request(&self, size: (usize, usize)) -> Request {
        let mut values = self.values.clone();
        if let Some(flight) = &self.flight {
            values.extend(camera(&flight.camera()));
            if self.placed.plane.is_some() {
                values.extend(plane(&flight.plane));
            }
        } else if let Some(pose) = self.by_keys().or(self.pose) {
            values.extend(camera(&pose));
        }
        let (scene, time, base) = (self.scene, milliseconds(self.time), self.base);
        Request { scene, time, size, base, quality: self.quality, values, threads: self.threads, simd: self.simd }
    }

    /// The camera of the frame that is to be shown.
    pub fn camera(&self) -> Option<Pose> {
        self.flight.map(|flight| flight.camera()).or_else(|| self.by_keys()).or(self.pose).or(self.placed.camera)
    }

    /// The camera by its keys, where it goes by these.
    fn by_keys(&self) -> Option<Pose> {
        self.keys.pose(milliseconds(self.time)).filter(|_| self.keyed)
    }

    /// Adds a key where the camera is.
    pub fn add_key(&mut self) {
        if let Some(pose) = self.camera() {
            self.keys.add(milliseconds(self.time), &pose);
        }
    }

    /// Moves on by so many seconds of real time.
    pub fn advance(&mut self, seconds: f64, stick: Stick) {
        if self.playing {
            self.time += seconds * self.rate;
            self.wrap();
        }
        if let Some(flight) = &mut self.flight {
            flight.fly(stick, seconds);
        }
    }

    /// Walks metres to the right, up and ahead, along the view.
    pub fn walk(&mut self, [right, up, ahead]: [f64; 3]) {
        let Some(mut pose) = self.camera().filter(|_| self.flight.is_none()) else { return };
        let turn = pose.turn();
        let way = turn.x_axis.as_dvec3() * right - turn.z_axis.as_dvec3() * ahead;
        pose.eye += way + glam::DVec3::Y * up;
        // Who moves by hand leaves the keys.
        (self.pose, self.keyed) = (Some(pose), false);
    }

    /// Turns the eye as a drag of so many pixels over a picture of `height` rows turns it.
    pub fn look(&mut self, (x, y): (f32, f32), height: usize) {
        let Some(mut pose) = self.camera().filter(|_| self.flight.is_none()) else { return };
        let degrees = DEGREES * 720.0 / height as f64 * pose.fov / 50.0;
        pose.heading = (pose.heading - f64::from(x) * degrees + 180.0).rem_euclid(360.0) - 180.0;
        pose.pitch = (pose.pitch + f64::from(y) * degrees).clamp(-90.0, 90.0);
        (self.pose, self.keyed) = (Some(pose), false);
    }

    /// Walks faster or slower, or widens the view, by notches of the wheel.
    pub fn wheel(&mut self, notches: f64, zooms: bool) {
        if !zooms {
            self.speed = (self.speed * 1.25f64.powf(notches)).clamp(SPEEDS[0], SPEEDS[1]);
        } else if let Some(flight) = &mut self.flight {
            flight.plane.fov = (flight.plane.fov * 0.95f64.powf(notches)).clamp(5.0, 140.0);
        } else if let Some(pose) = self.camera() {
            let fov = (pose.fov * 0.95f64.powf(notches)).clamp(5.0, 140.0);
            (self.pose, self.keyed) = (Some(Pose { fov, ..pose }), false);
        }
    }

    /// The value of one of the scene's parameters.
    pub fn value(&self, parameter: &Parameter) -> f64 {
        self.values.iter().find(|value| value.0 == parameter.name).map_or(parameter.default, |value| value.1)
    }

    /// Sets one of the scene's parameters, to the nearest value that it takes.
    pub fn set(&mut self, parameter: &Parameter, value: f64) {
        let value = if parameter.unit == "count" { value.round() } else { rounded(value) };
        let value = value.clamp(parameter.range.0, parameter.range.1);
        self.values.retain(|other| other.0 != parameter.name);
        if value != parameter.default {
            self.values.push((parameter.name, value));
        }
    }

    /// Goes to another scene, from its start.
    pub fn go(&mut self, scene: Scene) {
        if scene.name != self.scene.name {
            let Model { playing, rate, base, quality, speed, threads, simd, cap, .. } = *self;
            *self = Model { playing, rate, base, quality, speed, cap, ..Model::new(scene, threads, simd) };
        }
    }

    /// Starts from a quality by name.
    pub fn start_from(&mut self, base: &'static str) {
        (self.base, self.quality) = (base, Quality::named(base).unwrap_or_default());
    }

    /// Sets a field of the settings.
    pub fn turn(&mut self, knob: &Knob, value: f64) {
        let (least, most) = knob.parameter.range;
        (knob.set)(&mut self.quality, rounded(value).clamp(least, most));
    }

    /// Does what a key asks for, as far as it concerns the scene.
    pub fn act(&mut self, action: Action) {
        match action {
            Action::Pause => self.playing = !self.playing,
            Action::Seek(seconds) if self.flight.is_none() => self.seek(f64::from(seconds)),
            Action::Frame(frames) => {
                self.playing = false;
                self.seek(f64::from(frames) / 30.0);
            }
            Action::Rate(doubled) => self.rate = (self.rate * 2f64.powi(doubled)).clamp(1.0 / 64.0, 64.0),
            Action::RealTime => self.rate = 1.0,
            Action::Cap(by) => {
                let place = CAPS.iter().position(|cap| *cap == self.cap).unwrap_or(0) as i32;
                self.cap = CAPS[(place + by).rem_euclid(CAPS.len() as i32) as usize];
            }
            Action::Scene(by) => {
                let all = scenes::all();
                let place = all.iter().position(|scene| scene.name == self.scene.name).unwrap_or(0) as i32;
                self.go(all[(place + by).rem_euclid(all.len() as i32) as usize]);
            }
            Action::Day(days) => self.date(|day| day + f64::from(days)),
            Action::Month(months) => self.date(|day| months_later(day, months)),
            Action::Turn(number, steps) => {
                if let Some(parameter) = self.scene.parameters.get(number) {
                    self.set(
                        parameter,
                        self.value(parameter) + f64::from(steps) * step(parameter, self.value(parameter)),
                    );
                }
            }
            Action::Snow => {
                if let Some(share) = self.scene.parameter("share") {
                    let now = self.value(share);
                    let before = self.share.replace(now).filter(|_| now == 0.0).unwrap_or(share.default);
                    self.set(share, if now > 0.0 { 0.0 } else { before });
                }
            }
            Action::Reset => {
                self.values.clear();
                self.start_from("default");
            }
            Action::Home => (self.pose, self.flight, self.keyed) = (None, None, false),
            Action::Key => self.add_key(),
            Action::Fly => self.fly(),
            Action::Person => {
                if let Some(flight) = &mut self.flight {
                    flight.first_person = !flight.first_person;
                }
            }
            _ => {}
        }
    }

    fn fly(&mut self) {
        self.flight = match self.flight {
            Some(flight) => {
                self.pose = Some(flight.camera());
                None
            }
            None => self.camera().map(|camera| {
                // From where the scene's aeroplane is, or from the eye; level at first.
                let from = self.placed.plane.unwrap_or(camera);
                Flight::new(Pose { roll: 0.0, pitch: from.pitch.clamp(-20.0, 20.0), fov: camera.fov, ..from })
            }),
        };
    }

    /// Seconds from one frame to the next at least.
    pub fn pace(&self) -> f64 {
        if self.cap == 0 { 0.0 } else { 1.0 / f64::from(self.cap) }
    }

    /// Goes to a time of the scene, which begins anew after its end.
    pub fn seek(&mut self, seconds: f64) {
        self.time += seconds;
        self.wrap();
    }

    fn wrap(&mut self) {
        self.time = self.time.rem_euclid(self.scene.duration.max(1e-3));
    }

    fn date(&mut self, new: impl Fn(f64) -> f64) {
        if let Some(date) = self.scene.parameter("date") {
            self.set(date, new(self.value(date)));
        }
    }
}

/// By how much a key changes a parameter.
fn step(parameter: &Parameter, value: f64) -> f64 {
    let (least, most) = parameter.range;
    match parameter.unit {
        "days" => 1.0,
        "h" => 0.25,
        "degrees" => 5.0,
        "count" => (value.abs() / 10.0).round().max(1.0),
        // Signed ones pass zero, others go by a tenth.
        _ if least < 0.0 => (most - least) / 80.0,
        _ => (value.abs() / 10.0).max((most - least) / 1000.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn model(name: &str) -> Model {
        Model::new(scenes::named(name).unwrap(), 1, "sse2")
    }

    #[test]
    fn every_parameter_has_a_pair_of_keys_that_turns_it() {
        for scene in scenes::all() {
            for (number, parameter) in scene.parameters.iter().enumerate() {
                let mut model = model(scene.name);
                let up = if parameter.default < parameter.range.1 { 1 } else { -1 };
                model.act(Action::Turn(number, up));
                let value = model.value(parameter);
                assert!(f64::from(up) * (value - parameter.default) > 0.0, "{} {}", scene.name, parameter.name);
                assert!(parameter.takes(value));
            }
        }
    }

    #[test]
    fn the_camera_goes_by_its_keys_until_it_is_moved() {
        let mut model = model("snow");
        for (time, x) in [(1.0, 0.0), (3.0, 8.0)] {
            model.time = time;
            model.pose = Some(Pose { eye: glam::dvec3(x, 2.0, 3.0), heading: 0.0, pitch: 0.0, roll: 0.0, fov: 50.0 });
            model.act(Action::Key);
        }
        (model.keyed, model.time) = (true, 2.0);
        let asked = model.request((64, 36));
        let x = asked.values.iter().find(|value| value.0 == "camera.x").unwrap().1;
        assert!((x - 4.0).abs() < 1e-3, "{asked:?}");
        model.walk([1.0, 0.0, 0.0]);
        assert!(!model.keyed && (model.pose.unwrap().eye.x - 5.0).abs() < 1e-3);
    }

    #[test]
    fn snow_goes_and_comes_back_as_it_was() {
        let mut model = model("snowfall");
        let share = model.scene.parameter("share").unwrap();
        model.set(share, 0.25);
        model.act(Action::Snow);
        assert_eq!(model.value(share), 0.0);
        model.act(Action::Snow);
        assert_eq!(model.value(share), 0.25);
    }

    #[test]
    fn walking_follows_the_view() {
        let mut model = model("snow");
        let eye = glam::dvec3(1.0, 2.0, 3.0);
        model.pose = Some(Pose { eye, heading: 90.0, pitch: 0.0, roll: 0.0, fov: 50.0 });
        model.walk([0.0, 0.5, 2.0]);
        assert!((model.pose.unwrap().eye - glam::dvec3(3.0, 2.5, 3.0)).length() < 1e-5);
        model.walk([1.0, 0.0, 0.0]);
        assert!((model.pose.unwrap().eye - glam::dvec3(3.0, 2.5, 4.0)).length() < 1e-5);
        // The scene follows the mouse: to the right the eye turns left.
        model.look((72.0, 0.0), 720);
        assert!((model.pose.unwrap().heading - 85.0).abs() < 1e-9);
    }
}
