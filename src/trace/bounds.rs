//! Which bodies a packet of rays may meet: boxes around bodies, many per vector, against the shaft of the packet.
//!
//! A test of a packet against a body is dear, above all against a block, and most packets come near few bodies. So the
//! packet's rays are taken together, as in shaft culling `[Haines91]`: all origins lie in one box, all directions in
//! another, so that at a distance t along the rays all points lie in `origins + t directions`, by interval arithmetic
//! `[Boulos06]`. Along each axis that box overlaps the box of a body from some distance on, up to some distance; both are
//! linear in the body's sides, so that a vector of bodies takes six multiplications. What is left is one bit per body.
//!
//! No body that a ray meets is ever left out: boxes and directions are taken a little larger than they are
//! (`SLACK`), so that roundings in [`Shape::span`](super::shape::Shape::span) do not matter. So culling changes what a
//! frame costs, and none of its bytes.

use super::shape::{FAR, Shape};
use super::world::{NOWHERE, World};
use crate::cuts;
use crate::simd::block::{BLOCK, load};
use crate::simd::lanes::{Bits, F, M, V3};
use fearless_simd::{f32x8, prelude::*};
use glam::Vec3A;

/// By how much boxes (as a share of their size and their distance from the origin) and directions are taken larger than
/// they are. Roundings are a hundredth of it.
const SLACK: f32 = 1e-5;

/// Bodies of a word.
pub const WORD: usize = BLOCK;

/// Boxes around as many bodies as a word has bits: their least x, y and z, and their largest. The last two rows are not
/// used.
type Boxes = [[f32; BLOCK]; SIDES];

/// The sides of a box, in a number of which vectors can be made.
const SIDES: usize = 8;

/// Boxes around the bodies of a world, 64 to a word.
///
/// In worlds of more bodies than a word holds, those of a word are neighbours, and the word has a box of its own. So the
/// bodies that a packet may meet are found among 10,000 in the time of some tens of tests.
pub struct Bounds {
    boxes: Vec<Boxes>,
    /// Boxes around words, 64 to a row.
    words: Vec<Boxes>,
    /// The index of every body, in the order of their bits. Empty if that is the order of the bodies themselves.
    order: Vec<u32>,
    /// A bit for every body.
    pub all: Vec<u64>,
    /// The bits of bodies that cast shadows.
    pub casters: Vec<u64>,
}

impl Bounds {
    /// The boxes around the bodies of a world.
    pub fn new(world: &World) -> Bounds {
        let extents: Vec<Extent> = world.objects.iter().map(|body| around(&body.shape)).collect();
        let mut order = Vec::new();
        if cuts::MANY_BODIES && extents.len() > WORD {
            order = (0..extents.len() as u32).collect();
            gather(&extents, &mut order);
        }
        let mut bounds = Bounds { boxes: Vec::new(), words: Vec::new(), order, all: Vec::new(), casters: Vec::new() };
        let mut first = 0;
        while first < extents.len() {
            let mut boxes = [[0.0; BLOCK]; SIDES];
            let (mut all, mut casters) = (0, 0);
            let mut whole = Extent { low: Vec3A::INFINITY, high: Vec3A::NEG_INFINITY };
            for bit in 0..WORD.min(extents.len() - first) {
                let index = bounds.index(first + bit);
                let extent = extents[index];
                put(&mut boxes, bit, extent);
                whole = Extent { low: whole.low.min(extent.low), high: whole.high.max(extent.high) };
                all |= 1 << bit;
                casters |= (world.objects[index].casts_shadow as u64) << bit;
            }
            if cuts::MANY_BODIES {
                let word = bounds.all.len();
                if word.is_multiple_of(WORD) {
                    bounds.words.push([[0.0; BLOCK]; SIDES]);
                }
                put(&mut bounds.words[word / WORD], word % WORD, whole);
            }
            bounds.boxes.push(boxes);
            bounds.all.push(all);
            bounds.casters.push(casters);
            if !cuts::MANY_BODIES {
                break;
            }
            first += WORD;
        }
        bounds
    }

    /// The index of the body of a bit, which is counted from the first word's first.
    #[inline(always)]
    pub fn index(&self, bit: usize) -> usize {
        if cuts::MANY_BODIES && !self.order.is_empty() { self.order[bit] as usize } else { bit }
    }

    /// Centre and radius of a ball around the bodies of a word.
    pub fn around(&self, word: usize) -> (Vec3A, f32) {
        let (row, bit) = (&self.words[word / WORD], word % WORD);
        let low = Vec3A::new(row[0][bit], row[1][bit], row[2][bit]);
        let high = Vec3A::new(row[3][bit], row[4][bit], row[5][bit]);
        let radius = 0.5 * low.distance(high);
        if radius.is_finite() { (0.5 * (low + high), radius) } else { (Vec3A::ZERO, f32::INFINITY) }
    }

    /// The bits of the words, of which 64 make a row, that hold bodies which a ray of a shaft may meet; of all words
    /// without a shaft.
    #[inline(always)]
    pub fn words<S: Simd>(&self, simd: S, shaft: Option<&Shaft>, row: usize) -> u64 {
        let count = if cuts::MANY_BODIES { WORD.min(self.all.len() - row * WORD) } else { 1 };
        let all = u64::MAX >> (WORD - count);
        match shaft {
            Some(shaft) if count > 1 => shaft.meets(simd, &self.words[row], count) & all,
            _ => all,
        }
    }

    /// The bits of the bodies of a word that a ray of a shaft may meet; bits beyond the last body mean nothing.
    #[inline(always)]
    pub fn bodies<S: Simd>(&self, simd: S, shaft: &Shaft, word: usize) -> u64 {
        shaft.meets(simd, &self.boxes[word], WORD - self.all[word].leading_zeros() as usize)
    }
}

/// Writes a box into a row of boxes.
fn put(boxes: &mut Boxes, bit: usize, Extent { low, high }: Extent) {
    for axis in 0..3 {
        boxes[axis][bit] = low[axis];
        boxes[3 + axis][bit] = high[axis];
    }
}

/// Orders bodies so that those of a word are neighbours: halves them across their longest side, down to words.
fn gather(extents: &[Extent], order: &mut [u32]) {
    if order.len() <= WORD {
        return;
    }
    // Bodies without end are where the origin is.
    let middle = |&index: &u32| {
        let Extent { low, high } = extents[index as usize];
        let middle = 0.5 * (low + high);
        if middle.is_finite() { middle } else { Vec3A::ZERO }
    };
    let (mut low, mut high) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
    for index in &*order {
        low = low.min(middle(index));
        high = high.max(middle(index));
    }
    let axis = (high - low).max_position();
    // Whole words to the left, so that none but the last is partly filled.
    let half = order.len().div_ceil(2).next_multiple_of(WORD).min(order.len() - 1);
    order.select_nth_unstable_by(half, |a, b| middle(a)[axis].total_cmp(&middle(b)[axis]).then(a.cmp(b)));
    let (left, right) = order.split_at_mut(half);
    gather(extents, left);
    gather(extents, right);
}

/// The box around a body, a little larger. It has no end where the body has none.
fn around(shape: &Shape) -> Extent {
    let (center, half) = match *shape {
        Shape::Sphere { center, radius } => (center, Vec3A::splat(radius)),
        Shape::Block { center, half, .. } if !cuts::ASKEW => (center, half),
        Shape::Block { center, half, turn } => {
            let turn = turn.transpose();
            let reach = |axis: usize| turn.row(axis).abs().dot(half);
            (center, Vec3A::new(reach(0), reach(1), reach(2)))
        }
        Shape::Cylinder { center, half, radius, .. } if !cuts::ASKEW => (center, Vec3A::new(radius, half, radius)),
        Shape::Cylinder { center, axis, half, radius } => {
            let across = (Vec3A::ONE - axis * axis).max(Vec3A::ZERO);
            (center, axis.abs() * half + Vec3A::new(across.x.sqrt(), across.y.sqrt(), across.z.sqrt()) * radius)
        }
        // A level plane ends at its own height.
        Shape::Plane { normal, offset } => {
            let mut high = Vec3A::INFINITY;
            if normal == Vec3A::Y {
                high.y = offset + offset.abs() * SLACK;
            }
            return Extent { low: Vec3A::NEG_INFINITY, high };
        }
        #[cfg(feature = "full")]
        Shape::Globe { .. } => return Extent { low: Vec3A::NEG_INFINITY, high: Vec3A::INFINITY },
    };
    let half = half + (half.max_element() + center.abs().max_element()) * SLACK;
    Extent { low: center - half, high: center + half }
}

/// A box: least and largest coordinates.
#[derive(Clone, Copy)]
pub struct Extent {
    low: Vec3A,
    high: Vec3A,
}

impl Extent {
    /// A point.
    pub const fn point(at: Vec3A) -> Extent {
        Extent { low: at, high: at }
    }

    /// The box around the `active` lanes.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S, v: V3<S>, active: M<S>) -> Extent {
        let (least, most) = (F::<S>::splat(simd, f32::INFINITY), F::<S>::splat(simd, f32::NEG_INFINITY));
        let low: V3<S> =
            V3 { x: active.select(v.x, least), y: active.select(v.y, least), z: active.select(v.z, least) };
        let high: V3<S> = V3 { x: active.select(v.x, most), y: active.select(v.y, most), z: active.select(v.z, most) };
        Extent {
            low: Vec3A::new(low.x.reduce_min(), low.y.reduce_min(), low.z.reduce_min()),
            high: Vec3A::new(high.x.reduce_max(), high.y.reduce_max(), high.z.reduce_max()),
        }
    }
}

/// Where the rays of a packet begin.
#[derive(Clone, Copy)]
pub struct Start {
    /// The box around their origins.
    pub origins: Extent,
    /// The body that none of them can meet, because all of them leave it outwards; or [`NOWHERE`].
    pub leaves: u32,
}

impl Start {
    /// The same where some rays may go `inward`, into the body that they leave.
    #[inline(always)]
    pub fn without<S: Simd>(self, _simd: S, inward: M<S>) -> Start {
        Start { leaves: if inward.any_true() { NOWHERE } else { self.leaves }, ..self }
    }
}

/// All places where the rays of a packet may be.
///
/// Its box at a distance overlaps that of a body under six conditions, one for each side of the latter:
/// `(side - edge) * inverse` is a bound of that distance.
pub struct Shaft {
    edge: [f32; SIDES],
    inverse: [f32; SIDES],
    /// The bits of the sides that give a lower bound; the others give an upper one.
    lower: u64,
    reach: f32,
    /// The body that no ray meets, because all of them leave it outwards; or [`NOWHERE`].
    pub leaves: u32,
}

impl Shaft {
    /// The shaft of rays whose unit directions lie in a box.
    #[inline(always)]
    pub fn new<S: Simd>(simd: S, start: Start, directions: Extent) -> Shaft {
        Shaft::between(simd, start, directions.low - SLACK, directions.high + SLACK, FAR)
    }

    /// The shaft of rays that end at one point.
    #[inline(always)]
    pub fn to<S: Simd>(simd: S, start: Start, target: Vec3A) -> Shaft {
        // With its own length for the unit, each of them is there at 1.
        let origins = start.origins;
        let (low, high) = (target - origins.low, target - origins.high);
        let slack = SLACK * low.abs().max(high.abs()).max_element();
        Shaft::between(simd, start, low - slack, high + slack, 1.0)
    }

    /// The same of rays that end at a distance.
    #[inline(always)]
    pub fn within(self, reach: f32) -> Shaft {
        Shaft { reach: self.reach.min(reach * (1.0 + SLACK)), ..self }
    }

    /// At the distance t the rays are between `origins.low + low t` and `origins.high + high t`.
    #[inline(always)]
    fn between<S: Simd>(simd: S, start: Start, low: Vec3A, high: Vec3A, reach: f32) -> Shaft {
        let Start { origins, leaves } = start;
        // The high end of the rays meets a box's low side, and the other way round.
        let edge =
            [origins.high.x, origins.high.y, origins.high.z, origins.low.x, origins.low.y, origins.low.z, 0.0, 0.0];
        let speed = f32x8::from_slice(simd, &[high.x, high.y, high.z, low.x, low.y, low.z, 1.0, 1.0]);
        // Never 0, so that 0 times infinity never forms.
        let speed = speed.abs().max(f32x8::splat(simd, 1e-20)).copysign(speed);
        let mut inverse = [0.0; SIDES];
        (f32x8::splat(simd, 1.0) / speed).store_slice(&mut inverse);
        let lower = (speed.simd_gt(f32x8::splat(simd, 0.0)).to_bitmask() ^ 0b111_000) & 0b111_111;
        Shaft { edge, inverse, lower, reach, leaves }
    }

    /// The bits of the first `count` boxes that a ray may meet; bits beyond mean nothing.
    #[inline(always)]
    fn meets<S: Simd>(&self, simd: S, boxes: &Boxes, count: usize) -> u64 {
        let mut bits = 0;
        let mut i = 0;
        // Two vectors at a time, so that what a condition needs is loaded once for both.
        while i * F::<S>::LEN < count {
            let mut from = [F::<S>::splat(simd, 0.0); 2];
            let mut to = [F::<S>::splat(simd, self.reach); 2];
            for side in Bits(self.lower) {
                let bound = self.bound(simd, &boxes[side & (SIDES - 1)], side, i);
                from = [from[0].max(bound[0]), from[1].max(bound[1])];
            }
            for side in Bits(self.lower ^ 0b111_111) {
                let bound = self.bound(simd, &boxes[side & (SIDES - 1)], side, i);
                to = [to[0].min(bound[0]), to[1].min(bound[1])];
            }
            let pair = from[0].simd_le(to[0]).to_bitmask() | from[1].simd_le(to[1]).to_bitmask() << F::<S>::LEN;
            bits |= pair << (i * F::<S>::LEN);
            i += 2;
        }
        bits
    }

    /// The bounds of the distance that one side of two vectors of boxes gives.
    #[inline(always)]
    fn bound<S: Simd>(&self, simd: S, row: &[f32; BLOCK], side: usize, i: usize) -> [F<S>; 2] {
        let edge = F::<S>::splat(simd, self.edge[side & (SIDES - 1)]);
        let inverse = F::<S>::splat(simd, self.inverse[side & (SIDES - 1)]);
        let (first, second): (F<S>, F<S>) = (load(simd, row, i), load(simd, row, i + 1));
        [(first - edge) * inverse, (second - edge) * inverse]
    }
}
