//! Volumetric clouds: cubes of voxels that are lit once and then marched through by rays.
//!
//! A cloud is a cube of densities between which light is absorbed and scattered by the law of Beer and Lambert. The
//! method is that of `[Kajiya84]` in two passes, as a game uses it `[Clouds10]`: light from the sun is computed for
//! every voxel beforehand, and the rays of the picture then only gather it. On the way from a formula to pixels:
//!
//! 1. [`shape`] makes a cloud's densities: balls on a flat base, warped and eroded by noise.
//! 2. [`voxels`] stores them with their light, and knows how much empty space a ray may leap over.
//! 3. [`sunlight`] finds the light of every voxel in one sweep, and does so again when the sun has moved.
//! 4. [`field`] places clouds (`world`) in a sky and lets the wind carry them; [`shadow`] has the light that they leave
//!    for each other and for the ground.
//! 5. `seen` sorts them for an eye, and decides how many steps each is worth.
//! 6. [`march`] takes a vector of rays through one cloud. Where the settings allow it, an `imposter`, which is a
//!    picture kept from earlier frames (`imposter_cache`), stands for the cloud instead.
//! 7. `cells` decides which pixels of a tile get a ray and which are interpolated, and mixes in what is solid.
//! 8. `layer` is all of that as a layer of a picture.
//!
//! Clouds are drawn after solids and before the sky: what they hide counts as covered, so the sky fills what is left.
//!
//! Every approximation is a field of [`CloudSettings`](crate::settings::CloudSettings). The reference is a march in
//! `f64` (`tools/testkit/src/voxels.rs`).

mod cells;
pub mod field;
pub mod grain;
mod imposter;
mod imposter_cache;
#[cfg(feature = "full")]
mod inspect;
mod layer;
pub mod march;
mod seen;
pub mod shadow;
pub mod shape;
pub mod sunlight;
pub mod voxels;
mod world;

pub use field::CloudField;
pub use layer::CloudLayer;
pub use shape::CloudKind;
pub use voxels::Voxels;
pub use world::{Cloud, CloudLight};
