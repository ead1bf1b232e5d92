//! A snow crystal in the unit disc: a six-armed star, by a formula.
//!
//! A point is folded by the symmetry of the star onto one side of one arm; there the star is a plate in the middle, an
//! arm and branches that leave it at 60 degrees, as in the drawings of `[Snow07]`. The distance to the nearest border,
//! in pixels, gives an edge that is one pixel wide at any size.

use crate::simd::lanes::{F, masked};
use fearless_simd::prelude::*;

/// Radius in pixels from which on a flake is more than a soft disc.
pub const LEAST: f32 = 2.5;

/// Distance from the middle of the plate to the middles of its sides; half of the width of an arm, and of a branch.
/// Lengths are shares of the star's radius.
const PLATE: f32 = 0.28;
const ARM: f32 = 0.07;
const BRANCH: f32 = 0.055;

/// Sine and cosine of the angles between an arm and the lines that a point is folded at: 60 and 30 degrees.
const FOLDS: [(f32, f32); 2] = [(0.866_025_4, 0.5), (0.5, 0.866_025_4)];

/// The weight of a crystal with a radius of `radius` pixels at points (`u`, `v`), which is 0 outside of the unit disc.
/// From [`LEAST`] on, the soft disc of a sprite fades into it.
#[inline(always)]
pub fn weight<S: Simd>(simd: S, u: F<S>, v: F<S>, radius: f32) -> F<S> {
    let (zero, one) = (F::<S>::splat(simd, 0.0), F::<S>::splat(simd, 1.0));
    let rest = (one - (u * u + v * v)).max(zero);
    // Folded onto the upper side of the arm along x.
    let (mut x, mut y) = (u.abs(), v.abs());
    for (sin, cos) in FOLDS {
        let beyond = (x * sin - y * cos).min(zero);
        (x, y) = (x - beyond * (2.0 * sin), y + beyond * (2.0 * cos));
    }
    let middle = -(x * 0.866_025_4 + y * 0.5) + PLATE;
    // A branch every quarter of the arm, shorter towards its end.
    let slant = (x - y * 0.577_350_3) * 4.0;
    let side = ((slant - slant.floor() - 0.5).abs() * -0.217 + BRANCH).min((one - x) * 0.55 - y);
    let inside = middle.max(-y + ARM).max(side).min(one - x);
    let edge = (inside * radius + 0.5).max(zero).min(one);
    let share = ((radius - LEAST) * 0.4).min(1.0);
    // Which pixels beyond the disc are asked for depends on the number of lanes.
    masked::<S>(rest * rest + (edge - rest * rest) * share, rest.simd_gt(zero))
}
