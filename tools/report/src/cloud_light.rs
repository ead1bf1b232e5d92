//! Sunlight within a cloud, by four methods: baked into voxels, by the distance to the wall of the cube (a term of constant
//! cost), by both, and not at all; each against rays from every sample to the sun.
//!
//! The term of the distance and its combination with baked light are those of `[Clouds10]`: `1 - distance / 70` in a cube of
//! 64 voxels; baked light is multiplied by that term plus 1.5 where the term exceeds baked light less 0.1, else by that term
//! plus 0.3. The error is that of the sunlight that reaches the eye, scaled to fit best, since the scale is an artist's
//! choice.

use crate::options::{Quick, Result};
use fearless_simd::{Level, dispatch, prelude::*};
use fearless_simd_macros::simd;
use glam::{Vec3A, vec3a};
use paprsek::cloud::{CloudKind, Voxels, sunlight};
use paprsek::simd::block::{BLOCK, load, store};
use paprsek::simd::lanes::{F, V3};
use paprsek::simd::math::exp2;
use std::f32::consts::LOG2_E;
use std::time::Instant;

const EXTINCTION: f32 = 26.0;
/// Width and height of the picture, pixels.
const SIDE: usize = 128;
/// The number of steps through the cloud, and from a sample to the sun.
const STEPS: u32 = 100;
const SUN_STEPS: u32 = 64;

const MODES: [&str; 5] = ["rays to the sun", "baked", "real time", "both", "no sun"];

/// The sunlight that a cloud sends along parallel rays, with its inner light by one of the [`MODES`].
#[simd]
fn picture<S: Simd>(simd: S, voxels: &Voxels, towards: Vec3A, d: Vec3A, mode: usize) -> Vec<f32> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let right = d.cross(Vec3A::Y).normalize();
    let up = right.cross(d);
    let half = voxels.edge() as u32 as f32 * 0.5;
    let most = voxels.edge() as u32 as f32 - 1.0;
    let at = |p: V3<S>| {
        let u = |p: F<S>| (p * half + (half - 0.5)).max(zero).min(F::<S>::splat(simd, most));
        V3 { x: u(p.x), y: u(p.y), z: u(p.z) }
    };
    let moved = |p: V3<S>, by: Vec3A, t: F<S>| V3 { x: p.x + t * by.x, y: p.y + t * by.y, z: p.z + t * by.z };
    let length = 3.4 / STEPS as f32;
    let mut picture = vec![0.0; SIDE * SIDE];
    let (mut x, mut y) = ([0.0; BLOCK], [0.0; BLOCK]);
    for (number, block) in picture.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
        for i in 0..BLOCK {
            let pixel = number * BLOCK + i;
            x[i] = ((pixel % SIDE) as f32 + 0.5) * (3.0 / SIDE as f32) - 1.5;
            y[i] = ((pixel / SIDE) as f32 + 0.5) * (3.0 / SIDE as f32) - 1.5;
        }
        for i in 0..BLOCK / F::<S>::LEN {
            let start = moved(V3::splat(simd, d * -1.7), right, load(simd, &x, i));
            let start = moved(start, up, load(simd, &y, i));
            let (mut light, mut passes) = (zero, one);
            for step in 0..STEPS {
                let p = moved(start, d, F::<S>::splat(simd, (step as f32 + 0.5) * length));
                let u = at(p);
                if !voxels.leap(simd, u).simd_eq(0).any_true() {
                    continue;
                }
                let [density, baked] = voxels.look_up(simd, u);
                let hides = passes * (one - exp2(simd, density * (-length * EXTINCTION * LOG2_E / Voxels::FULL)));
                passes -= hides;
                if hides.simd_le(1e-4).all_true() {
                    continue;
                }
                // The distance to the wall of the cube, in halves of its edge.
                let wall = |p: F<S>, s: f32| (one - p * s.signum()) * (1.0 / s.abs().max(1e-6));
                let way = wall(p.x, towards.x).min(wall(p.y, towards.y)).min(wall(p.z, towards.z)).max(zero);
                let baked = baked * (1.0 / Voxels::FULL);
                let near = (one - way * (32.0 / 70.0)).max(zero);
                let lit = match mode {
                    0 => {
                        let mut depth = zero;
                        for step in 0..SUN_STEPS {
                            let t = way * ((step as f32 + 0.5) / SUN_STEPS as f32);
                            depth += voxels.look_up(simd, at(moved(p, towards, t)))[0];
                        }
                        let q = depth * way * (EXTINCTION * LOG2_E / (Voxels::FULL * SUN_STEPS as f32));
                        exp2(simd, q * -0.5) * 0.7 + exp2(simd, q * -0.06) * 0.3
                    }
                    1 => baked,
                    2 => near,
                    3 => baked * (near + near.simd_gt(baked - 0.1).select(one * 1.5, one * 0.3)),
                    _ => one,
                };
                light += hides * lit;
            }
            store(light, block, i);
        }
    }
    picture
}

/// The root mean square of the residual when `a` is scaled to fit `b`, and that scale.
fn error(a: &[f32], b: &[f32]) -> (f32, f32) {
    let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| (a * b) as f64).sum::<f64>();
    let scale = (dot(a, b) / dot(a, a)) as f32;
    // Over the pixels that show the cloud.
    let seen = b.iter().filter(|b| **b > 0.0).count() as f32;
    let sum: f32 = a.iter().zip(b).map(|(a, b)| (a * scale - b).powi(2)).sum();
    ((sum / seen).sqrt(), scale)
}

/// Prints the table.
pub fn run(options: &Quick) -> Result {
    let level = Level::new();
    println!("| light | ms a picture | error: sun at 8 degrees | 35 | 65 | scale at 35 |\n|---|---|---|---|---|---|");
    let mut rows = vec![(f32::INFINITY, Vec::new(), 0.0f32); MODES.len()];
    let mut bake = f32::INFINITY;
    for height in [8f32, 35.0, 65.0] {
        let (sin, cos) = height.to_radians().sin_cos();
        let towards = vec3a(cos * 0.8, sin, cos * 0.6);
        let mut squares = vec![0.0; MODES.len()];
        for (kind, seed) in [(CloudKind::CUMULUS, 0), (CloudKind::CUMULUS, 1), (CloudKind::CONGESTUS, 4)] {
            let mut voxels = dispatch!(level, simd => CloudKind::grow(simd, &kind, seed, 64));
            let start = Instant::now();
            dispatch!(level, simd => sunlight::bake(simd, &mut voxels, towards, EXTINCTION));
            bake = bake.min(start.elapsed().as_secs_f32() * 1e3);
            for d in [vec3a(1.0, 0.1, 0.2), vec3a(-1.0, 0.0, 0.3), vec3a(0.2, -0.4, -1.0)] {
                let mut truth = Vec::new();
                for (mode, row) in rows.iter_mut().enumerate() {
                    let mut found = Vec::new();
                    for _ in 0..if options.quick { 1 } else { 3 } {
                        let start = Instant::now();
                        found = dispatch!(level, simd => picture(simd, &voxels, towards, d.normalize(), mode));
                        row.0 = row.0.min(start.elapsed().as_secs_f32() * 1e3);
                    }
                    if mode == 0 {
                        truth = found.clone();
                    }
                    let (error, scale) = error(&found, &truth);
                    squares[mode] += error * error / 9.0;
                    row.2 = if height == 35.0 { scale } else { row.2 };
                }
            }
        }
        for (row, square) in rows.iter_mut().zip(squares) {
            row.1.push(square.sqrt());
        }
    }
    for (name, (time, errors, scale)) in MODES.iter().zip(rows) {
        let [a, b, c] = [errors[0], errors[1], errors[2]];
        println!("| {name} | {time:.2} | {a:.4} | {b:.4} | {c:.4} | {scale:.2} |");
    }
    println!(
        "\nBaking takes {bake:.1} ms for a shape of 64^3 voxels and a sun; 128 x 128 pixels, one thread, {level:?}."
    );
    Ok(())
}
