//! A scene, its parameters, and the request for one of its frames.

use super::cache::Cache;
use super::layer::Picture;
use super::workers::Workers;
use crate::cuts;
use crate::settings::Quality;
use crate::view::{Camera, Eye, View};

/// A scene: a picture at every instant.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Name on the command line.
    pub name: &'static str,
    /// One line for `--list`.
    pub about: &'static str,
    /// Length in seconds; playing loops after it.
    pub duration: f64,
    /// What it can be changed by.
    pub parameters: &'static [Parameter],
    /// The picture that is asked for: a pure function of the request.
    pub picture: fn(&FrameSpec) -> Picture,
}

impl Scene {
    /// Nothing, for no time.
    pub const EMPTY: Scene = Scene { name: "", about: "", duration: 0.0, parameters: &[], picture: |_| Picture::EMPTY };

    /// A part of the show. The 64 kB build does not play parts alone: there they have neither names nor parameters.
    pub const fn part(self) -> Scene {
        if cuts::SCENES { self } else { Scene { duration: self.duration, picture: self.picture, ..Scene::EMPTY } }
    }

    /// The parameter of that name.
    pub fn parameter(&self, name: &str) -> Option<&'static Parameter> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }
}

/// A number that a scene can be changed by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// Name on the command line.
    pub name: &'static str,
    /// Unit of its values: `m`, `m/s`, `s`, `degrees`, `1` for a plain number, `count` for a whole one: others are
    /// rounded.
    pub unit: &'static str,
    /// The least and the largest value.
    pub range: (f64, f64),
    /// The value that makes the scene as it is shown.
    pub default: f64,
    /// What it does, in one line.
    pub about: &'static str,
}

impl Parameter {
    /// A parameter as a row of a table: name, unit, range, default, and what it does.
    pub const fn new(
        name: &'static str,
        unit: &'static str,
        range: (f64, f64),
        default: f64,
        about: &'static str,
    ) -> Parameter {
        Parameter { name, unit, range, default, about }
    }

    /// Whether it takes that value: a number within its range.
    pub fn takes(&self, value: f64) -> bool {
        (self.range.0..=self.range.1).contains(&value)
    }
}

/// Values of parameters by name; those that are not among them have their defaults.
pub type Values<'a> = &'a [(&'static str, f64)];

/// The request for a frame: one instant of a scene, and how it is to be rendered.
#[derive(Clone, Copy)]
pub struct FrameSpec<'a> {
    /// Seconds since the scene's start, finite: at infinity and NaN a scene gives some picture, whose light may be NaN.
    pub time: f64,
    /// Pixels per row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Speed against error.
    pub quality: &'a Quality,
    /// The eye that the picture is for. [`FrameSpec::view`] moves a scene's camera to it.
    pub eye: Eye,
    /// What the scene's parameters are set to.
    pub values: Values<'a>,
    /// The threads that make what the scene still lacks.
    pub workers: &'a Workers,
    /// What earlier frames have left.
    pub cache: &'a Cache,
}

impl FrameSpec<'_> {
    /// The scene's camera, moved to the eye that the picture is for.
    pub fn camera(&self, camera: Camera) -> Camera {
        camera.at(self.eye)
    }

    /// The view of the scene's camera, moved to the eye that the picture is for.
    pub fn view(&self, camera: Camera) -> View {
        View::new(self.camera(camera), self.width, self.height)
    }

    /// The value of a parameter, rounded if it is a count. In the 64 kB build its default, a constant.
    #[inline(always)]
    pub fn get(&self, parameter: &Parameter) -> f64 {
        if cuts::PARAMETERS
            && let Some(value) = self.values.iter().find(|value| value.0 == parameter.name)
        {
            return if parameter.unit == "count" { value.1.round() } else { value.1 };
        }
        parameter.default
    }
}
