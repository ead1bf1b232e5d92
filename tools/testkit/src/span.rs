//! Where a line crosses a body, by the textbook's formulas over numbers that are not rounded.
//!
//! `b^2 - ac`, which cancels in floating point, is right here: nothing is rounded before the last root and quotient.

use super::exact::{Exact, Exact3};
use glam::Vec3A;
use paprsek::trace::Shape;

/// One crossing of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Parameter along the direction as it is given, unit or not.
    pub t: f64,
    /// Cosine between line and normal there.
    pub slope: f64,
}

/// Entry and exit.
pub type Span = Option<[Crossing; 2]>;

/// Crossings of the body grown by `grow` on all sides; none where the line misses it or only touches it.
pub fn span(shape: &Shape, o: Vec3A, d: Vec3A, grow: f64) -> Span {
    let number = |x: f32| Exact::new(x as f64);
    let (o, d) = (Exact3::new(o), Exact3::new(d));
    let length = d.dot(&d).value().sqrt();
    match *shape {
        Shape::Sphere { center, radius } => {
            let q = &o - &Exact3::new(center);
            let r = &number(radius) + &Exact::new(grow);
            if r.value() <= 0.0 {
                return None;
            }
            let roots = roots(&d.dot(&d), &q.dot(&d), &(&q.dot(&q) - &(&r * &r)));
            roots.map(|(t, s)| t.map(|t| Crossing { t, slope: s / (length * r.value()) }))
        }
        Shape::Globe { touch, normal, radius } => {
            let (q, n) = (&o - &Exact3::new(touch), Exact3::new(normal));
            let r = number(radius);
            let twice = &r * &Exact::new(2.0);
            let g = Exact::new(grow);
            let b = &q.dot(&d) + &(&r * &n.dot(&d));
            let c = &(&q.dot(&q) + &(&twice * &q.dot(&n))) - &(&(&twice * &g) + &(&g * &g));
            let steep = length * r.value() * n.dot(&n).value().sqrt();
            roots(&d.dot(&d), &b, &c).map(|(t, s)| t.map(|t| Crossing { t, slope: s / steep }))
        }
        Shape::Plane { normal, offset } => {
            let n = Exact3::new(normal);
            let height = &o.dot(&n) - &(&number(offset) + &Exact::new(grow));
            half_space(height.value(), d.dot(&n).value(), length)
        }
        Shape::Block { center, half, turn } => {
            let q = &o - &Exact3::new(center);
            let mut all = everything();
            for axis in 0..3 {
                let row = Exact3::new(turn.row(axis));
                let half = &number(half[axis]) + &Exact::new(grow);
                all = meet(all?, slab(&q.dot(&row), &d.dot(&row), &half, length)?);
            }
            all
        }
        Shape::Cylinder { center, axis, half, radius } => {
            let (q, n) = (&o - &Exact3::new(center), Exact3::new(axis));
            // In lengths of the axis, which is not quite one.
            let unit = n.dot(&n).value().sqrt();
            let caps = {
                let half = Exact::new((half as f64 + grow) * unit);
                slab(&q.dot(&n), &d.dot(&n), &half, length)?
            };
            let r = radius as f64 + grow;
            if r <= 0.0 {
                return None;
            }
            let (u, v) = (q.cross(&n), d.cross(&n));
            let reach = Exact::new(r * unit);
            let (a, c) = (v.dot(&v), &u.dot(&u) - &(&reach * &reach));
            if a.value() == 0.0 {
                return if c.value() < 0.0 { Some(caps) } else { None };
            }
            let (t, s) = roots(&a, &u.dot(&v), &c)?;
            meet(caps, t.map(|t| Crossing { t, slope: s / (r * unit * unit * length) }))
        }
    }
}

/// The roots of `a t^2 + 2 b t + c`, and the root of the discriminant.
fn roots(a: &Exact, b: &Exact, c: &Exact) -> Option<([f64; 2], f64)> {
    let discriminant = (&(b * b) - &(a * c)).value();
    if discriminant <= 0.0 {
        return None;
    }
    let (b, s) = (-b.value(), discriminant.sqrt());
    let far = b + s.copysign(b);
    let (t, u) = (far / a.value(), c.value() / far);
    Some(([t.min(u), t.max(u)], s))
}

fn everything() -> Span {
    Some([f64::NEG_INFINITY, f64::INFINITY].map(|t| Crossing { t, slope: 1.0 }))
}

/// Where a line is at or below height zero.
fn half_space(height: f64, speed: f64, length: f64) -> Span {
    let mut all = everything()?;
    let crossing = Crossing { t: -height / speed, slope: speed.abs() / length };
    match speed {
        s if s < 0.0 => all[0] = crossing,
        s if s > 0.0 => all[1] = crossing,
        _ if height > 0.0 => return None,
        _ => (),
    }
    Some(all)
}

/// Where a line is between `-half` and `half`.
fn slab(o: &Exact, d: &Exact, half: &Exact, length: f64) -> Span {
    if half.value() <= 0.0 {
        return None;
    }
    let below = half_space((o - half).value(), d.value(), length)?;
    let above = half_space(-(o + half).value(), -d.value(), length)?;
    meet(below, above)
}

fn meet(a: [Crossing; 2], b: [Crossing; 2]) -> Span {
    let entry = if a[0].t > b[0].t { a[0] } else { b[0] };
    let exit = if a[1].t < b[1].t { a[1] } else { b[1] };
    (entry.t < exit.t).then_some([entry, exit])
}
