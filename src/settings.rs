//! Speed against error: every approximation is a field here, and each has an exact limit.
//!
//! There is one plain struct per renderer, and [`Quality`] is the five of them. [`Quality::FAST`] and
//! [`Quality::DEFAULT`] stand at the knees of the measured curves (`docs/report/report.md`); [`Quality::EXACT`] takes no
//! shortcut, and [`Quality::REFERENCE`] takes 64 samples per pixel besides.

use crate::cuts;

/// Settings of the ray tracer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceSettings {
    /// Edge of the coarsest square of the corner grid, pixels: a power of two from 2 to 16. At 1 every pixel is traced.
    pub cell: usize,
    /// A square is interpolated where the error estimated at its centre is at most this, in linear light. With anti-aliasing
    /// one of two pixels whose corners are of one surface needs no such estimate, unless `contrast` is 0.
    pub threshold: f32,
    /// A secondary ray whose weight is below this is not traced and takes the sky's light. Where the brightest light
    /// exceeds 1, its weight counts that many times. At 0 every ray is traced, up to the depth limit.
    pub min_weight: f32,
    /// Hits whose weight is below this share of the light in front of them are interpolated whatever they hit, with
    /// mean textures. At 0 none is.
    pub min_detail: f32,
    /// Whether pixels that an edge crosses are anti-aliased, by samples half a pixel apart.
    pub antialias: bool,
    /// An edge has samples within its pixels where the light of their corners differs by more than this, on the scale of
    /// `threshold`. Elsewhere the corners and their neighbours say how much of the pixel each surface takes.
    pub contrast: f32,
    /// Samples along each axis of every pixel: 1, or 8 for the reference.
    pub grid: usize,
    /// Shadow rays towards a light that has a size: from what the eye sees directly, and from what it sees mirrored or
    /// refracted.
    pub light_samples: [u32; 2],
}

/// Settings of the rasterizer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RasterSettings {
    /// Coverage samples per pixel: 1, 2, 4, 8 or 16. Each triangle in a pixel is shaded once.
    pub coverage: usize,
    /// Texels along an edge of the shadow maps of scenes that do not fix their size: a multiple of 64, the edge of a tile;
    /// others panic. At 0 shadows are traced.
    pub shadow_map: u32,
    /// Samples along each axis of every pixel: 1, or 8 for the reference. Above 1 it replaces `coverage`.
    pub grid: usize,
    /// The light of three lights or more is interpolated between pixels of a triangle's row where it differs by less than
    /// this, of the sum of both; 0 for never.
    pub threshold: f32,
}

/// Settings of the cloud renderer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloudSettings {
    /// Steps along an edge of a cloud's cube of voxels. The error falls with their square.
    pub steps: u32,
    /// Steps per pixel of the cube's edge on the screen, where that makes fewer than `steps`; infinite for never.
    pub detail: f32,
    /// A ray ends inside a cloud where its transmittance falls below this; 0 for never.
    pub opaque: f32,
    /// A ray ends between clouds where its transmittance falls below this, and solids behind are not drawn; 0 for never.
    pub hidden: f32,
    /// Edge of the coarsest square of pixels with rays at its corners, a power of two up to 16. At 1 every pixel has a
    /// ray.
    pub cell: usize,
    /// A square of 2 pixels is interpolated where its centre is off by at most this, in linear light, one of `size` pixels by
    /// `(2 / size)^1.5` of it.
    pub threshold: f32,
    /// Samples along each axis of every pixel, where `cell` is 1.
    pub grid: usize,
    /// Pixels by which an imposter may misplace what it shows; 0 for no imposters.
    pub imposter: f32,
}

/// Settings of the particle renderer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParticleSettings {
    /// Share of a fire's particles that is drawn per pixel of its height; infinite draws them all.
    pub detail: f32,
}

/// Settings of the sky.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkySettings {
    /// Steps along a direction in which scattered light is summed. The error falls with their square.
    pub steps: u32,
    /// Largest angle between directions that are computed, radians; the light between is interpolated. At 0 every pixel
    /// has its own.
    pub cell: f32,
    /// Samples along each axis of every pixel, where `cell` is 0.
    pub grid: usize,
}

/// The settings of all renderers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// The ray tracer's.
    pub trace: TraceSettings,
    /// The rasterizer's.
    pub raster: RasterSettings,
    /// The cloud renderer's.
    pub cloud: CloudSettings,
    /// The particle renderer's.
    pub particles: ParticleSettings,
    /// The sky's.
    pub sky: SkySettings,
}

impl Quality {
    /// Every shortcut, one sample per pixel.
    pub const FAST: Quality = Quality {
        trace: TraceSettings {
            cell: 8,
            threshold: 0.03,
            min_weight: 1.0 / 64.0,
            min_detail: 1.0 / 5.0,
            antialias: false,
            contrast: 0.15,
            grid: 1,
            light_samples: [16, 4],
        },
        raster: RasterSettings { coverage: 1, shadow_map: 1024, grid: 1, threshold: 0.05 },
        cloud: CloudSettings {
            steps: 125,
            detail: 0.5,
            opaque: 1.0 / 256.0,
            hidden: 1.0 / 256.0,
            cell: 16,
            // At 0.06 0.2 % of the pixels of `sky-of-clouds` at 2 and 6 s are off by more than 8 codes, at 0.08 0.3 %, for 0.98
            // of the time.
            threshold: 0.08,
            grid: 1,
            imposter: 0.0,
        },
        particles: ParticleSettings { detail: 1.0 / 128.0 },
        sky: SkySettings { steps: 10, cell: 0.026, grid: 1 },
    };

    /// What the intro plays: every shortcut, anti-aliased.
    pub const DEFAULT: Quality = Quality {
        trace: TraceSettings {
            threshold: 0.02,
            min_weight: 1.0 / 256.0,
            min_detail: 1.0 / 7.0,
            antialias: true,
            ..Quality::FAST.trace
        },
        raster: RasterSettings { coverage: 4, ..Quality::FAST.raster },
        ..Quality::FAST
    };

    /// No shortcut, one sample at each pixel centre.
    pub const EXACT: Quality = Quality {
        trace: TraceSettings {
            cell: 1,
            threshold: 0.0,
            min_weight: 0.0,
            min_detail: 0.0,
            antialias: false,
            contrast: 0.0,
            grid: 1,
            light_samples: [64, 64],
        },
        raster: RasterSettings { coverage: 1, shadow_map: 0, grid: 1, threshold: 0.0 },
        cloud: CloudSettings {
            steps: 800,
            detail: f32::INFINITY,
            opaque: 0.0,
            hidden: 0.0,
            cell: 1,
            threshold: 0.0,
            grid: 1,
            imposter: 0.0,
        },
        particles: ParticleSettings { detail: f32::INFINITY },
        sky: SkySettings { steps: 100, cell: 0.0, grid: 1 },
    };

    /// No shortcut, 64 samples per pixel.
    pub const REFERENCE: Quality = Quality {
        trace: TraceSettings { grid: 8, ..Quality::EXACT.trace },
        raster: RasterSettings { grid: 8, ..Quality::EXACT.raster },
        cloud: CloudSettings { grid: 8, ..Quality::EXACT.cloud },
        sky: SkySettings { grid: 8, ..Quality::EXACT.sky },
        ..Quality::EXACT
    };

    /// The qualities of the command line by name.
    #[cfg(feature = "full")]
    pub const NAMED: [(&'static str, Quality); 4] = [
        ("fast", Quality::FAST),
        ("default", Quality::DEFAULT),
        ("exact", Quality::EXACT),
        ("reference", Quality::REFERENCE),
    ];

    /// The qualities of the command line by name.
    #[cfg(not(feature = "full"))]
    pub const NAMED: [(&'static str, Quality); 2] = [("fast", Quality::FAST), ("default", Quality::DEFAULT)];

    /// The names of [`Quality::NAMED`].
    #[cfg(feature = "full")]
    pub const NAMES: [&'static str; 4] =
        [Quality::NAMED[0].0, Quality::NAMED[1].0, Quality::NAMED[2].0, Quality::NAMED[3].0];

    /// The quality of that name.
    pub fn named(name: &str) -> Option<Quality> {
        Quality::NAMED.into_iter().find(|named| named.0 == name).map(|named| named.1)
    }
}

impl Default for Quality {
    /// [`Quality::DEFAULT`].
    fn default() -> Quality {
        Quality::DEFAULT
    }
}

// The settings as this build has them. In the 64 kB build those in which its two qualities agree are constants, and what
// other values would need is left out.

impl TraceSettings {
    /// These settings; in the 64 kB build all but four are those of [`Quality::FAST`].
    #[inline(always)]
    pub const fn built(&self) -> TraceSettings {
        if cuts::QUALITIES {
            return *self;
        }
        let TraceSettings { threshold, min_weight, min_detail, antialias, .. } = *self;
        TraceSettings { threshold, min_weight, min_detail, antialias, ..Quality::FAST.trace }
    }
}

impl RasterSettings {
    /// These settings; in the 64 kB build all but the coverage are those of [`Quality::FAST`].
    #[inline(always)]
    pub const fn built(&self) -> RasterSettings {
        if cuts::QUALITIES { *self } else { RasterSettings { coverage: self.coverage, ..Quality::FAST.raster } }
    }
}

impl CloudSettings {
    /// These settings; in the 64 kB build those of [`Quality::FAST`].
    #[inline(always)]
    pub const fn built(&self) -> CloudSettings {
        if cuts::QUALITIES { *self } else { Quality::FAST.cloud }
    }
}

impl ParticleSettings {
    /// These settings; in the 64 kB build those of [`Quality::FAST`].
    #[inline(always)]
    pub const fn built(&self) -> ParticleSettings {
        if cuts::QUALITIES { *self } else { Quality::FAST.particles }
    }
}

impl SkySettings {
    /// These settings; in the 64 kB build those of [`Quality::FAST`].
    #[inline(always)]
    pub const fn built(&self) -> SkySettings {
        if cuts::QUALITIES { *self } else { Quality::FAST.sky }
    }
}
