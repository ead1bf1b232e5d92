//! What shading reads of a frame.

use super::depth_map::DepthMap;
use super::rasters::Raster;
use super::world::World;
use crate::view::View;
use std::sync::Arc;

/// Where the shadows of a light are looked up, if it casts any that may be seen.
pub type ShadowLookup = Option<Arc<DepthMap>>;

/// What shading reads of a frame.
pub struct ShadeContext<'a> {
    /// Materials, lights and haze.
    pub world: &'a World,
    /// The shadows of each light, and after those of falling snow.
    pub lookups: &'a [ShadowLookup],
    /// The camera's raster.
    pub raster: &'a Raster,
    /// The camera's view.
    pub view: &'a View,
    /// Share of its pixel that a sample stands for.
    pub share: f32,
    /// The angle that textures are averaged over, radians: of a pixel, or of a cell of the grid in it.
    pub pixel: f32,
    /// [`RasterSettings::threshold`](crate::settings::RasterSettings::threshold).
    pub threshold: f32,
}
