//! From particles in space to sprites on the screen.

use super::batch::Batch;
use super::lens::Lens;
use super::sprite::Sprite;
use crate::cuts;
use crate::frame::Tile;
use crate::simd::lanes::{Bits, F, Lane};
use crate::simd::math::{smooth, to_f32};
use crate::view::View;
use fearless_simd::prelude::*;
use glam::Vec3A;

/// Distance along the view axis within which nothing is drawn, metres.
const NEAREST: f32 = 0.25;

/// The screen that sprites are on.
pub struct Screen {
    /// The eye.
    pub eye: Vec3A,
    /// Unit vector along the view axis; along rows and columns, pixels per metre at one metre.
    forward: Vec3A,
    right: Vec3A,
    down: Vec3A,
    /// The middle of the screen, and its size, pixels.
    middle: [f32; 2],
    size: [f32; 2],
    /// Pixels per metre at one metre.
    focal: f32,
    /// Tiles per row.
    pub columns: u32,
    /// Rows of tiles.
    pub rows: u32,
}

/// The ellipses of a batch.
struct Ellipses<S: Simd> {
    /// As [`Sprite::axes`].
    axes: [F<S>; 4],
    /// As [`Sprite::reach`].
    reach: [F<S>; 2],
}

impl Screen {
    /// The screen of a view.
    pub fn new(view: &View) -> Screen {
        let c = view.camera();
        let ((x, y), scale) = view.screen();
        let [columns, rows] = [view.width(), view.height()].map(|n| n.div_ceil(Tile::SIZE) as u32);
        Screen {
            eye: c.eye,
            forward: c.forward,
            right: c.right * scale,
            down: c.up * -scale,
            middle: [x, y],
            size: [to_f32(view.width()), to_f32(view.height())],
            focal: c.right.length() * scale,
            columns,
            rows,
        }
    }

    /// The tiles that a sprite touches along x and y: the first, and the one after the last.
    #[inline(always)]
    pub fn tiles(&self, sprite: &Sprite) -> [[u32; 2]; 2] {
        let range = |axis: usize, tiles: u32| {
            let edge = Tile::SIZE as f32;
            let (from, to) = (sprite.at[axis] - sprite.reach[axis], sprite.at[axis] + sprite.reach[axis]);
            // A cast to `u32` makes 0 of what is below 0.
            [(from / edge) as u32, ((to / edge) as u32).saturating_add(1).min(tiles)]
        };
        [range(0, self.columns), range(1, self.rows)]
    }

    /// Adds the sprites of those particles of a batch that are on the screen, of the lanes in `wanted`. The batch is
    /// seen from `eye`.
    ///
    /// ```text
    /// project the particle: depth, place on the screen, radius
    /// add the blur of a lens that is focused farther off, and clamp the radius
    /// share = (radius / clamped radius)^2, so that the light of a small particle stays; times how far it is in sight
    /// axes = those of a streak, of a tumbling flake or of a disc
    /// add a sprite where its bounding box is on the screen and it is not invisible
    /// ```
    #[inline(always)]
    pub fn push<S: Simd>(
        &self,
        simd: S,
        batch: Batch<S>,
        lens: &Lens,
        eye: Vec3A,
        wanted: u64,
        sprites: &mut Vec<Sprite>,
    ) {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let at = batch.at.sub1(eye);
        let depth = at.dot1(self.forward);
        let inverse = one / depth;
        let (x, y) = (at.dot1(self.right) * inverse, at.dot1(self.down) * inverse);
        let size = batch.radius * inverse * self.focal;
        let blur = (inverse - 1.0 / lens.focus).max(zero) * (lens.aperture * self.focal);
        let radius = (size + blur).max(F::<S>::splat(simd, lens.radius[0])).min(F::<S>::splat(simd, lens.radius[1]));
        let thin = one / radius;
        let share = size * thin;
        let [near, far] = lens.near;
        let comes = smooth(simd, (depth - near) * (1.0 / (far - near)));
        let mut share = (share * share).min(one) * comes;
        let (x, y) = (x + self.middle[0], y + self.middle[1]);
        let mut ellipses = Ellipses { axes: [thin, zero, zero, thin], reach: [radius, radius] };
        if cuts::STREAKS && lens.streaks {
            ellipses = self.streaks(simd, &batch, [x, y, inverse], [radius, thin], &mut share);
        } else if lens.crystals {
            let [cos, sin, narrow] = batch.turn;
            let wide = thin / narrow;
            ellipses.axes = [cos * thin, sin * thin, -(sin * wide), cos * wide];
        }
        let [across, down] = ellipses.reach;
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
        let [a, b, c, d] = ellipses.axes;
        let (edge, alpha) = (inverse * thin * self.focal, batch.alpha * share);
        let ink = batch.light * Lane(share);
        let crystal = if lens.crystals { size - blur - blur } else { zero };
        let numbers = [x, y, a, b, c, d, across, down, depth, edge, alpha, zero, ink.x, ink.y, ink.z, crystal];
        for lane in Bits(seen) {
            let mut of = [0.0; 16];
            for (number, lanes) in of.iter_mut().zip(&numbers) {
                *number = lanes.as_slice()[lane];
            }
            sprites.push(Sprite::of(of));
        }
    }

    /// The ellipses of discs that are drawn out along their way while the shutter is open; what they hide then falls to
    /// a larger area, so `share` becomes less.
    #[inline(always)]
    fn streaks<S: Simd>(
        &self,
        simd: S,
        batch: &Batch<S>,
        [x, y, inverse]: [F<S>; 3],
        [radius, thin]: [F<S>; 2],
        share: &mut F<S>,
    ) -> Ellipses<S> {
        let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
        let away = batch.streak.dot1(self.forward);
        let (right, below) = (batch.streak.dot1(self.right), batch.streak.dot1(self.down));
        let (dx, dy) =
            ((right - (x - self.middle[0]) * away) * inverse, (below - (y - self.middle[1]) * away) * inverse);
        let length = (dx * dx + dy * dy).sqrt();
        let still = length.simd_lt(1e-6);
        let (cos, sin) = (still.select(one, dx / length), still.select(zero, dy / length));
        let long = radius + length;
        *share *= radius / long;
        Ellipses {
            axes: [cos / long, sin / long, -(sin * thin), cos * thin],
            reach: [dx.abs() + radius, dy.abs() + radius],
        }
    }
}
