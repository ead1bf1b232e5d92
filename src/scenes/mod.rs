//! One file a scene; only scenes know more than one renderer.

#[cfg(feature = "full")]
pub mod bench;
pub mod models;
mod script;
pub mod show;

use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Picture, Scene};
#[cfg(feature = "full")]
use crate::raster::{self, RasterLayer};
use crate::trace::{TraceLayer, World};
use crate::view::Camera;

/// A picture that is all ray tracing.
fn traced(spec: &FrameSpec, world: World, camera: Camera, transfer: Transfer) -> Picture {
    let traced = TraceLayer::new(world, &spec.view(camera), &spec.quality.trace);
    Picture { layers: vec![Box::new(traced)], transfer }
}

/// A picture that is all triangles.
#[cfg(feature = "full")]
fn drawn(spec: &FrameSpec, world: raster::World, camera: Camera, transfer: Transfer) -> Picture {
    let drawn = RasterLayer::new(world, &spec.view(camera), &spec.quality.raster);
    Picture { layers: vec![Box::new(drawn)], transfer }
}

/// Every scene, the intro's own first; in the 64 kB build that alone.
pub const ALL: &[Scene] = &[
    show::intro::INTRO,
    #[cfg(feature = "full")]
    show::lumen::LUMEN,
    #[cfg(feature = "full")]
    show::day::DAY,
    #[cfg(feature = "full")]
    show::clouds::CLOUDS,
    #[cfg(feature = "full")]
    show::torches::TORCHES,
    #[cfg(feature = "full")]
    show::snowfall::SNOWFALL,
    #[cfg(feature = "full")]
    bench::spheres::SPHERES,
    #[cfg(feature = "full")]
    bench::spheres::SPHERES_FLAT,
    #[cfg(feature = "full")]
    bench::spheres::SPHERES_GLASS,
    #[cfg(feature = "full")]
    bench::shadow::SHADOW,
    #[cfg(feature = "full")]
    bench::shadow::SHADOW_CUBE,
    #[cfg(feature = "full")]
    bench::sky::SKY,
    #[cfg(feature = "full")]
    bench::cumulus::CUMULUS,
    #[cfg(feature = "full")]
    bench::cumulus::CUMULUS_INSIDE,
    #[cfg(feature = "full")]
    bench::cumulus::SKY_OF_CLOUDS,
    #[cfg(feature = "full")]
    bench::particles::SNOW,
    #[cfg(feature = "full")]
    bench::particles::FIRE,
    #[cfg(feature = "full")]
    bench::rain::RAIN,
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
