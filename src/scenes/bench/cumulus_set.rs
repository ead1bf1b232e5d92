//! The voxels and clouds of the bench scenes `cumulus`, `cumulus-inside` and `sky-of-clouds`, as specified for every
//! renderer that is compared.

use crate::cloud::{Cloud, CloudKind, Voxels};
use crate::simd::hash::rnd;
use crate::simd::level;
use crate::vector::unit;
use fearless_simd::dispatch;
use glam::{DVec3, Vec3A, dvec3, vec3a};
use std::sync::{Arc, OnceLock};

/// Points along an edge of the voxels.
const EDGE: usize = 64;

/// Direction to the sun.
pub fn sun() -> Vec3A {
    unit(vec3a(0.6, 0.55, 0.45))
}

/// Shape `k` of four, made when it is first asked for.
pub fn shape(k: usize) -> Arc<Voxels> {
    static SHAPES: [OnceLock<Arc<Voxels>>; SHAPE_COUNT] = [const { OnceLock::new() }; SHAPE_COUNT];
    SHAPES[k].get_or_init(|| grow(&CloudKind::CUMULUS, k as u32)).clone()
}

/// The number of shapes in a sky.
pub const SHAPE_COUNT: usize = 4;

/// A shape of a kind, with its light.
pub fn grow(kind: &CloudKind, seed: u32) -> Arc<Voxels> {
    let mut voxels = dispatch!(level::best(), simd => CloudKind::grow(simd, kind, seed, EDGE));
    voxels.set_light(bake(voxels.density()));
    Arc::new(voxels)
}

/// Eye and view direction of `cumulus`, `cumulus-inside` and `sky-of-clouds` at `t` seconds.
pub fn camera(variant: usize, t: f64) -> (DVec3, DVec3) {
    let a = 0.3 * t + [1.6, 0.4, 0.0][variant];
    match variant {
        0 => {
            let eye = dvec3(105.0 * a.sin(), 42.0, 105.0 * a.cos());
            (eye, dvec3(0.0, 62.0, 0.0) - eye)
        }
        1 => {
            let eye = dvec3(27.0 * a.sin(), 55.0 + 5.0 * (0.8 * t).sin(), 27.0 * a.cos());
            (eye, dvec3((a + 0.3).cos(), 0.25, -(a + 0.3).sin()))
        }
        _ => {
            let b = 0.1 * t + 2.3;
            (dvec3(-700.0 + 10.0 * t, 25.0, 620.0 - 9.0 * t), dvec3(b.sin(), 0.22, b.cos()))
        }
    }
}

/// The clouds of a variant, as specified.
pub fn clouds(variant: usize) -> Vec<Cloud> {
    if variant < 2 { one(shape(0), 60.0, 50.0, [30.0, 10.0][variant]) } else { many(shape, 100, 1, 130.0, 30.0) }
}

/// One cloud, by the height of its centre and half of its cube's edge, metres.
pub fn one(voxels: Arc<Voxels>, height: f32, size: f32, extinction: f32) -> Vec<Cloud> {
    vec![Cloud { voxels, centre: vec3a(0.0, height, 0.0), size, extinction }]
}

/// A sky of `count` clouds above `height`, metres, whose places and sizes are by the random numbers of `seed`.
pub fn many(shape: impl Fn(usize) -> Arc<Voxels>, count: u32, seed: u32, height: f32, extinction: f32) -> Vec<Cloud> {
    let cloud = |i: u32| {
        let r = |k: u32| rnd(seed, i, k);
        let size = 45.0 + 55.0 * r(3) * r(3);
        let centre = vec3a(1800.0 * (r(0) - 0.5), height + 0.45 * size + 12.0 * r(2), 1800.0 * (r(1) - 0.5));
        Cloud { voxels: shape(i as usize % SHAPE_COUNT), centre, size, extinction }
    };
    (0..count).map(cloud).collect()
}

/// The sun's light at each voxel: 60 samples towards it, one voxel apart.
fn bake(density: &[u8]) -> Vec<u8> {
    // A margin of empty points, as far as a sample may stick out.
    const WIDE: usize = EDGE + 2;
    let mut padded = vec![0.0; WIDE * WIDE * WIDE];
    for (at, density) in density.iter().enumerate() {
        let (i, j, l) = (at % EDGE + 1, at / EDGE % EDGE + 1, at / (EDGE * EDGE) + 1);
        padded[i + WIDE * (j + WIDE * l)] = *density as f32 / 255.0;
    }
    let light = |at: usize| {
        let start = Vec3A::from([at % EDGE, at / EDGE % EDGE, at / (EDGE * EDGE)].map(|i| (i + 1) as f32));
        let mut depth = 0.0;
        for s in 0..60 {
            let p = start + sun() * (s as f32 + 0.5);
            if p.max_element() >= (WIDE - 1) as f32 {
                break;
            }
            let (base, f) = (p.floor(), p.fract());
            let at = base.x as usize + WIDE * (base.y as usize + WIDE * base.z as usize);
            let along = |at: usize| padded[at] + (padded[at + 1] - padded[at]) * f.x;
            let face = |at: usize| along(at) + (along(at + WIDE) - along(at)) * f.y;
            depth += face(at) + (face(at + WIDE * WIDE) - face(at)) * f.z;
        }
        let q = f64::from(30.0 * depth / 32.0);
        (255.0 * (0.7 * (-0.5 * q).exp() + 0.3 * (-0.06 * q).exp())).round() as u8
    };
    (0..EDGE * EDGE * EDGE).map(light).collect()
}
