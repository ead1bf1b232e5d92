//! The rasterizer: triangles with shadow maps, many lights, anti-aliasing by coverage, and snow that settles.
//!
//! A [`World`] of bodies and lights becomes a picture in these stages, each of which has its file:
//!
//! ```text
//! once a frame    fit        views of lights, fitted to what the camera sees         (asked for by scenes)
//!                 setup      faces clipped, snapped and turned into planes
//!                 bins       the triangles of each body sorted into tiles of 64x64 pixels
//! per tile        fill       which triangle each sample shows, but of those that are `hidden`
//!                 collect    fragments: the part of a pixel that shows one triangle, gathered by texture
//!                 shade      surfaces, textures, snow, haze; `illuminate` adds what each light in reach gives
//! when met        depth_map  a tile of a shadow map, for which `rasters` sets up the bodies that it may show;
//!                            `shadow_maps` keeps the maps of lights that stay the same
//! ```
//!
//! So visibility is decided before anything is shaded (deferred shading per tile), a fragment is shaded once whatever the
//! number of its samples, and lights are summed up over visible points only.
//!
//! What approximates, and where its reference stands: shadow maps ([`depth_map`]) against shadows traced through the
//! same triangles (`exact_shadow`), and a few samples per pixel against a grid of 64. Edges are exact at any sample:
//! coverage is decided in whole numbers. The files of `tests/raster/` hold the stages against formulas in f64.
//!
//! ```
//! use glam::{Affine3A, Mat3A, Vec3A, vec3a};
//! use paprsek::frame::encode::Transfer;
//! use paprsek::frame::{Frame, Picture, Renderer};
//! use paprsek::raster::{Bias, Body, Light, Mesh, Paint, RasterLayer, ShadowViews, World, fit};
//! use paprsek::settings::Quality;
//! use paprsek::view::{Camera, View};
//! use std::sync::Arc;
//!
//! // A cube under a sun whose shadows are looked up in two maps, up to 5 and up to 20 metres away.
//! let mut cube = Mesh::painted(&[Paint { albedo: Vec3A::splat(0.7), texture: None, gloss: 0.0 }]);
//! cube.block(&Mat3A::IDENTITY, Vec3A::ZERO, 0);
//! let camera = Camera::look_at(vec3a(3.0, 2.0, 4.0), Vec3A::ZERO, 0.8, 0.0);
//! let towards = vec3a(0.4, 0.8, 0.45).normalize();
//! let views = fit::cascades(&camera, 64.0 / 48.0, towards, &[5.0, 20.0], 512);
//! let bias = Bias { constant: 0.02, slope: 3.0, normal: 0.5 };
//! let sun = Light::sun(towards, Vec3A::ONE).with_shadow(ShadowViews::new(views, bias));
//! let world = World { lights: vec![sun], ..World::new(vec![Body::new(Arc::new(cube), Affine3A::IDENTITY)]) };
//!
//! let layer = RasterLayer::new(world, &View::new(camera, 64, 48), &Quality::DEFAULT.raster);
//! let mut frame = Frame::new(64, 48);
//! let picture = Picture { layers: vec![Box::new(layer)], transfer: Transfer::Srgb };
//! Renderer::new(1)?.draw(picture, &mut frame);
//! assert!(frame.pixels[24 * 64 + 32] > 0x0040_4040 && frame.pixels[0] == 0);
//! # Ok::<(), String>(())
//! ```

pub mod bins;
pub mod cloud_shadow;
mod collect;
mod context;
pub mod depth_map;
mod exact_shadow;
pub mod fill;
pub mod fit;
pub mod form;
pub mod haze;
mod hidden;
pub mod id;
mod illuminate;
#[cfg(feature = "full")]
mod inspect;
mod layer;
pub mod light;
mod lighting;
mod memory;
pub mod mesh;
pub mod project;
mod queue;
mod rasters;
pub mod setup;
mod shade;
pub mod shadow_maps;
pub mod shadow_views;
pub mod snow_cover;
pub mod triangle;
pub mod visible;
pub mod world;

pub use cloud_shadow::CloudShadow;
pub use haze::Haze;
pub use layer::RasterLayer;
pub use light::{Light, Source};
pub use memory::RasterMemory;
pub use mesh::{Face, Mesh, Paint};
pub use project::Projection;
pub use shadow_views::{Bias, ShadowViews};
pub use snow_cover::SnowCover;
pub use world::{Body, World};
