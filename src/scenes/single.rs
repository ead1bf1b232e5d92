//! Pictures of one layer, for scenes that need no more.

use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Picture};
#[cfg(feature = "full")]
use crate::raster::{self, RasterLayer};
use crate::trace::{TraceLayer, World};
use crate::view::Camera;
#[cfg(feature = "full")]
use crate::view::View;

/// A picture that is ray traced alone.
pub fn traced(spec: &FrameSpec, world: World, camera: Camera, transfer: Transfer) -> Picture {
    let traced = TraceLayer::new(world, &spec.view(camera), &spec.quality.trace);
    Picture { layers: vec![Box::new(traced)], transfer }
}

/// A picture of triangles alone.
#[cfg(feature = "full")]
pub fn drawn(spec: &FrameSpec, world: raster::World, camera: Camera, transfer: Transfer) -> Picture {
    let view = View::new(spec.camera(camera), spec.width, spec.height);
    Picture { layers: vec![Box::new(RasterLayer::new(world, view, spec.width, spec.height, *spec.quality))], transfer }
}
