//! Pictures of one layer, for scenes that need no more.

use crate::frame::encode::Transfer;
use crate::frame::{FrameSpec, Picture};
#[cfg(feature = "full")]
use crate::raster::{self, RasterLayer};
use crate::trace::{TraceLayer, World};
use crate::view::Camera;

/// A picture that is ray traced alone.
pub fn traced(spec: &FrameSpec, world: World, camera: Camera, transfer: Transfer) -> Picture {
    let traced = TraceLayer::new(world, &spec.view(camera), &spec.quality.trace);
    Picture { layers: vec![Box::new(traced)], transfer }
}

/// A picture of triangles alone.
#[cfg(feature = "full")]
pub fn drawn(spec: &FrameSpec, world: raster::World, camera: Camera, transfer: Transfer) -> Picture {
    let drawn = RasterLayer::new(world, &spec.view(camera), &spec.quality.raster);
    Picture { layers: vec![Box::new(drawn)], transfer }
}
