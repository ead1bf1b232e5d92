//! A scene, and the request for one of its frames.

use super::layer::Picture;
use super::workers::Workers;
use crate::cuts::BENCH;
use crate::settings::Quality;
use crate::view::{Camera, Eye};

/// A scene of the command line.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// Name on the command line.
    pub name: &'static str,
    /// One line for `--list`.
    pub about: &'static str,
    /// Length in seconds; playing loops after it.
    pub duration: f64,
    /// The scene at one instant: a pure function of it.
    pub picture: fn(&FrameSpec) -> Picture,
}

impl Scene {
    /// Nothing, for no time.
    pub const EMPTY: Scene = Scene { name: "", about: "", duration: 0.0, picture: |_| Picture::EMPTY };

    /// A part of the show, which the 64 kB build does not play alone: there it has no name.
    pub const fn part(
        name: &'static str,
        about: &'static str,
        duration: f64,
        picture: fn(&FrameSpec) -> Picture,
    ) -> Scene {
        if BENCH { Scene { name, about, duration, picture } } else { Scene { name: "", about: "", duration, picture } }
    }

    /// The layers of one instant.
    pub fn picture(&self, spec: &FrameSpec) -> Picture {
        (self.picture)(spec)
    }
}

/// One instant of a scene, and how it is to be drawn.
#[derive(Clone, Copy)]
pub struct FrameSpec<'a> {
    /// Seconds since the scene's start.
    pub time: f64,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Speed against error.
    pub quality: Quality,
    /// Who looks: every scene passes its camera through [`FrameSpec::camera`].
    pub eye: Eye,
    /// Who makes what the scene still lacks.
    pub workers: &'a Workers,
}

impl FrameSpec<'_> {
    /// The scene's camera, moved to the eye that looks.
    pub fn camera(&self, camera: Camera) -> Camera {
        camera.at(self.eye)
    }
}
