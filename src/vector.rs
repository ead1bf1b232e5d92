//! What [`Vec3A`] computes differently from one machine to another, here with the same bits on every one.

use glam::{Vec3A, Vec3Swizzles};

/// The cross product. [`Vec3A::cross`] fuses products with the sum where the processor can.
pub fn cross(a: Vec3A, b: Vec3A) -> Vec3A {
    (a * b.yzx() - a.yzx() * b).yzx()
}

/// `v` with a length of 1, which must not be zero. [`Vec3A::normalize`] divides on some machines and multiplies by the
/// reciprocal on others.
pub fn unit(v: Vec3A) -> Vec3A {
    v * v.length_recip()
}
