//! Particles: snow, rain, fire and writing made of sparks, drawn as soft sprites over what is there.
//!
//! A particle system in the sense of `[Reeves83]`, but without a state: where a particle is, and how it looks, is a
//! closed form of the time and of its number, whose hash gives it its chances. So nothing is emitted, stored or
//! recycled from frame to frame, every instant can be rendered alone, and all particles are independent of each other.
//!
//! 1. [`snow`], [`fire`] and [`strokes`] say where each particle is and how bright: a `batch` is as many particles as a
//!    vector has lanes. An `emitter` is one of them.
//! 2. `screen` projects a batch through a `lens`. The particles that are seen become ellipses (`sprite`).
//! 3. `chunk` lists sprites by the tiles that they touch.
//! 4. `blend` draws a tile's sprites into planes of their own, and the planes over the tile. Flakes close by are snow
//!    crystals (`crystal`).
//! 5. `layer` is all of that as a layer of a picture.
//!
//! [`flicker`] is how the light wavers that a fire throws on other things.
//!
//! Particles of a layer are drawn in any order, which needs no sorting and is exact for what they are made for: flakes
//! of one colour, which together let a product of shares of the light behind through, and sparks that only add light.
//!
//! The only approximation is [`ParticleSettings::detail`](crate::settings::ParticleSettings::detail). The reference is
//! a drawing of the same text in `f64` with time that is never rounded (`tools/testkit/src/particles.rs`).

mod batch;
mod blend;
mod chunk;
mod crystal;
mod emitter;
pub mod fire;
pub mod flicker;
mod layer;
mod lens;
mod screen;
pub mod snow;
mod sprite;
pub mod strokes;

pub use emitter::Emitter;
pub use fire::{Fire, Flame};
pub use layer::ParticleLayer;
pub use lens::Lens;
pub use snow::{Calm, Flakes, Snow};
pub use strokes::Strokes;
