//! The scenes, one file each: what is shown at an instant, from where, and by which renderers.
//!
//! A [`Scene`] is a function from a [`FrameSpec`](crate::frame::FrameSpec) to a [`Picture`](crate::frame::Picture), and
//! a table of the [`Parameter`](crate::frame::Parameter)s that it can be changed by. Only scenes know more than one
//! renderer.
//!
//! - [`show`] is what the intro plays: [`show::intro`], and the parts that it is made of.
//! - [`mod@bench`] are scenes that other renderers are compared by. Each follows a specification.
//! - [`models`] are the meshes that scenes share.
//! - `script` is the byte code that sets and models are written in.

#[cfg(feature = "full")]
pub mod bench;
mod flakes;
pub mod models;
mod script;
pub mod show;
mod single;

use crate::frame::Scene;

/// Every scene, the show first. The 64 kB build has the show alone.
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

/// The show: what plays when no scene is named.
pub const INTRO: Scene = ALL[0];

/// Every scene, the show first.
pub fn all() -> &'static [Scene] {
    ALL
}

/// The scene of that name.
pub fn named(name: &str) -> Option<Scene> {
    ALL.iter().find(|s| s.name == name).copied()
}
