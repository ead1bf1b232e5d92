//! The discs of sun and moon, and the glare around the sun.

use super::dome::Dome;
use crate::block::{BLOCK, load, store};
use crate::lanes::{F, Lane};
use crate::noise;
use crate::tile::Tile;
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
    /// How far from the middle anything is drawn, radians.
    reach: f32,
    /// Its light.
    color: Vec3,
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
        Disc {
            axes: axes(d, Vec3::Y),
            radius: super::sun::RADIUS as f32 * scale * (1.0 + 0.6 / (1.0 + near * near)),
            reach: 0.35,
            color,
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
        Disc { axes, radius, reach: radius * 1.1, color, glare: 0.0, lamp, unlit: 0.03 * (1.0 - sky.lit) }
    }
}

impl Disc {
    /// May a tile show it?
    pub fn meets(&self, view: &View, tile: &Tile) -> bool {
        let half = Tile::SIZE as f32 * 0.5;
        let (x, y) = (tile.x as u32 as f32 + half, tile.y as u32 as f32 + half);
        let middle = view.ray(x, y).normalize();
        let corner = |sx, sy| middle.distance(view.ray(x + sx * half, y + sy * half).normalize());
        let spread = corner(-1.0, -1.0).max(corner(1.0, 1.0)).max(corner(-1.0, 1.0)).max(corner(1.0, -1.0));
        middle.distance(self.axes[0]) < spread + self.reach && self.color.max_element() > 1e-5
    }
}

/// Draws a disc over a tile of sky, behind what solids have left.
#[simd]
pub fn draw<S: Simd>(simd: S, disc: &Disc, view: &View, behind: bool, tile: &mut Tile) {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let [d, right, up] = disc.axes;
    let per_pixel = view.pixel();
    for row in 0..tile.height {
        let [mut x, mut y, mut nx, mut ny, mut nz, mut spots] = [[0.0; BLOCK]; 6];
        for (i, x) in x.iter_mut().enumerate() {
            *x = (tile.x + i) as u32 as f32 + 0.5;
        }
        y.fill((tile.y + row) as u32 as f32 + 0.5);
        let mut any = false;
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let ray = view.rays(simd, load(simd, &x, i), load(simd, &y, i));
            let ray = ray * Lane(one / ray.dot(ray).sqrt());
            // Offsets from the middle; the half of the sky behind is moved out of reach.
            let back = ray.dot1(d).simd_lt(0.0);
            let u = back.select(one, ray.dot1(right));
            let v = back.select(one, ray.dot1(up));
            any |= (u * u + v * v).simd_lt(disc.reach * disc.reach).any_true();
            store(u, &mut nx, i);
            store(v, &mut ny, i);
            i += 1;
        }
        if !any {
            continue;
        }
        let shaded = disc.glare == 0.0;
        if shaded {
            let mut i = 0;
            let k = 1.0 / disc.radius;
            while i < BLOCK / F::<S>::LEN {
                let (u, v) = (load::<S, F<S>>(simd, &nx, i) * k, load::<S, F<S>>(simd, &ny, i) * k);
                store(u, &mut x, i);
                store(v, &mut y, i);
                store((one - u * u - v * v).max(zero).sqrt(), &mut nz, i);
                i += 1;
            }
            noise::fbm_block(simd, &x, &y, &nz, 4, &mut spots);
        }
        let coverage = &tile.coverage.as_chunks::<BLOCK>().0[row];
        let mut i = 0;
        while i < BLOCK / F::<S>::LEN {
            let (u, v): (F<S>, F<S>) = (load(simd, &nx, i), load(simd, &ny, i));
            let squared = u * u + v * v;
            let distance = squared.sqrt().max(1e-6);
            let inside = ((-distance + disc.radius) * (1.0 / per_pixel) + 0.5).max(zero).min(one);
            let mut light = inside;
            if shaded {
                let (a, b, c): (F<S>, F<S>, F<S>) = (load(simd, &x, i), load(simd, &y, i), load(simd, &nz, i));
                let sun = (a * disc.lamp.x + b * disc.lamp.y + c * disc.lamp.z).max(zero);
                // Lommel and Seeliger's law: dust does not darken towards the rim.
                let lit = sun * 2.0 / (sun + c + 1e-3);
                let seas = (load::<S, F<S>>(simd, &spots, i) * -2.2 + 0.85).max(0.45).min(one);
                light = inside * (lit.min(one) + disc.unlit) * seas;
            } else {
                // Falls with the square, to nothing where it ends; rays are waves around the sun, doubled in number.
                let end = (one - squared * (1.0 / (disc.reach * disc.reach))).max(zero);
                let around = disc.radius * disc.radius;
                let (mut p, mut q) = (u / distance, v / distance);
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
                light += end * end * rays * (disc.glare * around) / (squared + around);
                light += end * end * end * (disc.glare * 0.05);
            }
            let left = if behind { one - load::<S, F<S>>(simd, coverage, i) } else { one };
            let planes = [&mut tile.red, &mut tile.green, &mut tile.blue];
            for (plane, color) in planes.into_iter().zip(disc.color.to_array()) {
                let plane = &mut plane.as_chunks_mut::<BLOCK>().0[row];
                let there: F<S> = load(simd, plane, i);
                // The shoulder of the dome, of both lights together.
                let shown = one - crate::math::exp2(simd, light * (-std::f32::consts::LOG2_E * color));
                store(there + (one - there).max(zero) * shown * left, plane, i);
            }
            i += 1;
        }
    }
}
