//! Perlin's improved noise in f64, apart from the renderer's: the paper's permutation, fade and edges `[Perlin02]`.

use glam::Vec3A;

/// Perlin's permutation, copied apart from the source so that a slip in either shows.
#[rustfmt::skip]
const P: [u8; 256] = [
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
];

/// The 12 edges of a cube as Perlin's paper lists them, and the four that he repeats.
pub const EDGES: [[i8; 3]; 16] = [
    [1, 1, 0],
    [-1, 1, 0],
    [1, -1, 0],
    [-1, -1, 0],
    [1, 0, 1],
    [-1, 0, 1],
    [1, 0, -1],
    [-1, 0, -1],
    [0, 1, 1],
    [0, -1, 1],
    [0, 1, -1],
    [0, -1, -1],
    [1, 1, 0],
    [0, -1, 1],
    [-1, 1, 0],
    [0, -1, -1],
];

/// Noise in f64 as a weighted sum over corners, the lattice in 64 bits.
pub fn exact(p: [f64; 3]) -> f64 {
    let cell = p.map(|x| x.floor() as i64);
    let hash = |h: u8, i: i64| P[(h as i64 + i).rem_euclid(256) as usize];
    let mut sum = 0.0;
    for corner in 0..8 {
        let mut weight = 1.0;
        let mut offset = [0.0; 3];
        let mut h = 0;
        for axis in 0..3 {
            let bit = corner >> axis & 1;
            let t = p[axis] - p[axis].floor();
            let s = t.powi(3) * (10.0 + t * (6.0 * t - 15.0));
            weight *= if bit == 1 { s } else { 1.0 - s };
            offset[axis] = t - bit as f64;
            h = hash(h, cell[axis].rem_euclid(256) + bit);
        }
        let edge = EDGES[h as usize % 16];
        sum += weight * (0..3).map(|a| edge[a] as f64 * offset[a]).sum::<f64>();
    }
    sum
}

/// The same at a point in f32.
pub fn exact_at(p: Vec3A) -> f64 {
    exact(p.to_array().map(|x| x as f64))
}
