//! The plain truth: noise one point at a time, as in Perlin's reference code
//! (<https://mrl.cs.nyu.edu/~perlin/noise/>).

use super::permutation::PERMUTATION;
use glam::Vec3A;

/// Entry `i` modulo 256 of the permutation.
fn permute(i: usize) -> usize {
    PERMUTATION[i & 255] as usize
}

/// A whole number modulo 256, exact for every finite value; 0 for NaN and infinities.
///
/// It is reduced before it is converted, since `as i32` alone saturates at 2^31.
fn lattice(floor: f32) -> usize {
    (floor - 256.0 * (floor * (1.0 / 256.0)).floor()) as usize
}

/// Perlin's quintic `6 t^5 - 15 t^4 + 10 t^3`, for `t` from 0 to 1: rises from 0 to 1, and its first two derivatives
/// vanish at both ends.
///
/// It is expanded about 1/2. Perlin's own form adds 10 to numbers near -9 where `t` is near 1, and noise is off by up
/// to 2e-6; this one keeps noise within 4e-7 for one more operation, and is exact at both ends too.
pub fn fade(t: f32) -> f32 {
    let d = t - 0.5;
    let q = d * d;
    d * (q * (q * 6.0 - 5.0) + 1.875) + 0.5
}

/// Linear interpolation: `a` at `t` = 0, `b` at `t` = 1.
fn lerp(t: f32, a: f32, b: f32) -> f32 {
    a + t * (b - a)
}

/// The dot product of the offset (x, y, z) and a gradient, which is chosen by the low four bits of `hash`.
///
/// The gradients are the directions from a cube's centre to the middles of its 12 edges, four of them twice. The sum is
/// rounded once; infinite offsets of opposite sign and NaN give NaN where the gradient has both.
pub fn gradient(hash: usize, x: f32, y: f32, z: f32) -> f32 {
    let h = hash & 15;
    let u = if h < 8 { x } else { y };
    let v = if h < 4 {
        y
    } else if h == 12 || h == 14 {
        x
    } else {
        z
    };
    (if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v })
}

/// Perlin's improved noise at `p`, in lattice units.
///
/// It is 0 on the lattice; its standard deviation is 0.27, its absolute value is seldom above 0.9 and never above 1.04.
/// The period is 256 along each axis. The result is within 4e-7 of exact arithmetic and never -0. From 2^24 on, where a
/// float has no fraction, it is 0. NaN or infinite coordinates give NaN.
pub fn noise(p: Vec3A) -> f32 {
    let corner = p.floor();
    let (ix, iy, iz) = (lattice(corner.x), lattice(corner.y), lattice(corner.z));
    let [x, y, z] = (p - corner).to_array();
    let (u, v, w) = (fade(x), fade(y), fade(z));

    let a = permute(ix) + iy;
    let b = permute(ix + 1) + iy;
    let (aa, ab) = (permute(a) + iz, permute(a + 1) + iz);
    let (ba, bb) = (permute(b) + iz, permute(b + 1) + iz);

    let plane = |k: usize, z: f32| {
        let near = lerp(u, gradient(permute(aa + k), x, y, z), gradient(permute(ba + k), x - 1.0, y, z));
        let far = lerp(u, gradient(permute(ab + k), x, y - 1.0, z), gradient(permute(bb + k), x - 1.0, y - 1.0, z));
        lerp(v, near, far)
    };
    // The sign of a zero depends on how the gradient is multiplied. Adding +0 makes it positive everywhere.
    lerp(w, plane(0, z), plane(1, z - 1.0)) + 0.0
}

/// Fractional Brownian motion: a sum of noises, each at twice the frequency and half the amplitude of the one before
/// it, the first at the amplitude 1/2.
///
/// The standard deviation is about 0.16. All octaves vanish together on the integer lattice.
pub fn fbm(p: Vec3A, octaves: u32) -> f32 {
    sum_octaves(p, octaves, |n| n)
}

/// The same sum of the noises' absolute values: 0 to 1, with creases where a noise vanishes.
pub fn turbulence(p: Vec3A, octaves: u32) -> f32 {
    sum_octaves(p, octaves, f32::abs)
}

/// The sum over `octaves` of `shape(noise)`.
fn sum_octaves(p: Vec3A, octaves: u32, shape: impl Fn(f32) -> f32) -> f32 {
    let (mut sum, mut amplitude, mut p) = (0.0, 0.5, p);
    for _ in 0..octaves {
        sum += amplitude * shape(noise(p));
        amplitude *= 0.5;
        p *= 2.0;
    }
    sum
}
