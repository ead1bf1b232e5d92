//! What clouds are held against, in f64 and without shortcuts, and rays to ask the kernel by.

use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::{DVec3, Vec3A, dvec3, vec3a};
use paprsek::cloud::march::march;
use paprsek::cloud::{Cloud, CloudLight, Voxels};
use paprsek::noise::{fbm, noise};
use paprsek::simd::hash::rnd;
use paprsek::simd::lanes::{F, V3};
use std::f64::consts::TAU;
use std::sync::Arc;

/// All light comes from everywhere, and is 1: then light and transmittance make 1.
pub const FURNACE: CloudLight =
    CloudLight { ambient: [Vec3A::ONE; 2], towards: Vec3A::Y, sun: Vec3A::ZERO, phase: [0.0; 2] };
/// Light that differs by height and direction.
pub const DAY: CloudLight = CloudLight {
    ambient: [vec3a(0.2, 0.3, 0.4), vec3a(0.4, 0.4, 0.5)],
    towards: Vec3A::Y,
    sun: Vec3A::ONE,
    phase: [0.8, 0.5],
};

/// A cloud in the cube from -1 to 1.
pub fn cloud(voxels: Voxels, extinction: f32) -> Cloud {
    Cloud { voxels: Arc::new(voxels), centre: Vec3A::ZERO, size: 1.0, extinction }
}

/// Voxels by their place.
pub fn filled(edge: usize, density: impl Fn([usize; 3]) -> u8) -> Voxels {
    let place = |at: usize| [at % edge, at / edge % edge, at / (edge * edge)];
    Voxels::new(edge, (0..edge * edge * edge).map(|at| density(place(at))).collect())
}

/// A smooth ball: 255 in the middle, `exp(-narrow r^2)` of it at the radius r.
pub fn ball(edge: usize, narrow: f32) -> Voxels {
    filled(edge, |place| {
        let r2: f32 = place.iter().map(|i| ((*i as f32 + 0.5) * 2.0 / edge as f32 - 1.0).powi(2)).sum();
        (255.0 * (-narrow * r2).exp()).round() as u8
    })
}

/// An eye around a cloud and a direction into its middle part, for each number another.
pub fn aim(k: usize) -> (Vec3A, Vec3A) {
    let a = k as f32;
    let away = 0.3 + 0.03 * (k % 90) as f32;
    let eye = vec3a((a * 0.77).sin(), 0.7 * (a * 0.31).sin(), (a * 0.77).cos()) * away;
    let target = vec3a((a * 1.7).sin(), (a * 2.3).sin(), (a * 2.9).sin()) * 0.5;
    (eye, (target - eye).normalize())
}

/// Light and transmittance along rays from an eye, each in a lane of its own.
pub fn rays(
    level: Level,
    cloud: &Cloud,
    look: &CloudLight,
    eye: Vec3A,
    d: &[Vec3A; 16],
    limit: f32,
    cut: [f32; 2],
) -> Vec<(Vec3A, f32)> {
    fine_rays(level, (cloud, None), look, eye, d, limit, cut)
}

/// The same through a cloud with detail below a voxel.
pub fn fine_rays(
    level: Level,
    (cloud, fine): (&Cloud, Option<&Voxels>),
    look: &CloudLight,
    eye: Vec3A,
    d: &[Vec3A; 16],
    limit: f32,
    cut: [f32; 2],
) -> Vec<(Vec3A, f32)> {
    fn all<S: Simd>(
        simd: S,
        (cloud, fine, look, eye): (&Cloud, Option<&Voxels>, &CloudLight, Vec3A),
        d: &[Vec3A; 16],
        limit: f32,
        cut: [f32; 2],
    ) -> Vec<(Vec3A, f32)> {
        let mut found = Vec::new();
        for d in d.chunks(F::<S>::LEN) {
            let axis = |axis: usize| d.iter().map(|d| d[axis]).collect::<Vec<_>>();
            let [x, y, z] = [0, 1, 2].map(|k| F::<S>::from_slice(simd, &axis(k)));
            let d = V3 { x, y, z };
            let [limit, opaque] = [limit, cut[1]].map(|x| F::<S>::splat(simd, x));
            let met = march(simd, (cloud, fine), eye, d, limit, cut[0], opaque);
            let (light, left) = met.shine(simd, look, d);
            for i in 0..F::<S>::LEN {
                found.push((vec3a(light.x[i], light.y[i], light.z[i]), left[i]));
            }
        }
        found
    }
    dispatch!(level, simd => all(simd, (cloud, fine, look, eye), d, limit, cut))
}

/// Light and transmittance along one ray that nothing ends before `limit`.
pub fn ray(cloud: &Cloud, look: &CloudLight, eye: Vec3A, d: Vec3A, limit: f32, steps: f32) -> (Vec3A, f32) {
    rays(Level::new(), cloud, look, eye, &[d; 16], limit, [steps, 0.0])[0]
}

/// The eight cubes of half the edge of a cloud of 64^3 voxels in the cube from -1 to 1, each a cloud of its own. Each has
/// two voxels of its neighbours around it, which rays through its inner cube do not reach.
pub fn eighths(whole: &Cloud) -> [Cloud; 8] {
    std::array::from_fn(|k| {
        let corner = [k & 1, k >> 1 & 1, k >> 2];
        let voxels = filled(36, |place| {
            let at = |axis: usize| (place[axis] + 32 * corner[axis]).clamp(2, 65) - 2;
            whole.voxels.density()[at(0) + 64 * (at(1) + 64 * at(2))]
        });
        let centre = Vec3A::from(corner.map(|bit| bit as f32 - 0.5));
        let (size, extinction) = (36.0 / 64.0, whole.extinction * 36.0 / 64.0);
        Cloud { voxels: Arc::new(voxels), centre, size, extinction }
    })
}

/// Transmittance along x at a height and a depth, -1 to 1: of the whole cloud, and of its eighths one after the other.
pub fn whole_and_eighths(whole: &Cloud, parts: &[Cloud; 8], y: f32, z: f32) -> [f32; 2] {
    let one = ray(whole, &FURNACE, vec3a(-1.0, y, z), Vec3A::X, 2.0, 1600.0).1;
    let met = |part: &&Cloud| (part.centre.y > 0.0) == (y > 0.0) && (part.centre.z > 0.0) == (z > 0.0);
    let through = |part: &Cloud| ray(part, &FURNACE, vec3a(part.centre.x - 0.5, y, z), Vec3A::X, 1.0, 800.0).1;
    [one, parts.iter().filter(met).map(through).product()]
}

/// Where a ray is in the cube from -1 to 1: the slabs in f64. None for nowhere.
pub fn span(q: DVec3, d: DVec3) -> Option<(f64, f64)> {
    let (mut entry, mut exit) = (0.0f64, f64::INFINITY);
    for axis in 0..3 {
        if d[axis] != 0.0 {
            let (a, b) = ((-1.0 - q[axis]) / d[axis], (1.0 - q[axis]) / d[axis]);
            (entry, exit) = (entry.max(a.min(b)), exit.min(a.max(b)));
        } else if q[axis].abs() > 1.0 {
            return None;
        }
    }
    (exit > entry).then_some((entry, exit))
}

/// The point of the lattice of voxels, in voxels, at a point of the cube.
fn voxel(voxels: &Voxels, p: DVec3) -> DVec3 {
    let n = voxels.edge() as f64;
    ((p + 1.0) * (0.5 * n) - 0.5).clamp(DVec3::ZERO, DVec3::splat(n - 1.0))
}

/// Detail at a point of the lattice of voxels, from -1 to 1: the table, mirrored, by turned coordinates.
fn grain(table: &Voxels, u: DVec3) -> f64 {
    let x = u.x * 0.8 + u.y * 0.6;
    let turned = dvec3(x, u.z * 0.8 + x * 0.6, u.y * 0.8 - u.x * 0.6);
    let most = (table.edge() - 1) as f64;
    let mirrored = |x: f64| {
        let far = (x * 2.4).rem_euclid(2.0 * most);
        if far > most { 2.0 * most - far } else { far }
    };
    look_up(table, dvec3(mirrored(turned.x), mirrored(turned.y), mirrored(turned.z)))[0] * 2.0 - 0.8
}

/// Density and light at a point of the lattice, 0 to 1: trilinear between voxels.
fn look_up(voxels: &Voxels, u: DVec3) -> [f64; 2] {
    let n = voxels.edge();
    let base = u.floor().min(DVec3::splat((n - 2) as f64));
    let f = u - base;
    let mut sum = [0.0; 2];
    for corner in 0..8 {
        let (mut at, mut weight) = (0, 1.0 / 255.0);
        for axis in 0..3 {
            let far = corner >> axis & 1;
            at += (base[axis] as usize + far) * [1, n, n * n][axis];
            weight *= if far == 1 { f[axis] } else { 1.0 - f[axis] };
        }
        sum[0] += weight * voxels.density()[at] as f64;
        sum[1] += weight * voxels.light(at) as f64;
    }
    sum
}

/// The march in f64, with about `steps` steps for an edge of the cube, but that nothing ends it.
pub fn truth(cloud: &Cloud, look: &CloudLight, eye: Vec3A, d: Vec3A, steps: u32) -> (DVec3, f64) {
    fine_truth((cloud, None), look, eye, d, steps)
}

/// The same with detail below a voxel.
pub fn fine_truth(
    (cloud, fine): (&Cloud, Option<&Voxels>),
    look: &CloudLight,
    eye: Vec3A,
    d: Vec3A,
    steps: u32,
) -> (DVec3, f64) {
    let (q, d) = ((eye - cloud.centre).as_dvec3() / cloud.size as f64, d.as_dvec3());
    let Some((entry, exit)) = span(q, d) else { return (DVec3::ZERO, 1.0) };
    let steps = ((exit - entry) * (0.5 * steps as f64) + 0.5).floor().max(1.0) as u32;
    let length = (exit - entry) / steps as f64;
    let (mut light, mut left) = (DVec3::ZERO, 1.0);
    let phase = look.phase[0] as f64 + look.phase[1] as f64 * d.dot(look.towards.as_dvec3()).max(0.0).powi(6);
    for step in 0..steps {
        let along = entry + (step as f64 + 0.5) * length;
        let p = q + d * along;
        let u = voxel(&cloud.voxels, p);
        let [mut density, mut lit] = look_up(&cloud.voxels, u);
        if let Some(fine) = fine {
            let grain = grain(fine, u) * density * (1.0 - density);
            density = (density + 3.0 * grain).clamp(0.0, 1.0);
            lit *= 1.0 + 2.04 * grain;
        }
        let hides = left * -(-cloud.extinction as f64 * length * density).exp_m1();
        let ambient = look.ambient[0].as_dvec3().lerp(look.ambient[1].as_dvec3(), p.y * 0.5 + 0.5);
        light += hides * (ambient + look.sun.as_dvec3() * (lit * phase));
        left -= hides;
    }
    (light, left)
}

/// Optical depth from a voxel's centre towards the sun by so many samples, and so many a voxel; nothing is outside of the
/// cube.
pub fn depth(voxels: &Voxels, voxel: usize, towards: DVec3, extinction: f64, [samples, steps]: [usize; 2]) -> f64 {
    let n = voxels.edge();
    let start = [voxel % n, voxel / n % n, voxel / (n * n)].map(|i| i as f64);
    let at = |place: [i64; 3]| {
        let inside = place.iter().all(|i| (0..n as i64).contains(i));
        let index = place[0] + n as i64 * (place[1] + n as i64 * place[2]);
        if inside { voxels.density()[index as usize] as f64 / 255.0 } else { 0.0 }
    };
    let mut sum = 0.0;
    for s in 0..samples {
        let p = DVec3::from(start) + towards * ((s as f64 + 0.5) / steps as f64);
        let (base, f) = (p.floor(), p - p.floor());
        for corner in 0..8 {
            let far = dvec3((corner & 1) as f64, (corner >> 1 & 1) as f64, (corner >> 2) as f64);
            let weight = far * f + (1.0 - far) * (1.0 - f);
            sum += weight.element_product() * at((base + far).to_array().map(|i| i as i64));
        }
    }
    extinction * sum * 2.0 / (n * steps) as f64
}

/// Sunlight, 0 to 1, that an optical depth leaves.
pub fn lit(depth: f64) -> f64 {
    0.7 * (-0.5 * depth).exp() + 0.3 * (-0.06 * depth).exp()
}

/// Density of shape `k` of the bench scenes at a voxel of 64^3, 0 to 255.
pub fn cumulus(k: u32, place: [usize; 3]) -> f64 {
    if place.iter().any(|i| *i == 0 || *i == 63) {
        return 0.0;
    }
    let o = 17.3 * (k + 1) as f64;
    let p = DVec3::from(place.map(|i| (i as f64 + 0.5) / 32.0 - 1.0));
    let warp = |a: f64| 0.22 * fbm((1.6 * p + dvec3(o + a, a, -a)).as_vec3a(), 2) as f64;
    let q = p + dvec3(warp(0.0), warp(31.7), warp(63.1));
    let mut d = f64::INFINITY;
    for i in 0..9 {
        let r = |j: u32| rnd(1, 800 + 16 * k + i, j) as f64;
        let ring = [0.30 + 0.16 * r(1), -0.34 + 0.22 * r(2), 0.22 + 0.13 * r(3)];
        let [rho, y, radius] = if i < 8 { ring } else { [0.0, -0.04, 0.50 + 0.12 * r(3)] };
        let (sin, cos) = (TAU * (i as f64 / 8.0 + 0.1 * r(0))).sin_cos();
        d = d.min((q - dvec3(rho * cos, y, rho * sin)).length() - radius);
    }
    for m in 0..4 {
        let f = 3.0 * 2.03f64.powi(m);
        let billow = noise((f * q + dvec3(o, 0.0, 0.0)).as_vec3a()).abs() as f64 * 0.5f64.powi(m + 1);
        d -= 0.42 * billow;
    }
    d += 0.42 * 0.16;
    let base = p.y + 0.46 + 0.1 * fbm(dvec3(3.0 * p.x + o, 0.0, 3.0 * p.z).as_vec3a(), 4) as f64;
    255.0 * (-d / 0.12).clamp(0.0, 1.0) * (base / 0.1).clamp(0.0, 1.0)
}
