//! Snow that settles: what faces the open sky turns white.

use super::light::{Light, ShadowLookup};
use super::shade::{Context, Queue, shine};
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math;
use crate::texture::{self, Palette, Pattern, Texture};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3, vec3};

/// Snow on all surfaces that keep any.
#[derive(Clone, Debug)]
pub struct SnowCover {
    /// How much: 0 is none, and at 1 all that is level and open is white.
    pub amount: f32,
    /// How it falls: as light of colour 1 would, from above. Its depth map is what stands in between.
    pub from: Light,
    /// Light that comes the same way, as from a sky of cloud, on a surface that faces it; linear.
    pub gives: Vec3,
}

/// Albedo of snow where [`GRAIN`] is 0,
pub const WHITE: Vec3 = vec3(0.8, 0.83, 0.88);
/// and the share of itself by which that changes where it is 1: what wind makes of it.
pub const RELIEF: f32 = 0.3;
/// Cosines of the steepest slope that keeps snow, 75 degrees, and of the steepest that keeps all, 46; or shares of the sky.
pub const KEEPS: [f32; 2] = [0.25, 0.7];
/// Depth that covers a surface by its albedo in green: what is dark are hollows, and pale stalks stand out longest.
pub const ROUGH: f32 = 4.5;
/// How that varies and the snow itself, around 0, in places of a metre.
pub static GRAIN: Texture =
    Texture::new(Pattern::Clouds { octaves: 3 }, Palette::Mix(Vec3::splat(-0.8), Vec3::splat(0.8)), 0.7);
/// Depth from the first flakes in a place to the last gap.
pub const EDGE: f32 = 0.25;

/// Whitens the surfaces of a queue, takes their gloss, and adds the light from above.
///
/// Where snow lies is a matter of its depth, which falls with the slope and with what stands above, over the roughness of
/// the ground: so it comes in patches. What mirrors as water does keeps none.
#[simd]
#[inline(never)] // As the stages beside it.
pub fn settle<S: Simd>(simd: S, context: &Context, snow: &SnowCover, sight: &ShadowLookup, queue: &mut Queue) {
    let (mut open, mut grain) = ([[0.0; BLOCK]; 3], [[0.0; BLOCK]; 3]);
    shine(simd, context, &snow.from, sight, &queue.point, &queue.normal, &mut open);
    texture::shade(simd, &GRAIN, &queue.point, Some(&queue.footprint), &mut grain);
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let (open, grain): (F<S>, F<S>) = (load(simd, &open[0], i), load(simd, &grain[0], i));
        let albedo = V3::load(simd, &queue.albedo, i);
        let gloss: F<S> = load(simd, &queue.gloss, i);
        let depth =
            math::smooth(simd, (open - KEEPS[0]) * (1.0 / (KEEPS[1] - KEEPS[0]))) * (snow.amount * (1.0 + EDGE));
        let rough = (albedo.y * ROUGH + grain).max(zero).min(one);
        let cover = math::smooth(simd, (depth - rough) * (1.0 / EDGE)) * (one - gloss);
        let white = V3::splat(simd, WHITE) * Lane(grain * RELIEF + 1.0);
        (albedo + (white - albedo) * Lane(cover)).store(&mut queue.albedo, i);
        (V3::load(simd, &queue.light, i) + V3::splat(simd, snow.gives) * Lane(open)).store(&mut queue.light, i);
        store(gloss * (one - cover), &mut queue.gloss, i);
        i += 1;
    }
}
