//! Paprsek ("ray of light") renders pictures on the processor alone: five renderers, the frame that they share, and the
//! scenes of a 64 kB intro made with them.
//!
//! # A picture
//!
//! A [`Scene`] gives a [`Picture`] for every instant: layers, which a [`Renderer`] draws one over the other into tiles, on
//! all threads. This one is a white ball lit from the upper left, in five rows of nine pixels:
//!
//! ```
//! use paprsek::glam::{Vec3A, vec3a};
//! use paprsek::trace::{Light, Material, Object, Shape, TraceLayer, World};
//! use paprsek::{Camera, Frame, FrameSpec, Picture, Quality, Renderer, Scene, Transfer};
//!
//! fn ball(spec: &FrameSpec) -> Picture {
//!     let ball = Shape::Sphere { center: Vec3A::ZERO, radius: 1.0 };
//!     let world = World {
//!         lights: vec![Light::directional(vec3a(-1.0, 1.0, 1.0).normalize(), Vec3A::ONE)],
//!         ambient: Vec3A::splat(0.1),
//!         ..World::new(vec![Object::new(ball, Material::plain(Vec3A::ONE))])
//!     };
//!     let camera = Camera::look_at(vec3a(0.0, 0.0, 4.0), Vec3A::ZERO, 0.5, 0.0);
//!     let layer = TraceLayer::new(world, &spec.view(camera), &spec.quality.trace);
//!     Picture { layers: vec![Box::new(layer)], transfer: Transfer::Linear }
//! }
//!
//! let scene = Scene { name: "ball", picture: ball, ..Scene::EMPTY };
//! let mut frame = Frame::new(9, 5);
//! Renderer::new(2)?.render(&scene, 0.0, &Quality::EXACT, &mut frame);
//!
//! let shade = |pixel: &u32| match pixel & 255 { 0 => ' ', 1..100 => '.', 100..200 => 'o', _ => '@' };
//! let rows: Vec<String> = frame.pixels.chunks(9).map(|row| row.iter().map(shade).collect()).collect();
//! assert_eq!(rows, [
//!     "   @@o   ",
//!     "  @@@o.  ",
//!     "  @@oo.  ",
//!     "  ooo..  ",
//!     "   ...   ",
//! ]);
//! # Ok::<(), String>(())
//! ```
//!
//! A frame is a pure function of its scene, time, size, quality and parameters: it has the same bytes on every number of
//! threads, at every SIMD level, on every machine, and whatever was rendered before.
//!
//! # The rooms
//!
//! | | |
//! |---|---|
//! | [`trace`] | rays: Whitted's recursion over convex bodies, interpolated where that is good enough |
//! | [`raster`] | triangles: depth first, shadow maps, many lights |
//! | [`cloud`] | clouds: rays through voxels with baked light |
//! | [`particles`] | snow, rain, fire, writing: closed forms of time and a number |
//! | [`sky`] | sun, moon, stars and the light of the air by date and place |
//! | [`effects`] | fog and fades |
//! | [`frame`] | scenes, layers, tiles, threads, and pixels |
//! | [`settings`] | speed against error: [`Quality`] and its five parts |
//! | [`view`], [`angle`], [`vector`], [`texture`], [`noise`], [`timeline`] | cameras, turns, products, solid textures, Perlin's noise, keyframes |
//! | [`simd`] | lanes, blocks, elementary functions, hashes |
//! | [`sound`] | music and noise in closed form |
//! | [`scenes`] | the show, and scenes to measure with |
//!
//! Each renderer's layer can be used alone, as in `examples/`; layers of several make a picture together. Imports run down
//! this list's floors only: no renderer knows another.
//!
//! Lengths are metres, angles radians, times seconds; `y` is up and axes are right-handed; light is linear, and 1 is white.

// Of functions that C libraries compute differently: see clippy.toml.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod angle;
pub mod cloud;
pub mod cuts;
pub mod effects;
pub mod frame;
pub mod noise;
pub mod particles;
pub mod raster;
pub mod scenes;
pub mod settings;
pub mod simd;
pub mod sky;
pub mod sound;
pub mod texture;
pub mod timeline;
pub mod trace;
pub mod vector;
pub mod view;

pub use frame::encode::Transfer;
pub use frame::{Frame, FrameSpec, Layer, Options, Parameter, Picture, Renderer, Scene};
/// The vectors and matrices of this interface.
pub use glam;
pub use settings::Quality;
pub use view::{Camera, View};
