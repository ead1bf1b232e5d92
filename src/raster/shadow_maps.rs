//! Shadow maps kept from frame to frame: a map that would be the same again is not drawn again.
//!
//! A map depends on nothing but its key, so a frame has the same bytes whether or not its maps were kept.

use super::depth_map::{DepthMap, MapKey};
use std::sync::Arc;

/// The latest map of each slot.
pub struct ShadowMaps(Vec<(MapKey, Arc<DepthMap>)>);

impl ShadowMaps {
    /// None yet.
    pub const NONE: ShadowMaps = ShadowMaps(Vec::new());

    /// The map that has this key: the one of an earlier frame, or a new one, which replaces that of the same slot.
    pub fn get(&mut self, key: MapKey) -> Arc<DepthMap> {
        let mut old = None;
        if let Some(at) = self.0.iter().position(|(kept, _)| kept.slot == key.slot) {
            if self.0[at].0 == key {
                return self.0[at].1.clone();
            }
            // Another frame may still be reading it.
            old = Arc::try_unwrap(self.0.swap_remove(at).1).ok();
        }
        let map = Arc::new(DepthMap::new(&key, old));
        self.0.push((key, map.clone()));
        map
    }

    /// The maps that are kept, in no order.
    pub fn iter(&self) -> impl Iterator<Item = &(MapKey, Arc<DepthMap>)> {
        self.0.iter()
    }

    /// Has the map of a slot drawn anew in the next frame, as if its light had moved; its memory is kept for that. For
    /// measurements, where a map of the round before would spare the work that is timed.
    pub fn forget(&mut self, slot: usize) {
        for (key, _) in self.0.iter_mut().filter(|(key, _)| key.slot == slot) {
            // No light has a map without views.
            key.views.clear();
        }
    }
}
