//! One file a scene; only scenes know more than one renderer.

#[cfg(feature = "day")]
pub mod clouds;
#[cfg(feature = "bench-scenes")]
pub mod cumulus;
#[cfg(feature = "bench-scenes")]
pub mod cumulus_set;
#[cfg(feature = "day")]
pub mod day;
pub mod intro;
pub mod letters;
pub mod lumen;
#[cfg(feature = "day")]
pub mod models;
#[cfg(feature = "bench-scenes")]
pub mod particles;
#[cfg(all(feature = "bench-scenes", feature = "day"))]
pub mod rain;
mod script;
#[cfg(feature = "bench-scenes")]
pub mod shadow;
#[cfg(feature = "bench-scenes")]
pub mod shadow_set;
#[cfg(feature = "bench-scenes")]
pub mod sky;
#[cfg(feature = "bench-scenes")]
mod sky_grid;
#[cfg(feature = "day")]
pub mod snowfall;
#[cfg(feature = "bench-scenes")]
pub mod spheres;
#[cfg(feature = "day")]
pub mod torches;

use crate::BENCH;
use crate::camera::{Camera, Eye};
use crate::color::Transfer;
use crate::quality::Quality;
#[cfg(feature = "bench-scenes")]
use crate::raster::{self, Drawn};
use crate::tile::{Crew, Picture};
use crate::trace::Traced;
use crate::trace::world::World;
#[cfg(feature = "bench-scenes")]
use crate::view::View;

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
    picture: fn(&Shot) -> Picture,
}

impl Scene {
    /// Nothing, for no time.
    const EMPTY: Scene = Scene { name: "", about: "", duration: 0.0, picture: |_| Picture::EMPTY };

    /// A part of the show, which the 64 kB build does not play alone: there it has no name.
    const fn part(name: &'static str, about: &'static str, duration: f64, picture: fn(&Shot) -> Picture) -> Scene {
        if BENCH { Scene { name, about, duration, picture } } else { Scene { name: "", about: "", duration, picture } }
    }

    /// The layers of one instant.
    pub fn picture(&self, shot: &Shot) -> Picture {
        (self.picture)(shot)
    }
}

/// One instant of a scene, and how it is to be drawn.
#[derive(Clone, Copy)]
pub struct Shot<'a> {
    /// Seconds since the scene's start.
    pub time: f64,
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Speed against error.
    pub quality: Quality,
    /// Who looks: every scene passes its camera through [`Shot::camera`].
    pub eye: Eye,
    /// Who makes what the scene still lacks.
    pub crew: &'a Crew,
}

impl Shot<'_> {
    /// The scene's camera, moved to the eye that looks.
    pub fn camera(&self, camera: Camera) -> Camera {
        camera.at(self.eye)
    }

    /// A picture that is all ray tracing.
    fn traced(&self, world: World, camera: Camera, transfer: Transfer) -> Picture {
        let traced = Traced::new(world, self.camera(camera), self.width, self.height, self.quality);
        Picture { layers: vec![Box::new(traced)], transfer }
    }

    /// A picture that is all triangles.
    #[cfg(feature = "bench-scenes")]
    fn drawn(&self, world: raster::World, camera: Camera, transfer: Transfer) -> Picture {
        let view = View::new(camera, self.width, self.height);
        Picture { layers: vec![Box::new(Drawn::new(world, view, self.width, self.height, self.quality))], transfer }
    }
}

/// Every scene, the intro's own first; in the 64 kB build that alone.
pub const ALL: &[Scene] = &[
    intro::INTRO,
    #[cfg(feature = "bench-scenes")]
    lumen::LUMEN,
    #[cfg(all(feature = "bench-scenes", feature = "day"))]
    day::DAY,
    #[cfg(all(feature = "bench-scenes", feature = "day"))]
    clouds::CLOUDS,
    #[cfg(all(feature = "bench-scenes", feature = "day"))]
    torches::TORCHES,
    #[cfg(all(feature = "bench-scenes", feature = "day"))]
    snowfall::SNOWFALL,
    #[cfg(feature = "bench-scenes")]
    spheres::SPHERES,
    #[cfg(feature = "bench-scenes")]
    spheres::SPHERES_FLAT,
    #[cfg(feature = "bench-scenes")]
    spheres::SPHERES_GLASS,
    #[cfg(feature = "bench-scenes")]
    shadow::SHADOW,
    #[cfg(feature = "bench-scenes")]
    shadow::SHADOW_CUBE,
    #[cfg(feature = "bench-scenes")]
    sky::SKY,
    #[cfg(feature = "bench-scenes")]
    cumulus::CUMULUS,
    #[cfg(feature = "bench-scenes")]
    cumulus::CUMULUS_INSIDE,
    #[cfg(feature = "bench-scenes")]
    cumulus::SKY_OF_CLOUDS,
    #[cfg(feature = "bench-scenes")]
    particles::SNOW,
    #[cfg(feature = "bench-scenes")]
    particles::FIRE,
    #[cfg(all(feature = "bench-scenes", feature = "day"))]
    rain::RAIN,
];

/// The intro's own show: what plays when no scene is named.
pub const INTRO: Scene = ALL[0];

/// Every scene.
pub fn all() -> &'static [Scene] {
    ALL
}

/// The scene of that name.
pub fn named(name: &str) -> Option<Scene> {
    ALL.iter().find(|s| s.name == name).copied()
}
