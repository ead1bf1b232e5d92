//! A scene, and the request for one of its frames.

use super::cache::Cache;
use super::layer::Picture;
use super::parameter::{Parameter, Values};
#[cfg(feature = "full")]
use super::placement;
use super::workers::Workers;
use crate::cuts;
use crate::settings::Quality;
use crate::view::{Camera, Eye, View};
#[cfg(feature = "full")]
use glam::{Mat3A, Vec3A};

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
    /// The scene's camera, moved to where the values `camera.*` put it.
    #[cfg(feature = "full")]
    pub fn placed(&self, camera: Camera) -> Camera {
        placement::camera(self.values, self.cache, camera)
    }

    /// The scene's aeroplane, moved to where the values `plane.*` put it: its place, metres, and its turn, from axes to
    /// the right, up and astern.
    #[cfg(feature = "full")]
    pub fn flown(&self, place: Vec3A, turn: Mat3A) -> (Vec3A, Mat3A) {
        placement::plane(self.values, self.cache, place, turn)
    }

    /// The view of a camera of the screen's own, such as that of writing: moved to the eye that the picture is for, but
    /// not to where the values put the scene's camera.
    #[inline(always)]
    pub fn screen(&self, camera: Camera) -> View {
        #[cfg(feature = "full")]
        return View::new(camera.at(self.eye), self.width, self.height);
        #[cfg(not(feature = "full"))]
        self.view(camera)
    }

    /// The scene's camera, placed where the values put it, and moved to the eye that the picture is for.
    pub fn camera(&self, camera: Camera) -> Camera {
        #[cfg(feature = "full")]
        let camera = self.placed(camera);
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
