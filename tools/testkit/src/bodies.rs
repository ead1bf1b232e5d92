//! Random lines and bodies of all sizes, each kind where its arithmetic is hard: what [`super::lines`] is asked.

use super::found::Found;
use super::lines::{BALL, Case, ROUGH, TURNED, Worst, alone, bodies, place, spans, toward, wide_blocks};
use super::span::span as exact_span;
use super::{ULP, random::Random};
use fearless_simd::dispatch;
use glam::{Mat3A, Vec3A, vec3a};
use paprsek::trace::reference::{self, Ray};
use paprsek::trace::{Material, Shape};

/// Far, near, inside and on the surface; all sizes; straight at it, past it and anywhere between.
pub fn balls(count: u32) -> Worst {
    let mut worst = Worst::default();
    let mut random = Random(1);
    for _ in 0..count {
        let radius = random.log(1e-6, 1e6) as f32;
        let distance = radius as f64 * random.log(1e-3, 1e6);
        let o = random.direction() * distance as f32;
        let center = if random.unit() < 0.5 { Vec3A::ZERO } else { random.direction() * random.log(1e-6, 1e6) as f32 };
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
    worst
}

/// The naive discriminant misses from 1e4 radii on. Rays to f32's own precision: exactly representable offsets.
pub fn far_balls() -> Worst {
    let mut worst = Worst::default();
    for distance in [1e4f32, 3e4, 1e5, 3e5, 1e6] {
        for k in 0..=200 {
            let shape = Shape::Sphere { center: vec3a(0.0, 0.0, -distance), radius: 1.0 };
            let o = vec3a(k as f32 / 128.0, 0.0, 0.0);
            worst.check(&Case { shape, o, d: Vec3A::NEG_Z }, BALL);
        }
    }
    worst
}

/// Lines that pass a ball at `r (1 +- 1e-6)`, 16 roundings inside and outside, and how often one falls on the wrong side.
/// Along an axis the distance to the line is the offset itself.
pub fn sides() -> Found {
    let mut found = Found::default();
    for radius in [1e-6f32, 1e-3, 0.55, 1.0, 7.3, 1e3, 1e6] {
        for axis in 0..3 {
            let (d, side) = (Vec3A::AXES[axis], Vec3A::AXES[(axis + 1) % 3]);
            for distance in [-3.0, -1.0, 0.0, 1.0, 3.0] {
                for (factor, meets) in [(1.0 - 1e-6, true), (1.0 + 1e-6, false)] {
                    let o = d * (-distance * radius) + side * (radius as f64 * factor) as f32;
                    for (name, span) in spans(&Case { shape: Shape::Sphere { center: Vec3A::ZERO, radius }, o, d }) {
                        found.judge(span.is_some() == meets, || format!("{name}: {radius} {axis} {distance} {factor}"));
                    }
                }
            }
        }
    }
    found
}

/// Lines in all directions that pass a ball within a hundred thousandth of its radius.
pub fn tangents(count: u32) -> Worst {
    let mut worst = Worst::default();
    let mut random = Random(2);
    for _ in 0..count {
        let d = random.direction();
        let o = d * -random.log(0.1, 100.0) as f32 + random.across(d) * random.range(1.0 - 1e-5, 1.0 + 1e-5) as f32;
        worst.check(&Case { shape: Shape::Sphere { center: Vec3A::ZERO, radius: 1.0 }, o, d }, BALL);
    }
    worst
}

/// Balls of 1e5 to 1e9 metres, seen from a millimetre to a kilometre above the ground, and sometimes below it or on it.
pub fn globes(count: u32) -> Worst {
    let mut worst = Worst::default();
    let mut random = Random(3);
    for _ in 0..count {
        let radius = random.log(1e5, 1e9) as f32;
        let normal = if random.unit() < 0.5 { Vec3A::Y } else { random.direction() };
        let touch = if random.unit() < 0.5 { Vec3A::ZERO } else { random.direction() * 100.0 };
        let height = random.log(1e-3, 1e3) as f32 * [1.0, 1.0, 1.0, -1.0, 0.0][(random.unit() * 5.0) as usize];
        let o = touch + normal * height + random.across(normal) * random.log(1e-3, 1e3) as f32;
        let d = if random.unit() < 0.3 {
            (random.across(normal) + normal * random.range(-1e-3, 1e-3) as f32).normalize()
        } else {
            random.direction()
        };
        worst.check(&Case { shape: Shape::Globe { touch, normal, radius }, o, d }, BALL);
    }
    worst
}

/// Planes from all sides.
pub fn planes(count: u32) -> Worst {
    let mut worst = Worst::default();
    let mut random = Random(4);
    for _ in 0..count {
        let normal = if random.unit() < 0.5 { Vec3A::Y } else { random.direction() };
        let shape = Shape::Plane { normal, offset: random.log(1e-3, 1e3) as f32 };
        let o = random.direction() * random.log(1e-3, 1e4) as f32;
        worst.check(&Case { shape, o, d: random.direction() }, BALL);
    }
    worst
}

/// Turned boxes from inside, near and far, half of the lines at edges and corners.
pub fn blocks(count: u32) -> Worst {
    let mut worst = Worst::default();
    let mut random = Random(5);
    for _ in 0..count {
        let half = vec3a(random.log(1e-2, 1e2) as f32, random.log(1e-2, 1e2) as f32, random.log(1e-2, 1e2) as f32);
        let turn = if random.unit() < 0.3 { Mat3A::IDENTITY } else { random.turn() };
        let center = random.direction() * random.log(1e-3, 1e2) as f32;
        let inside = |random: &mut Random, k: f64| {
            let mut side = || random.range(-k, k) as f32;
            center + turn.transpose() * (half * vec3a(side(), side(), side()))
        };
        let o = if random.unit() < 0.2 {
            inside(&mut random, 1.0)
        } else {
            center + random.direction() * random.log(1e-1, 1e4) as f32
        };
        let mut aim = inside(&mut random, 1.3);
        if random.unit() < 0.5 {
            let mut pick = || [-1.0, 1.0, 1.0, random.range(-1.0, 1.0) as f32][(random.unit() * 4.0) as usize];
            aim = center + turn.transpose() * (half * vec3a(pick(), pick(), pick()));
        }
        worst.check(&Case { shape: Shape::Block { center, half, turn }, o, d: toward(o, aim) }, TURNED);
    }
    worst
}

/// Capped cylinders from inside, near and far; along the axis, almost along it, across it, and at their edges.
pub fn cylinders(count: u32) -> Worst {
    let mut worst = Worst::default();
    let mut random = Random(6);
    for _ in 0..count {
        let axis = if random.unit() < 0.3 { Vec3A::Y } else { random.direction() };
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
    worst
}

/// Segments between points outside of a body, which a shadow ray must find blocked or free; and how many surely are.
pub fn segments(count: usize) -> (Found, [u32; 2]) {
    let mut random = Random(8);
    let (mut all, mut counts) = (Found::default(), [0; 2]);
    for round in 0..count {
        let scale = random.log(1e-3, 1e4) as f32;
        let shape = bodies(&mut random, scale)[round % 5];
        let (center, _) = place(&shape);
        let o = center + random.direction() * scale * random.log(0.5, 20.0) as f32;
        let end = center + random.direction() * scale * random.log(0.5, 20.0) as f32;
        let (d, reach) = (toward(o, end), o.distance(end));
        let end = o + d * reach;
        let slack = ROUGH * ULP * (o.distance(center) + reach + 2.0 * scale) as f64;
        // Both ends lie outside of it: there the shortest line through the grown body starts or ends beyond them.
        let inside = |p: Vec3A| {
            let through = exact_span(&shape, p, d, 4.0 * slack);
            through.is_some_and(|s| s[0].t <= 0.0 && s[1].t >= 0.0)
        };
        if inside(o) || inside(end) {
            continue;
        }
        let meets = |grow: f64| exact_span(&shape, o, d, grow).is_some_and(|s| s[1].t > 0.0 && s[0].t < reach as f64);
        let (surely, possibly) = (meets(-slack), meets(slack));
        counts[0] += surely as u32;
        counts[1] += !possibly as u32;
        for (name, level) in super::levels() {
            let blocked = dispatch!(level, simd => wide_blocks(simd, &Case { shape, o, d }, reach));
            all.judge(blocked == surely || blocked == possibly, || {
                format!("{name}: {shape:?}, {o} to {end}: {blocked}")
            });
        }
    }
    (all, counts)
}

/// Rays that meet a body from outside, at all scales and up to grazing.
pub fn arrivals(seed: u64, count: usize, mut each: impl FnMut(Shape, Vec3A, Vec3A)) {
    let mut random = Random(seed);
    for round in 0..count {
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

/// Mirrored rays that meet the body which they leave. A perfect mirror under an even sky brings 1, and black where it is
/// met a second time.
pub fn reflected(count: usize) -> Found {
    let mut found = Found::default();
    let mirror = Material::mirror(Vec3A::ONE);
    arrivals(10, count, |shape, o, d| {
        let light = reference::radiance(&alone(shape, mirror, 2), Ray::new(o, d), 1);
        found.judge(light == Vec3A::ONE, || format!("{light}: {shape:?} from {o} along {d}"));
    });
    found
}

/// Refracted rays that do not meet the far side of the body which they enter, or meet the near side again; and how many
/// ways through were too short to be judged.
///
/// Every crossing leaves half; nothing is reflected at equal indices; a plane and a globe are left by neither. A ray that
/// missed the far side would bring 1/2, one that met the near side again 1/8 or black.
pub fn refracted(count: usize) -> (Found, u64) {
    let clear = Material::glass(1.0, Vec3A::splat(0.5));
    let (mut found, mut grazing) = (Found::default(), 0);
    arrivals(11, count, |shape, o, d| {
        if matches!(shape, Shape::Plane { .. } | Shape::Globe { .. }) {
            return;
        }
        // Where the way through is shorter than the rounding of its start there is no far side to be met.
        let Some((t0, t1)) = reference::span(&shape, o, d) else { return };
        let (center, size) = place(&shape);
        let lengths = o.as_dvec3().distance(center.as_dvec3()) + size + o.length() as f64;
        let slack = ROUGH * ULP * lengths;
        if exact_span(&shape, o, d, -slack).is_none() || ((t1 - t0) as f64) < slack {
            grazing += 1;
            return;
        }
        let light = reference::radiance(&alone(shape, clear, 3), Ray::new(o, d), 1);
        let right = (light - Vec3A::splat(0.25)).abs().max_element() < 1e-6;
        found.judge(right, || format!("{light}: {shape:?} from {o} along {d}"));
    });
    (found, grazing)
}
