//! Noise for 64 points with AVX2.
//!
//! Points that follow one another mostly lie in one cell, as neighbouring pixels do: 64 of them in 2 to 24 cells. So
//! hashes are looked up once for each run of points in a cell, in memory, and what they gave is dealt out to lanes.
//!
//! ```text
//! for each vector of points: cells, offsets in them -> a bit for each point that is in another cell than the one before
//! for each of these: seven lookups in the permutation, each of two neighbouring entries
//! for each vector of points: weights; all of one run?
//!     gradients out of a table, the same in all lanes
//!     or else gradients of its runs, dealt out to lanes by a permutation
//!     the blend of the lower four corners, of the upper four, and of both
//! ```
//!
//! Where each point is in a cell of its own, this takes as long as hashes point by point.

use super::curve::{fade, lerp};
use super::permutation::PERMUTATION;
use super::wide::{CODES, at};
use crate::simd::block::{BLOCK, Block3, load, store, vectors};
use core::arch::x86_64::*;
use fearless_simd::{Avx2, f32x8, i32x8, prelude::*, u8x16, u32x8};

type Floats = f32x8<Avx2>;
type Words = u32x8<Avx2>;

/// Lanes of a vector.
const LANES: usize = 8;

/// The components x, y and z of each gradient.
static COMPONENTS: [[f32; 4]; 16] = {
    const VALUES: [f32; 4] = [0.0, 1.0, 0.0, -1.0];
    let mut components = [[0.0; 4]; 16];
    let mut i = 0;
    while i < 16 {
        let code = CODES[i] as usize;
        components[i] = [VALUES[code & 3], VALUES[code >> 2 & 3], VALUES[code >> 4], 0.0];
        i += 1;
    }
    components
};

fearless_simd::kernel!(
    /// For each lane the one before it: for the first the last of the vector before.
    #[inline]
    fn before(simd: Avx2, last: u32x8<Avx2>, this: u32x8<Avx2>) -> u32x8<Avx2> {
        let across = _mm256_permute2x128_si256::<0x21>(last.into(), this.into());
        _mm256_alignr_epi8::<12>(this.into(), across).simd_into(simd)
    }
);

fearless_simd::kernel!(
    /// `table[index]` for eight lanes.
    #[inline]
    fn deal(simd: Avx2, table: u32x8<Avx2>, index: u32x8<Avx2>) -> u32x8<Avx2> {
        _mm256_permutevar8x32_epi32(table.into(), index.into()).simd_into(simd)
    }
);

fearless_simd::kernel!(
    /// The eight bytes of a word, the lowest first.
    #[inline]
    fn bytes(simd: Avx2, word: u64) -> u32x8<Avx2> {
        _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(word as i64)).simd_into(simd)
    }
);

fearless_simd::kernel!(
    /// The codes of gradients by the low four bits of each byte.
    #[inline]
    fn encode(simd: Avx2, hashes: u32x8<Avx2>) -> u32x8<Avx2> {
        let codes = u8x16::load_array(simd, CODES).into();
        let low = _mm256_and_si256(hashes.into(), _mm256_set1_epi8(15));
        _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(codes), low).simd_into(simd)
    }
);

fearless_simd::kernel!(
    /// The low two bits of each lane, as a number with a sign, by one permutation.
    #[inline]
    fn component(simd: Avx2, codes: u32x8<Avx2>) -> f32x8<Avx2> {
        let values = _mm256_setr_ps(0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0);
        _mm256_permutevar_ps(values, codes.into()).simd_into(simd)
    }
);

/// Memory for 64 points.
pub struct Scratch {
    /// Offsets of points in their cells.
    offsets: Block3,
    /// The cells of points, in whose place come the first hashes of runs: the number of a run is at most that of its first
    /// point.
    near: [u32; BLOCK + LANES],
    /// The second hashes of runs.
    far: [u32; BLOCK + LANES],
}

impl Default for Scratch {
    #[inline(always)]
    fn default() -> Scratch {
        Scratch { offsets: [[0.0; BLOCK]; 3], near: [0; BLOCK + LANES], far: [0; BLOCK + LANES] }
    }
}

/// Noise at the first `count` of 64 points times `zoom`.
#[inline(always)]
pub fn noise64(
    simd: Avx2,
    points: [&[f32; BLOCK]; 3],
    zoom: f32,
    count: usize,
    scratch: &mut Scratch,
    out: &mut [f32; BLOCK],
) {
    let vectors = vectors(count, LANES);
    let Scratch { offsets, near, far } = scratch;
    let cells = near.first_chunk_mut().expect("it is longer than a block");
    let starts = locate(simd, points, zoom, vectors, offsets, cells);
    let (mut todo, mut run) = (starts, 0);
    while todo != 0 {
        let cell = near[todo.trailing_zeros() as usize & (BLOCK - 1)];
        todo &= todo - 1;
        [near[run], far[run]] = hash(cell);
        run = (run + 1) & (BLOCK - 1);
    }

    // The number of the run that the last point was in.
    let mut run = !0usize;
    let mut i = 0;
    while i < vectors {
        let [x, y, z] = &*offsets;
        let p = [load(simd, x, i), load(simd, y, i), load(simd, z, i)];
        let begins = starts >> (i * LANES) & 255;
        run = run.wrapping_add(begins as usize & 1);
        let first = run & (BLOCK - 1);
        // A byte for each lane but the first, 1 where a run begins; then the number of these up to each lane.
        let each = (begins >> 1).wrapping_mul(0x0002_0408_1020_4081) & 0x0101_0101_0101_0101;
        let count = each.wrapping_mul(0x0101_0101_0101_0100);
        run = run.wrapping_add((count >> 56) as usize);
        let value = if count == 0 {
            let hashes = [near[first], far[first]];
            blend(
                p,
                #[inline(always)]
                |side, shift| {
                    let [x, y, z, _] = COMPONENTS[(hashes[side] >> shift) as usize & 15];
                    [Floats::splat(simd, x), Floats::splat(simd, y), Floats::splat(simd, z)]
                },
            )
        } else {
            let index = bytes(simd, count);
            let near = encode(simd, deal(simd, Words::from_slice(simd, &near[first..first + LANES]), index));
            let far = encode(simd, deal(simd, Words::from_slice(simd, &far[first..first + LANES]), index));
            blend(
                p,
                #[inline(always)]
                |side, shift| {
                    let code = [near, far][side];
                    let [x, y, z] = [code >> shift, code >> (shift + 2), code >> (shift + 4)];
                    [component(simd, x), component(simd, y), component(simd, z)]
                },
            )
        };
        store(value, out, i);
        i += 1;
    }
}

/// The offsets of points times `zoom` in their cells, and the cells modulo 256: x, y and z in a byte each. Returns a bit
/// for each point whose cell is not that of the point before it.
#[inline(always)]
fn locate(
    simd: Avx2,
    points: [&[f32; BLOCK]; 3],
    zoom: f32,
    vectors: usize,
    offsets: &mut Block3,
    cells: &mut [u32; BLOCK],
) -> u64 {
    let mut starts = 0;
    // No cell: the first point begins a run.
    let mut last = Words::splat(simd, !0);
    let mut i = 0;
    while i < vectors {
        let mut cell = Words::splat(simd, 0);
        let mut axis = 0;
        while axis < 3 {
            let p = load::<_, Floats>(simd, points[axis], i) * zoom;
            let floor = p.floor();
            // Where the conversion overflows it gives 0x80000000. Its low byte is right, since floats as large are
            // multiples of 256.
            cell = cell << 8 | (floor.to_int::<i32x8<_>>().bitcast::<Words>() & 255);
            store(p - floor, &mut offsets[axis], i);
            axis += 1;
        }
        store(cell, cells, i);
        let same = cell.simd_eq(before(simd, last, cell)).to_bitmask();
        starts |= (same ^ 255) << (i * LANES);
        last = cell;
        i += 1;
    }
    starts
}

/// The hashes of a cell's corners, whose low four bits choose gradients: in the first word those at y = 0, in the second
/// at y = 1; from the lowest byte on those at (x, z) = (0, 0), (0, 1), (1, 0) and (1, 1).
#[inline(always)]
fn hash(cell: u32) -> [u32; 2] {
    let (ix, iy, iz) = (cell >> 16, cell >> 8, cell);
    let ab = at(&PERMUTATION, ix);
    let (a, b) = (at(&PERMUTATION, ab + iy), at(&PERMUTATION, (ab >> 8) + iy));
    let (aa, ba) = (at(&PERMUTATION, a + iz), at(&PERMUTATION, b + iz));
    let (ab, bb) = (at(&PERMUTATION, (a >> 8) + iz), at(&PERMUTATION, (b >> 8) + iz));
    [aa | ba << 16, ab | bb << 16]
}

/// The blend of the eight corners at offsets in their cells. `gradient` gives the components of a corner's gradient, by
/// the word and the bit from which on [`hash`] has its hash.
#[inline(always)]
fn blend([x, y, z]: [Floats; 3], gradient: impl Fn(usize, u32) -> [Floats; 3]) -> Floats {
    let (u, v, w) = (fade(x), fade(y), fade(z));
    let (x1, y1, z1) = (x - 1.0, y - 1.0, z - 1.0);
    let mut bottom = lerp(u, dot(gradient(0, 0), x, y, z), dot(gradient(0, 16), x1, y, z));
    let mut top = lerp(u, dot(gradient(0, 8), x, y, z1), dot(gradient(0, 24), x1, y, z1));
    // y = 0 in all lanes, as on a floor that lies on the lattice: the far half has no weight.
    if !y.simd_eq(0.0).all_true() {
        let far = lerp(u, dot(gradient(1, 0), x, y1, z), dot(gradient(1, 16), x1, y1, z));
        bottom = lerp(v, bottom, far);
        let far = lerp(u, dot(gradient(1, 8), x, y1, z1), dot(gradient(1, 24), x1, y1, z1));
        top = lerp(v, top, far);
    }
    lerp(w, bottom, top) + 0.0
}

/// The dot product of a gradient and an offset. One of the three products is zero and all are exact, so that a fused
/// multiply-add rounds just once, as Perlin's sum of two does.
#[inline(always)]
fn dot([a, b, c]: [Floats; 3], x: Floats, y: Floats, z: Floats) -> Floats {
    a.mul_add(x, b.mul_add(y, c * z))
}
