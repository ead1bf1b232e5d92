//! Shadow maps are kept while a light rests, which would spare whoever comes second in a comparison his own.

use paprsek::frame::Renderer;
use paprsek::frame::cache::lock;
use paprsek::raster::RasterMemory;

/// Has the next frame draw the first light's map, as if that light had moved: sun and torch do in every frame of a show.
pub fn forget(renderer: &Renderer) {
    lock(&renderer.cache().get::<RasterMemory>()).maps.forget(0);
}
