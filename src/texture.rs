//! Solid textures: a scalar field in space, through a palette. The hit point is the only coordinate (thesis A).

use crate::cuts::BENCH;
use crate::noise::{self, Footprint};
pub use crate::simd::block::Block3;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, V3};
use crate::simd::math;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Mat3, Vec3};
use std::f32::consts::{LOG2_E, TAU};

/// The scalar field, about 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pattern {
    /// 0 everywhere.
    Plain,
    /// 0 and 1 in turn, in unit squares of x and z.
    Checker,
    /// 1/2 + 1/2 fbm.
    Clouds {
        /// Octaves of noise.
        octaves: u32,
    },
    /// Turbulence: the sum of octaves of |noise|.
    Turbulence {
        /// Octaves of noise.
        octaves: u32,
    },
    /// 1/2 + 1/2 sin(x + warp fbm(p / scale)): layers along x, folded.
    Marble {
        /// Radians that the noise moves the layers.
        warp: f32,
        /// Length of the lowest octave, in radians of x.
        scale: f32,
        /// Octaves of noise.
        octaves: u32,
    },
    /// Year rings around the y axis, one a unit, bent by noise.
    Wood {
        /// Rings that the noise moves them.
        warp: f32,
        /// Octaves of noise.
        octaves: u32,
    },
}

/// How a texture's colour changes, for the error of a displaced lookup.
#[derive(Clone, Copy, Debug)]
pub struct Variation {
    /// At most, linear light.
    pub contrast: f32,
    /// Typically, linear light a metre.
    pub slope: f32,
}

/// From the field to a colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Palette {
    /// From the first colour at 0 to the second at 1, not clamped.
    Mix(Vec3, Vec3),
    /// Four colours at 0, 1/3, 2/3 and 1, clamped at the ends.
    Ramp([Vec3; 4]),
}

/// A solid texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Texture {
    /// The field.
    pub pattern: Pattern,
    /// Its colours.
    pub palette: Palette,
    /// World to texture: a point p is looked up at `turn * (p - origin)`. Scales, and ties the texture to an object.
    pub turn: Mat3,
    /// Where the texture's origin lies in the world.
    pub origin: Vec3,
}

impl Texture {
    /// One colour.
    pub const fn plain(color: Vec3) -> Texture {
        Texture::new(Pattern::Plain, Palette::Mix(color, color), 1.0)
    }

    /// A pattern in world space, `scale` units of texture a metre.
    pub const fn new(pattern: Pattern, palette: Palette, scale: f32) -> Texture {
        let turn = Mat3::from_cols(Vec3::new(scale, 0.0, 0.0), Vec3::new(0.0, scale, 0.0), Vec3::new(0.0, 0.0, scale));
        Texture { pattern, palette, turn, origin: Vec3::ZERO }
    }

    /// The same texture, tied to an object at `origin` that is turned by `turn` (world to object).
    pub fn on(self, origin: Vec3, turn: Mat3) -> Texture {
        Texture { turn: self.turn * turn, origin, ..self }
    }

    /// The colour that stands for all of the texture where it is too faint to be seen.
    pub fn mean(&self) -> Vec3 {
        self.paint(match self.pattern {
            Pattern::Plain => 0.0,
            Pattern::Turbulence { .. } => 0.2,
            _ => 0.5,
        })
    }

    /// How the colour changes.
    pub fn variation(&self) -> Variation {
        // The gradient of fbm with n octaves is about n/2 times that of noise, whose typical size is 1.
        let field = match self.pattern {
            Pattern::Plain => 0.0,
            Pattern::Checker => 1.0,
            Pattern::Clouds { octaves } => 0.25 * octaves as f32,
            Pattern::Turbulence { octaves } => 0.5 * octaves as f32,
            Pattern::Marble { warp, scale, octaves } => 0.5 + 0.25 * warp * octaves as f32 / scale,
            Pattern::Wood { warp, octaves } => 1.0 + 0.5 * warp * octaves as f32,
        };
        let contrast = match self.palette {
            Palette::Mix(a, b) => (b - a).abs().max_element(),
            Palette::Ramp(c) => (0..3).map(|i| (c[i + 1] - c[i]).abs().max_element() * 3.0).fold(0.0, f32::max),
        };
        let zoom = self.turn.x_axis.length().max(self.turn.y_axis.length());
        Variation { contrast, slope: field * contrast * zoom }
    }

    /// The colour at a point: the truth that [`shade`] is tested against.
    pub fn color(&self, p: Vec3) -> Vec3 {
        let p = self.turn * (p - self.origin);
        let s = match self.pattern {
            Pattern::Plain => 0.0,
            Pattern::Checker => (p.x.floor() + p.z.floor()).rem_euclid(2.0),
            Pattern::Clouds { octaves } => 0.5 + 0.5 * noise::fbm(p, octaves),
            Pattern::Turbulence { octaves } => noise::turbulence(p, octaves),
            Pattern::Marble { warp, scale, octaves } => {
                0.5 + 0.5 * (p.x + warp * noise::fbm(p * (1.0 / scale), octaves)).sin()
            }
            Pattern::Wood { warp, octaves } => {
                let ring = (p.x * p.x + p.z * p.z).sqrt() + warp * noise::fbm(p, octaves);
                ring - ring.floor()
            }
        };
        self.paint(s)
    }

    /// The palette's colour for a value of the field.
    fn paint(&self, s: f32) -> Vec3 {
        match self.palette {
            Palette::Mix(a, b) => a + (b - a) * s,
            Palette::Ramp(c) => {
                (0..3).fold(c[0], |sum, i| sum + (c[i + 1] - c[i]) * (3.0 * s - i as f32).clamp(0.0, 1.0))
            }
        }
    }
}

/// The colours of a block of points: [`Texture::color`], [`BLOCK`] at a time.
///
/// `footprint`, metres, is the length of a pixel's picture on the surface; where it is not 0 the colour is an estimate of
/// the mean over it. Octaves of noise fade ([`noise::octaves_block`]), and what has faded inside of a sine damps it by
/// `exp(-variance / 2)`, the mean of a sine with a normal phase.
#[simd]
pub fn shade<S: Simd>(simd: S, texture: &Texture, points: &Block3, footprint: Option<&[f32; BLOCK]>, out: &mut Block3) {
    let mut local = [[0.0; BLOCK]; 3];
    let (octaves, absolute, warp, scale) = match texture.pattern {
        Pattern::Plain | Pattern::Checker => (0, false, 0.0, 1.0),
        Pattern::Clouds { octaves } => (octaves, false, 0.0, 1.0),
        Pattern::Turbulence { octaves } => (octaves, true, 0.0, 1.0),
        Pattern::Marble { warp, scale, octaves } => (octaves, false, warp, scale),
        Pattern::Wood { warp, octaves } => (octaves, false, warp, 1.0),
    };
    let pre = 1.0 / scale;
    let mut foot = [0.0; BLOCK];
    let zoom = texture.turn.x_axis.length() * pre;
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let p = V3::load(simd, points, i).sub1(texture.origin);
        for (axis, local) in local.iter_mut().enumerate() {
            store(p.dot1(texture.turn.row(axis)) * pre, local, i);
        }
        if let Some(footprint) = footprint {
            store(load::<S, F<S>>(simd, footprint, i) * zoom, &mut foot, i);
        }
        i += 1;
    }
    let mut field = [0.0; BLOCK];
    let mut lost = [0.0; BLOCK];
    let [x, y, z] = &local;
    let fade = if footprint.is_some() { Some(Footprint { length: &foot, lost: &mut lost }) } else { None };
    noise::octaves_block(simd, [x, y, z], octaves, absolute, fade, &mut field);
    let wood = matches!(texture.pattern, Pattern::Wood { .. });
    // A sine's phase is even over the footprint, of which a third lies along any one axis; and radians of a wave.
    let (spread, radians) = if wood { (1.0 / 24.0, TAU * TAU) } else { (1.0 / 36.0, 1.0) };
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let p = V3::load(simd, &local, i);
        let n = load::<S, F<S>>(simd, &field, i);
        let w = load::<S, F<S>>(simd, &foot, i);
        let lost = load::<S, F<S>>(simd, &lost, i);
        let s = match texture.pattern {
            // What the show has of lumen has none.
            Pattern::Checker if BENCH && footprint.is_some() => {
                let w = w.max(F::<S>::splat(simd, 1e-3));
                checks(simd, p.x, w) * checks(simd, p.z, w) * -0.5 + 0.5
            }
            Pattern::Checker if BENCH => {
                let half = (p.x.floor() + p.z.floor()) * 0.5;
                (half - half.floor()) * 2.0
            }
            Pattern::Plain | Pattern::Turbulence { .. } | Pattern::Checker => n,
            Pattern::Clouds { .. } => n * 0.5 + 0.5,
            Pattern::Marble { .. } | Pattern::Wood { .. } => {
                let mut wave = if wood {
                    let ring = (p.x * p.x + p.z * p.z).sqrt() + n * warp;
                    ring - ring.floor() - 0.5
                } else {
                    math::sin(simd, p.x * scale + n * warp) * 0.5
                };
                if footprint.is_some() {
                    let phase = w * scale;
                    let variance = (lost * (warp * warp) + phase * phase * spread) * radians;
                    wave *= math::exp2(simd, variance * (-0.5 * LOG2_E));
                }
                wave + 0.5
            }
        };
        for channel in 0..3 {
            let color = match &texture.palette {
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
        i += 1;
    }
}

/// Mean of a square wave of period 2 and height 1 over a window of width `w` around `x`.
#[inline(always)]
fn checks<S: Simd>(simd: S, x: F<S>, w: F<S>) -> F<S> {
    let (a, b) = ((x - w * 0.5) * 0.5, (x + w * 0.5) * 0.5);
    let half = F::<S>::splat(simd, 0.5);
    ((a - a.floor() - half).abs() - (b - b.floor() - half).abs()) * 2.0 / w
}
