//! Perlin's improved noise (2002).
//!
//! [`noise`] is the truth, one point at a time, as Perlin wrote it; the `_block` functions evaluate 64 points and
//! give the same bits at every SIMD level.
//!
//! Ken Perlin, "Improving Noise", SIGGRAPH 2002, and his reference code at <https://mrl.cs.nyu.edu/~perlin/noise/>.

#[cfg(target_arch = "x86_64")]
mod avx512;
mod wide;

pub use wide::{Fade, noise_block, octaves_block};

use crate::simd::block::BLOCK;
use crate::simd::level::best;
use fearless_simd::dispatch;
use glam::Vec3;

/// Perlin's permutation of 0..256, and its first entry again, so that each has a next one.
#[rustfmt::skip]
static PERMUTATION: [u8; 257] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225,
    140, 36, 103, 30, 69, 142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148,
    247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175,
    74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122,
    60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54,
    65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169,
    200, 196, 135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64,
    52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212,
    207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213,
    119, 248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9,
    129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104,
    218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241,
    81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157,
    184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93,
    222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180,
    151,
];

/// The permutation at `i` modulo 256.
fn permute(i: usize) -> usize {
    PERMUTATION[i & 255] as usize
}

/// An integer-valued float modulo 256, exact for every finite value; 0 for NaN and infinities.
///
/// Reduced before it is converted: `as i32` alone saturates at 2^31.
fn lattice(floor: f32) -> usize {
    (floor - 256.0 * (floor * (1.0 / 256.0)).floor()) as usize
}

/// Perlin's quintic 6 t^5 - 15 t^4 + 10 t^3, 0 to 1 with two vanishing derivatives at both ends.
///
/// Expanded about 1/2: his own form adds 10 to numbers near -9 where `t` is near 1, and noise is off by up to 2e-6.
/// This one keeps it within 4e-7, for one more operation, and is still exact at both ends.
fn fade(t: f32) -> f32 {
    let d = t - 0.5;
    let q = d * d;
    d * (q * (q * 6.0 - 5.0) + 1.875) + 0.5
}

/// `a` at `t` = 0, `b` at 1.
fn lerp(t: f32, a: f32, b: f32) -> f32 {
    a + t * (b - a)
}

/// The product of (x, y, z) and one of the 12 edge directions of a cube, four of them twice.
fn gradient(hash: usize, x: f32, y: f32, z: f32) -> f32 {
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

/// Perlin's improved noise at `p` in lattice units: sigma 0.27, seldom beyond 0.9, never beyond 1.04, 0 on the lattice.
///
/// The period is 256 along each axis, and nothing is left of it from 2^24 on, where a float has no fraction. Within
/// 4e-7 of exact arithmetic. Never -0. NaN or infinite coordinates give NaN.
pub fn noise(p: Vec3) -> f32 {
    let corner = p.floor();
    let (ix, iy, iz) = (lattice(corner.x), lattice(corner.y), lattice(corner.z));
    let Vec3 { x, y, z } = p - corner;
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
    // The sign of a zero depends on how the gradient is multiplied; adding +0 makes it + everywhere.
    lerp(w, plane(0, z), plane(1, z - 1.0)) + 0.0
}

/// A sum of noises, each at twice the frequency and half the amplitude of the last, the first at amplitude 1/2.
///
/// Sigma is about 0.16. All `octaves` vanish together on the integer lattice.
pub fn fbm(p: Vec3, octaves: u32) -> f32 {
    sum_octaves(p, octaves, |n| n)
}

/// [`fbm`] of absolute noises: 0 to 1, with creases where a noise vanishes.
pub fn turbulence(p: Vec3, octaves: u32) -> f32 {
    sum_octaves(p, octaves, f32::abs)
}

/// The sum over `octaves` of `shape(noise)`.
fn sum_octaves(p: Vec3, octaves: u32, shape: impl Fn(f32) -> f32) -> f32 {
    let (mut sum, mut amplitude, mut p) = (0.0, 0.5, p);
    for _ in 0..octaves {
        sum += amplitude * shape(noise(p));
        amplitude *= 0.5;
        p *= 2.0;
    }
    sum
}

/// [`fbm`], or where it is `absolute` [`turbulence`], of up to 8 octaves: the same bits, by [`noise_block`].
#[inline(never)]
pub fn octaves(p: Vec3, octaves: usize, absolute: bool) -> f32 {
    let [mut x, mut y, mut z, mut n] = [[0.0; BLOCK]; 4];
    let mut zoomed = p;
    for k in 0..8 {
        [x[k], y[k], z[k]] = zoomed.to_array();
        zoomed *= 2.0;
    }
    dispatch!(best(), simd => noise_block(simd, &x, &y, &z, 1.0, &mut n));
    let (mut sum, mut amplitude) = (0.0, 0.5);
    for n in &n[..octaves] {
        sum += amplitude * if absolute { n.abs() } else { *n };
        amplitude *= 0.5;
    }
    sum
}
