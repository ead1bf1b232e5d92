//! The ray tracer: Whitted's recursion [Whitted80] over convex bodies, with adaptive subdivision by corners [Intro07].
//!
//! A [`World`] of convex bodies, lights and a background becomes a [`TraceLayer`], which fills every pixel of a picture.
//! Rays are traced at the corners of squares of pixels; where the corners agree, the square is interpolated. One flow
//! leads through the files:
//!
//! ```text
//! world, shape   what is there
//! guard          which squares must be cut, because something small is there
//! adaptive       which rays are traced (grid: their samples; job: what a tile reads)
//! packet         what they see (ray: the nearest body; surface: its material; light: the lights)
//! fill, edge     from samples to pixels
//! deferred       textures, at each pixel's own hit point
//! layer          all of it as a layer of a picture
//! ```
//!
//! What is approximated is in [`TraceSettings`](crate::settings::TraceSettings); its limit traces every pixel. The same
//! recursion in plain scalar code, against which the tests hold the packets, is [`mod@reference`].

mod adaptive;
mod deferred;
mod edge;
mod fill;
mod grid;
mod guard;
mod job;
mod layer;
mod light;
mod packet;
pub mod ray;
pub mod reference;
mod sample;
pub mod shape;
mod surface;
pub mod world;

pub use layer::TraceLayer;
pub use shape::Shape;
pub use world::{Background, Emitter, Glow, Light, Material, Object, World};
