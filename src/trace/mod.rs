//! The ray tracer: Whitted's recursion `[Whitted80]` over convex bodies, with adaptive subdivision by corners `[Intro07]`.
//!
//! A [`World`] of convex bodies, lights and a background becomes a [`TraceLayer`], which fills every pixel of a picture.
//! Rays are traced at the corners of squares of pixels; where the corners agree, the square is interpolated. One flow
//! leads through the files:
//!
//! ```text
//! world, shape   what is there
//! guard          which squares must be cut, because something small is there
//! adaptive       which rays are traced (grid: their samples; job: what a tile reads)
//! packet         what they see (ray: the nearest body; bounds: which bodies may be it; surface: its material; light: the lights)
//! fill, edge     from samples to pixels
//! deferred       textures, at each pixel's own hit point
//! layer          all of it as a layer of a picture
//! ```
//!
//! What is approximated is in [`TraceSettings`](crate::settings::TraceSettings); its limit traces every pixel. The same
//! recursion in plain scalar code, against which the tests hold the packets, is [`mod@reference`].
//!
//! A shining ball on a floor, one tile of it:
//!
//! ```
//! use glam::{Vec3A, vec3a};
//! use paprsek::frame::{Layer, Tile};
//! use paprsek::settings::Quality;
//! use paprsek::simd::level;
//! use paprsek::trace::{Background, Light, Material, Object, Shape, TraceLayer, World};
//! use paprsek::view::{Camera, View};
//!
//! let ball = Shape::Sphere { center: Vec3A::Y, radius: 1.0 };
//! let floor = Shape::Plane { normal: Vec3A::Y, offset: 0.0 };
//! let world = World {
//!     lights: vec![Light::point(vec3a(3.0, 5.0, 4.0), Vec3A::ONE)],
//!     ambient: Vec3A::splat(0.1),
//!     background: Background::gradient(vec3a(0.7, 0.8, 0.9), vec3a(0.2, 0.4, 0.7)),
//!     ..World::new(vec![
//!         Object::new(ball, Material::plain(vec3a(0.8, 0.1, 0.1)).polished(0.2, 0.5, 50.0)),
//!         Object::new(floor, Material::plain(Vec3A::splat(0.5))).without_shadow(),
//!     ])
//! };
//! let camera = Camera::look_at(vec3a(0.0, 1.5, 6.0), Vec3A::Y, 0.8, 0.0);
//! let layer = TraceLayer::new(world, &View::new(camera, 64, 64), &Quality::DEFAULT.trace);
//! let mut tile = Tile::at(0, 0, 64, 64);
//! layer.draw(level::best(), &mut tile);
//! // The pixel in the middle shows the ball.
//! let middle = 32 * Tile::SIZE + 32;
//! assert!(tile.red[middle] > 2.0 * tile.blue[middle] && tile.inv_depth[middle] > 0.15);
//! ```

mod adaptive;
pub mod bounds;
mod deferred;
mod edge;
mod fill;
mod grid;
mod guard;
#[cfg(feature = "full")]
mod inspect;
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
pub use surface::fresnel;
pub use world::{Background, Emitter, Glow, Light, Material, Object, World};
