//! Vectors in space over lanes, and the few lane operations that kernels share.
//!
//! Nothing here fuses a multiplication with an addition, so that every SIMD level gives the same bits.

use crate::simd::block::{Block3, load, store};
use fearless_simd::prelude::*;
use glam::Vec3A;
use std::ops::{Add, Mul, Neg, Sub};

/// A SIMD level's native vector of `f32`: 4, 8 or 16 lanes.
pub type F<S> = <S as Simd>::f32s;
/// A SIMD level's native vector of `u32`, with as many lanes as [`F`].
pub type U<S> = <S as Simd>::u32s;
/// A mask over the lanes of [`F`] and [`U`].
pub type M<S> = <S as Simd>::mask32s;

/// A vector in space per lane.
#[derive(Clone, Copy)]
pub struct V3<S: Simd> {
    /// The x of every lane.
    pub x: F<S>,
    /// The y of every lane.
    pub y: F<S>,
    /// The z of every lane.
    pub z: F<S>,
}

impl<S: Simd> V3<S> {
    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(simd: S, v: Vec3A) -> V3<S> {
        V3 { x: F::<S>::splat(simd, v.x), y: F::<S>::splat(simd, v.y), z: F::<S>::splat(simd, v.z) }
    }

    /// The points of vector `i` of a block.
    #[inline(always)]
    pub fn load(simd: S, blocks: &Block3, i: usize) -> V3<S> {
        V3 { x: load(simd, &blocks[0], i), y: load(simd, &blocks[1], i), z: load(simd, &blocks[2], i) }
    }

    /// Writes the points of vector `i` of a block.
    #[inline(always)]
    pub fn store(self, blocks: &mut Block3, i: usize) {
        store(self.x, &mut blocks[0], i);
        store(self.y, &mut blocks[1], i);
        store(self.z, &mut blocks[2], i);
    }

    /// The dot product.
    #[inline(always)]
    pub fn dot(self, o: V3<S>) -> F<S> {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// The dot product with the same vector in every lane.
    #[inline(always)]
    pub fn dot1(self, o: Vec3A) -> F<S> {
        self.x * o.x + self.y * o.y + self.z * o.z
    }

    /// The difference to the same vector in every lane.
    #[inline(always)]
    pub fn sub1(self, o: Vec3A) -> V3<S> {
        V3 { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }

    /// The product by component.
    #[inline(always)]
    pub fn mulv(self, o: V3<S>) -> V3<S> {
        V3 { x: self.x * o.x, y: self.y * o.y, z: self.z * o.z }
    }

    /// The largest component.
    #[inline(always)]
    pub fn max_element(self) -> F<S> {
        self.x.max(self.y).max(self.z)
    }

    /// The vector of the first lane.
    #[inline(always)]
    pub fn first(self) -> Vec3A {
        Vec3A::new(self.x[0], self.y[0], self.z[0])
    }

    /// `a` where the mask is set, else `b`.
    #[inline(always)]
    pub fn select(mask: M<S>, a: V3<S>, b: V3<S>) -> V3<S> {
        V3 { x: mask.select(a.x, b.x), y: mask.select(a.y, b.y), z: mask.select(a.z, b.z) }
    }

    /// `self` where the mask is set, else zero.
    #[inline(always)]
    pub fn masked(self, mask: M<S>) -> V3<S> {
        V3 { x: masked::<S>(self.x, mask), y: masked::<S>(self.y, mask), z: masked::<S>(self.z, mask) }
    }
}

/// `x` where the mask is set, else zero. Of [`Select::select`] with a zero compilers make two instructions at AVX2.
#[inline(always)]
pub fn masked<S: Simd>(x: F<S>, mask: M<S>) -> F<S> {
    (x.bitcast::<S::i32s>() & mask.to_vector()).bitcast()
}

impl<S: Simd> Add for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn add(self, o: V3<S>) -> V3<S> {
        V3 { x: self.x + o.x, y: self.y + o.y, z: self.z + o.z }
    }
}

impl<S: Simd> Sub for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn sub(self, o: V3<S>) -> V3<S> {
        V3 { x: self.x - o.x, y: self.y - o.y, z: self.z - o.z }
    }
}

impl<S: Simd> Neg for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn neg(self) -> V3<S> {
        V3 { x: -self.x, y: -self.y, z: -self.z }
    }
}

/// Scales each lane's vector by that lane's number.
impl<S: Simd> Mul<Lane<S>> for V3<S> {
    type Output = V3<S>;
    #[inline(always)]
    fn mul(self, k: Lane<S>) -> V3<S> {
        V3 { x: self.x * k.0, y: self.y * k.0, z: self.z * k.0 }
    }
}

/// A number per lane, as the factor in `V3 * Lane`.
#[derive(Clone, Copy)]
pub struct Lane<S: Simd>(pub F<S>);

/// The number of each lane, for as many lanes as there are.
pub static STEPS: [u32; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// The lanes, read as whole numbers with a sign, as floats.
#[inline(always)]
pub fn float<S: Simd>(_simd: S, n: U<S>) -> F<S> {
    n.bitcast::<S::i32s>().to_float()
}

/// Iterates over the lanes whose bit is set in a mask, lowest first.
pub struct Bits(pub u64);

impl Iterator for Bits {
    type Item = usize;
    #[inline(always)]
    fn next(&mut self) -> Option<usize> {
        (self.0 != 0).then(|| {
            let lane = self.0.trailing_zeros() as usize;
            self.0 &= self.0 - 1;
            lane
        })
    }
}
