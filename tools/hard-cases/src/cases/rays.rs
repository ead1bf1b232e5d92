//! Lines and convex bodies.

use crate::case::{Case, Effort, Runs};
use glam::{DVec3, Mat3A, Vec3A, vec3a};
use paprsek::trace::Material;
use paprsek::trace::reference::{self, Ray};
use paprsek::trace::shape::{FAR, Shape};
use paprsek::view::{Camera, View};
use testkit::bodies;
use testkit::lines::{self, alone, spans};
use testkit::random::Random;
use testkit::{Found, ULP};

const EXACT: &str = "integers of any length";

/// A case of the projected form and its like: roundings against exact integers.
const fn lines(name: &'static str, source: &'static str, target: f64, run: fn(&Effort) -> Found) -> Case {
    Case::new(Runs::All, name, source, EXACT, target, run).unit("roundings")
}

const fn failures(name: &'static str, source: &'static str, oracle: &'static str, run: fn(&Effort) -> Found) -> Case {
    Case::new(Runs::All, name, source, oracle, 0.0, run).unit("failures")
}

pub const CASES: &[Case] = &[
    lines(
        "balls of 1e-6 to 1e6 m from 1e-3 to 1e6 radii, inside, behind, off unit length by 1e-7",
        "[Haines19]",
        lines::BALL,
        |e| bodies::balls(e.of(400_000)).found,
    ),
    lines("balls at 1e4 to 1e6 radii", "[Haines19]", lines::BALL, |_| bodies::far_balls().found),
    lines("balls within 1e-5 of a tangent", "[Haines19]", lines::BALL, |e| bodies::tangents(e.of(60_000)).found),
    failures("lines past a ball at r (1 +- 1e-6)", "16 roundings on either side", EXACT, |_| bodies::sides()),
    lines(
        "globes of 1e5 to 1e9 m, the eye on the ground",
        "centre-based forms break from R = 1e5 on",
        lines::BALL,
        |e| bodies::globes(e.of(60_000)).found,
    ),
    lines("planes from all sides", "nearly parallel lines", lines::BALL, |e| bodies::planes(e.of(60_000)).found),
    lines("turned boxes at edges and corners, from inside and 1e4 away", "[Williams05]", lines::TURNED, |e| {
        bodies::blocks(e.of(40_000)).found
    }),
    failures(
        "boxes along their faces: 0, -0, origins on faces",
        "0 times infinity, [Williams05]",
        "closed form",
        zeros,
    ),
    lines(
        "cylinders along, almost along and across the axis",
        "a quadratic without a leading term",
        lines::TURNED,
        |e| bodies::cylinders(e.of(40_000)).found,
    ),
    failures("segments between points outside of a body", "shadow rays", EXACT, |e| {
        bodies::segments(e.of(60_000) as usize).0
    }),
    failures(
        "mirrored rays meet their own body",
        "[WaechterBinder19]: 3 to 36 % with a constant epsilon",
        "closed form",
        |e| bodies::reflected(e.of(200_000) as usize),
    ),
    failures("refracted rays miss the far side of their body", "[WaechterBinder19]", "closed form", |e| {
        bodies::refracted(e.of(200_000) as usize).0
    }),
    failures(
        "lines and bodies of any bits",
        "0, -0, denormals, MAX, infinities, NaN; 1e-8 to 1e8",
        "intervals in order, no panic",
        any_bits,
    ),
    Case::new(
        Runs::Scalar,
        "cameras with any target, up along the view, eye at the target",
        "degenerate look-at",
        "f64: axes unit, across, right-handed",
        1e-6,
        cameras,
    ),
    Case::new(
        Runs::Scalar,
        "points to pixels and back to rays, 1e-2 to 1e6 m away",
        "two ways that have to agree",
        "f64",
        2e-3,
        pixels,
    )
    .unit("pixels"),
];

/// Along the faces of a box, whose slabs divide by zeros of both signs.
fn zeros(_: &Effort) -> Found {
    let mut all = Found::default();
    let half = vec3a(1.0, 2.0, 3.0);
    let shape = Shape::Block { center: Vec3A::ZERO, half, turn: Mat3A::IDENTITY };
    for (zero, axis) in [(0.0, 0), (0.0, 1), (0.0, 2), (-0.0, 0), (-0.0, 1), (-0.0, 2)] {
        let mut d = Vec3A::splat(zero);
        d[axis] = 1.0;
        for other in (0..3).filter(|other| *other != axis) {
            for (at, start) in [0.0f32, -0.0, 0.5, 1.0, -1.0, 1.000_001, -1.000_001]
                .into_iter()
                .flat_map(|at| [0.0f32, 1.0, -1.0, -1000.0, 1000.0].map(|start| (at, start)))
            {
                let mut o = Vec3A::ZERO;
                o[axis] = if start.abs() > 1.0 { start } else { start * half[axis] };
                o[other] = at * half[other];
                let truth = (-half[axis] - o[axis], half[axis] - o[axis]);
                for (name, found) in spans(&lines::Case { shape, o, d }) {
                    let right = match (at.abs(), found) {
                        (at, Some(found)) if at < 1.0 => found == truth,
                        (at, None) => at >= 1.0,
                        // Within a face a line may be inside or not, and may leave it where it starts.
                        (1.0, Some((a, b))) => (a == truth.0 || a == 0.0) && (b == truth.1 || b == 0.0),
                        _ => false,
                    };
                    all.judge(right, || format!("{name}: {found:?} for {truth:?} from {o} along {d}"));
                }
            }
        }
    }
    all
}

/// A number of any size, or one that breaks things.
pub fn any(random: &mut Random) -> f32 {
    let special =
        [0.0, -0.0, 1e-45, -1e-45, f32::MIN_POSITIVE, f32::MAX, f32::MIN, f32::INFINITY, -f32::INFINITY, f32::NAN];
    if random.unit() < 0.2 {
        return special[(random.unit() * special.len() as f64) as usize];
    }
    random.log(1e-8, 1e8) as f32 * if random.unit() < 0.5 { -1.0 } else { 1.0 }
}

/// A vector of such numbers.
pub fn any3(random: &mut Random) -> Vec3A {
    Vec3A::from_array([0; 3].map(|_| any(random)))
}

fn any_bits(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(41);
    for round in 0..effort.of(60_000) {
        let (a, b, x, y) = (any3(&mut random), any3(&mut random), any(&mut random), any(&mut random));
        let shape = match round % 5 {
            0 => Shape::Sphere { center: a, radius: x },
            1 => Shape::Plane { normal: b, offset: x },
            2 => Shape::Globe { touch: a, normal: b, radius: x },
            3 => Shape::Block { center: a, half: b, turn: Mat3A::from_rotation_y(x) },
            _ => Shape::Cylinder { center: a, axis: b, half: x, radius: y },
        };
        let (o, d) = (any3(&mut random), any3(&mut random));
        for d in [d, d.normalize_or(Vec3A::X)] {
            let case = lines::Case { shape, o, d };
            let ordered = spans(&case).into_iter().all(|(_, span)| span.is_none_or(|(t0, t1)| t0 <= t1));
            found.judge(ordered, || format!("{case:?}"));
            shape.normal_at(o);
            reference::radiance(&alone(shape, Material::glass(1.5, Vec3A::ONE), 6), Ray::new(o, d), 1);
            let near = reference::nearest(&alone(shape, Material::plain(Vec3A::ONE), 1), o, d, |_| true);
            found.fail(near.is_some_and(|(_, t)| t <= 0.0 || t >= FAR), || format!("{case:?}: {near:?}"));
        }
    }
    found
}

fn cameras(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(42);
    for round in 0..effort.of(100_000) {
        let eye = random.direction() * random.log(1e-8, 1e8) as f32;
        let away = random.log(1e-8, 1e8) as f32;
        let target = match round % 5 {
            0 => eye,
            1 => eye + Vec3A::Y * away,
            2 => eye - Vec3A::Y * away,
            3 => eye + (Vec3A::Y + random.direction() * random.log(1e-9, 1e-3) as f32) * away,
            _ => eye + random.direction() * away,
        };
        let fov = random.range(0.01, 3.0) as f32;
        let camera = Camera::look_at(eye, target, fov, random.range(-4.0, 4.0) as f32);
        let scale = (0.5 * fov as f64).tan();
        let [f, r, u] = [camera.forward, camera.right, camera.up].map(|v| v.as_dvec3());
        let (r, u) = (r / scale, u / scale);
        let error = [f.length() - 1.0, r.length() - 1.0, u.length() - 1.0, f.dot(r), f.dot(u), r.dot(u)];
        let error = error.into_iter().fold(r.cross(u).distance(-f), |worst, e| worst.max(e.abs()));
        found.see(error, || format!("from {eye} to {target}, {fov}: {camera:?}"));
    }
    found
}

fn pixels(effort: &Effort) -> Found {
    let mut found = Found::default();
    let mut random = Random(43);
    for _ in 0..effort.of(100_000) {
        let camera = Camera::look_at(
            Vec3A::ZERO,
            random.direction(),
            random.range(0.1, 2.5) as f32,
            random.range(-4.0, 4.0) as f32,
        );
        let (width, height) = (1 + (random.unit() * 2000.0) as usize, 1 + (random.unit() * 2000.0) as usize);
        let view = View::new(camera, width, height);
        let at = [random.range(0.0, width as f64), random.range(0.0, height as f64)];
        // The ray in f64, by the text of the camera.
        let (w, h) = (width as f64, height as f64);
        let (px, py) = ((2.0 * at[0] - w) / h, (h - 2.0 * at[1]) / h);
        let [f, r, u] = [camera.forward, camera.right, camera.up].map(|v| v.as_dvec3());
        let ray: DVec3 = f + r * px + u * py;
        let what = || format!("{camera:?}, {width} x {height} at {at:?}");
        let [x, y] = at.map(|x| x as f32);
        // In pixels: an angle over that of a pixel, in the middle, where it is widest.
        let turned = view.direction(x, y).as_dvec3().cross(ray.normalize()).length() / view.pixel() as f64;
        // Coordinates themselves are rounded to f32.
        let doubt = 4.0 * ULP * (w + h);
        found.see(turned - doubt, what);
        match view.project((ray * random.log(1e-2, 1e6)).as_vec3a()) {
            // Wide pictures stretch what is far from the middle, and roundings of the direction with it.
            Some((x, y, _)) => {
                found.more(((x as f64 - at[0]).hypot(y as f64 - at[1])) / ray.length_squared() - doubt, what)
            }
            None => found.more(f64::INFINITY, what),
        }
    }
    found
}
