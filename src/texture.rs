//! Solid textures `[Perlin02]`: a scalar field in space, turned into colours by a palette.
//!
//! The point in space is the only coordinate, so nothing is unwrapped and no image is stored (`[Intro07]`). The plain
//! truth is [`Texture::color`], for one point. [`shade`] does the same for blocks of points, and where it is given the
//! size of a pixel on the surface it estimates the mean over it: octaves of noise fade, checks are averaged in closed
//! form.

use crate::angle;
use crate::cuts;
use crate::noise::{self, Footprint};
use crate::simd::block::{BLOCK, Block3, load, store, vectors};
use crate::simd::lanes::{F, V3};
use crate::simd::math;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Mat3A, Vec3A};
use std::f32::consts::{LOG2_E, TAU};

/// Largest phase of marble's layers, radians: beyond, floats have less and less of one, and its sine is none.
const FARTHEST: f32 = 1e5;

/// A scalar field in texture space, about 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// 0 everywhere.
    Plain,
    /// 0 and 1 in turn, in unit squares of x and z; the same at every y.
    Checker,
    /// `1/2 + 1/2 fbm(p)`, see [`noise::fbm`].
    Clouds {
        /// The number of octaves of noise.
        octaves: u32,
    },
    /// [`noise::turbulence`], the sum of octaves of |noise|.
    Turbulence {
        /// The number of octaves of noise.
        octaves: u32,
    },
    /// `1/2 + 1/2 sin(x + warp fbm(p / scale))`: layers along x, folded.
    Marble {
        /// How far noise of 1 moves the layers, radians of x.
        warp: f32,
        /// Size of the first octave's cells, radians of x.
        scale: f32,
        /// The number of octaves of noise.
        octaves: u32,
    },
    /// Year rings around the y axis, one per unit, bent by noise.
    Wood {
        /// How far noise of 1 moves the rings, in rings.
        warp: f32,
        /// The number of octaves of noise.
        octaves: u32,
    },
}

/// How much a texture's colour changes: from this follows the error of a lookup at a slightly wrong point.
#[derive(Clone, Copy, Debug)]
pub struct Variation {
    /// The largest difference between two colours, linear light.
    pub contrast: f32,
    /// The typical change per metre, linear light.
    pub slope: f32,
}

/// The colours, in linear light, of a field's values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Palette {
    /// From the first colour at 0 to the second at 1, not clamped.
    Mix(Vec3A, Vec3A),
    /// Four colours at 0, 1/3, 2/3 and 1, clamped at the ends.
    Ramp([Vec3A; 4]),
}

/// A solid texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// The field in texture space.
    pub pattern: Pattern,
    /// The colours of its values.
    pub palette: Palette,
    /// From world to texture space: a point `p` is looked up at `turn * (p - origin)`. The matrix holds the scale, and
    /// the rotation of the object that the texture is tied to.
    pub turn: Mat3A,
    /// Where the origin of texture space lies in the world, metres.
    pub origin: Vec3A,
}

impl Texture {
    /// One colour everywhere, linear light.
    pub const fn plain(color: Vec3A) -> Texture {
        Texture::new(Pattern::Plain, Palette::Mix(color, color), 1.0)
    }

    /// A pattern that is not tied to an object, with `scale` units of texture space per metre.
    pub const fn new(pattern: Pattern, palette: Palette, scale: f32) -> Texture {
        let turn =
            Mat3A::from_cols(Vec3A::new(scale, 0.0, 0.0), Vec3A::new(0.0, scale, 0.0), Vec3A::new(0.0, 0.0, scale));
        Texture { pattern, palette, turn, origin: Vec3A::ZERO }
    }

    /// The same texture tied to an object at `origin`, metres, whose rotation from world to object is `turn`.
    pub fn on(self, origin: Vec3A, turn: Mat3A) -> Texture {
        Texture { turn: self.turn * turn, origin, ..self }
    }

    /// The colour that stands for all of the texture where its details are too faint to be seen, linear light.
    pub fn mean(&self) -> Vec3A {
        self.paint(match self.pattern {
            Pattern::Plain => 0.0,
            Pattern::Turbulence { .. } => 0.2,
            _ => 0.5,
        })
    }

    /// How much the colour changes.
    pub fn variation(&self) -> Variation {
        // Slope of the field. The gradient of noise is typically 1, that of fbm with n octaves n / 2.
        let field = match self.pattern {
            Pattern::Plain => 0.0,
            Pattern::Checker => 1.0,
            Pattern::Clouds { octaves } => 0.25 * math::to_f32(octaves as usize),
            Pattern::Turbulence { octaves } => 0.5 * math::to_f32(octaves as usize),
            Pattern::Marble { warp, scale, octaves } => 0.5 + 0.25 * warp * math::to_f32(octaves as usize) / scale,
            Pattern::Wood { warp, octaves } => 1.0 + 0.5 * warp * math::to_f32(octaves as usize),
        };
        let contrast = match self.palette {
            Palette::Mix(a, b) => (b - a).abs().max_element(),
            Palette::Ramp(c) => (0..3).map(|i| (c[i + 1] - c[i]).abs().max_element() * 3.0).fold(0.0, f32::max),
        };
        let zoom = self.turn.x_axis.length().max(self.turn.y_axis.length());
        Variation { contrast, slope: field * contrast * zoom }
    }

    /// The colour at a point of the world, linear light: the truth that [`shade`] is tested against.
    pub fn color(&self, p: Vec3A) -> Vec3A {
        let p = self.turn * (p - self.origin);
        let s = match self.pattern {
            Pattern::Plain => 0.0,
            Pattern::Checker => (p.x.floor() + p.z.floor()).rem_euclid(2.0),
            Pattern::Clouds { octaves } => 0.5 + 0.5 * noise::fbm(p, octaves),
            Pattern::Turbulence { octaves } => noise::turbulence(p, octaves),
            Pattern::Marble { warp, scale, octaves } => {
                0.5 + 0.5 * angle::sin(p.x + warp * noise::fbm(p * (1.0 / scale), octaves))
            }
            Pattern::Wood { warp, octaves } => {
                let ring = (p.x * p.x + p.z * p.z).sqrt() + warp * noise::fbm(p, octaves);
                ring - ring.floor()
            }
        };
        self.paint(s)
    }

    /// The palette's colour of a value of the field.
    fn paint(&self, s: f32) -> Vec3A {
        match self.palette {
            Palette::Mix(a, b) => a + (b - a) * s,
            Palette::Ramp(c) => {
                (0..3).fold(c[0], |sum, i| sum + (c[i + 1] - c[i]) * (3.0 * s - i as f32).clamp(0.0, 1.0))
            }
        }
    }
}

/// What of a pattern is a sum of octaves of noise: the number of octaves, whether they are absolute, how far the sum
/// moves the pattern, and the size of the first octave's cells.
#[inline(always)]
fn octaves_of(pattern: &Pattern) -> (u32, bool, f32, f32) {
    match *pattern {
        Pattern::Plain | Pattern::Checker => (0, false, 0.0, 1.0),
        Pattern::Clouds { octaves } => (octaves, false, 0.0, 1.0),
        Pattern::Turbulence { octaves } => (octaves, true, 0.0, 1.0),
        Pattern::Marble { warp, scale, octaves } => (octaves, false, warp, scale),
        Pattern::Wood { warp, octaves } => (octaves, false, warp, 1.0),
    }
}

/// Puts colours, linear light, in the place of the first `count` points of a block: [`Texture::color`], up to [`BLOCK`] at a
/// time.
///
/// `footprint` is the length of a pixel's picture on the surface, metres. Where it is given, a colour is an estimate of
/// the mean over it.
///
/// ```text
/// points -> texture space, in cells of the first octave, in their place
/// octaves of noise there, faded by the footprint -> noise, and the variance that it lost
/// for each vector of points: the pattern's value from point and noise -> the palette's colour
/// ```
#[simd]
pub fn shade<S: Simd>(simd: S, texture: &Texture, block: &mut Block3, count: usize, footprint: Option<&[f32; BLOCK]>) {
    let vectors = vectors(count, F::<S>::LEN);
    let (octaves, absolute, warp, scale) = octaves_of(&texture.pattern);
    let mut foot = [0.0; BLOCK];
    localize(simd, texture, 1.0 / scale, footprint, block, &mut foot);
    let mut field = [0.0; BLOCK];
    let mut lost = [0.0; BLOCK];
    let [x, y, z] = &*block;
    let fading = if footprint.is_some() { Some(Footprint { length: &foot, lost: &mut lost }) } else { None };
    noise::octaves_block(simd, [x, y, z], octaves, absolute, count, fading, &mut field);
    let mut i = 0;
    while i < vectors {
        let p = V3::load(simd, block, i);
        let n = load::<S, F<S>>(simd, &field, i);
        let w = load::<S, F<S>>(simd, &foot, i);
        let lost = load::<S, F<S>>(simd, &lost, i);
        let filter = footprint.is_some();
        let s = match texture.pattern {
            Pattern::Checker if cuts::CHECKER => checker(simd, p, if filter { Some(w) } else { None }),
            Pattern::Plain | Pattern::Turbulence { .. } | Pattern::Checker => n,
            Pattern::Clouds { .. } => n * 0.5 + 0.5,
            Pattern::Marble { .. } | Pattern::Wood { .. } => {
                let wood = matches!(texture.pattern, Pattern::Wood { .. });
                let mut wave = wave(simd, wood, p, n, warp, scale);
                if filter {
                    wave *= damping(simd, wood, w * scale, lost * (warp * warp));
                }
                wave + 0.5
            }
        };
        paint(simd, &texture.palette, s, i, block);
        i += 1;
    }
}

/// Octaves of noise that [`shade`] evaluates at each point of a block with these footprints.
#[cfg(feature = "full")]
pub fn octaves(texture: &Texture, footprint: Option<&[f32; BLOCK]>) -> u32 {
    let (octaves, _, _, scale) = octaves_of(&texture.pattern);
    let zoom = texture.turn.x_axis.length() * (1.0 / scale);
    let shortest = footprint.map_or(0.0, |lengths| lengths.iter().copied().fold(f32::INFINITY, f32::min));
    noise::evaluated(octaves, shortest * zoom)
}

/// Points and footprints in texture space times `pre`.
#[inline(always)]
fn localize<S: Simd>(
    simd: S,
    texture: &Texture,
    pre: f32,
    footprint: Option<&[f32; BLOCK]>,
    points: &mut Block3,
    foot: &mut [f32; BLOCK],
) {
    let zoom = texture.turn.x_axis.length() * pre;
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let p = V3::load(simd, points, i).sub1(texture.origin);
        for (axis, points) in points.iter_mut().enumerate() {
            store(p.dot1(texture.turn.row(axis)) * pre, points, i);
        }
        if let Some(footprint) = footprint {
            store(load::<S, F<S>>(simd, footprint, i) * zoom, foot, i);
        }
        i += 1;
    }
}

/// The checker's value at points, or its mean over windows of the width `w`.
#[inline(always)]
fn checker<S: Simd>(simd: S, p: V3<S>, w: Option<F<S>>) -> F<S> {
    if let Some(w) = w {
        let w = w.max(F::<S>::splat(simd, 1e-3));
        return checks(simd, p.x, w) * checks(simd, p.z, w) * -0.5 + 0.5;
    }
    let half = (p.x.floor() + p.z.floor()) * 0.5;
    (half - half.floor()) * 2.0
}

/// Mean of a square wave of period 2 and height 1 over a window of width `w` around `x`.
#[inline(always)]
fn checks<S: Simd>(simd: S, x: F<S>, w: F<S>) -> F<S> {
    let (a, b) = ((x - w * 0.5) * 0.5, (x + w * 0.5) * 0.5);
    let half = F::<S>::splat(simd, 0.5);
    ((a - a.floor() - half).abs() - (b - b.floor() - half).abs()) * 2.0 / w
}

/// The wave of wood or marble, -1/2 to 1/2: a sawtooth over the rings, or a sine over the layers.
#[inline(always)]
fn wave<S: Simd>(simd: S, wood: bool, p: V3<S>, n: F<S>, warp: f32, scale: f32) -> F<S> {
    if wood {
        let ring = (p.x * p.x + p.z * p.z).sqrt() + n * warp;
        ring - ring.floor() - 0.5
    } else {
        // Points that are far away have no phase left, but the sine has its range.
        math::sin(simd, (p.x * scale + n * warp).max(-FARTHEST).min(FARTHEST)) * 0.5
    }
}

/// What is left of such a wave over a footprint that is `phase` long, whose faded noise had the variance `lost`.
///
/// The mean of a sine with a normally distributed phase is damped by `exp(-variance / 2)`. The phase is spread evenly
/// over the footprint, of which a third lies along any one axis; wood's sawtooth counts as its first sine.
#[inline(always)]
fn damping<S: Simd>(simd: S, wood: bool, phase: F<S>, lost: F<S>) -> F<S> {
    // The variance of the phase, and the square of the radians of a wave.
    let (spread, radians) = if wood { (1.0 / 24.0, TAU * TAU) } else { (1.0 / 36.0, 1.0) };
    let variance = (lost + phase * phase * spread) * radians;
    math::exp2(simd, variance * (-0.5 * LOG2_E))
}

/// The palette's colours of the values `s`, as vector `i` of the block.
#[inline(always)]
fn paint<S: Simd>(simd: S, palette: &Palette, s: F<S>, i: usize, out: &mut Block3) {
    for channel in 0..3 {
        let color = match palette {
            Palette::Mix(a, b) => s * (b[channel] - a[channel]) + a[channel],
            Palette::Ramp(c) => {
                let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
                let mut sum = F::<S>::splat(simd, c[0][channel]);
                for k in 0..3 {
                    let step = (s * 3.0 - k as f32).max(zero).min(one);
                    sum += step * (c[k + 1][channel] - c[k][channel]);
                }
                sum
            }
        };
        store(color, &mut out[channel], i);
    }
}
