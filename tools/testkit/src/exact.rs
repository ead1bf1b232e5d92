//! Numbers without rounding: an integer of any length times a power of two.
//!
//! Every f32 and f64 is one, and so are all sums and products of them. A discriminant computed this way has the right
//! sign and all its digits, whatever cancels.

use num_bigint::BigInt;
use std::ops::{Add, Mul, Sub};

/// `mantissa * 2^exponent`.
#[derive(Clone, Debug)]
pub struct Exact {
    mantissa: BigInt,
    exponent: i64,
}

impl Exact {
    /// The value of a finite number.
    pub fn new(x: f64) -> Exact {
        assert!(x.is_finite());
        let bits = x.to_bits();
        let (field, fraction) = (bits >> 52 & 0x7ff, (bits & ((1 << 52) - 1)) as i64);
        let (mantissa, exponent) =
            if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field as i64 - 1075) };
        // Without trailing zeros: products of short numbers stay short.
        let zeros = if mantissa == 0 { 0 } else { mantissa.trailing_zeros() };
        let mantissa = BigInt::from(if x < 0.0 { -(mantissa >> zeros) } else { mantissa >> zeros });
        Exact { mantissa, exponent: exponent + zeros as i64 }
    }

    /// The nearest f64, or one beside it.
    pub fn value(&self) -> f64 {
        let spare = self.mantissa.bits() as i64 - 64;
        let (mantissa, exponent) = (&self.mantissa >> spare.max(0) as usize, self.exponent + spare.max(0));
        let mantissa = i128::try_from(mantissa).unwrap() as f64;
        // In two steps: 2^exponent alone may lie below the least f64.
        let half = exponent / 2;
        mantissa * 2f64.powi(half as i32) * 2f64.powi((exponent - half) as i32)
    }
}

fn combine(a: &Exact, b: &Exact, f: impl Fn(BigInt, BigInt) -> BigInt) -> Exact {
    let exponent = a.exponent.min(b.exponent);
    let raise = |x: &Exact| &x.mantissa << (x.exponent - exponent) as usize;
    Exact { mantissa: f(raise(a), raise(b)), exponent }
}

impl Add for &Exact {
    type Output = Exact;
    fn add(self, o: &Exact) -> Exact {
        combine(self, o, |a, b| a + b)
    }
}

impl Sub for &Exact {
    type Output = Exact;
    fn sub(self, o: &Exact) -> Exact {
        combine(self, o, |a, b| a - b)
    }
}

impl Mul for &Exact {
    type Output = Exact;
    fn mul(self, o: &Exact) -> Exact {
        Exact { mantissa: &self.mantissa * &o.mantissa, exponent: self.exponent + o.exponent }
    }
}

/// A vector of exact numbers.
#[derive(Clone, Debug)]
pub struct Exact3(pub [Exact; 3]);

impl Exact3 {
    /// The exact value of a vector.
    pub fn new(v: glam::Vec3A) -> Exact3 {
        Exact3(v.to_array().map(|x| Exact::new(x as f64)))
    }

    /// Inner product.
    pub fn dot(&self, o: &Exact3) -> Exact {
        let Exact3([a, b, c]) = self;
        let Exact3([d, e, f]) = o;
        &(&(a * d) + &(b * e)) + &(c * f)
    }

    /// Cross product.
    pub fn cross(&self, o: &Exact3) -> Exact3 {
        let Exact3([a, b, c]) = self;
        let Exact3([d, e, f]) = o;
        Exact3([&(b * f) - &(c * e), &(c * d) - &(a * f), &(a * e) - &(b * d)])
    }
}

impl Sub for &Exact3 {
    type Output = Exact3;
    fn sub(self, o: &Exact3) -> Exact3 {
        Exact3(std::array::from_fn(|i| &self.0[i] - &o.0[i]))
    }
}
