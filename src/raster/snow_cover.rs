//! Snow that settles: what faces the open sky turns white.
//!
//! How far a surface lies open is a lighting problem: falling snow is a light from above with a shadow map, and what it
//! would give a surface tells the slope and what stands above at once. The depth of snow follows from that, and a surface
//! is covered where the depth exceeds its roughness, which noise varies, so that snow comes in patches. The formula is
//! checked in f64 by `tests/raster/snow_cover.rs`.

use super::light::Light;
use super::queue::{FragmentQueue, POINTS};
use crate::simd::block::{BLOCK, Block3, load, store};
use crate::simd::lanes::{F, Lane, V3, masked};
use crate::simd::math;
use crate::texture::{Palette, Pattern, Texture};
use fearless_simd::prelude::*;
use glam::{Mat3A, Vec2, Vec3A, vec3a};

/// Snow on all surfaces that keep it.
#[derive(Clone, Debug)]
pub struct SnowCover {
    /// How much has fallen: 0 is none, and at 1 all that is level and open is white.
    pub amount: f32,
    /// How it falls: as a light of colour 1 from above would, in whose shadows there is none.
    pub fall: Light,
    /// Light that comes the same way, as from an overcast sky, on a surface that faces it; linear.
    pub sky: Vec3A,
    /// Someone has walked from here to there, straight on: x and z, metres. Nobody has where both are one place.
    pub track: [Vec2; 2],
}

/// The length of a step, metres.
pub const STEP: f32 = 0.7;
/// How far left and right prints lie beside the track, metres.
pub const STANCE: f32 = 0.14;
/// Half the length and half the width of a print, metres.
pub const PRINT: [f32; 2] = [0.17, 0.075];
/// The depth that a foot takes.
pub const SINKS: f32 = 0.4;

/// Albedo of snow where [`GRAIN`] is 0.
pub const WHITE: Vec3A = vec3a(0.8, 0.83, 0.88);
/// Relative change of the albedo where [`GRAIN`] is 1: the relief that wind leaves.
pub const RELIEF: f32 = 0.3;
/// Openness, as the cosine of a slope times the share of the sky, at which snow begins to stay (75 degrees), and from which
/// on all of it stays (46 degrees).
pub const KEEPS: [f32; 2] = [0.25, 0.7];
/// Depth that covers a surface, per albedo in green: dark places are hollows, and pale stalks stand out longest.
pub const ROUGH: f32 = 4.5;
/// Variation, around 0, of roughness and of the snow itself: 0.62 cells per metre. It is noise at the lattice's own height,
/// which takes two thirds of its time, and leans, so that what stands upright has other grain higher up.
pub static GRAIN: Texture = Texture {
    turn: Mat3A::from_cols(vec3a(0.62, 0.0, 0.0), vec3a(0.2, 0.0, 0.3), vec3a(0.0, 0.0, 0.62)),
    ..Texture::new(Pattern::Clouds { octaves: 3 }, Palette::Mix(Vec3A::splat(-0.8), Vec3A::splat(0.8)), 1.0)
};
/// Depth between the first flakes in a place and the last gap.
pub const EDGE: f32 = 0.25;
/// How much roughness varies per metre: by as much, in squares, a pixel on the surface widens [`EDGE`]. To `reference` at
/// 640x360, 88, 93, 98, 103 and 108 s of the show: 41.6, 40.6, 37.4, 42.4, 46.3 dB at 0, 41.6, 40.7, 39.0, 43.3, 46.5 at
/// 1.5, 41.5, 39.6, 38.5, 43.4, 46.7 at 3.
pub const VARIES: f32 = 1.5;

impl SnowCover {
    /// Whitens the surfaces of a queue, removes their gloss and adds the sky's light. `open` holds the openness of each in
    /// its first component, and `grain` the value of [`GRAIN`]. A surface that mirrors as water does keeps no snow.
    #[inline(always)]
    pub(super) fn whiten<S: Simd>(&self, simd: S, open: &Block3, grain: &Block3, queue: &mut FragmentQueue) {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let (open, grain): (F<S>, F<S>) = (load(simd, &open[0], i), load(simd, &grain[0], i));
            let albedo = V3::load(simd, &queue.albedo, i);
            let gloss: F<S> = load(simd, &queue.gloss, i);
            let print = self.print(simd, V3::load(simd, &queue.places[POINTS], i));
            let depth = math::smooth(simd, (open - KEEPS[0]) * (1.0 / (KEEPS[1] - KEEPS[0])))
                * (self.amount * (1.0 + EDGE))
                - print * SINKS;
            let rough = (albedo.y * ROUGH + grain).max(zero).min(one);
            // The mean over the pixel, but where there is no depth and where there is all of it.
            let across = load::<S, F<S>>(simd, &queue.footprint, i) * VARIES;
            let across = across.min(depth).min(-depth + (1.0 + EDGE));
            let edge = (across * across + EDGE * EDGE).sqrt();
            let cover = math::smooth(simd, (depth - rough - 0.5 * EDGE) / edge + 0.5) * (one - gloss);
            let white = V3::splat(simd, WHITE) * Lane(grain * RELIEF + 1.0 - print * RELIEF);
            (albedo + (white - albedo) * Lane(cover)).store(&mut queue.albedo, i);
            (V3::load(simd, &queue.light, i) + V3::splat(simd, self.sky) * Lane(open)).store(&mut queue.light, i);
            store(gloss * (one - cover), &mut queue.gloss, i);
            i += 1;
        }
    }

    /// How far a place lies in a footprint: 1 in the middle, 0 outside.
    #[inline(always)]
    fn print<S: Simd>(&self, simd: S, p: V3<S>) -> F<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let [from, to] = self.track;
        let length = from.distance(to);
        let way = (to - from) / length.max(1e-9);
        let (x, z) = (p.x - from.x, p.z - from.y);
        let (along, across) = (x * way.x + z * way.y, z * way.x - x * way.y);
        let steps = along * (1.0 / STEP);
        let step = steps.floor();
        let half = step * 0.5;
        // Right and left in turn.
        let side = (half - half.floor()) * (4.0 * STANCE) - STANCE;
        let (u, v) = ((steps - step - 0.5) * (STEP / PRINT[0]), (across - side) * (1.0 / PRINT[1]));
        let print = (one - u * u - v * v).max(zero).min(one);
        masked::<S>(print, along.simd_ge(zero) & along.simd_le(length))
    }
}
