//! Every shape against crossings without rounding: where lines enter and leave, what they do not meet, normals,
//! shadows, and that no ray meets again what it leaves. The bodies of most are `testkit::bodies`, errors are as
//! `testkit::lines` says.

use fearless_simd::dispatch;
use glam::{Mat3A, Vec3A, vec3a};
use paprsek::trace::Material;
use paprsek::trace::reference::{self, Ray};
use paprsek::trace::shape::{FAR, Shape};
use proptest::prelude::*;
use testkit::bodies::{
    balls, blocks, cylinders, far_balls, globes, planes, reflected, refracted, segments, sides, tangents,
};
use testkit::lines::{
    BALL, Case, ROUGH, TURNED, alone, bodies, place, spans, toward, wide, wide_at, wide_blocks, wide_normal,
};
use testkit::span::span as exact_span;
use testkit::{ULP, levels, random::Random};

#[test]
fn balls_are_met_where_they_are() {
    let worst = balls(60_000);
    worst.found.within(BALL);
    assert!(worst.hits > 20_000 && worst.misses > 5_000);
}

#[test]
fn balls_far_away_are_not_lost() {
    let worst = far_balls();
    worst.found.within(BALL);
    assert!(worst.hits > 400);
}

#[test]
fn tangents_fall_on_the_right_side() {
    sides().within(0.0);
    tangents(5_000).found.within(BALL);
}

#[test]
fn globes_are_met_where_they_are() {
    let worst = globes(10_000);
    worst.found.within(BALL);
    assert!(worst.hits > 4_000 && worst.misses > 1_000);
}

#[test]
fn planes_are_met_where_they_are() {
    planes(10_000).found.within(BALL);
    let floor = Shape::Plane { normal: Vec3A::Y, offset: 1.0 };
    for (d, zero) in [(Vec3A::X, 0.0), (Vec3A::Z, -0.0)] {
        let d = vec3a(d.x, zero, d.z);
        for (y, inside) in [(2.0, false), (1.0, true), (0.0, true), (-5.0, true), (1f32.next_up(), false)] {
            for (name, found) in spans(&Case { shape: floor, o: vec3a(3.0, y, 4.0), d }) {
                assert_eq!(found, inside.then_some((-FAR, FAR)), "{name} parallel at {y}");
            }
        }
    }
    for (y, d, span) in [
        (3.0, Vec3A::NEG_Y, (2.0, FAR)),
        (3.0, Vec3A::Y, (-FAR, -2.0)),
        (-1.0, Vec3A::Y, (-FAR, 2.0)),
        (1.0, Vec3A::Y, (-FAR, 0.0)),
        (1.0, Vec3A::NEG_Y, (0.0, FAR)),
    ] {
        for (name, found) in spans(&Case { shape: floor, o: vec3a(0.0, y, 0.0), d }) {
            assert_eq!(found, Some(span), "{name} from {y} along {d}");
        }
    }
}

#[test]
fn blocks_are_met_where_they_are() {
    let worst = blocks(8_000);
    worst.found.within(TURNED);
    assert!(worst.hits > 2_000 && worst.misses > 500);
}

#[test]
fn blocks_and_zeros() {
    // 0 * inf: directions along the faces, and origins on them.
    let block = Shape::Block { center: Vec3A::ZERO, half: vec3a(1.0, 2.0, 3.0), turn: Mat3A::IDENTITY };
    for zero in [0.0, -0.0] {
        let along = [vec3a(1.0, zero, zero), vec3a(zero, 1.0, zero), vec3a(zero, zero, 1.0)];
        for axis in 0..3 {
            let half = [1.0, 2.0, 3.0][axis];
            for (other, side) in [(1, 2.0), (0, 1.0), (2, 3.0)].into_iter().filter(|(other, _)| *other != axis) {
                for at in [0.0f32, -0.0, 0.5, 1.0, -1.0] {
                    // From inside, from the face it leaves by, from the face it enters by, from far.
                    for start in [0.0, half, -half, -1000.0, 1000.0] {
                        let mut o = Vec3A::ZERO;
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
                    let mut o = Vec3A::ZERO;
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
    let edge = Case { shape: block, o: vec3a(1.0, 2.0, 0.0), d: vec3a(-s, -s, 0.0) };
    for (name, found) in spans(&edge) {
        let (t0, t1) = found.unwrap_or_else(|| panic!("{name}"));
        assert!(t0 == 0.0 && (t1 as f64 - 2f64.sqrt() * 2f64.min(1.0 + 1.0)).abs() < 1e-6, "{name}: {t0} {t1}");
    }
}

#[test]
fn cylinders_are_met_where_they_are() {
    let worst = cylinders(8_000);
    worst.found.within(TURNED);
    assert!(worst.hits > 2_000 && worst.misses > 500);
    let upright = Shape::Cylinder { center: Vec3A::ZERO, axis: Vec3A::Y, half: 2.0, radius: 1.0 };
    for (o, d, span) in [
        // Along the axis: in the middle, off it, on the rim's inside; across; from inside; behind.
        (vec3a(0.0, 5.0, 0.0), Vec3A::NEG_Y, Some((3.0, 7.0))),
        (vec3a(0.5, 5.0, 0.5), Vec3A::NEG_Y, Some((3.0, 7.0))),
        (vec3a(0.999, 5.0, 0.0), Vec3A::NEG_Y, Some((3.0, 7.0))),
        (vec3a(1.001, 5.0, 0.0), Vec3A::NEG_Y, None),
        (vec3a(-5.0, 0.0, 0.0), Vec3A::X, Some((4.0, 6.0))),
        (vec3a(-5.0, 1.999, 0.0), Vec3A::X, Some((4.0, 6.0))),
        (vec3a(-5.0, 2.001, 0.0), Vec3A::X, None),
        (vec3a(-5.0, 0.0, 1.001), Vec3A::X, None),
        (vec3a(0.0, 0.0, 0.0), Vec3A::X, Some((-1.0, 1.0))),
        (vec3a(0.0, 0.0, 0.0), Vec3A::Y, Some((-2.0, 2.0))),
        (vec3a(5.0, 0.0, 0.0), Vec3A::X, Some((-6.0, -4.0))),
        (vec3a(0.0, 2.0, 0.0), Vec3A::Y, Some((-4.0, 0.0))),
    ] {
        for (name, found) in spans(&Case { shape: upright, o, d }) {
            assert_eq!(found, span, "{name} from {o} along {d}");
        }
    }
}

#[test]
fn rough_spans_are_as_good_as_they_say() {
    let mut random = Random(7);
    let mut worst = 0.0f64;
    for _ in 0..10_000 {
        let radius = random.log(1e-3, 1e3) as f32;
        let shape = Shape::Sphere { center: Vec3A::ZERO, radius };
        let o = random.direction() * (radius as f64 * random.log(0.1, 1e4)) as f32;
        let d = toward(o, random.direction() * radius * random.unit() as f32);
        let case = Case { shape, o, d };
        let slack = ROUGH * ULP * (o.length() + radius) as f64;
        let Some(inner) = exact_span(&shape, o, d, -slack) else { continue };
        let outer = exact_span(&shape, o, d, slack).unwrap();
        for (name, level) in levels() {
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
    let (found, [blocked, free]) = segments(10_000);
    found.within(0.0);
    assert!(blocked > 500 && free > 500);
}

/// The unit normal in f64 by the surface's gradient.
fn exact_normal(shape: &Shape, p: Vec3A) -> glam::DVec3 {
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
            for (name, level) in levels() {
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

#[test]
fn reflected_rays_never_meet_their_own_body() {
    let found = reflected(40_000);
    found.within(0.0);
    assert!(found.inputs > 10_000);
}

#[test]
fn refracted_rays_meet_the_far_side_of_their_own_body() {
    let (found, grazing) = refracted(40_000);
    found.within(0.0);
    assert!(found.inputs > 8_000 && grazing < found.inputs / 100);
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

fn any_vector() -> impl Strategy<Value = Vec3A> {
    (anything(), anything(), anything()).prop_map(|(x, y, z)| vec3a(x, y, z))
}

fn any_shape() -> impl Strategy<Value = Shape> {
    (0..5, any_vector(), any_vector(), anything(), anything()).prop_map(|(kind, a, b, x, y)| match kind {
        0 => Shape::Sphere { center: a, radius: x },
        1 => Shape::Plane { normal: b, offset: x },
        2 => Shape::Globe { touch: a, normal: b, radius: x },
        3 => Shape::Block { center: a, half: b, turn: Mat3A::from_rotation_y(x) },
        _ => Shape::Cylinder { center: a, axis: b, half: x, radius: y },
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nothing_breaks_on_nonsense(shape in any_shape(), o in any_vector(), d in any_vector(), reach in anything()) {
        for d in [d, d.normalize_or(Vec3A::X)] {
            let case = Case { shape, o, d };
            for (_, found) in spans(&case) {
                if let Some((t0, t1)) = found {
                    prop_assert!(t0 <= t1);
                }
            }
            for (_, level) in levels() {
                wide_at(level, &case, true);
                dispatch!(level, simd => wide_blocks(simd, &case, reach));
                dispatch!(level, simd => wide_normal(simd, &shape, o));
            }
            shape.normal_at(o);
            let glass = Material::glass(1.5, Vec3A::ONE);
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
            let all: Vec<_> = levels()
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
