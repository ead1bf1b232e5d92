//! Scenes that other renderers are compared by, each after a specification, and `rain`, which is not in the show.

pub mod cumulus;
pub mod cumulus_set;
pub mod particles;
pub mod rain;
pub mod shadow;
pub mod shadow_set;
pub mod sky;
mod sky_grid;
pub mod spheres;
