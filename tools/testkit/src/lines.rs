//! One line and one convex body: every implementation of the crossing against numbers without rounding.
//!
//! Errors are backward errors: how much the body must grow or shrink to be met exactly where it was found, in roundings
//! of the lengths that take part. For a ball that is the relative error of t over the conditioning of t.

use super::found::Found;
use super::span::{Crossing, span as exact_span};
use super::{ULP, random::Random};
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::{Vec3A, vec3a};
use paprsek::simd::lanes::{F, M, U, V3};
use paprsek::trace::bounds::Bounds;
use paprsek::trace::ray::{RayPacket, Search, nearest};
use paprsek::trace::reference;
use paprsek::trace::shape::{Ball, FAR, Shape};
use paprsek::trace::world::NOWHERE;
use paprsek::trace::{Background, Material, Object, World};

/// The target for balls, roundings: four, as the projected form reaches them.
pub const BALL: f64 = 4.0;
/// A rotation or an axis taken out first costs three more products and sums.
pub const TURNED: f64 = 8.0;
/// A rougher crossing may be off by this many roundings of the distance and be found or missed within them.
pub const ROUGH: f64 = 8.0;

/// One line and one body.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// The body.
    pub shape: Shape,
    /// Start of the line.
    pub o: Vec3A,
    /// Its direction.
    pub d: Vec3A,
}

/// `Shape::span` in the first lane.
#[inline(always)]
pub fn wide<S: Simd>(simd: S, case: &Case, roughly: bool) -> Option<(f32, f32)> {
    let (o, d) = (V3::splat(simd, case.o), V3::splat(simd, case.d));
    let (t0, t1, hit) = case.shape.span(simd, o, d, if roughly { Ball::Rough } else { Ball::Exact });
    let found = hit.to_bitmask() & 1 != 0 && t0[0] <= t1[0];
    found.then_some((t0[0], t1[0]))
}

/// Whether the body lies between the origin and `reach`, as a shadow ray asks.
#[inline(always)]
pub fn wide_blocks<S: Simd>(simd: S, case: &Case, reach: f32) -> bool {
    let (o, d) = (V3::splat(simd, case.o), V3::splat(simd, case.d));
    let world = alone(case.shape, Material::plain(Vec3A::ONE), 1);
    let (from, inward) = (U::<S>::splat(simd, NOWHERE), M::<S>::splat(simd, false));
    let ray = RayPacket { origin: o, direction: d, from, inward };
    let bounds = Bounds::new(&world);
    let (reach, list) = (F::<S>::splat(simd, reach), &bounds.casters);
    let (_, light, _) = nearest(simd, &world, &bounds, list, None, &ray, !inward, reach, Search::Shadow);
    light[0] == 0.0
}

/// The outward normal in the first lane.
#[inline(always)]
pub fn wide_normal<S: Simd>(simd: S, shape: &Shape, p: Vec3A) -> Vec3A {
    let n = shape.normal(simd, V3::splat(simd, p));
    vec3a(n.x[0], n.y[0], n.z[0])
}

/// `Shape::span` at one level.
pub fn wide_at(level: Level, case: &Case, roughly: bool) -> Option<(f32, f32)> {
    dispatch!(level, simd => wide(simd, case, roughly))
}

/// The span of every implementation, by name.
pub fn spans(case: &Case) -> Vec<(&'static str, Option<(f32, f32)>)> {
    let Case { shape, o, d } = case;
    let mut all = vec![("scalar", reference::span(shape, *o, *d))];
    all.extend(crate::levels().into_iter().map(|(name, level)| (name, wide_at(level, case, false))));
    all
}

/// Where the shape is, and the length that its own numbers bring in.
pub fn place(shape: &Shape) -> (Vec3A, f64) {
    match *shape {
        Shape::Sphere { center, radius } => (center, radius as f64),
        Shape::Block { center, half, .. } => (center, half.length() as f64),
        Shape::Cylinder { center, half, radius, .. } => (center, half.hypot(radius) as f64),
        Shape::Plane { offset, .. } => (Vec3A::ZERO, offset.abs() as f64),
        Shape::Globe { touch, .. } => (touch, 0.0),
    }
}

/// The direction from `o` to `p`, normalised in f32.
pub fn toward(o: Vec3A, p: Vec3A) -> Vec3A {
    (p - o).try_normalize().unwrap_or(Vec3A::X)
}

/// One body alone under a sky of light 1.
pub fn alone(shape: Shape, material: Material, max_level: u32) -> World {
    World { background: Background::even(Vec3A::ONE), max_level, ..World::new(vec![Object::new(shape, material)]) }
}

/// One body of each kind at a scale, its surface some way from the origin.
pub fn bodies(random: &mut Random, scale: f32) -> Vec<Shape> {
    let center = random.direction() * scale * random.range(0.0, 3.0) as f32;
    let half = vec3a(1.0, 0.4, 1.7) * scale;
    vec![
        Shape::Sphere { center, radius: scale },
        Shape::Block { center, half, turn: random.turn() },
        Shape::Cylinder { center, axis: random.direction(), half: 1.3 * scale, radius: 0.6 * scale },
        Shape::Plane { normal: random.direction(), offset: 0.3 * scale },
        Shape::Globe { touch: center, normal: random.direction(), radius: 1e6 * scale },
    ]
}

/// The largest errors found, in roundings.
#[derive(Default, Debug)]
pub struct Worst {
    /// Lines tried, and the largest error of any implementation; infinite where one found what is not there, or missed
    /// what is.
    pub found: Found,
    /// Lines that surely meet their body.
    pub hits: u32,
    /// Lines that surely miss it.
    pub misses: u32,
    /// Lines so near to the rim that rounding may decide.
    pub open: u32,
}

impl Worst {
    /// Every implementation against the truth: found or missed as it should be, and where. Lines within `bound` roundings
    /// of the rim may be found or missed.
    pub fn check(&mut self, case: &Case, bound: f64) {
        let Case { shape, o, d } = case;
        let (center, size) = place(shape);
        let away = o.as_dvec3().distance(center.as_dvec3());
        let truth = exact_span(shape, *o, *d, 0.0);
        let slack = bound * ULP * (away + size);
        let surely = exact_span(shape, *o, *d, -slack).is_some();
        let possibly = exact_span(shape, *o, *d, slack).is_some();
        match (surely, possibly) {
            (true, _) => self.hits += 1,
            (_, false) => self.misses += 1,
            _ => self.open += 1,
        }
        self.found.inputs += 1;
        for (name, found) in spans(case) {
            if found.is_some() != surely && found.is_some() != possibly {
                self.found.more(f64::INFINITY, || format!("{name} finds {found:?} for {truth:?}: {case:?}"));
            }
            let (Some((t0, t1)), Some(truth)) = (found, truth) else { continue };
            for (index, (t, exact)) in [t0, t1].into_iter().zip(truth).enumerate() {
                if !surely && !matches!(shape, Shape::Sphere { .. } | Shape::Plane { .. } | Shape::Globe { .. }) {
                    continue;
                }
                // What the direction lacks of unit length moves the crossing by that share of t, twice.
                let lack = (d.as_dvec3().length() - 1.0).abs() / ULP;
                let error = Worst::error(case, index, t, exact, away + size) - lack;
                self.found.more(error, || format!("{name}: {t} for {exact:?}: {case:?}"));
            }
        }
    }

    /// By how many roundings the crossing `t` is off.
    fn error(case: &Case, index: usize, t: f32, exact: Crossing, lengths: f64) -> f64 {
        if exact.t.abs() >= FAR as f64 {
            return if t.abs() >= FAR { 0.0 } else { f64::INFINITY };
        }
        let lengths = lengths + exact.t.abs();
        // Radius and normal count too, with the distance between the point met and the touch point.
        let lengths = if let Shape::Globe { .. } = case.shape { 2.0 * lengths } else { lengths };
        match case.shape {
            Shape::Block { .. } | Shape::Cylinder { .. } => {
                // Near an edge either face may be the one that counts: the body grown or shrunk by k roundings must be
                // met beyond and before t.
                let between = |k: f64| {
                    let slack = k * ULP * lengths;
                    let outer = exact_span(&case.shape, case.o, case.d, slack).map(|s| s[index].t);
                    let inner = exact_span(&case.shape, case.o, case.d, -slack).map(|s| s[index].t);
                    let t = if index == 0 { t as f64 } else { -t as f64 };
                    let sign = if index == 0 { 1.0 } else { -1.0 };
                    outer.is_some_and(|o| sign * o <= t) && inner.is_none_or(|i| t <= sign * i)
                };
                [0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0].into_iter().find(|k| between(*k)).unwrap_or(f64::INFINITY)
            }
            _ => (t as f64 - exact.t).abs() * exact.slope / lengths / ULP,
        }
    }
}
