//! Shadow maps are kept while a light rests, which would spare whoever comes second in a comparison his own.

use paprsek::raster::shadow;

/// Has the next frame draw the first light's map, as if that light had moved: sun and torch do in every frame of a show.
pub fn forget() {
    for (key, _) in shadow::maps().iter_mut().filter(|(key, _)| key.slot == 0) {
        // No light has a plan without views. The memory stays for the next map.
        key.views.clear();
    }
}
