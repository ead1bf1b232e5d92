//! Visibility: coverage and depth of triangles in a tile, a vector of pixels at a time.
//!
//! A pixel's sample is inside of a triangle where three edge functions are not negative `[Pineda88]`. They are whole
//! numbers, and the top-left rule is part of their constants, so each sample on a shared edge belongs to exactly one of
//! the two triangles. Depth is a plane over the raster; the larger `inv_depth` wins, and of equals the first one.

use super::id::{Id, NOTHING, parts};
use super::triangle::{SUB, SetupMesh, Triangle};
use crate::frame::Tile;
use crate::simd::lanes::{F, STEPS};
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;

/// The nearest triangle at one sample of each pixel of a tile.
#[derive(Clone)]
pub struct Visible {
    /// Its `inv_depth`, or that of the background.
    pub inv_depth: Box<[f32; Tile::AREA]>,
    /// The triangle.
    pub id: Box<[Id; Tile::AREA]>,
}

/// To be cleared before use: a buffer of zeros that nobody writes to takes no memory.
impl Default for Visible {
    fn default() -> Visible {
        Visible { inv_depth: Box::new([0.0; Tile::AREA]), id: Box::new([0; Tile::AREA]) }
    }
}

impl Visible {
    /// Shows nothing anywhere, at a depth of each pixel's own, beyond which nothing will be shown.
    pub fn clear(&mut self, inv_depth: &[f32; Tile::AREA]) {
        self.inv_depth.copy_from_slice(inv_depth);
        self.id.fill(NOTHING);
    }
}

/// The place of a sample in its pixel, in steps of 1 / [`SUB`] pixel from the top left corner.
pub type SubPixel = [i32; 2];
/// The middle of the pixel.
pub const CENTER: SubPixel = [SUB / 2; 2];

/// Where the value of an edge function at a tile's corner exceeds this, it has one sign in the whole tile.
const FAR: i64 = 1 << 30;

/// What triangles are drawn into.
enum Target<'a> {
    /// The samples of a tile's pixels: what is visible at each, and where it lies. With the triangle's number.
    Eye(Id, &'a mut [(Visible, SubPixel)]),
    /// Depths at the middles of pixels.
    Light(&'a mut [f32; Tile::AREA]),
}

/// Draws triangles into the tile whose top left pixel is (`x`, `y`) of the raster, over what is visible at each sample of
/// its pixels, of which there are at least one.
#[simd]
pub fn fill<S: Simd>(
    simd: S,
    meshes: &[SetupMesh],
    ids: &[Id],
    x: i32,
    y: i32,
    planes: &mut [(Visible, SubPixel)],
) {
    for &id in ids {
        let (mesh, number) = parts(id);
        fill_one(simd, &meshes[mesh].triangles[number], [x, y], Target::Eye(id, planes));
    }
}

/// Draws the depths alone of triangles of a mesh, at the middles of pixels, into the tile whose top left pixel is `corner`.
#[simd]
pub fn fill_depths<S: Simd>(simd: S, mesh: &SetupMesh, ids: &[Id], corner: [i32; 2], depths: &mut [f32; Tile::AREA]) {
    for &id in ids {
        fill_one(simd, &mesh.triangles[parts(id).1], corner, Target::Light(depths));
    }
}

/// Draws one triangle.
///
/// ```text
/// for each strip, as wide as a vector, of the triangle's bounding box within the tile
///     for each sample of the pixels
///         for each row of the strip that the edges may leave something of     (found for a vector of strips at once)
///             inside  = no edge function is negative          (the sign of their disjunction)
///             nearer  = inside and inv_depth > what is there
///             keep inv_depth and id where nearer
///             step the edge functions down
/// ```
///
/// Along rows instead the loops would be shorter, and their ends harder to predict. Most triangles are as small as a few
/// pixels, so what samples have in common is found once.
#[simd]
#[inline(never)] // For eye and lights one copy: 0.2 kB packed.
fn fill_one<S: Simd>(simd: S, t: &Triangle, [x, y]: [i32; 2], mut target: Target) {
    let lanes = F::<S>::LEN;
    let size = Tile::SIZE as i32;
    let samples = if let Target::Eye(_, planes) = &target { planes.len() } else { 1 };
    // The part of the tile that the triangle may touch, its columns from a multiple of the lanes on.
    let (mut column, x1) = ((t.bound[0] - x).max(0) & !(lanes as i32 - 1), (t.bound[1] - x).min(size - 1));
    let rows = [(t.bound[2] - y).max(0), (t.bound[3] - y).min(size - 1)];
    let edges = t.edges.map(|edge| Edge::new(edge, [x, y]));
    // The values of the edge functions at the sample of the first pixel that lies farthest inside.
    let mut most = [i32::MIN; 3];
    for k in 0..samples {
        let sample = target.sample(k);
        for (most, edge) in most.iter_mut().zip(&edges) {
            *most = edge.start(sample).max(*most);
        }
    }
    // `inv_depth` is computed anew at each pixel, not summed up along the row: so it is the same for any number of lanes.
    let (zx, zy) = (t.by[0].w, t.by[1].w);
    let steps = S::u32s::from_slice(simd, &STEPS[..lanes]).bitcast::<S::i32s>();
    let lane: F<S> = steps.to_float();
    let nothing = S::i32s::splat(simd, 0);
    let least = F::<S>::splat(simd, f32::NEG_INFINITY);
    while column <= x1 {
        let (mut firsts, mut lasts) = ([0; 16], [0; 16]);
        let [first, last] = strips(simd, &edges, most, rows, steps * lanes as i32 + column);
        first.store_slice(&mut firsts[..lanes]);
        last.store_slice(&mut lasts[..lanes]);
        for (&first, &last) in firsts[..lanes].iter().zip(&lasts) {
            for k in 0..samples {
                let sample = target.sample(k);
                let mut edge = [nothing; 3];
                let mut e = 0;
                while e < 3 {
                    edge[e] = steps * edges[e].a + (edges[e].start(sample) + edges[e].a * column + edges[e].b * first);
                    e += 1;
                }
                let offset = |pixel: i32, sample: i32| pixel as f32 + sample as f32 * (1.0 / SUB as f32);
                let (dx, dy) = (offset(x, sample[0]) - t.anchor[0], offset(y, sample[1]) - t.anchor[1]);
                let along = (lane + (dx + column as f32)) * zx;
                let (depths, mut shown) = match &mut target {
                    Target::Eye(id, planes) => {
                        let Visible { inv_depth, id: ids } = &mut planes[k].0;
                        (&mut **inv_depth, Some((*id, ids)))
                    }
                    Target::Light(depths) => (&mut **depths, None),
                };
                let mut row = first;
                while row <= last {
                    let place = (row * size + column) as usize;
                    let z = t.at.w + zy * (dy + row as f32);
                    let inv_depth = (along + z).max(t.range[0]).min(t.range[1]);
                    let inside = (edge[0] | edge[1] | edge[2]).simd_ge(nothing);
                    let depths = &mut depths[place..place + lanes];
                    let old = F::<S>::from_slice(simd, depths);
                    let nearer = inside & inv_depth.simd_gt(old);
                    // Not `nearer` selects, which compilers make a masked store of: on AMD's processors that takes as long
                    // as all else here.
                    inside.select(inv_depth, least).max(old).store_slice(depths);
                    if let Some((id, ids)) = &mut shown {
                        let ids = &mut ids[place..place + lanes];
                        let old = S::u32s::from_slice(simd, ids);
                        nearer.select(S::u32s::splat(simd, *id), old).store_slice(ids);
                    }
                    let mut e = 0;
                    while e < 3 {
                        edge[e] += edges[e].b;
                        e += 1;
                    }
                    row += 1;
                }
            }
            column += lanes as i32;
            if column > x1 {
                break;
            }
        }
    }
}

impl Target<'_> {
    /// The place of sample `k`.
    #[inline(always)]
    fn sample(&self, k: usize) -> SubPixel {
        if let Target::Eye(_, planes) = self { planes[k].1 } else { CENTER }
    }
}

/// An edge function of a triangle over a tile, `a x + b y + start` of whole pixels.
///
/// A pixel is [`SUB`] steps wide, so in 1 / [`SUB`] of their unit the functions change by whole numbers from pixel to
/// pixel, and the remainder of the division never changes a sign.
struct Edge {
    a: i32,
    b: i32,
    /// Value at the tile's corner, in their unit.
    corner: i64,
}

impl Edge {
    /// An edge function in the tile whose top left pixel is `corner`.
    #[inline(always)]
    fn new((a, b, c): (i32, i32, i64), [x, y]: [i32; 2]) -> Edge {
        Edge { a, b, corner: (a as i64 * x as i64 + b as i64 * y as i64) * SUB as i64 + c }
    }

    /// Value at a sample of the tile's first pixel.
    #[inline(always)]
    fn start(&self, [x, y]: SubPixel) -> i32 {
        let value = self.corner + self.a as i64 * x as i64 + self.b as i64 * y as i64;
        (value >> SUB.trailing_zeros()).clamp(-FAR, FAR) as i32
    }
}

/// The first and the last of some rows that may have a pixel inside of three edges, in each of the strips that begin at
/// `columns`; `start` holds the edges' values at the first pixel.
///
/// Each edge is met where a strip lies farthest inside of it. In floating point a row within a tile is off by less than
/// 1/1024.
#[inline(always)]
fn strips<S: Simd>(
    simd: S,
    edges: &[Edge; 3],
    start: [i32; 3],
    rows: [i32; 2],
    columns: S::i32s,
) -> [S::i32s; 2] {
    let [mut first, mut last] = rows.map(|row| S::i32s::splat(simd, row));
    for (&Edge { a, b, .. }, start) in edges.iter().zip(start) {
        let best = if a > 0 { F::<S>::LEN as i32 - 1 } else { 0 };
        let value: F<S> = (columns * a + (start + best * a)).to_float();
        // The row where the edge passes, half of the least value below 0; where the edge is level, one beyond the tile.
        let row = (value + 0.5) * if b == 0 { 1e20 } else { -1.0 / b as f32 };
        let row = row.max(-1.0).min(Tile::SIZE as f32);
        if b > 0 {
            first = first.max((row - 1.0 / 1024.0).ceil().to_int::<S::i32s>());
        } else {
            last = last.min((row + 1.0 / 1024.0).floor().to_int::<S::i32s>());
        }
    }
    [first, last]
}
