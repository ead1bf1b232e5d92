//! What the clouds' renderer does, made visible: steps that a ray takes, and what it meets. All of it runs at the level
//! that every machine has, for one ray at a time, so that the executable has it once: every level gives the same bits.

use super::imposter::Imposter;
use super::march::{CUBE, below_log2, closest, steps_along, within};
use super::seen::{SeenCloud, SeenClouds};
use super::voxels::Voxels;
use crate::frame::Tile;
use crate::simd::lanes::{F, V3};
use crate::simd::math::to_f32;
use crate::vector::unit;
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::Vec3A;
use std::f32::consts::LOG2_E;

/// The ray through a point of the picture: its unit direction, and the distance of a solid, metres.
pub fn ray(clouds: &SeenClouds, tile: &Tile, x: usize, y: usize) -> (Vec3A, f32) {
    let ray = clouds.view.ray(x as f32 + 0.5, y as f32 + 0.5);
    let at = (y - tile.y) * Tile::SIZE + (x - tile.x);
    (unit(ray), ray.length() / tile.inv_depth[at])
}

/// Steps that a ray takes in a cloud, up to `limit` metres: those of the loop of `march`, which ends in the same way.
pub fn steps(seen: &SeenCloud, eye: Vec3A, d: Vec3A, limit: f32, opaque: f32) -> u32 {
    dispatch!(Level::baseline(), simd => steps_in(simd, seen, eye, d, limit, opaque))
}

#[inline(always)]
fn steps_in<S: Simd>(simd: S, seen: &SeenCloud, eye: Vec3A, d: Vec3A, limit: f32, opaque: f32) -> u32 {
    let cloud = &seen.cloud;
    let first = |lanes: F<S>| lanes.as_slice()[0];
    let ways = V3::splat(simd, d);
    let (q, way) = closest::<S>((eye.as_dvec3() - cloud.centre.as_dvec3()) / cloud.size as f64, ways);
    let way = first(way);
    let clip = |(entry, exit)| (first(entry).max(-way), first(exit).min(limit / cloud.size - way));
    let (met, left) = clip(within(simd, q, ways, cloud.voxels.bounds()));
    let (entry, exit) = clip(within(simd, q, ways, CUBE));
    let q = Vec3A::new(first(q.x), first(q.y), first(q.z));
    let steps = first(steps_along::<S>(F::<S>::splat(simd, exit - entry), seen.steps));
    let length = (exit - entry) / steps;
    // Written so that a NaN takes no steps.
    if length.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
        return 0;
    }
    let (most, half) = (to_f32(cloud.voxels.edge() - 1), to_f32(cloud.voxels.edge()) * 0.5);
    let reach = 0.9999 / (length * half * d.abs().max_element());
    let thickness = length * (-cloud.extinction * LOG2_E / Voxels::FULL);
    let least = first(below_log2::<S>(F::<S>::splat(simd, opaque)));
    let (mut step, mut taken, mut depth, mut in_cloud) = (((met - entry) / length).floor().max(0.0), 0, 0.0, false);
    while step < ((left - entry) / length).min(steps) {
        taken += 1;
        let p = q + d * (entry + (step + 0.5) * length);
        let u = (p * half + (half - 0.5)).max(Vec3A::ZERO).min(Vec3A::splat(most));
        let u = V3::splat(simd, u);
        if !in_cloud {
            let leap = cloud.voxels.leap(simd, u).as_slice()[0];
            if leap > 0 {
                step += ((leap - 1) as f32 * reach).floor() + 1.0;
                continue;
            }
        }
        let density = first(cloud.voxels.look_up(simd, u)[0]);
        in_cloud = density > 0.0;
        depth += density * thickness;
        if depth < least {
            break;
        }
        step += 1.0;
    }
    taken
}

/// The imposters in which the ray through a pixel meets clouds: their number, and the mean of the frames since each was
/// drawn, weighted by what it hides; NaN where there are none.
pub fn imposters(clouds: &SeenClouds, near: &[&SeenCloud], tile: &Tile, x: usize, y: usize) -> (usize, f32) {
    let (d, limit) = ray(clouds, tile, x, y);
    let eye = clouds.view.camera().eye;
    let (mut count, mut hidden, mut age) = (0, 0.0, 0.0);
    for seen in near.iter().filter(|seen| limit > seen.distance) {
        let q = (eye - seen.cloud.centre) / seen.cloud.size;
        for (imposter, weight) in &seen.imposters {
            let hides = weight * dispatch!(Level::baseline(), simd => hides(simd, imposter, q, d));
            if hides > 0.0 {
                count += 1;
                hidden += hides;
                age += hides * (clouds.frame - imposter.born) as f32;
            }
        }
    }
    (count, age / hidden)
}

/// The share of what is behind an imposter that it hides along a ray; 0 where the ray passes by.
#[inline(always)]
fn hides<S: Simd>(simd: S, imposter: &Imposter, q: Vec3A, d: Vec3A) -> f32 {
    let at = imposter.cross(simd, q, V3::splat(simd, d));
    let inside = at.iter().all(|lanes| (0.0..=imposter.most()).contains(&lanes.as_slice()[0]));
    if inside { 1.0 - imposter.look_up(simd, at)[0].as_slice()[0] / 255.0 } else { 0.0 }
}

/// Tells what the ray through a pixel meets.
pub fn explain(clouds: &SeenClouds, tile: &Tile, x: usize, y: usize) -> Vec<String> {
    let (d, limit) = ray(clouds, tile, x, y);
    let eye = clouds.view.camera().eye;
    let near = clouds.near(tile);
    let mut lines = vec![format!("{} clouds that rays through the tile may meet", near.len())];
    let opaque = clouds.settings.built().opaque;
    for (number, seen) in near.into_iter().enumerate() {
        let (hidden, lit, passes) = dispatch!(Level::baseline(), simd => met(simd, seen, eye, d, limit, opaque));
        if hidden > 0.0 {
            let imposters = match seen.imposters.len() {
                0 => String::new(),
                count => format!(", {count} imposters"),
            };
            lines.push(format!(
                "cloud {number}, {:.0} m away: hides {:.1} % of what is behind, {:.0} % of its light the sun's, {} steps of \
                 {}, {:.1} % comes through{imposters}",
                seen.distance,
                hidden * 100.0,
                lit / (255.0 * hidden) * 100.0,
                steps(seen, eye, d, limit, opaque),
                seen.steps,
                passes * 100.0
            ));
        }
    }
    lines
}

/// The share of what is behind a cloud that it hides, the part of that which the sun lights, of 255, and the share that
/// comes through.
#[inline(always)]
fn met<S: Simd>(simd: S, seen: &SeenCloud, eye: Vec3A, d: Vec3A, limit: f32, opaque: f32) -> (f32, f32, f32) {
    let [limit, opaque] = [limit, opaque].map(|number| F::<S>::splat(simd, number));
    let passage = seen.meet(simd, eye, V3::splat(simd, d), limit, opaque);
    let first = |lanes: F<S>| lanes.as_slice()[0];
    (first(passage.hidden), first(passage.lit), first(passage.transmittance))
}
