//! Soft sprites: what particles are on the screen, and how they come into a tile.

use super::Batch;
use crate::cuts::BENCH;
use crate::frame::Tile;
use crate::simd::block::{BLOCK, load, store};
use crate::simd::lanes::{Bits, F, Lane};
use crate::simd::math;
use crate::view::View;
use fearless_simd::prelude::*;
use fearless_simd_macros::simd;
use glam::Vec3;
use std::f32::consts::LOG2_E;

/// Metres along the view axis within which nothing is drawn.
pub const NEAREST: f32 = 0.25;

/// An ellipse on the screen, in pixels from the top left corner. Its weight is `(1 - q)^2`, where q is 0 in its middle
/// and 1 on its border.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Sprite {
    /// Its middle.
    pub at: [f32; 2],
    /// From pixels beside the middle to a space in which it is the unit disc: the rows of a matrix.
    pub axes: [f32; 4],
    /// How far it reaches along x and y.
    pub reach: [f32; 2],
    /// Metres along the view axis.
    pub depth: f32,
    /// 1 over the metres before a solid within which it fades.
    pub edge: f32,
    /// The share of the light behind that it takes where its weight is 1.
    pub alpha: f32,
    /// What it adds there to each plane: nothing to [`PASSES`], and premultiplied light.
    pub ink: [f32; 4],
    /// Pixels of its radius, as far as it is in focus; 0 if it is not to be seen as a crystal.
    pub crystal: f32,
}

/// The plane of what is left of the light behind, and the first one of light.
pub const PASSES: usize = 0;
/// See there.
pub const LIGHT: usize = 1;

/// What limits the size of sprites: pixels, and an aperture.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// The least and the greatest radius, pixels; what is smaller or larger is weaker, or as strong.
    pub radius: [f32; 2],
    /// Metres along the view axis between which they come into sight.
    pub near: [f32; 2],
    /// Radius of the lens, metres: what is nearer than its focus is blurred.
    pub aperture: f32,
    /// Metres.
    pub focus: f32,
    /// Are sprites turned, and drawn as crystals from some pixels on?
    pub crystals: bool,
    /// Do sprites move while the shutter is open? Never, in a build without the bench scenes.
    pub streaks: bool,
}

impl Lens {
    /// Everything is sharp, of its own size, and there from the eye on.
    pub const SHARP: Lens =
        Lens { radius: [0.0, f32::MAX], near: [-1.0, 0.0], aperture: 0.0, focus: 1.0, crystals: false, streaks: false };
}

/// The screen that sprites are on.
pub struct Screen {
    /// The eye.
    pub eye: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Pixels.
    middle: [f32; 2],
    size: [f32; 2],
    /// Pixels of a metre at a metre.
    focal: f32,
    /// Tiles in a row.
    pub columns: u32,
    /// Rows of tiles.
    pub rows: u32,
}

impl Screen {
    /// The screen of a view of `width` x `height` pixels.
    pub fn new(view: &View, width: usize, height: usize) -> Screen {
        let c = view.camera();
        let ((x, y), scale) = view.screen();
        let [columns, rows] = [width, height].map(|n| n.div_ceil(Tile::SIZE) as u32);
        Screen {
            eye: c.eye,
            right: c.right * scale,
            up: c.up * -scale,
            forward: c.forward,
            middle: [x, y],
            size: [width as u32 as f32, height as u32 as f32],
            focal: c.right.length() * scale,
            columns,
            rows,
        }
    }

    /// Tiles that a sprite touches: from where to before where, along x and y.
    #[inline(always)]
    pub fn tiles(&self, sprite: &Sprite) -> [[u32; 2]; 2] {
        let range = |axis: usize, tiles: u32| {
            let edge = Tile::SIZE as f32;
            let (from, to) = (sprite.at[axis] - sprite.reach[axis], sprite.at[axis] + sprite.reach[axis]);
            // As a number of 32 bits nothing is less than 0.
            [(from / edge) as u32, ((to / edge) as u32).saturating_add(1).min(tiles)]
        };
        [range(0, self.columns), range(1, self.rows)]
    }

    /// Adds the particles of a vector that are seen from `eye`, of those in `wanted`.
    #[inline(always)]
    pub fn push<S: Simd>(
        &self,
        simd: S,
        batch: Batch<S>,
        lens: &Lens,
        eye: Vec3,
        wanted: u64,
        sprites: &mut Vec<Sprite>,
    ) {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let at = batch.at.sub1(eye);
        let depth = at.dot1(self.forward);
        let inverse = one / depth;
        let (x, y) = (at.dot1(self.right) * inverse, at.dot1(self.up) * inverse);
        let size = batch.radius * inverse * self.focal;
        let blur = (inverse - 1.0 / lens.focus).max(zero) * (lens.aperture * self.focal);
        let radius = (size + blur).max(F::<S>::splat(simd, lens.radius[0])).min(F::<S>::splat(simd, lens.radius[1]));
        let thin = one / radius;
        let share = size * thin;
        let [near, far] = lens.near;
        let comes = math::smooth(simd, (depth - near) * (1.0 / (far - near)));
        let mut share = (share * share).min(one) * comes;
        let (x, y) = (x + self.middle[0], y + self.middle[1]);
        let (mut across, mut down) = (radius, radius);
        let mut axes = [thin, zero, zero, thin];
        if BENCH && lens.streaks {
            let away = batch.streak.dot1(self.forward);
            let (right, below) = (batch.streak.dot1(self.right), batch.streak.dot1(self.up));
            let (dx, dy) =
                ((right - (x - self.middle[0]) * away) * inverse, (below - (y - self.middle[1]) * away) * inverse);
            let length = (dx * dx + dy * dy).sqrt();
            let still = length.simd_lt(1e-6);
            let (cos, sin) = (still.select(one, dx / length), still.select(zero, dy / length));
            let long = radius + length;
            share *= radius / long;
            (across, down) = (dx.abs() + radius, dy.abs() + radius);
            axes = [cos / long, sin / long, -(sin * thin), cos * thin];
        } else if lens.crystals {
            let [cos, sin, narrow] = batch.turn;
            let wide = thin / narrow;
            axes = [cos * thin, sin * thin, -(sin * wide), cos * wide];
        }
        let seen = depth.simd_gt(NEAREST)
            & (x + across).simd_gt(zero)
            & (x - across).simd_lt(self.size[0])
            & (y + down).simd_gt(zero)
            & (y - down).simd_lt(self.size[1])
            & batch.alpha.max(batch.light.max_element()).simd_gt(zero)
            & share.simd_gt(zero);
        let seen = seen.to_bitmask() & wanted;
        if seen == 0 {
            return;
        }
        let crystal = if lens.crystals { size - blur - blur } else { zero };
        let ink = batch.light * Lane(share);
        let numbers = [
            x,
            y,
            axes[0],
            axes[1],
            axes[2],
            axes[3],
            across,
            down,
            depth,
            inverse * thin * self.focal,
            batch.alpha * share,
            zero,
            ink.x,
            ink.y,
            ink.z,
            crystal,
        ];
        for lane in Bits(seen) {
            let mut of = [0.0; 16];
            for (number, lanes) in of.iter_mut().zip(&numbers) {
                *number = lanes.as_slice()[lane];
            }
            sprites.push(Sprite::of(of));
        }
    }
}

impl Sprite {
    /// From its numbers in their order.
    fn of([x, y, a, b, c, d, across, down, depth, edge, alpha, none, red, green, blue, crystal]: [f32; 16]) -> Sprite {
        Sprite {
            at: [x, y],
            axes: [a, b, c, d],
            reach: [across, down],
            depth,
            edge,
            alpha,
            ink: [none, red, green, blue],
            crystal,
        }
    }
}

/// Sorts sprites from far to near, by their bits, a byte at a time; equally far ones stay in their order.
pub fn sort(list: &mut Vec<Sprite>) {
    for shift in [0, 8, 16, 24] {
        let digit = |sprite: &Sprite| !(sprite.depth.to_bits() >> shift) as u8 as usize;
        let mut starts = [0; 257];
        for sprite in list.iter() {
            starts[digit(sprite) + 1] += 1;
        }
        for i in 1..257 {
            starts[i] += starts[i - 1];
        }
        let mut sorted = list.clone();
        for sprite in list.iter() {
            let start = &mut starts[digit(sprite)];
            sorted[*start] = *sprite;
            *start += 1;
        }
        *list = sorted;
    }
}

/// The pixels of a tile whose middles lie within `reach` of `at` along an axis: from where to before where. The tile's
/// first one is number `corner`.
#[inline(always)]
fn range(at: f32, reach: f32, corner: usize) -> [usize; 2] {
    let from = at - corner as u32 as f32 + 0.5;
    // As a number of 32 bits nothing is less than 0.
    let end = (from + reach).min(Tile::SIZE as f32) as u32;
    [(from - reach) as u32 as usize, end as usize]
}

/// Draws a sprite into planes of a tile, from plane `first` on: each becomes what the sprite leaves of it, and what it
/// adds.
#[simd]
pub fn draw<S: Simd>(
    simd: S,
    sprite: &Sprite,
    crystal: &Crystal,
    tile: &Tile,
    solids: bool,
    planes: &mut [[f32; Tile::AREA]],
    first: usize,
) {
    let lanes = F::<S>::LEN;
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let [left, right] = range(sprite.at[0], sprite.reach[0], tile.x);
    let [top, bottom] = range(sprite.at[1], sprite.reach[1], tile.y);
    let [a, b, c, d] = sprite.axes;
    for row in top..bottom {
        let y = (tile.y + row) as u32 as f32 + 0.5 - sprite.at[1];
        let (by, dy) = (b * y, d * y);
        let mut column = left & lanes.wrapping_neg();
        while column < right {
            // Exact but for the last difference, wherever vectors and tiles begin.
            let x = F::<S>::from_slice(simd, &HALVES[..lanes]) + (tile.x + column) as u32 as f32 - sprite.at[0];
            let (u, v) = (x * a + by, x * c + dy);
            let rest = (one - (u * u + v * v)).max(zero);
            let mut weight = rest * rest;
            if sprite.crystal > CRYSTAL && !cfg!(without = "crystals") {
                weight = grown(simd, crystal, u, v, sprite.crystal);
            }
            let at = row * Tile::SIZE + column;
            if solids {
                let inv_depth = F::<S>::from_slice(simd, &tile.inv_depth[at..at + lanes]);
                weight *= ((one / inv_depth - sprite.depth) * sprite.edge).max(zero).min(one);
            }
            let leaves = one - weight * sprite.alpha;
            for (plane, ink) in planes.iter_mut().zip(&sprite.ink[first..]) {
                let plane = &mut plane[at..at + lanes];
                (F::<S>::from_slice(simd, plane) * leaves + weight * *ink).store_slice(plane);
            }
            column += lanes;
        }
    }
}

/// 1/2, 3/2 and so on.
const HALVES: [f32; 16] = [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5];

/// Pixels of radius from which on a crystal is more than a disc.
const CRYSTAL: f32 = 2.5;

/// A crystal in the unit disc: what is nearer than these to its middle, to its arms, to their branches. Below 0 for none.
#[derive(Clone, Copy, Debug)]
pub struct Crystal {
    /// The plate in its middle, to the middles of its sides.
    pub plate: f32,
    /// Half the width of arms.
    pub arm: f32,
    /// Half the width of branches.
    pub branch: f32,
    /// How often it is folded: 0 for one bar, 2 for six arms, 3 for twelve.
    pub folds: usize,
}

impl Crystal {
    /// A six-armed star.
    pub const STAR: Crystal = Crystal { plate: 0.28, arm: 0.07, branch: 0.055, folds: 2 };

    /// What grows at so many degrees Celsius, after the table of thesis C: needles below -4, plates below -8, stars below
    /// -12, spatial stars, which look like two of them, below -18, columns below -25.
    #[cfg(feature = "full")]
    pub fn at(celsius: f32) -> Crystal {
        match celsius {
            ..-25.0 => Crystal { plate: -1.0, arm: 0.3, branch: -1.0, folds: 0 },
            ..-18.0 => Crystal { plate: 0.15, arm: 0.05, branch: 0.03, folds: 3 },
            ..-12.0 => Crystal::STAR,
            ..-8.0 => Crystal { plate: 0.8, arm: -1.0, branch: -1.0, folds: 2 },
            _ => Crystal { plate: -1.0, arm: 0.08, branch: -1.0, folds: 0 },
        }
    }
}

/// Lines through the middle at 60, 30 and 15 degrees to an arm: sines and cosines.
const FOLDS: [(f32, f32); 3] = [(0.866_025_4, 0.5), (0.5, 0.866_025_4), (0.258_819_04, 0.965_925_8)];

/// The weight of a crystal of `radius` pixels at points of the unit disc; small ones are soft discs.
#[inline(always)]
fn grown<S: Simd>(simd: S, crystal: &Crystal, u: F<S>, v: F<S>, radius: f32) -> F<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let Crystal { plate, arm, branch, folds } = if BENCH { *crystal } else { Crystal::STAR };
    let rest = (one - (u * u + v * v)).max(zero);
    // Folded onto one side of an arm, which lies along x.
    let (mut x, mut y) = (u.abs(), v.abs());
    for &(sin, cos) in &FOLDS[..folds] {
        let beyond = (x * sin - y * cos).min(zero);
        (x, y) = (x - beyond * (2.0 * sin), y + beyond * (2.0 * cos));
    }
    let middle = -(x * 0.866_025_4 + y * 0.5) + plate;
    // Branches leave it at 60 degrees, every quarter, shorter to the outside.
    let slant = (x - y * 0.577_350_3) * 4.0;
    let side = ((slant - slant.floor() - 0.5).abs() * -0.217 + branch).min((one - x) * 0.55 - y);
    let inside = middle.max(-y + arm).max(side).min(one - x);
    let edge = (inside * radius + 0.5).max(zero).min(one);
    let share = ((radius - CRYSTAL) * 0.4).min(1.0);
    rest * rest + (edge - rest * rest) * share
}

/// Puts what planes of a tile have over its light.
#[simd]
pub fn blend<S: Simd>(simd: S, planes: &[[f32; Tile::AREA]], color: Vec3, exposure: f32, tile: &mut Tile) {
    let one = F::<S>::splat(simd, 1.0);
    let passes = planes[PASSES].as_chunks::<BLOCK>().0;
    for (k, plane) in [&mut tile.red, &mut tile.green, &mut tile.blue].into_iter().enumerate() {
        let color = color[k];
        for (row, light) in plane.as_chunks_mut::<BLOCK>().0.iter_mut().enumerate() {
            let mut i = 0;
            while i < BLOCK / F::<S>::LEN {
                let behind: F<S> = load(simd, light, i);
                let mut seen = (behind - color) * load::<S, F<S>>(simd, &passes[row], i) + color;
                if let Some(plane) = planes.get(LIGHT + k) {
                    let added: F<S> = load(simd, &plane.as_chunks::<BLOCK>().0[row], i);
                    seen = one - (one - seen) * math::exp2(simd, added * (-exposure * LOG2_E));
                }
                store(seen, light, i);
                i += 1;
            }
        }
    }
}
