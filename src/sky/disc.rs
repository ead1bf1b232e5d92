//! The discs of sun and moon, and the glare around the sun.
//!
//! Both go through the dome's shoulder. The moon is a sphere of dust (Lommel and Seeliger's law) with seas of noise,
//! lit from where the sun is, so its phase follows.

use super::cells::put;
use super::dome::Dome;
use super::sun;
use crate::frame::Tile;
use crate::noise;
use crate::simd::block::{BLOCK, Block3, load};
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math::{exp3, to_f32};
use crate::vector::cross;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3A, vec3a};

/// The disc of the sun or the moon.
#[derive(Clone, Copy, Debug)]
pub struct Disc {
    /// Unit vectors: towards its middle, to its right, and to its top.
    axes: [Vec3A; 3],
    /// Radius, radians.
    radius: f32,
    /// Distance from the middle up to which anything is drawn, in radii.
    reach: f32,
    /// Its light before the shoulder.
    color: Vec3A,
    /// The share of that which is seen on the disc: all of the moon's, and so much of the sun's that its colour can be
    /// told.
    seen: f32,
    /// The glare at its rim over its light; 0 for the moon.
    glare: f32,
    /// Unit vector from the moon to the sun, along right, up and towards the eye. The sun's disc does not use it.
    sun: Vec3A,
    /// The share of the moon's light that its dark part has.
    unlit: f32,
}

/// Axes of a disc in the direction `d` whose top is towards `pole`; unit vectors.
fn axes(d: Vec3A, pole: Vec3A) -> [Vec3A; 3] {
    let right = cross(d, pole).normalize_or(Vec3A::X);
    [d, right, cross(right, d)]
}

impl Dome {
    /// The sun's disc. Near the horizon it is up to 1.6 times as large, as it seems there. `gaze`, a unit vector, is
    /// where the eye looks: into the sun the glare is strongest.
    pub fn sun_disc(&self, gaze: Vec3A) -> Disc {
        let d = self.sky.sun;
        let near = d.y * 8.0;
        // Never 0, which is the moon.
        let into = d.dot(gaze).max(0.1);
        let color = self.through(d) * self.exposure;
        let radius = sun::RADIUS as f32 * self.sun_size * (1.0 + 0.6 / (1.0 + near * near));
        Disc {
            axes: axes(d, Vec3A::Y),
            radius,
            reach: 0.35 / radius,
            color,
            seen: (3.0 / color.max_element()).min(1.0),
            glare: 0.12 * into * into * into * into,
            sun: Vec3A::ZERO,
            unlit: 0.0,
        }
    }

    /// The moon's disc.
    pub fn moon_disc(&self) -> Disc {
        let sky = &self.sky;
        let axes = axes(sky.moon, sky.turn.z_axis);
        // A surface of albedo 0.12 in sunlight. The eye adapts to it too, more than to the sky.
        let light = 0.04 * self.exposure;
        let color = self.through(sky.moon) * (1.4 * light / (1.0 + light));
        let sun = vec3a(sky.moon_to_sun.dot(axes[1]), sky.moon_to_sun.dot(axes[2]), -sky.moon_to_sun.dot(axes[0]));
        let radius = sky.moon_radius * self.moon_size;
        Disc { axes, radius, reach: 1.1, color, seen: 1.0, glare: 0.0, sun, unlit: 0.03 * (1.0 - sky.lit) }
    }
}

/// Half of a tile's edge, and a little more than half of its diagonal, pixels.
const HALF: f32 = Tile::SIZE as f32 / 2.0;
const AROUND: f32 = 46.0;

/// Draws a disc over a tile of sky, behind what solids have left.
///
/// ```text
/// for each row of pixels that the disc or its glare meets:
///     offsets from the disc's middle -> point of the sphere that is seen there
///     the moon: noise at these points -> seas, the sun's direction -> what is lit
///     the sun: the disc -> glare with rays
///     the light through the dome's shoulder, added to the tile
/// ```
#[simd]
pub fn draw<S: Simd>(simd: S, disc: &Disc, view: &View, tile: &mut Tile) {
    let (left, top) = (to_f32(tile.x) + 0.5, to_f32(tile.y) + 0.5);
    // A pixel in the middle of the view is the widest.
    let away = view.direction(left + HALF, top + HALF).distance(disc.axes[0]);
    if away > AROUND * view.pixel() + disc.reach * disc.radius || disc.color.max_element() < 1e-5 {
        return;
    }
    let moon = disc.glare == 0.0;
    for row in 0..tile.height {
        let mut points = [[0.0; BLOCK]; 3];
        let mut spots = [0.0; BLOCK];
        if !offsets(simd, disc, view, left, top + to_f32(row), &mut points) {
            continue;
        }
        if moon {
            let [x, y, z] = &points;
            noise::octaves_block(simd, [x, y, z], 4, false, BLOCK, None, &mut spots);
        }
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
            let p = V3::load(simd, &points, i);
            let squared = p.x * p.x + p.y * p.y;
            let distance = squared.sqrt().max(1e-6);
            let covers = ((one - distance) * (disc.radius / view.pixel()) + 0.5).max(zero).min(one);
            let mut light = covers * disc.seen;
            if moon {
                light = moonlit(simd, disc, p, load(simd, &spots, i), light);
            } else {
                light += glare(simd, disc, p, squared, distance);
            }
            // The shoulder of the dome, of both lights together.
            let shown = V3::splat(simd, Vec3A::ONE) - exp3(simd, V3::splat(simd, disc.color) * Lane(light), -1.0);
            // The dome's light is shown too bright beside the sun to leave the low disc its colour.
            let hides = if moon { zero } else { covers * shown.x * 0.6 };
            put(simd, shown, Some(hides), row, i, tile);
            i += 1;
        }
    }
}

/// The points of a unit sphere that stands for the disc, along its right, up and towards the eye, for the pixels of a
/// row from (`left`, `y`) on; beyond its rim the last is 0. Returns whether any pixel is within the disc's reach.
#[inline(always)]
fn offsets<S: Simd>(simd: S, disc: &Disc, view: &View, left: f32, y: f32, points: &mut Block3) -> bool {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let [d, right, up] = disc.axes;
    let k = 1.0 / disc.radius;
    let mut columns = [0.0; BLOCK];
    for (i, column) in columns.iter_mut().enumerate() {
        *column = left + to_f32(i);
    }
    let mut any = false;
    let mut i = 0;
    while i < BLOCK / F::<S>::LEN {
        let ray = view.rays(simd, load(simd, &columns, i), F::<S>::splat(simd, y));
        let ray = ray * Lane(one * k / ray.dot(ray).sqrt());
        // Rays into the half of the sky behind are moved out of reach.
        let (u, v) = (ray.dot1(d).simd_lt(zero).select(one * k, ray.dot1(right)), ray.dot1(up));
        let squared = u * u + v * v;
        any |= squared.simd_lt(disc.reach * disc.reach).any_true();
        let p: V3<S> = V3 { x: u, y: v, z: (one - squared).max(zero).sqrt() };
        p.store(points, i);
        i += 1;
    }
    any
}

/// What of `light` the moon sends from a point of its sphere, by the sun's direction and the noise there.
#[inline(always)]
fn moonlit<S: Simd>(simd: S, disc: &Disc, p: V3<S>, noise: F<S>, light: F<S>) -> F<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let sun = (p.x * disc.sun.x + p.y * disc.sun.y + p.z * disc.sun.z).max(zero);
    // Lommel and Seeliger's law: dust does not darken towards the rim.
    let lit = sun * 2.0 / (sun + p.z + 1e-3);
    let seas = (noise * -2.2 + 0.85).max(0.45).min(one);
    light * (lit.min(one) + disc.unlit) * seas
}

/// The glare around the sun: it falls with the square of the distance, to nothing where it ends, and has rays.
#[inline(always)]
fn glare<S: Simd>(simd: S, disc: &Disc, p: V3<S>, squared: F<S>, distance: F<S>) -> F<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let end = (one - squared * (1.0 / (disc.reach * disc.reach))).max(zero);
    // Rays are four waves around the sun, each with twice as many crests as the one before. (x, y) is their cosine and
    // sine; a square of that number doubles the angle.
    let (mut x, mut y) = (p.x / distance, p.y / distance);
    let mut rays = one;
    let mut k = 0;
    while k < 4 {
        let next = x * x - y * y;
        y = x * y * 2.0;
        // A turn between, so that their crests do not meet.
        x = next * 0.8 - y * 0.6;
        y = next * 0.6 + y * 0.8;
        rays += x * 0.22;
        k += 1;
    }
    end * end * (rays / (squared + 1.0) + end * 0.05) * disc.glare
}
