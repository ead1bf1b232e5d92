//! Numbers and vectors from the bytes of an input.

use arbitrary::Unstructured;
use glam::{Mat3A, Vec3A, vec3a};

/// Numbers beyond what a scene would have.
const WILD: [f32; 16] = [
    f32::NAN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::MAX,
    f32::MIN,
    f32::MIN_POSITIVE,
    1e-42,
    -0.0,
    1e30,
    -1e30,
    1e-30,
    1e15,
    -1e15,
    1e7,
    1e-7,
    16_777_217.0,
];

/// An input that is being read. Where its bytes have ended, all that follows is zero.
pub struct Input<'a> {
    bytes: Unstructured<'a>,
    /// Whether numbers beyond what a scene would have may come. Then only time, memory and the lack of panics are
    /// promised.
    pub is_wild: bool,
}

impl<'a> Input<'a> {
    /// The first byte says whether numbers may be wild: one of four does.
    pub fn new(bytes: &'a [u8]) -> Input<'a> {
        let mut input = Input { bytes: Unstructured::new(bytes), is_wild: false };
        input.is_wild = input.byte() & 3 == 3;
        input
    }

    /// Whether there is nothing left.
    pub fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// All that is left.
    pub fn rest(self) -> &'a [u8] {
        self.bytes.take_rest()
    }

    pub fn byte(&mut self) -> u8 {
        self.bytes.arbitrary().unwrap_or(0)
    }

    pub fn word(&mut self) -> u32 {
        self.bytes.arbitrary().unwrap_or(0)
    }

    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// A whole number below `end`, which is at most 65,536.
    pub fn below(&mut self, end: usize) -> usize {
        let number: u16 = self.bytes.arbitrary().unwrap_or(0);
        usize::from(number) % end
    }

    /// One of these.
    pub fn one_of<T: Copy>(&mut self, these: &[T]) -> T {
        these[self.below(these.len())]
    }

    /// A number from `least` to `most`, or a wild one.
    pub fn number(&mut self, least: f32, most: f32) -> f32 {
        let share: u16 = self.bytes.arbitrary().unwrap_or(0);
        if self.is_wild && share >> 8 > 0xe0 {
            return WILD[usize::from(share) % WILD.len()];
        }
        least + (most - least) * (f32::from(share) / 65535.0)
    }

    /// A vector whose coordinates are from `-most` to `most`, or wild. Often on a grid, so that things touch.
    pub fn vector(&mut self, most: f32) -> Vec3A {
        let is_on_grid = self.flag();
        let v = vec3a(self.number(-most, most), self.number(-most, most), self.number(-most, most));
        if is_on_grid && !self.is_wild { v.round() } else { v }
    }

    /// A direction of length 1, often an axis; or a wild vector.
    pub fn direction(&mut self) -> Vec3A {
        let v = self.vector(2.0);
        if self.is_wild { v } else { v.try_normalize().unwrap_or(Vec3A::Y) }
    }

    /// A rotation.
    pub fn turn(&mut self) -> Mat3A {
        let axis = self.direction();
        let angle = self.number(-4.0, 4.0);
        if self.is_wild {
            Mat3A::from_cols(axis, axis * angle, Vec3A::Y)
        } else {
            Mat3A::from_axis_angle(axis.into(), angle)
        }
    }

    /// A colour, linear light up to 2.
    pub fn color(&mut self) -> Vec3A {
        vec3a(self.number(0.0, 2.0), self.number(0.0, 2.0), self.number(0.0, 2.0))
    }
}
