//! The discs of sun and moon, and the glare around the sun.

use super::dome::Dome;
use super::grid::put;
use crate::frame::Tile;
use crate::noise;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{F, Lane, V3};
use crate::simd::math::exp3;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::{Vec3, vec3};

/// A disc in the sky.
#[derive(Clone, Copy, Debug)]
pub struct Disc {
    /// Unit vectors: towards its middle, to its right, and up on it.
    axes: [Vec3; 3],
    /// Radius, radians.
    radius: f32,
    /// How far from the middle anything is drawn, in radii.
    reach: f32,
    /// Its light.
    color: Vec3,
    /// What is seen of that on it: all of the moon, and of the sun so much that the eye can tell its colour.
    seen: f32,
    /// The glare at its rim over its light; 0 for the moon.
    glare: f32,
    /// Where its light comes from, along right, up and towards the eye; the sun's own is not used.
    lamp: Vec3,
    /// What is left of its light where it is not lit.
    unlit: f32,
}

/// Axes of a disc at `d` whose up is towards `pole`.
fn axes(d: Vec3, pole: Vec3) -> [Vec3; 3] {
    let right = d.cross(pole).normalize_or(Vec3::X);
    [d, right, right.cross(d)]
}

impl Dome {
    /// The sun's disc, `scale` times its true size, and up to 1.6 times that near the horizon, where it seems so. `gaze` is
    /// where the eye looks: the glare grows with looking into it.
    pub fn sun_disc(&self, gaze: Vec3, scale: f32) -> Disc {
        let d = self.sky.sun;
        let near = d.y * 8.0;
        // Never 0, which is the moon.
        let into = d.dot(gaze).max(0.1);
        let color = self.through(d) * self.exposure;
        let radius = super::sun::RADIUS as f32 * scale * (1.0 + 0.6 / (1.0 + near * near));
        Disc {
            axes: axes(d, Vec3::Y),
            radius,
            reach: 0.35 / radius,
            color,
            seen: (3.0 / color.max_element()).min(1.0),
            glare: 0.12 * into * into * into * into,
            lamp: Vec3::ZERO,
            unlit: 0.0,
        }
    }

    /// The moon's disc, `scale` times its true size.
    pub fn moon_disc(&self, scale: f32) -> Disc {
        let sky = &self.sky;
        let axes = axes(sky.moon, sky.turn.z_axis);
        // A surface of albedo 0.12 in sunlight. The eye gets used to it too, more than to the sky.
        let light = 0.04 * self.exposure;
        let color = self.through(sky.moon) * (1.4 * light / (1.0 + light));
        let lamp = vec3(sky.moon_to_sun.dot(axes[1]), sky.moon_to_sun.dot(axes[2]), -sky.moon_to_sun.dot(axes[0]));
        let radius = sky.moon_radius * scale;
        Disc { axes, radius, reach: 1.1, color, seen: 1.0, glare: 0.0, lamp, unlit: 0.03 * (1.0 - sky.lit) }
    }
}

/// Draws a disc over a tile of sky, behind what solids have left.
#[simd]
pub fn draw<S: Simd>(simd: S, disc: &Disc, view: &View, tile: &mut Tile) {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let [d, right, up] = disc.axes;
    let [left, top] = [tile.x, tile.y].map(|at| at as u32 as f32 + 0.5);
    // Half of a tile's diagonal is 45 pixels, the middle's the widest.
    let away = view.ray(left + 32.0, top + 32.0).normalize().distance(d);
    if away > 46.0 * view.pixel() + disc.reach * disc.radius || disc.color.max_element() < 1e-5 {
        return;
    }
    let shaded = disc.glare == 0.0;
    let k = 1.0 / disc.radius;
    for row in 0..tile.height {
        // Offsets from the middle in radii.
        let [mut x, mut y, mut z, mut spots] = [[0.0; BLOCK]; 4];
        for (i, x) in spots.iter_mut().enumerate() {
            *x = left + i as u32 as f32;
        }
        let mut any = false;
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let ray = view.rays(simd, load(simd, &spots, i), F::<S>::splat(simd, top + row as u32 as f32));
            let ray = ray * Lane(one * k / ray.dot(ray).sqrt());
            // The half of the sky behind is moved out of reach.
            let (u, v) = (ray.dot1(d).simd_lt(zero).select(one * k, ray.dot1(right)), ray.dot1(up));
            let squared = u * u + v * v;
            any |= squared.simd_lt(disc.reach * disc.reach).any_true();
            store(u, &mut x, i);
            store(v, &mut y, i);
            store((one - squared).max(zero).sqrt(), &mut z, i);
            i += 1;
        }
        if !any {
            continue;
        }
        if shaded {
            noise::octaves_block(simd, [&x, &y, &z], 4, false, None, &mut spots);
        }
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let (a, b, c): (F<S>, F<S>, F<S>) = (load(simd, &x, i), load(simd, &y, i), load(simd, &z, i));
            let squared = a * a + b * b;
            let distance = squared.sqrt().max(1e-6);
            let covers = ((one - distance) * (disc.radius / view.pixel()) + 0.5).max(zero).min(one);
            let mut light = covers * disc.seen;
            if shaded {
                let sun = (a * disc.lamp.x + b * disc.lamp.y + c * disc.lamp.z).max(zero);
                // Lommel and Seeliger's law: dust does not darken towards the rim.
                let lit = sun * 2.0 / (sun + c + 1e-3);
                let seas = (load::<S, F<S>>(simd, &spots, i) * -2.2 + 0.85).max(0.45).min(one);
                light = light * (lit.min(one) + disc.unlit) * seas;
            } else {
                // Falls with the square, to nothing where it ends; rays are waves around the sun, doubled in number.
                let end = (one - squared * (1.0 / (disc.reach * disc.reach))).max(zero);
                let (mut p, mut q) = (a / distance, b / distance);
                let mut rays = one;
                let mut k = 0;
                while k < 4 {
                    let next = p * p - q * q;
                    q = p * q * 2.0;
                    // A turn between, so that their crests do not meet.
                    p = next * 0.8 - q * 0.6;
                    q = next * 0.6 + q * 0.8;
                    rays += p * 0.22;
                    k += 1;
                }
                light += end * end * (rays / (squared + 1.0) + end * 0.05) * disc.glare;
            }
            // The shoulder of the dome, of both lights together.
            let shown = V3::splat(simd, Vec3::ONE) - exp3(simd, V3::splat(simd, disc.color) * Lane(light), -1.0);
            // The dome's light is shown too bright beside the sun to leave the low disc its colour.
            let hides = if shaded { zero } else { covers * shown.x * 0.6 };
            put(simd, shown, Some(hides), row, i, tile);
            i += 1;
        }
    }
}
