//! Scenes that other renderers are compared by.

pub mod cumulus;
pub mod cumulus_set;
pub mod particles;
pub mod rain;
pub mod shadow;
pub mod shadow_set;
pub mod sky;
mod sky_grid;
pub mod spheres;
