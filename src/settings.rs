//! Speed against error, in one value whose limit is exact.

use crate::cuts::BENCH;

/// Every approximation that a renderer may take. [`Quality::EXACT`] and [`Quality::REFERENCE`] take none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Edge of the coarsest cell of the corner grid, pixels: a power of two from 2 to 16; 1 traces every pixel.
    pub cell: usize,
    /// A cell is interpolated when the error estimated at its centre is at most this, linear light.
    pub threshold: f32,
    /// A secondary ray whose weight falls below this, over the brightest light where that is more than 1, is not traced
    /// and takes the sky's light; 0 traces all up to the depth limit.
    pub min_weight: f32,
    /// Hits whose weight is less than this share of the light before them are interpolated whatever they hit, with mean
    /// textures.
    pub min_detail: f32,
    /// Anti-aliasing where an edge runs through a pixel: 0 none, 1 halves and 2 quarters the pixel.
    pub subpixel: u32,
    /// Samples of a pixel along each axis, everywhere: 1, or 8 for the reference.
    pub grid: usize,
    /// Samples of a pixel for the edges of triangles: 1, 2, 4, 8 or 16. Each triangle in a pixel is shaded once.
    pub coverage: usize,
    /// Texels along an edge of the shadow maps of scenes that leave it to the quality; 0 traces shadows instead.
    pub shadow_map: u32,
    /// Steps through a cloud's cube of voxels: the error falls with their square.
    pub cloud_steps: u32,
    /// Steps for each pixel of the cube's edge on the screen, where that makes fewer; infinite for never.
    pub cloud_detail: f32,
    /// Share of the light below which nothing that comes through clouds is looked for; 0 looks for all.
    pub cloud_opaque: f32,
    /// Pixels by which pictures that stand for clouds may be off; 0 for none, where rays are cast in every frame.
    pub cloud_imposter: f32,
    /// Share of a fire's particles that is drawn for each pixel of its height; infinite for all of them.
    pub particle_detail: f32,
    /// Points on a light that has a size: for what the eye sees directly, and for what it sees mirrored or refracted.
    pub light_samples: [u32; 2],
}

impl Quality {
    /// Every shortcut, one sample a pixel.
    pub const FAST: Quality = Quality {
        cell: 8,
        threshold: 0.03,
        min_weight: 1.0 / 64.0,
        min_detail: 1.0 / 5.0,
        subpixel: 0,
        grid: 1,
        coverage: 1,
        shadow_map: 1024,
        cloud_steps: 100,
        cloud_detail: 0.5,
        cloud_opaque: 1.0 / 256.0,
        cloud_imposter: 0.0,
        particle_detail: 1.0 / 128.0,
        light_samples: [16, 4],
    };
    /// What the intro plays: every shortcut, anti-aliased.
    pub const DEFAULT: Quality = Quality { min_detail: 1.0 / 6.0, subpixel: 1, coverage: 4, ..Quality::FAST };
    /// No shortcut, one sample at each pixel centre.
    pub const EXACT: Quality = Quality {
        cell: 1,
        threshold: 0.0,
        min_weight: 0.0,
        min_detail: 0.0,
        subpixel: 0,
        grid: 1,
        coverage: 1,
        shadow_map: 0,
        cloud_steps: 800,
        cloud_detail: f32::INFINITY,
        cloud_opaque: 0.0,
        cloud_imposter: 0.0,
        particle_detail: f32::INFINITY,
        light_samples: [64, 64],
    };
    /// No shortcut, 64 samples a pixel.
    pub const REFERENCE: Quality = Quality { grid: 8, ..Quality::EXACT };

    /// The qualities of the command line.
    #[cfg(feature = "full")]
    pub const NAMED: [(&'static str, Quality); 4] = [
        ("fast", Quality::FAST),
        ("default", Quality::DEFAULT),
        ("exact", Quality::EXACT),
        ("reference", Quality::REFERENCE),
    ];

    /// Those with shortcuts.
    #[cfg(not(feature = "full"))]
    pub const NAMED: [(&'static str, Quality); 2] = [("fast", Quality::FAST), ("default", Quality::DEFAULT)];

    /// Their names.
    #[cfg(feature = "full")]
    pub const NAMES: [&'static str; 4] =
        [Quality::NAMED[0].0, Quality::NAMED[1].0, Quality::NAMED[2].0, Quality::NAMED[3].0];

    /// [`Quality::grid`]: 1 in a build that has no quality without shortcuts.
    #[inline(always)]
    pub fn grid(&self) -> usize {
        if BENCH { self.grid } else { 1 }
    }

    /// The quality of that name.
    pub fn named(name: &str) -> Option<Quality> {
        Quality::NAMED.into_iter().find(|named| named.0 == name).map(|named| named.1)
    }
}
