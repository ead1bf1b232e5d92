//! Every shape against crossings without rounding: where lines enter and leave, what they do not meet, normals,
//! shadows, and that no ray meets again what it leaves.
//!
//! Errors are backward errors: how much the body must grow or shrink to be met exactly where it was found, in roundings
//! of the lengths that take part. For a ball that is the relative error of t over the conditioning of t.

use super::span::{Crossing, span as exact_span};
use fearless_simd::{Level, Simd, dispatch, prelude::*};
use glam::{Mat3, Vec3, vec3};
use paprsek::simd::lanes::{F, M, U, V3};
use paprsek::trace::bounds::Bounds;
use paprsek::trace::ray::{RayPacket, Search, nearest};
use paprsek::trace::reference::{self, Ray};
use paprsek::trace::shape::{Ball, FAR, Shape};
use paprsek::trace::world::NOWHERE;
use paprsek::trace::{Background, Material, Object, World};
use proptest::prelude::*;
use testkit::{ULP, random::Random};

/// The target for balls, roundings: four, as the projected form reaches them.
const BALL: f64 = 4.0;
/// A rotation or an axis taken out first costs three more products and sums.
const TURNED: f64 = 8.0;
/// A rougher crossing may be off by this many roundings of the distance and be found or missed within them.
const ROUGH: f64 = 8.0;

/// One line and one body.
#[derive(Clone, Copy, Debug)]
struct Case {
    shape: Shape,
    o: Vec3,
    d: Vec3,
}

/// `span` at one level, in the first lane.
#[inline(always)]
fn wide<S: Simd>(simd: S, case: &Case, roughly: bool) -> Option<(f32, f32)> {
    let (o, d) = (V3::splat(simd, case.o), V3::splat(simd, case.d));
    let (t0, t1, hit) = case.shape.span(simd, o, d, if roughly { Ball::Rough } else { Ball::Exact });
    let found = hit.to_bitmask() & 1 != 0 && t0[0] <= t1[0];
    found.then_some((t0[0], t1[0]))
}

#[inline(always)]
fn wide_blocks<S: Simd>(simd: S, case: &Case, reach: f32) -> bool {
    let (o, d) = (V3::splat(simd, case.o), V3::splat(simd, case.d));
    let world = alone(case.shape, Material::plain(Vec3::ONE), 1);
    let (from, inward) = (U::<S>::splat(simd, NOWHERE), M::<S>::splat(simd, false));
    let ray = RayPacket { origin: o, direction: d, from, inward };
    let bounds = Bounds::new(&world);
    let (reach, list) = (F::<S>::splat(simd, reach), &bounds.casters);
    let (object, _) = nearest(simd, &world, &bounds, list, None, &ray, !inward, reach, Search::Shadow);
    object[0] != NOWHERE
}

#[inline(always)]
fn wide_normal<S: Simd>(simd: S, shape: &Shape, p: Vec3) -> Vec3 {
    let n = shape.normal(simd, V3::splat(simd, p));
    vec3(n.x[0], n.y[0], n.z[0])
}

fn wide_at(level: Level, case: &Case, roughly: bool) -> Option<(f32, f32)> {
    dispatch!(level, simd => wide(simd, case, roughly))
}

/// The span of every implementation, by name.
fn spans(case: &Case) -> Vec<(&'static str, Option<(f32, f32)>)> {
    let Case { shape, o, d } = case;
    let mut all = vec![("scalar", reference::span(shape, *o, *d))];
    all.extend(testkit::levels().into_iter().map(|(name, level)| (name, wide_at(level, case, false))));
    all
}

/// Where the shape is, and the length that its own numbers bring in.
fn place(shape: &Shape) -> (Vec3, f64) {
    match *shape {
        Shape::Sphere { center, radius } => (center, radius as f64),
        Shape::Block { center, half, .. } => (center, half.length() as f64),
        Shape::Cylinder { center, half, radius, .. } => (center, half.hypot(radius) as f64),
        Shape::Plane { offset, .. } => (Vec3::ZERO, offset.abs() as f64),
        Shape::Globe { touch, .. } => (touch, 0.0),
    }
}

/// The largest errors found, in roundings.
#[derive(Default, Debug)]
struct Worst {
    error: f64,
    hits: u32,
    misses: u32,
    /// Lines so near to the rim that rounding may decide.
    open: u32,
}

impl Worst {
    /// Every implementation against the truth: found or missed as it should be, and where.
    fn check(&mut self, case: &Case, bound: f64) {
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
        for (name, found) in spans(case) {
            assert!(found.is_some() || !surely, "{name} misses: {case:?}, {truth:?}");
            assert!(found.is_none() || possibly, "{name} finds {found:?}: {case:?}");
            let (Some((t0, t1)), Some(truth)) = (found, truth) else { continue };
            for (index, (t, exact)) in [t0, t1].into_iter().zip(truth).enumerate() {
                if !surely && !matches!(shape, Shape::Sphere { .. } | Shape::Plane { .. } | Shape::Globe { .. }) {
                    continue;
                }
                // What the direction lacks of unit length moves the crossing by that share of t, twice.
                let lack = (d.as_dvec3().length() - 1.0).abs() / ULP;
                let error = Worst::error(case, index, t, exact, away + size) - lack;
                assert!(error <= bound, "{name}: {t} is off {exact:?} by {error} roundings: {case:?}");
                self.error = self.error.max(error);
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

/// The direction from `o` to `p`, normalised in f32.
fn toward(o: Vec3, p: Vec3) -> Vec3 {
    (p - o).try_normalize().unwrap_or(Vec3::X)
}

#[test]
fn balls_are_met_where_they_are() {
    let mut worst = Worst::default();
    let mut random = Random(1);
    // Far, near, inside and on the surface; all sizes; straight at it, past it and anywhere between.
    for _ in 0..60_000 {
        let radius = random.log(1e-6, 1e6) as f32;
        let distance = radius as f64 * random.log(1e-3, 1e6);
        let o = random.direction() * distance as f32;
        let center = if random.unit() < 0.5 { Vec3::ZERO } else { random.direction() * random.log(1e-6, 1e6) as f32 };
        let o = center + o;
        let aim = toward(o, center);
        let offset = radius as f64 * random.range(0.0, 1.2);
        let d = toward(o, center + random.across(aim) * offset as f32);
        let d = if random.unit() < 0.2 { random.direction() } else { d };
        let d = if random.unit() < 0.2 { -d } else { d };
        // Directions are documented as unit; the last place of f32 is not to matter.
        let d = if random.unit() < 0.2 { d * random.range(1.0 - 1e-7, 1.0 + 1e-7) as f32 } else { d };
        worst.check(&Case { shape: Shape::Sphere { center, radius }, o, d }, BALL);
    }
    println!("balls: {worst:?}");
    assert!(worst.hits > 20_000 && worst.misses > 5_000);
}

#[test]
fn balls_far_away_are_not_lost() {
    // The naive discriminant misses from 1e4 radii on. Rays to f32's own precision: exactly representable offsets.
    let mut worst = Worst::default();
    for distance in [1e4f32, 3e4, 1e5, 3e5, 1e6] {
        for k in 0..=200 {
            let shape = Shape::Sphere { center: vec3(0.0, 0.0, -distance), radius: 1.0 };
            let o = vec3(k as f32 / 128.0, 0.0, 0.0);
            worst.check(&Case { shape, o, d: Vec3::NEG_Z }, BALL);
        }
    }
    println!("far balls: {worst:?}");
    assert!(worst.hits > 400);
}

#[test]
fn tangents_fall_on_the_right_side() {
    // Along an axis the distance to the line is the offset itself: r (1 +- 1e-6) is 16 roundings inside and outside.
    let mut worst = Worst::default();
    let mut random = Random(2);
    for radius in [1e-6f32, 1e-3, 0.55, 1.0, 7.3, 1e3, 1e6] {
        for axis in 0..3 {
            let (d, side) = (Vec3::AXES[axis], Vec3::AXES[(axis + 1) % 3]);
            for distance in [-3.0, -1.0, 0.0, 1.0, 3.0] {
                let o = d * (-distance * radius);
                let shape = Shape::Sphere { center: Vec3::ZERO, radius };
                let at = |factor: f64| Case { shape, o: o + side * (radius as f64 * factor) as f32, d };
                for (name, found) in spans(&at(1.0 - 1e-6)) {
                    assert!(found.is_some(), "{name}: {radius} {axis} {distance}");
                }
                for (name, found) in spans(&at(1.0 + 1e-6)) {
                    assert!(found.is_none(), "{name}: {radius} {axis} {distance}");
                }
                worst.check(&at(1.0 - 1e-6), BALL);
            }
        }
    }
    for _ in 0..5_000 {
        let d = random.direction();
        let o = d * -random.log(0.1, 100.0) as f32 + random.across(d) * random.range(1.0 - 1e-5, 1.0 + 1e-5) as f32;
        worst.check(&Case { shape: Shape::Sphere { center: Vec3::ZERO, radius: 1.0 }, o, d }, BALL);
    }
    println!("tangents: {worst:?}");
}

#[test]
fn globes_are_met_where_they_are() {
    let mut worst = Worst::default();
    let mut random = Random(3);
    for _ in 0..10_000 {
        let radius = random.log(1e5, 1e9) as f32;
        let normal = if random.unit() < 0.5 { Vec3::Y } else { random.direction() };
        let touch = if random.unit() < 0.5 { Vec3::ZERO } else { random.direction() * 100.0 };
        // An eye from a millimetre to a kilometre above the ground, and sometimes below it or on it.
        let height = random.log(1e-3, 1e3) as f32 * [1.0, 1.0, 1.0, -1.0, 0.0][(random.unit() * 5.0) as usize];
        let o = touch + normal * height + random.across(normal) * random.log(1e-3, 1e3) as f32;
        let d = if random.unit() < 0.3 {
            (random.across(normal) + normal * random.range(-1e-3, 1e-3) as f32).normalize()
        } else {
            random.direction()
        };
        worst.check(&Case { shape: Shape::Globe { touch, normal, radius }, o, d }, BALL);
    }
    println!("globes: {worst:?}");
    assert!(worst.hits > 4_000 && worst.misses > 1_000);
}

#[test]
fn planes_are_met_where_they_are() {
    let mut worst = Worst::default();
    let mut random = Random(4);
    for _ in 0..10_000 {
        let normal = if random.unit() < 0.5 { Vec3::Y } else { random.direction() };
        let shape = Shape::Plane { normal, offset: random.log(1e-3, 1e3) as f32 };
        let o = random.direction() * random.log(1e-3, 1e4) as f32;
        worst.check(&Case { shape, o, d: random.direction() }, BALL);
    }
    println!("planes: {worst:?}");
    let floor = Shape::Plane { normal: Vec3::Y, offset: 1.0 };
    for (d, zero) in [(Vec3::X, 0.0), (Vec3::Z, -0.0)] {
        let d = vec3(d.x, zero, d.z);
        for (y, inside) in [(2.0, false), (1.0, true), (0.0, true), (-5.0, true), (1f32.next_up(), false)] {
            for (name, found) in spans(&Case { shape: floor, o: vec3(3.0, y, 4.0), d }) {
                assert_eq!(found, inside.then_some((-FAR, FAR)), "{name} parallel at {y}");
            }
        }
    }
    for (y, d, span) in [
        (3.0, Vec3::NEG_Y, (2.0, FAR)),
        (3.0, Vec3::Y, (-FAR, -2.0)),
        (-1.0, Vec3::Y, (-FAR, 2.0)),
        (1.0, Vec3::Y, (-FAR, 0.0)),
        (1.0, Vec3::NEG_Y, (0.0, FAR)),
    ] {
        for (name, found) in spans(&Case { shape: floor, o: vec3(0.0, y, 0.0), d }) {
            assert_eq!(found, Some(span), "{name} from {y} along {d}");
        }
    }
}

#[test]
fn blocks_are_met_where_they_are() {
    let mut worst = Worst::default();
    let mut random = Random(5);
    for _ in 0..8_000 {
        let half = vec3(random.log(1e-2, 1e2) as f32, random.log(1e-2, 1e2) as f32, random.log(1e-2, 1e2) as f32);
        let turn = if random.unit() < 0.3 { Mat3::IDENTITY } else { random.turn() };
        let center = random.direction() * random.log(1e-3, 1e2) as f32;
        let inside = |random: &mut Random, k: f64| {
            let mut side = || random.range(-k, k) as f32;
            center + turn.transpose() * (half * vec3(side(), side(), side()))
        };
        let o = if random.unit() < 0.2 {
            inside(&mut random, 1.0)
        } else {
            center + random.direction() * random.log(1e-1, 1e4) as f32
        };
        // Half of them at edges and corners.
        let mut aim = inside(&mut random, 1.3);
        if random.unit() < 0.5 {
            let mut pick = || [-1.0, 1.0, 1.0, random.range(-1.0, 1.0) as f32][(random.unit() * 4.0) as usize];
            aim = center + turn.transpose() * (half * vec3(pick(), pick(), pick()));
        }
        worst.check(&Case { shape: Shape::Block { center, half, turn }, o, d: toward(o, aim) }, TURNED);
    }
    println!("blocks: {worst:?}");
    assert!(worst.hits > 2_000 && worst.misses > 500);
}

#[test]
fn blocks_and_zeros() {
    // 0 * inf: directions along the faces, and origins on them.
    let block = Shape::Block { center: Vec3::ZERO, half: vec3(1.0, 2.0, 3.0), turn: Mat3::IDENTITY };
    for zero in [0.0, -0.0] {
        let along = [vec3(1.0, zero, zero), vec3(zero, 1.0, zero), vec3(zero, zero, 1.0)];
        for axis in 0..3 {
            let half = [1.0, 2.0, 3.0][axis];
            for (other, side) in [(1, 2.0), (0, 1.0), (2, 3.0)].into_iter().filter(|(other, _)| *other != axis) {
                for at in [0.0f32, -0.0, 0.5, 1.0, -1.0] {
                    // From inside, from the face it leaves by, from the face it enters by, from far.
                    for start in [0.0, half, -half, -1000.0, 1000.0] {
                        let mut o = Vec3::ZERO;
                        o[axis] = start;
                        o[other] = at * side;
                        for (name, found) in spans(&Case { shape: block, o, d: along[axis] }) {
                            let truth = (-half - start, half - start);
                            if at.abs() < 1.0 {
                                assert_eq!(found, Some(truth), "{name} from {o} along {axis}");
                            } else if let Some((t0, t1)) = found {
                                // Within a face a line may be inside or not, and may leave it where it starts.
                                let right = |t: f32, truth: f32| t == truth || t == 0.0;
                                assert!(right(t0, truth.0) && right(t1, truth.1), "{name} from {o} along {axis}");
                            }
                        }
                    }
                    let mut o = Vec3::ZERO;
                    o[other] = side.next_up() * 1.000001;
                    for (name, found) in spans(&Case { shape: block, o, d: along[axis] }) {
                        assert_eq!(found, None, "{name} finds from {o} along {axis}");
                    }
                }
            }
        }
    }
    // On two faces at once: an edge met from outside along the diagonal, and left by it.
    let s = std::f32::consts::FRAC_1_SQRT_2;
    let edge = Case { shape: block, o: vec3(1.0, 2.0, 0.0), d: vec3(-s, -s, 0.0) };
    for (name, found) in spans(&edge) {
        let (t0, t1) = found.unwrap_or_else(|| panic!("{name}"));
        assert!(t0 == 0.0 && (t1 as f64 - 2f64.sqrt() * 2f64.min(1.0 + 1.0)).abs() < 1e-6, "{name}: {t0} {t1}");
    }
}

#[test]
fn cylinders_are_met_where_they_are() {
    let mut worst = Worst::default();
    let mut random = Random(6);
    for _ in 0..8_000 {
        let axis = if random.unit() < 0.3 { Vec3::Y } else { random.direction() };
        let (half, radius) = (random.log(1e-2, 1e2) as f32, random.log(1e-2, 1e2) as f32);
        let center = random.direction() * random.log(1e-3, 1e2) as f32;
        let size = half.hypot(radius);
        let spot = |random: &mut Random, k: f64| {
            let round = random.across(axis) * (radius as f64 * random.range(0.0, k)) as f32;
            center + axis * (half as f64 * random.range(-k, k)) as f32 + round
        };
        let o = match (random.unit() * 4.0) as u32 {
            0 => spot(&mut random, 1.0),
            _ => center + random.direction() * size * random.log(0.1, 1e3) as f32,
        };
        let d = match (random.unit() * 8.0) as u32 {
            0 => axis,
            1 => (axis + random.across(axis) * random.log(1e-6, 1e-2) as f32).normalize(),
            2 => random.across(axis),
            3 => random.direction(),
            _ => toward(o, spot(&mut random, 1.3)),
        };
        worst.check(&Case { shape: Shape::Cylinder { center, axis, half, radius }, o, d }, TURNED);
    }
    println!("cylinders: {worst:?}");
    assert!(worst.hits > 2_000 && worst.misses > 500);
    let upright = Shape::Cylinder { center: Vec3::ZERO, axis: Vec3::Y, half: 2.0, radius: 1.0 };
    for (o, d, span) in [
        // Along the axis: in the middle, off it, on the rim's inside; across; from inside; behind.
        (vec3(0.0, 5.0, 0.0), Vec3::NEG_Y, Some((3.0, 7.0))),
        (vec3(0.5, 5.0, 0.5), Vec3::NEG_Y, Some((3.0, 7.0))),
        (vec3(0.999, 5.0, 0.0), Vec3::NEG_Y, Some((3.0, 7.0))),
        (vec3(1.001, 5.0, 0.0), Vec3::NEG_Y, None),
        (vec3(-5.0, 0.0, 0.0), Vec3::X, Some((4.0, 6.0))),
        (vec3(-5.0, 1.999, 0.0), Vec3::X, Some((4.0, 6.0))),
        (vec3(-5.0, 2.001, 0.0), Vec3::X, None),
        (vec3(-5.0, 0.0, 1.001), Vec3::X, None),
        (vec3(0.0, 0.0, 0.0), Vec3::X, Some((-1.0, 1.0))),
        (vec3(0.0, 0.0, 0.0), Vec3::Y, Some((-2.0, 2.0))),
        (vec3(5.0, 0.0, 0.0), Vec3::X, Some((-6.0, -4.0))),
        (vec3(0.0, 2.0, 0.0), Vec3::Y, Some((-4.0, 0.0))),
    ] {
        for (name, found) in spans(&Case { shape: upright, o, d }) {
            assert_eq!(found, span, "{name} from {o} along {d}");
        }
    }
}

/// One body of each kind at a scale, its surface some way from the origin.
fn bodies(random: &mut Random, scale: f32) -> Vec<Shape> {
    let center = random.direction() * scale * random.range(0.0, 3.0) as f32;
    let half = vec3(1.0, 0.4, 1.7) * scale;
    vec![
        Shape::Sphere { center, radius: scale },
        Shape::Block { center, half, turn: random.turn() },
        Shape::Cylinder { center, axis: random.direction(), half: 1.3 * scale, radius: 0.6 * scale },
        Shape::Plane { normal: random.direction(), offset: 0.3 * scale },
        Shape::Globe { touch: center, normal: random.direction(), radius: 1e6 * scale },
    ]
}

#[test]
fn rough_spans_are_as_good_as_they_say() {
    let mut random = Random(7);
    let mut worst = 0.0f64;
    for _ in 0..10_000 {
        let radius = random.log(1e-3, 1e3) as f32;
        let shape = Shape::Sphere { center: Vec3::ZERO, radius };
        let o = random.direction() * (radius as f64 * random.log(0.1, 1e4)) as f32;
        let d = toward(o, random.direction() * radius * random.unit() as f32);
        let case = Case { shape, o, d };
        let slack = ROUGH * ULP * (o.length() + radius) as f64;
        let Some(inner) = exact_span(&shape, o, d, -slack) else { continue };
        let outer = exact_span(&shape, o, d, slack).unwrap();
        for (name, level) in testkit::levels() {
            let (t0, t1) = wide_at(level, &case, true).unwrap_or_else(|| panic!("{name}: {case:?}"));
            let within = |t: f32, a: f64, b: f64| (a.min(b) - slack..=a.max(b) + slack).contains(&(t as f64));
            assert!(within(t0, outer[0].t, inner[0].t) && within(t1, outer[1].t, inner[1].t), "{name}: {case:?}");
            let exact = exact_span(&shape, o, d, 0.0).unwrap();
            worst = worst.max((t0 as f64 - exact[0].t).abs() * exact[0].slope / (o.length() + radius) as f64 / ULP);
        }
    }
    println!("rough spans: {worst} roundings of the distance");
}

#[test]
fn segments_are_blocked_by_what_lies_between() {
    let mut random = Random(8);
    let mut counts = [0; 3];
    for round in 0..10_000 {
        let scale = random.log(1e-3, 1e4) as f32;
        let shape = bodies(&mut random, scale)[round % 5];
        let (center, _) = place(&shape);
        let o = center + random.direction() * scale * random.log(0.5, 20.0) as f32;
        let end = center + random.direction() * scale * random.log(0.5, 20.0) as f32;
        let (d, reach) = (toward(o, end), o.distance(end));
        let end = o + d * reach;
        let slack = ROUGH * ULP * (o.distance(center) + reach + 2.0 * scale) as f64;
        // Both ends lie outside of it: there the shortest line through the grown body starts or ends beyond them.
        let inside = |p: Vec3| {
            let through = exact_span(&shape, p, d, 4.0 * slack);
            through.is_some_and(|s| s[0].t <= 0.0 && s[1].t >= 0.0)
        };
        if inside(o) || inside(end) {
            continue;
        }
        let meets = |grow: f64| exact_span(&shape, o, d, grow).is_some_and(|s| s[1].t > 0.0 && s[0].t < reach as f64);
        let (surely, possibly) = (meets(-slack), meets(slack));
        counts[if surely { 0 } else { 1 + possibly as usize }] += 1;
        for (name, level) in testkit::levels() {
            let found = dispatch!(level, simd => wide_blocks(simd, &Case { shape, o, d }, reach));
            assert!(found || !surely, "{name}: {shape:?} does not block {o} to {end}");
            assert!(!found || possibly, "{name}: {shape:?} blocks {o} to {end}");
        }
    }
    println!("segments: blocked, free, open {counts:?}");
    assert!(counts[0] > 500 && counts[1] > 500);
}

/// The unit normal in f64 by the surface's gradient.
fn exact_normal(shape: &Shape, p: Vec3) -> glam::DVec3 {
    let p = p.as_dvec3();
    match *shape {
        Shape::Sphere { center, .. } => (p - center.as_dvec3()).normalize(),
        Shape::Plane { normal, .. } => normal.as_dvec3().normalize(),
        Shape::Globe { touch, normal, radius } => {
            (p - (touch.as_dvec3() - normal.as_dvec3() * radius as f64)).normalize()
        }
        Shape::Block { center, half, turn } => {
            let q = turn.as_dmat3() * (p - center.as_dvec3());
            // The face that is nearest, by distance.
            let gap = half.as_dvec3() - q.abs();
            let axis = gap.min_position();
            (turn.as_dmat3().transpose().col(axis) * q[axis].signum()).normalize()
        }
        Shape::Cylinder { center, axis, half, radius } => {
            let (q, axis) = (p - center.as_dvec3(), axis.as_dvec3().normalize());
            let h = q.dot(axis);
            let round = q - axis * h;
            let cap = (half as f64 - h.abs()).abs() < (radius as f64 - round.length()).abs();
            if cap { axis * h.signum() } else { round.normalize() }
        }
    }
}

#[test]
fn normals_are_unit_outward_and_right() {
    let mut random = Random(9);
    let mut worst = [0f64; 5];
    for round in 0..10_000 {
        let scale = random.log(1e-3, 1e6) as f32;
        let kind = round % 5;
        let shape = bodies(&mut random, scale)[kind];
        let (center, _) = place(&shape);
        let aim = center + random.direction() * scale * 0.9 * random.unit() as f32;
        let o = center + random.direction() * scale * random.log(2.0, 1e4) as f32;
        let d = toward(o, aim);
        let Some((t0, t1)) = reference::span(&shape, o, d) else { continue };
        for (t, enters) in [(t0, true), (t1, false)] {
            // The far side of a globe is of no use; a plane has none.
            if matches!(shape, Shape::Globe { .. } | Shape::Plane { .. }) && t.abs() > 1e5 * scale {
                continue;
            }
            let p = o + d * t;
            let truth = exact_normal(&shape, p);
            // A rounding of the position turns the normal by its share of the radius; near an edge it picks the face.
            let position = ULP * (o.length() + p.length() + center.length() + 4.0 * scale) as f64 / scale as f64;
            let edge = exact_span(&shape, o, d, -1e-5 * scale as f64)
                .is_none_or(|s| (s[!enters as usize].t - t as f64).abs() > 1e-3 * scale as f64);
            if edge {
                continue;
            }
            let mut all = vec![("scalar", shape.normal_at(p))];
            for (name, level) in testkit::levels() {
                all.push((name, dispatch!(level, simd => wide_normal(simd, &shape, p))));
            }
            for (name, normal) in all {
                let n = normal.as_dvec3();
                let error = (n - truth).length().max((n.length() - 1.0).abs()) / (position + 2.0 * ULP);
                assert!(error < ROUGH, "{name}: {normal} for {truth}, {error} roundings: {shape:?} at {p}");
                worst[kind] = worst[kind].max(error);
                assert!((n.dot(d.as_dvec3()) < 0.0) == enters, "{name}: {shape:?} at {p} along {d}");
            }
        }
    }
    println!("normals, roundings of the position: {worst:?}");
}

/// One body alone under a sky of light 1.
fn alone(shape: Shape, material: Material, max_level: u32) -> World {
    World { background: Background::even(Vec3::ONE), max_level, ..World::new(vec![Object::new(shape, material)]) }
}

/// Rays that meet one of `bodies` from outside, at all scales and up to grazing.
fn arrivals(seed: u64, mut each: impl FnMut(Shape, Vec3, Vec3)) {
    let mut random = Random(seed);
    for round in 0..40_000 {
        let scale = random.log(1e-3, 1e6) as f32;
        let shape = bodies(&mut random, scale)[round % 5];
        let (center, _) = place(&shape);
        let o = center + random.direction() * scale * random.log(3.0, 30.0) as f32;
        let d = toward(o, center + random.direction() * scale * random.range(0.0, 1.2) as f32);
        if reference::span(&shape, o, d).is_some_and(|(t0, _)| t0 > 0.0 && t0 < 100.0 * scale) {
            each(shape, o, d);
        }
    }
}

#[test]
fn reflected_rays_never_meet_their_own_body() {
    // A perfect mirror under an even sky: the mirrored ray brings 1, and black if it met the mirror a second time.
    let mirror = Material::mirror(Vec3::ONE);
    let mut count = 0;
    arrivals(10, |shape, o, d| {
        let light = reference::radiance(&alone(shape, mirror, 2), Ray::new(o, d), 1);
        assert_eq!(light, Vec3::ONE, "{shape:?} from {o} along {d}");
        count += 1;
    });
    println!("reflected: {count} rays, 0 self-hits");
    assert!(count > 10_000);
}

#[test]
fn refracted_rays_meet_the_far_side_of_their_own_body() {
    // Every crossing leaves half; nothing is reflected at equal indices; a plane and a globe are left by neither. A ray
    // that missed the far side would bring 1/2, one that met the near side again 1/8 or black.
    let clear = Material::glass(1.0, Vec3::splat(0.5));
    let (mut count, mut grazing) = (0, 0);
    arrivals(11, |shape, o, d| {
        if matches!(shape, Shape::Plane { .. } | Shape::Globe { .. }) {
            return;
        }
        // Where the way through is shorter than the rounding of its start there is no far side to be met.
        let (t0, t1) = reference::span(&shape, o, d).unwrap();
        let (center, size) = place(&shape);
        let lengths = o.as_dvec3().distance(center.as_dvec3()) + size + o.length() as f64;
        let slack = ROUGH * ULP * lengths;
        if exact_span(&shape, o, d, -slack).is_none() || ((t1 - t0) as f64) < slack {
            grazing += 1;
            return;
        }
        let light = reference::radiance(&alone(shape, clear, 3), Ray::new(o, d), 1);
        assert!((light - Vec3::splat(0.25)).abs().max_element() < 1e-6, "{light}: {shape:?} from {o} along {d}");
        count += 1;
    });
    println!("refracted: {count} rays, 0 self-hits, {grazing} too short");
    assert!(count > 8_000 && grazing < count / 100);
}

/// Numbers of every size and both signs, and those that break things.
fn anything() -> impl Strategy<Value = f32> {
    let sized = (-8f32..8.0, any::<bool>()).prop_map(|(e, negative)| 10f32.powf(e) * if negative { -1.0 } else { 1.0 });
    let special = prop::sample::select(vec![
        0.0,
        -0.0,
        1e-45,
        -1e-45,
        f32::MIN_POSITIVE,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ]);
    prop_oneof![4 => sized, 1 => special]
}

fn any_vector() -> impl Strategy<Value = Vec3> {
    (anything(), anything(), anything()).prop_map(|(x, y, z)| vec3(x, y, z))
}

fn any_shape() -> impl Strategy<Value = Shape> {
    (0..5, any_vector(), any_vector(), anything(), anything()).prop_map(|(kind, a, b, x, y)| match kind {
        0 => Shape::Sphere { center: a, radius: x },
        1 => Shape::Plane { normal: b, offset: x },
        2 => Shape::Globe { touch: a, normal: b, radius: x },
        3 => Shape::Block { center: a, half: b, turn: Mat3::from_rotation_y(x) },
        _ => Shape::Cylinder { center: a, axis: b, half: x, radius: y },
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_breaks_on_nonsense(shape in any_shape(), o in any_vector(), d in any_vector(), reach in anything()) {
        for d in [d, d.normalize_or(Vec3::X)] {
            let case = Case { shape, o, d };
            for (_, found) in spans(&case) {
                if let Some((t0, t1)) = found {
                    prop_assert!(t0 <= t1);
                }
            }
            for (_, level) in testkit::levels() {
                wide_at(level, &case, true);
                dispatch!(level, simd => wide_blocks(simd, &case, reach));
                dispatch!(level, simd => wide_normal(simd, &shape, o));
            }
            shape.normal_at(o);
            let glass = Material::glass(1.5, Vec3::ONE);
            reference::radiance(&alone(shape, glass, 6), Ray::new(o, d), 1);
        }
    }

    #[test]
    fn levels_give_the_same_bits(seed in any::<u64>()) {
        let mut random = Random(seed);
        let scale = random.log(1e-8, 1e8) as f32;
        for shape in bodies(&mut random, scale) {
            let o = random.direction() * random.log(1e-8, 1e8) as f32;
            let case = Case { shape, o, d: random.direction() };
            let bits = |span: Option<(f32, f32)>| span.map(|(a, b)| (a.to_bits(), b.to_bits()));
            let all: Vec<_> = testkit::levels()
                .into_iter()
                .map(|(_, level)| {
                    let normal = dispatch!(level, simd => wide_normal(simd, &shape, o));
                    let precise = dispatch!(level, simd => wide(simd, &case, false));
                    let rough = dispatch!(level, simd => wide(simd, &case, true));
                    (bits(precise), bits(rough), normal.to_array().map(f32::to_bits))
                })
                .collect();
            prop_assert!(all.windows(2).all(|w| w[0] == w[1]), "{case:?}: {all:?}");
        }
    }
}
