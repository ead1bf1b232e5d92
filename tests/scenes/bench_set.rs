//! The bench scenes `shadow` and `shadow-cube` against a slow renderer of the same text: rays in f64 that try every
//! triangle, and depth maps of which only the texels that are looked up are made.

use glam::{DVec2, DVec3, dvec2, dvec3};
use paprsek::frame::{Frame, Renderer};
use paprsek::scenes;
use paprsek::scenes::bench::shadow_set;
use paprsek::settings::Quality;

const SIZE: [usize; 2] = [160, 90];
/// Sparse pixels, with steps that have no factor in common with the picture's.
const STEP: usize = 23;
/// Corners are snapped to 1/256 pixel, of the picture and of a map: so far off may a point or an edge be.
const SNAP: f64 = 1.0 / 128.0;
/// Metres by which a height on a map may differ: f32 of 36 metres, and slopes times the snapping.
const HEIGHT: f64 = 3e-3;
/// Codes that decided pixels may differ before they are rounded: half of one is found.
const CODES: f64 = 1.0;

struct Triangle {
    points: [DVec3; 3],
    normals: [DVec3; 3],
    albedo: DVec3,
}

fn triangles() -> Vec<Triangle> {
    let mut all = Vec::new();
    for mesh in shadow_set::meshes() {
        for face in &mesh.faces {
            let corners = face.corners.map(|i| i as usize);
            let points = corners.map(|i| mesh.points[i].as_dvec3());
            let flat = [(points[1] - points[0]).cross(points[2] - points[0]).normalize(); 3];
            let normals =
                if mesh.normals.is_empty() { flat } else { corners.map(|i| mesh.normals[i].as_dvec3().normalize()) };
            all.push(Triangle { points, normals, albedo: mesh.paints[face.paint as usize].albedo.as_dvec3() });
        }
    }
    assert_eq!(all.len(), 9984);
    all
}

/// T. Möller, B. Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; front faces only. The parameter, and
/// the shares of the second and third corner.
fn meets(t: &Triangle, o: DVec3, d: DVec3) -> Option<(f64, f64, f64)> {
    let [a, b, c] = t.points;
    let (ab, ac) = (b - a, c - a);
    let p = d.cross(ac);
    let whole = ab.dot(p);
    if whole <= 0.0 {
        return None;
    }
    let from = o - a;
    let u = from.dot(p);
    let q = from.cross(ab);
    let v = d.dot(q);
    if u < 0.0 || v < 0.0 || u + v > whole {
        return None;
    }
    Some((ac.dot(q) / whole, u / whole, v / whole))
}

/// The nearest triangle from a parameter on: its number, the parameter, the shares.
fn nearest<'a>(
    all: impl Iterator<Item = (usize, &'a Triangle)>,
    o: DVec3,
    d: DVec3,
    from: f64,
) -> Option<(usize, f64, f64, f64)> {
    let hits = all.filter_map(|(i, t)| meets(t, o, d).map(|(k, u, v)| (i, k, u, v)));
    hits.filter(|h| h.1 > from).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// A map of a light: axes, texels along an edge; the sun's is parallel, 72 metres wide.
struct Map {
    right: DVec3,
    up: DVec3,
    look: DVec3,
    eye: DVec3,
    texels: f64,
    parallel: bool,
}

impl Map {
    /// Where a point is on the map, texels, and how far along its axis.
    fn at(&self, p: DVec3) -> (DVec2, f64) {
        let q = p - self.eye;
        let depth = q.dot(self.look);
        let half = if self.parallel { 36.0 } else { depth };
        let flat = dvec2(q.dot(self.right), q.dot(self.up)) / half;
        ((flat + 1.0) * (0.5 * self.texels), depth)
    }

    /// The ray through a place on the map: its parameter is the depth.
    fn ray(&self, at: DVec2) -> (DVec3, DVec3) {
        let flat = at / (0.5 * self.texels) - 1.0;
        let off = self.right * flat.x + self.up * flat.y;
        if self.parallel { (self.eye + off * 36.0, self.look) } else { (self.eye, self.look + off) }
    }

    /// The share of the 3x3 texels around a point that see it, with a bias in metres; none where rounding may decide.
    fn vis(&self, all: &[Triangle], p: DVec3, bias: f64) -> Option<f64> {
        let (at, depth) = self.at(p);
        if (at - at.round()).abs().min_element() < 3.0 * SNAP {
            return None;
        }
        // What may be on those texels.
        let near = |t: &Triangle| {
            let places = t.points.map(|p| self.at(p));
            let behind = !self.parallel && places.iter().any(|p| p.1 < 0.01);
            let (low, high) = places.iter().fold((DVec2::MAX, DVec2::MIN), |(l, h), p| (l.min(p.0), h.max(p.0)));
            behind || (low.cmple(at + 4.0).all() && high.cmpge(at - 4.0).all())
        };
        let some: Vec<_> = all.iter().enumerate().filter(|(_, t)| near(t)).collect();
        let mut seen = 0;
        for j in -1..=1 {
            for i in -1..=1 {
                let center =
                    (at.floor() + dvec2(i as f64, j as f64)).clamp(DVec2::ZERO, DVec2::splat(self.texels - 1.0));
                let passes = |dx: f64, dy: f64, height: f64| {
                    let (o, d) = self.ray(center + 0.5 + dvec2(dx, dy));
                    let stored = nearest(some.iter().copied(), o, d, 0.05).map_or(f64::MAX, |h| h.1);
                    depth - bias + height <= stored
                };
                let first = passes(0.0, 0.0, 0.0);
                for (dx, dy) in [(-SNAP, -SNAP), (SNAP, -SNAP), (-SNAP, SNAP), (SNAP, SNAP)] {
                    if passes(dx, dy, HEIGHT) != first || passes(dx, dy, -HEIGHT) != first {
                        return None;
                    }
                }
                seen += first as u32;
            }
        }
        Some(seen as f64 / 9.0)
    }
}

/// What a point with that normal gets from the light of a scene at a time; none where rounding may decide.
type Lamp<'a> = &'a dyn Fn(DVec3, DVec3) -> Option<DVec3>;

/// Pixels whose codes are right, of those that are decided, and all: and the largest difference.
fn compare(name: &str, time: f64, all: &[Triangle], ambient: DVec3, fog: DVec3, lamp: Lamp) -> (u32, u32, u32, f64) {
    let mut frame = Frame::new(SIZE[0], SIZE[1]);
    Renderer::new(1).unwrap().render(&scenes::named(name).unwrap(), time, &Quality::FAST, &mut frame);
    let eye = shadow_set::eye(time);
    let f = (dvec3(0.0, 0.5, 0.0) - eye).normalize();
    let r = f.cross(DVec3::Y).normalize();
    let u = r.cross(f);
    let tan = 25f64.to_radians().tan();
    let [w, h] = SIZE.map(|n| n as f64);
    let ray = |x: f64, y: f64| f + (r * ((2.0 * x - w) / h) + u * ((h - 2.0 * y) / h)) * tan;
    let (mut right, mut decided, mut met, mut worst) = (0, 0, 0, 0f64);
    for pixel in (0..SIZE[0] * SIZE[1]).step_by(STEP) {
        met += 1;
        let (x, y) = ((pixel % SIZE[0]) as f64 + 0.5, (pixel / SIZE[0]) as f64 + 0.5);
        let hit = |dx: f64, dy: f64| nearest(all.iter().enumerate(), eye, ray(x + dx, y + dy), 0.1);
        let first = hit(0.0, 0.0);
        let corners = [(-SNAP, -SNAP), (SNAP, -SNAP), (-SNAP, SNAP), (SNAP, SNAP)];
        if corners.iter().any(|c| hit(c.0, c.1).map(|h| h.0) != first.map(|h| h.0)) {
            continue;
        }
        let color = match first {
            None => fog,
            Some((i, k, share_b, share_c)) => {
                let t = &all[i];
                let p = eye + ray(x, y) * k;
                let [a, b, c] = t.normals;
                let n = (a * (1.0 - share_b - share_c) + b * share_b + c * share_c).normalize();
                let Some(light) = lamp(p, n) else { continue };
                let lit = t.albedo * (ambient * (0.6 + 0.4 * n.y) + light);
                fog.lerp(lit, (-0.012 * p.distance(eye)).exp())
            }
        };
        decided += 1;
        let found = [16, 8, 0].map(|shift| (frame.pixels[pixel] >> shift & 255) as f64);
        let gap =
            (DVec3::from(found) - color.clamp(DVec3::ZERO, DVec3::ONE).powf(1.0 / 2.2) * 255.0).abs().max_element();
        // The code itself is rounded.
        right += (gap <= CODES + 0.5) as u32;
        worst = worst.max(gap);
    }
    println!("{name} at {time}: {right} of {decided} decided pixels of {met}, at most {worst:.2} codes");
    (right, decided, met, worst)
}

/// The tangent by which biases grow.
fn tangent(n: f64) -> f64 {
    ((1.0 - n * n).max(0.0).sqrt() / n.max(1e-3)).min(4.0)
}

/// All decided pixels are right, and they are most.
fn check((right, decided, met, worst): (u32, u32, u32, f64), least: f64) {
    assert_eq!(right, decided, "at most {worst} codes");
    assert!(met > 600 && decided as f64 > least * met as f64, "{decided} of {met}");
}

#[test]
fn shadow_is_what_its_text_says() {
    let all = triangles();
    for time in [2.0, 7.3] {
        let s = shadow_set::sun(time);
        let look = -s;
        let right = look.cross(DVec3::Y).normalize();
        let map = Map { right, up: right.cross(look), look, eye: s * 60.0, texels: 1024.0, parallel: true };
        let lamp = |p: DVec3, normal: DVec3| {
            let n = normal.dot(s).max(0.0);
            let vis = if n > 0.0 { map.vis(&all, p, 0.03 + 0.15 * tangent(n))? } else { 0.0 };
            Some(dvec3(1.05, 0.92, 0.74) * (n * vis))
        };
        check(compare("shadow", time, &all, dvec3(0.20, 0.27, 0.40), dvec3(0.42, 0.55, 0.72), &lamp), 0.85);
    }
}

#[test]
fn shadow_cube_is_what_its_text_says() {
    let all = triangles();
    for time in [2.0, 7.3] {
        let torch = shadow_set::torch(time);
        let ups = [DVec3::Y, DVec3::Y, -DVec3::Z, DVec3::Z, DVec3::Y, DVec3::Y];
        let maps: Vec<Map> = (0..6)
            .map(|i| {
                let look = DVec3::AXES[i / 2] * if i % 2 == 0 { 1.0 } else { -1.0 };
                Map { right: look.cross(ups[i]), up: ups[i], look, eye: torch, texels: 512.0, parallel: false }
            })
            .collect();
        let lamp = |p: DVec3, normal: DVec3| {
            let q = p - torch;
            let (distance, m) = (q.length(), q.abs().max_element());
            let axis = (0..3).find(|&k| q[k].abs() == m)?;
            let n = normal.dot(-q / distance).max(0.0);
            let bias = 0.03 + 2.0 * m / 512.0 * 2.12 * tangent(n);
            let face = 2 * axis + (q[axis] < 0.0) as usize;
            let vis = if n > 0.0 { maps[face].vis(&all, p, bias)? } else { 0.0 };
            Some(dvec3(2.6, 1.35, 0.5) * (n * vis / (1.0 + 0.06 * distance * distance)))
        };
        check(compare("shadow-cube", time, &all, dvec3(0.020, 0.028, 0.055), dvec3(0.010, 0.014, 0.030), &lamp), 0.85);
    }
}
