//! The sky through the day and the year: sun, moon and stars by time and place, and the light of the air between, after
//! the thesis `[Sun07]`.
//!
//! ```text
//! time, place -> Sky: sun, moon, turn of the stars, air
//! Sky -> Dome: the light of every direction, and how the eye has adapted to it
//! Dome, View -> SkyLayer: the dome at the corners of cells, stars, discs of sun and moon
//! Dome -> Lighting: what lights the ground, for the other renderers
//! ```
//!
//! World axes are x east, y up, z south. Light is linear, relative to the sun's outside of the air where it is
//! physical, and 0 to 1 where it is shown. What is approximated is in [`SkySettings`](crate::settings::SkySettings).
//!
//! - [`time`]: the calendar. [`place`]: a place's horizon, and refraction.
//! - [`sun`], [`moon`]: where they are, rise and set, phases.
//! - [`air`]: what air scatters and lets through.
//! - [`dome`]: the light of the sky at an instant. [`light`]: what of it matters on the ground.
//! - [`cells`], [`stars`], [`disc`]: the parts of the picture. [`layer`]: all of them as a layer.
//!
//! The tests hold sun and moon against `[SPA]` and `[Ephem]`, and the light of the air against an integral in f64.

pub mod air;
pub mod cells;
pub mod disc;
pub mod dome;
pub mod layer;
pub mod light;
pub mod moon;
pub mod place;
pub mod stars;
pub mod sun;
pub mod time;

pub use dome::{Dome, Sky};
pub use layer::SkyLayer;
pub use light::Lighting;
pub use place::Place;
