//! What the rasterizer keeps in a renderer's cache: shadow maps and scratch memory.

use super::id::PLAIN;
use super::queue::FragmentQueue;
use super::shadow_maps::ShadowMaps;
use super::visible::{CENTER, SubPixel, Visible};
use crate::frame::cache::keep;

/// Kept from tile to tile, and from frame to frame.
pub struct RasterMemory {
    /// The shadow maps of the lights.
    pub maps: ShadowMaps,
    /// Scratch memory that is not in use: in all there is one for each thread that was drawing at the same time.
    pub(super) spare: Vec<Scratch>,
}
keep!(RasterMemory, RasterMemory { maps: ShadowMaps::NONE, spare: Vec::new() });

/// Memory that a thread needs to draw a tile.
pub(super) struct Scratch {
    /// What is visible at each sample of the pixels, and where that sample lies.
    pub planes: Vec<(Visible, SubPixel)>,
    /// The fragments that wait, by texture; the last queue is for plain colours.
    pub queues: Vec<FragmentQueue>,
}

impl Scratch {
    /// Memory for 16 samples per pixel, of which those that are not used take no room.
    pub fn new() -> Scratch {
        Scratch {
            planes: (0..16).map(|_| (Visible::default(), CENTER)).collect(),
            queues: vec![FragmentQueue::EMPTY; PLAIN as usize + 1],
        }
    }
}
