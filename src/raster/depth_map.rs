//! Shadow maps: the depths that a light sees `[Williams78]`, looked up by percentage-closer filtering `[Reeves87]`.
//!
//! A lookup compares the depths of 3x3 texels with that of a point, and averages the outcomes. With `smooth` the 3x3
//! texels are a window that moves with the point and meets 4x4 texels, whose borders count by how much of them it covers:
//! bilinear interpolation of the averages. It is an approximation of `exact_shadow`.

use super::project::Projection;
use super::rasters::LightView;
use super::world::Body;
use crate::cuts;
use crate::frame::Tile;
#[cfg(feature = "full")]
use crate::frame::Workers;
use crate::simd::lanes::{Bits, F, M, U, float, masked};
use crate::simd::level;
use crate::simd::math::to_f32;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f32x4, f32x8};
use fearless_simd_macros::simd;
use std::sync::{Mutex, OnceLock, PoisonError};

/// `inv_depth` of a texel that shows nothing, -1.7e38: it never hides a point. All bytes are the same, so that a map is
/// cleared by one call.
pub const EMPTY: f32 = f32::from_bits(0xfefe_fefe);
/// The depths of a tile, row by row.
type Texels = Box<[f32; Tile::AREA]>;

/// What a depth map shows: maps of equal keys are equal.
#[derive(PartialEq)]
pub struct MapKey {
    /// Index of the light in the world's list, or the number of lights for falling snow. Each slot keeps one map.
    pub slot: usize,
    /// The light's views.
    pub views: Vec<Projection>,
    /// Whether faces that look away from the light are drawn.
    pub back_faces: bool,
    /// What casts shadows. Bodies hold their meshes, so no other mesh can come to lie at the same address meanwhile.
    pub casters: Vec<Body>,
}

/// The depths of all views of a light.
///
/// A tile of 64x64 texels is drawn when a lookup first meets it, by the thread that does: of the maps of `day` less than
/// a third is looked up in a frame. What a tile shows depends on nothing but the key of the map.
pub struct DepthMap {
    /// Number of texels along an edge of a view: a multiple of [`Tile::SIZE`].
    pub size: usize,
    views: Vec<LightView>,
    /// `inv_depth`, view by view, in rows of tiles.
    tiles: Vec<OnceLock<Texels>>,
    /// Memory for tiles, of a map before.
    spare: Mutex<Vec<Texels>>,
}

/// Where the points of a vector appear in the views of a light.
pub struct MapPoints<S: Simd> {
    /// Numbers of the views.
    pub view: F<S>,
    /// Texel coordinates along a row.
    pub x: F<S>,
    /// Texel coordinates down a column.
    pub y: F<S>,
    /// Depths of the points, bias included.
    pub inv_depth: F<S>,
    /// What the depth of the points' planes grows by from row to row, as far as bias does not make up for it. A smooth
    /// lookup compares each row with the plane there, where that is nearer to the light than the point. Along a row
    /// level ground does not slope.
    pub slope: F<S>,
    /// Which points appear in a view. The others are not looked up, and get any number.
    pub inside: M<S>,
}

impl DepthMap {
    /// The map that has that key, in the memory of an old one. Panics if the size of views is no multiple of
    /// [`Tile::SIZE`].
    pub fn new(key: &MapKey, old: Option<DepthMap>) -> DepthMap {
        let size = key.views[0].size[0] as usize;
        assert!(size.is_multiple_of(Tile::SIZE));
        let mut spare = Vec::new();
        if let Some(old) = old {
            spare = old.spare.into_inner().unwrap_or_default();
            spare.extend(old.tiles.into_iter().filter_map(OnceLock::into_inner));
        }
        let views = key.views.iter().map(|view| LightView::new(view, key.back_faces, &key.casters)).collect();
        let tiles = vec![OnceLock::new(); key.views.len() * (size / Tile::SIZE).pow(2)];
        DepthMap { size, views, tiles, spare: Mutex::new(spare) }
    }

    /// A map of known depths, in rows of texels for each view.
    #[cfg(feature = "full")]
    pub fn of(size: usize, views: &[Vec<f32>]) -> DepthMap {
        let mut tiles = Vec::new();
        for (depths, tile) in
            views.iter().flat_map(|depths| (0..(size / Tile::SIZE).pow(2)).map(move |tile| (depths, tile)))
        {
            let corner = tile / (size / Tile::SIZE) * Tile::SIZE * size + tile % (size / Tile::SIZE) * Tile::SIZE;
            let texel = |i: usize| depths[corner + i / Tile::SIZE * size + i % Tile::SIZE];
            tiles.push(OnceLock::from(Box::new(std::array::from_fn(texel))));
        }
        DepthMap { size, views: Vec::new(), tiles, spare: Mutex::default() }
    }

    /// The views of the light.
    pub(super) fn views(&self) -> &[LightView] {
        &self.views
    }

    /// Draws every tile that was not, as if all had been looked up.
    #[cfg(feature = "full")]
    pub fn draw_all(&self, workers: &Workers) {
        let draw = |index| _ = dispatch!(workers.level(), simd => self.tile(simd, index));
        workers.each(0..self.tiles.len(), draw);
    }

    /// `inv_depth` at a texel of a view.
    pub fn at(&self, view: usize, x: usize, y: usize) -> f32 {
        let tiles = self.size / Tile::SIZE;
        let index = (view * tiles + y / Tile::SIZE) * tiles + x / Tile::SIZE;
        dispatch!(level::best(), simd => self.tile(simd, index))[y % Tile::SIZE * Tile::SIZE + x % Tile::SIZE]
    }

    /// A tile, drawn if it was not.
    #[inline(always)]
    fn tile<S: Simd>(&self, simd: S, index: usize) -> &[f32; Tile::AREA] {
        match self.tiles[index].get() {
            Some(tile) => tile,
            None => draw(simd, self, index),
        }
    }

    /// The share of the light that reaches points, 0 to 1: of the 3x3 texels around each, those whose surfaces are not
    /// nearer. Along the border of the map and beyond, the nearest 3x3 texels within.
    #[inline(always)]
    pub fn lit<S: Simd>(&self, simd: S, points: &MapPoints<S>, smooth: bool) -> F<S> {
        let (size, lanes) = (self.size, F::<S>::LEN);
        // Smooth, the window of 3x3 texels begins 1.5 before the point; else at the texel before the point's own.
        let smooth = smooth || !cuts::COUNTED_TEXELS;
        let shift = if smooth { 1.5 } else { 1.0 };
        let end = to_f32(size - 3);
        let zero = F::<S>::splat(simd, 0.0);
        let (x, y) = ((points.x - shift).max(zero).min(end), (points.y - shift).max(zero).min(end));
        let (column, row) = (x.floor(), y.floor());
        // A coordinate that is NaN may lead anywhere, but not out of the map.
        let whole = |n: F<S>| n.to_int::<S::i32s>().bitcast::<S::u32s>().min(S::u32s::splat(simd, size as u32 - 3));
        let (left, top) = (whole(column), whole(row));
        let (tiles, last) = ((size / Tile::SIZE) as u32, S::u32s::splat(simd, Tile::SIZE as u32 - 1));
        let tile = ((whole(points.view) * tiles) + (top >> 6)) * tiles + (left >> 6);
        let (inner_left, inner_top) = (left & last, top & last);
        // Mostly all four rows of a window lie in one tile.
        let apart = inner_left.max(inner_top).simd_gt(S::u32s::splat(simd, Tile::SIZE as u32 - 4)).to_bitmask();
        // What texels are compared with: the points, or their planes in the middles of the windows' rows.
        let below = if smooth { points.slope } else { zero };
        let first = points.inv_depth + below * (row - points.y + 0.5);
        let (second, twice) = (first + below, below + below);
        let (third, fourth) = (first + twice, second + twice);
        let depth = points.inv_depth;
        let depths = [first.max(depth), second.max(depth), third.max(depth), fourth.max(depth)];
        let places = (inner_top << 6) + inner_left;
        let (mut upper, mut lower) = ([0; 16], [0; 16]);
        let mut window = [[0.0; 8]; 4];
        // Mostly all windows lie in the tile of the first one.
        let (mut met, mut texels) = (u32::MAX, &[0.0; 0][..]);
        for lane in Bits(points.inside.to_bitmask()) {
            let lane = lane & (lanes - 1);
            let (tile, at) = (tile.as_slice()[lane], places.as_slice()[lane] as usize);
            let rows = if apart >> lane & 1 == 0 {
                if tile != met {
                    (met, texels) = (tile, self.tile(simd, tile as usize));
                }
                pairs(simd, &texels[at..][..3 * Tile::SIZE + 4], Tile::SIZE)
            } else {
                let first = gather(simd, self, tile as usize, at, &mut window);
                pairs(simd, &window.as_flattened()[first & 3..][..28], 8)
            };
            let depth = |row: usize| f32x4::splat(simd, depths[row].as_slice()[lane]);
            upper[lane] = rows[0].simd_le(depth(0).combine(depth(1))).to_bitmask() as u32;
            lower[lane] = rows[1].simd_le(depth(2).combine(depth(3))).to_bitmask() as u32;
        }
        // Not shifted before: as one number compilers pack both halves by five instructions more.
        let windows = U::<S>::from_slice(simd, &lower[..lanes]) << 8 | U::<S>::from_slice(simd, &upper[..lanes]);
        let [fx, fy] = if smooth { [x - column, y - row] } else { [zero; 2] };
        weighted(simd, windows, fx, fy) * (1.0 / 9.0)
    }
}

/// Draws a tile of a map.
#[simd]
#[cold] // Once per tile.
#[inline(never)]
fn draw<S: Simd>(simd: S, map: &DepthMap, index: usize) -> &[f32; Tile::AREA] {
    map.tiles[index].get_or_init(|| {
        // In 32 bits, as a division of 64 takes several times the code.
        let (index, tiles) = (index as u32, (map.size / Tile::SIZE) as u32);
        let (row, column) = ((index / tiles) as usize, (index % tiles) as usize);
        let spare = map.spare.lock().unwrap_or_else(PoisonError::into_inner).pop();
        let mut texels = spare.unwrap_or_else(|| Box::new([0.0; Tile::AREA]));
        texels.fill(EMPTY);
        map.views[row / tiles as usize].draw(simd, [column, row % tiles as usize], texels)
    })
}

/// Gathers the 4x4 texels from a place of a tile on, which reach into the next tiles, and tells in which column of `window`
/// they begin. Those beyond the map are disregarded; whatever is there will do.
#[simd]
#[cold] // A tenth of the lookups.
#[inline(never)]
fn gather<S: Simd>(simd: S, map: &DepthMap, tile: usize, at: usize, window: &mut [[f32; 8]; 4]) -> usize {
    let (left, top) = (at % Tile::SIZE, at / Tile::SIZE);
    let met = |x: usize, y: usize| {
        let below = (top + y) / Tile::SIZE * (map.size / Tile::SIZE);
        map.tile(simd, (tile + below + (left + x) / Tile::SIZE).min(map.tiles.len() - 1))
    };
    let tiles = [[met(0, 0), met(3, 0)], [met(0, 3), met(3, 3)]];
    // Four texels of the left tile, and beside them the first four of the right one.
    let column = left.min(Tile::SIZE - 4);
    for (y, texels) in window.iter_mut().enumerate() {
        let row = top + y;
        let [left, right] = tiles[(row / Tile::SIZE) & 1];
        let start = row % Tile::SIZE * Tile::SIZE;
        f32x4::from_slice(simd, &left[start + column..][..4]).store_slice(&mut texels[..4]);
        f32x4::from_slice(simd, &right[start..][..4]).store_slice(&mut texels[4..]);
    }
    left - column
}

/// The rows of a window of 4x4 texels in pairs; in `texels` they are `stride` apart.
#[inline(always)]
fn pairs<S: Simd>(simd: S, texels: &[f32], stride: usize) -> [f32x8<S>; 2] {
    let row = |k: usize| f32x4::from_slice(simd, &texels[k * stride..][..4]);
    [row(0).combine(row(1)), row(2).combine(row(3))]
}

/// Areas of lit texels in windows of 3x3 that begin at (`fx`, `fy`) in the first of 4x4 texels, of which a bit tells
/// whether it is lit. Where all are it is 9 to the bit, and 0 where none is.
#[inline(always)]
fn weighted<S: Simd>(simd: S, windows: U<S>, fx: F<S>, fy: F<S>) -> F<S> {
    let (zero, nine) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 9.0));
    // Nine of ten windows are wholly lit or wholly dark.
    let lit = windows.simd_eq(U::<S>::splat(simd, 0xffff));
    if (lit | windows.simd_eq(U::<S>::splat(simd, 0))).all_true() {
        return masked::<S>(nine, lit);
    }
    // Four bits for each row: how many of its first three texels are lit, and how many of its last three.
    let column = |k: u32| windows >> k & 0x1111;
    let inner = column(1) + column(2);
    let counts = [column(0) + inner, inner + column(3)];
    let mut areas = [zero; 2];
    let mut k = 0;
    while k < 2 {
        let rows = counts[k];
        let (first, last, between) = (rows & 15, rows >> 12, (rows + (rows >> 4)) >> 4 & 15);
        areas[k] = float(simd, first + between) + float(simd, last - first) * fy;
        k += 1;
    }
    let [left, right] = areas;
    left + (right - left) * fx
}
