//! A frame as it is asked for, and the command line that reproduces it.

use paprsek::Quality;
use paprsek::frame::Scene;
use paprsek::frame::knobs::KNOBS;
use paprsek::frame::parameter::Parameter;
use paprsek::frame::placement::{self, CAMERA, PLANE};
use paprsek::view::Pose;
use std::fmt::Write;

/// All that a frame depends on, and how it is to be rendered.
#[derive(Clone, Debug)]
pub struct Request {
    /// The scene.
    pub scene: Scene,
    /// Seconds, in whole milliseconds.
    pub time: f64,
    /// Width and height, pixels.
    pub size: (usize, usize),
    /// Name of the quality that the settings started from.
    pub base: &'static str,
    /// The settings.
    pub quality: Quality,
    /// Parameters that have been changed, and where the camera and the aeroplane have been put.
    pub values: Vec<(&'static str, f64)>,
    /// Threads that render; 0 for one per core.
    pub threads: usize,
    /// Name of the SIMD level.
    pub simd: &'static str,
}

impl PartialEq for Request {
    fn eq(&self, other: &Request) -> bool {
        self.scene.name == other.scene.name
            && (self.time, self.size, self.quality, self.threads)
                == (other.time, other.size, other.quality, other.threads)
            && (&self.values, self.simd) == (&other.values, other.simd)
    }
}

/// Decimals that values have on the command line.
const PLACES: f64 = 1e6;

/// The value as the command line will read it. Everything that is shown has such values, so that what is copied has them.
pub fn rounded(value: f64) -> f64 {
    (value * PLACES).round() / PLACES
}

/// A time in whole milliseconds, which the command line takes exactly.
pub fn milliseconds(time: f64) -> f64 {
    (time * 1000.0).round() / 1000.0
}

/// The values that put something where a pose is.
pub fn placed(table: &'static [Parameter], pose: &Pose) -> Vec<(&'static str, f64)> {
    // A tenth of a millimetre, or of a thousandth of a degree. 0 is added so that there is no -0.
    let numbers = placement::numbers(pose).map(|number| (number * 1e4).round() / 1e4 + 0.0);
    let clamped = |(parameter, number): (&'static Parameter, f64)| {
        (parameter.name, number.clamp(parameter.range.0, parameter.range.1))
    };
    table.iter().zip(numbers).map(clamped).collect()
}

/// The values that put the camera where a pose is.
pub fn camera(pose: &Pose) -> Vec<(&'static str, f64)> {
    placed(&CAMERA, pose)
}

/// The values that put the aeroplane where a pose is.
pub fn plane(pose: &Pose) -> Vec<(&'static str, f64)> {
    placed(&PLANE, pose)
}

/// The settings that differ from those of the quality that they started from, as words of a command line.
fn settings(base: &str, quality: &Quality) -> Vec<(&'static str, String)> {
    let base = Quality::named(base).unwrap_or_default();
    let changed = |knob: &&paprsek::frame::knobs::Knob| (knob.get)(quality) != (knob.get)(&base);
    // Fields are f32 or whole numbers, and the shortest decimal of an f32 is read back as the same one.
    KNOBS.iter().filter(changed).map(|knob| (knob.parameter.name, ((knob.get)(quality) as f32).to_string())).collect()
}

impl Request {
    /// The arguments of the plain program that say which frame this is.
    pub fn words(&self) -> String {
        let Request { scene, time, size: (width, height), base, .. } = self;
        let mut words = format!("{} --at {time} --size {width}x{height} --quality {base}", scene.name);
        for (name, value) in settings(base, &self.quality) {
            let _ = write!(words, " --set {name}={value}");
        }
        for (name, value) in &self.values {
            let _ = write!(words, " --set {name}={value}");
        }
        words
    }

    /// A command line that writes this frame into a directory, `still`.
    pub fn command(&self) -> String {
        format!("paprsek {} --capture still", self.words())
    }
}
