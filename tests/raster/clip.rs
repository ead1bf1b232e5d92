//! Triangles through the eye's plane, behind it, and beyond any number; perspective and culling: all against rays in
//! f64.

use glam::{Affine3A, DVec3, Vec3A, vec3a};
use paprsek::raster::project::NEAR;
use paprsek::raster::{Body, Light, World};
use paprsek::settings::Quality;
use paprsek::view::Camera;
use proptest::prelude::*;
use std::sync::Arc;
use testkit::drawn::{Planes, block, body, dark, draw, ground, ray, triangles};
use testkit::random::Random;

const SIZE: [usize; 2] = [150, 90];
const FOV: f32 = 0.9;
/// Corners are snapped to 1/256 pixel, and f32 adds a 1000th where they lie at the end of the guard band: what a pixel
/// shows is what stands that far from its middle.
const SNAP: f64 = 1.0 / 100.0;

/// The eye rays around a pixel's middle that corners' snapping may make it show, the middle first.
fn rays(camera: &Camera, size: [usize; 2], pixel: usize) -> [DVec3; 5] {
    let (x, y) = ((pixel % size[0]) as f64 + 0.5, (pixel / size[0]) as f64 + 0.5);
    [(0.0, 0.0), (-SNAP, -SNAP), (SNAP, -SNAP), (-SNAP, SNAP), (SNAP, SNAP)]
        .map(|(dx, dy)| ray(camera, size, x + dx, y + dy))
}

/// Distance along the axis at which a ray meets level ground, if it does before the eye's near plane's end.
fn meets_ground(eye: DVec3, d: DVec3, height: f64, half: f64) -> Option<f64> {
    let t = (height - eye.y) / d.y;
    let p = eye + d * t;
    (d.y < 0.0 && t >= NEAR as f64 && p.x.abs() <= half && p.z.abs() <= half).then_some(t)
}

#[test]
fn ground_is_where_the_rays_meet_it() {
    let mut random = Random(1);
    let (mut solid, mut open, mut grazing) = (0, 0, 0);
    for case in 0..60 {
        let half = [3.0, 50.0, 2000.0, 20000.0][case % 4];
        let cells = [1, 2, 13, 40][case / 4 % 4];
        // From the near plane's height to that of an aeroplane, mostly over the ground, which passes below and behind.
        let up = random.log(0.06, 100.0);
        let aside = random.range(-0.8, 0.8) * half as f64;
        let eye = vec3a(aside as f32, up as f32, random.range(-0.8, 0.8) as f32 * half);
        let look = [random.direction(), Vec3A::NEG_Y, vec3a(1.0, 0.0, 0.0), vec3a(0.3, -0.4, 0.5)][case % 7 % 4];
        let camera = Camera::look_at(eye, eye + look, FOV, random.range(-1.0, 1.0) as f32);
        let world = dark(vec![body(ground(half, 0.0, cells))]);
        let mut first: Option<Planes> = None;
        for (name, level) in testkit::levels() {
            let planes = draw(&world, camera, SIZE, Quality::EXACT, level);
            if let Some(first) = &first {
                assert_eq!(first.differs(&planes), None, "{name}, case {case}");
                continue;
            }
            for pixel in 0..planes.inv_depth.len() {
                let hits = rays(&camera, SIZE, pixel).map(|d| meets_ground(eye.as_dvec3(), d, 0.0, half as f64));
                let found = planes.inv_depth[pixel] as f64;
                let sure = hits.iter().all(Option::is_some);
                if !sure && hits.iter().any(Option::is_some) {
                    grazing += 1;
                    continue;
                }
                assert_eq!(found > 0.0, sure, "case {case}, {eye}, pixel {pixel}: {found}, {hits:?}");
                solid += sure as u32;
                open += !sure as u32;
                if sure {
                    let near = hits.map(|t| 1.0 / t.unwrap());
                    let (low, high) = near.iter().fold((f64::MAX, 0f64), |(l, h), n| (l.min(*n), h.max(*n)));
                    // f32 of the far corners' places: metres of the eye's height, at most this share of it.
                    let slack = 1e-5 + 4.0 * testkit::ULP * (half as f64) / up;
                    let right = found >= low * (1.0 - slack) && found <= high * (1.0 + slack);
                    assert!(right, "case {case}, eye {eye}, pixel {pixel}: {found} not in {low} to {high}");
                }
            }
            first = Some(planes);
        }
    }
    println!("ground: {solid} pixels met, {open} not, {grazing} on an edge");
    assert!(solid > 100_000 && open > 50_000 && grazing < solid / 50, "{solid} {open} {grazing}");
}

#[test]
fn a_plane_of_a_million_metres_has_a_horizon() {
    // Two triangles that reach from far behind the eye to far before it. In f32 corners a million metres away are known
    // to centimetres, so the eye is far above.
    let camera = Camera::look_at(vec3a(0.0, 100.0, 0.0), vec3a(10.0, 99.0, -3.0), FOV, 0.2);
    for half in [1e5, 1e6] {
        let world = dark(vec![body(ground(half, 0.0, 1))]);
        let planes = draw(&world, camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
        let mut off = 0;
        for pixel in 0..planes.inv_depth.len() {
            let [d, around @ ..] = rays(&camera, SIZE, pixel);
            let meets = |d: DVec3| meets_ground(camera.eye.as_dvec3(), d, 0.0, half as f64);
            if around.iter().all(|d| meets(*d).is_some() == meets(around[0]).is_some()) {
                let truth = meets(d).map_or(0.0, |t| 1.0 / t);
                let found = planes.inv_depth[pixel] as f64;
                // A millionth of the way to a corner, of the eye's height; and 1/100 pixel of the ground's slope.
                let slope = 1.0 / 100.0 * 0.01;
                off += ((found > 0.0) != (truth > 0.0) || (found - truth).abs() > 2e-3 * truth + slope * SNAP) as u32;
            }
        }
        assert_eq!(off, 0, "{half}");
    }
}

#[test]
fn long_roads_lead_straight_past_the_eye() {
    // From a few metres behind the eye to far before it: what is left of the road at the near plane is found from both.
    let mut random = Random(6);
    let (mut on, mut off) = (0, 0);
    for case in 0..30 {
        let length = [1e3, 1e5, 1e6][case % 3];
        let angle = random.range(-0.3, 0.3);
        let (along, across) = (DVec3::new(angle.sin(), 0.0, -angle.cos()), DVec3::new(angle.cos(), 0.0, angle.sin()));
        let corner = |z: f64, x: f64| (along * z + across * x).as_vec3a();
        let [a, b, c, d] = [corner(-5.0, -1.0), corner(-5.0, 1.0), corner(length, -1.0), corner(length, 1.0)];
        let world = dark(vec![body(triangles(&[[a, b, c], [b, d, c]]))]);
        let eye = vec3a(0.1, 1.7, 0.0);
        let camera = Camera::look_at(eye, eye + vec3a(0.05, -0.2, -1.0), FOV, 0.1);
        let planes = draw(&world, camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
        for pixel in 0..planes.inv_depth.len() {
            let hit = |d: DVec3| {
                let p = eye.as_dvec3() + d * (-1.7 / d.y);
                d.y < 0.0 && p.dot(across).abs() < 1.0 && (-5.0..length).contains(&p.dot(along))
            };
            let hits = rays(&camera, SIZE, pixel).map(hit);
            if hits.iter().all(|h| *h == hits[0]) {
                assert_eq!(planes.inv_depth[pixel] > 0.0, hits[0], "case {case}, {length} m: pixel {pixel}");
                (on, off) = (on + hits[0] as u32, off + !hits[0] as u32);
            }
        }
    }
    assert!(on > 20_000 && off > 100_000, "{on} {off}");
}

#[test]
fn nothing_behind_the_eye_or_before_the_near_plane_is_seen() {
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, FOV, 0.0);
    // Across the axis, at many distances, among them the eye's own and the near plane's.
    let beside = [1e-4, 1e-3, 1e-6];
    let mut distances = vec![-1e6, -5.0, -0.05, -1e-30, 0.0, 1e-30, 0.04999, NEAR, 0.05001, 0.06, 1.0, 1e6, 1e30];
    distances.extend(beside.map(|k| NEAR * (1.0 + k)));
    for z in distances {
        let r = 3.0 * z.abs().max(1.0);
        let faces = [[vec3a(-r, -r, -z), vec3a(r, -r, -z), vec3a(0.0, r, -z)]];
        let planes = draw(&dark(vec![body(triangles(&faces))]), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
        let middle = planes.inv_depth[SIZE[0] * SIZE[1] / 2 + SIZE[0] / 2];
        if z < NEAR {
            assert!(planes.inv_depth.iter().all(|c| *c == 0.0), "{z}");
        } else {
            assert!((middle * z - 1.0).abs() < 1e-6, "{z}: {middle}");
        }
    }
}

#[test]
fn clipped_neighbours_leave_no_gap() {
    // A closed box around the eye, turned inwards, of many faces, most of which reach behind the eye.
    let mut random = Random(2);
    for case in 0..40 {
        let mut corner = || random.range(0.2, 1.0) as f32 * [0.3, 3.0, 300.0][case % 3];
        let (low, high) = (-vec3a(corner(), corner(), corner()), vec3a(corner(), corner(), corner()));
        let mut mesh = block(low, high);
        // Each face into three, about a place of its own.
        let mut faces = Vec::new();
        for face in &mesh.faces {
            let [a, b, c] = face.corners.map(|i| mesh.points[i as usize]);
            let (u, v) = (random.range(0.05, 0.9) as f32, random.range(0.05, 0.9) as f32);
            let (u, v) = if u + v > 0.95 { (0.95 - u, 0.95 - v) } else { (u, v) };
            let m = a + (b - a) * u + (c - a) * v;
            faces.extend([[b, a, m], [c, b, m], [a, c, m]]);
        }
        mesh = triangles(&faces);
        let eye = Vec3A::ZERO;
        let camera = Camera::look_at(eye, random.direction(), 1.4, random.range(-3.0, 3.0) as f32);
        // What the near plane cuts out of the box is open; nothing else is.
        let planes = draw(&dark(vec![body(mesh)]), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
        for pixel in 0..planes.inv_depth.len() {
            let way = |d: DVec3| {
                let t = |p: f32, d: f64| p as f64 / d;
                let axes = [(low.x, high.x, d.x), (low.y, high.y, d.y), (low.z, high.z, d.z)];
                axes.map(|(l, h, d)| if d < 0.0 { t(l, d) } else { t(h, d) }).into_iter().fold(f64::MAX, f64::min)
            };
            let ways = rays(&camera, SIZE, pixel).map(way);
            if ways.iter().all(|t| *t >= NEAR as f64 * 1.001) {
                let (least, most) = ways.iter().fold((f64::MAX, 0f64), |(l, h), t| (l.min(*t), h.max(*t)));
                let found = 1.0 / planes.inv_depth[pixel] as f64;
                let right = found > least * 0.9999 && found < most * 1.0001;
                assert!(right, "case {case}, pixel {pixel}: {found}, {least} to {most}");
            }
        }
    }
}

#[test]
fn layers_a_metre_apart_are_told_apart_five_kilometres_away() {
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, 0.9, 0.1);
    let mut random = Random(3);
    for case in 0..20 {
        // Up to 45 degrees askew, several cells each, cut differently.
        let tilt = vec3a(random.range(-1.0, 1.0) as f32, random.range(-1.0, 1.0) as f32, 0.0) * (case as f32 / 20.0);
        let layer = |distance: f32, cells: usize, red: f32| {
            let mut mesh = ground(2000.0, 0.0, cells);
            for p in &mut mesh.points {
                *p = vec3a(p.x, -p.z, -distance + tilt.x * p.x - tilt.y * p.z);
            }
            mesh.paints[0].albedo = vec3a(red, 0.0, 1.0);
            body(mesh)
        };
        let mut bodies = vec![layer(5000.0, 7, 1.0), layer(5001.0, 5, 0.0)];
        for _ in 0..2 {
            let world = World { ambient: [Vec3A::ONE, Vec3A::ZERO], ..dark(bodies.clone()) };
            let planes = draw(&world, camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
            // Blue where there is a layer; a little more of the far one is seen at the rim.
            let (near, far) = planes
                .color
                .iter()
                .fold((0, 0), |(n, f), c| (n + (c.x == 1.0) as u32, f + (c.z == 1.0 && c.x == 0.0) as u32));
            assert!(near > 3000 && far < 300, "case {case}: {near} pixels of the near layer, {far} of the far one");
            let behind = (0..planes.color.len()).filter(|&i| {
                let d = ray(&camera, SIZE, (i % SIZE[0]) as f64 + 0.5, (i / SIZE[0]) as f64 + 0.5);
                let t = -5000.0 / (d.z - tilt.x as f64 * d.x - tilt.y as f64 * d.y);
                let (x, y) = (d.x * t, d.y * t);
                x.abs() < 1990.0 && y.abs() < 1990.0 && planes.color[i].x != 1.0
            });
            assert_eq!(behind.count(), 0, "case {case}");
            bodies.reverse();
        }
    }
}

#[test]
fn corners_that_are_no_numbers_spoil_only_their_faces() {
    let camera = Camera::look_at(vec3a(0.0, 0.0, 5.0), Vec3A::ZERO, FOV, 0.0);
    let good = [[vec3a(-1.0, -1.0, 0.0), vec3a(1.0, -1.0, 0.0), vec3a(0.0, 1.0, 0.0)]];
    let truth = draw(&dark(vec![body(triangles(&good))]), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
    assert!(truth.coverage.contains(&1.0));
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN] {
        for spoilt in 1..8 {
            for corner in 0..3 {
                for order in [[0, 1, 2], [0, 2, 1]] {
                    let mut face = [vec3a(-2.0, -2.0, 1.0), vec3a(2.0, -2.0, 1.0), vec3a(0.0, 2.0, 1.0)];
                    for axis in (0..3).filter(|k| spoilt >> k & 1 != 0) {
                        face[corner][axis] = bad;
                    }
                    let bad_face = order.map(|i| face[i]);
                    for faces in [[bad_face, good[0]], [good[0], bad_face]] {
                        let mesh = body(triangles(&faces));
                        let planes = draw(&dark(vec![mesh]), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
                        assert_eq!(planes.differs(&truth), None, "{bad} in {face:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_full_mesh_of_clipped_faces_is_no_more_than_a_piece_may_have() {
    // 8,192 faces under and behind the eye, each cut at the near plane and on three sides of the guard band.
    let face = [vec3a(-4e4, -1.0, 3e4), vec3a(4e4, -1.0, 3e4), vec3a(0.0, -1.0, -9e4)];
    let mesh = triangles(&vec![face; 8192]);
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, FOV, 0.0);
    let few = draw(&dark(vec![body(triangles(&[face]))]), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
    // Before another body, whose pixels must stay its own.
    let wall = ground(1e5, -2.0, 1);
    let bodies = vec![body(mesh), body(wall)];
    let planes = draw(&dark(bodies), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
    let low = SIZE[0] * (SIZE[1] - 1) + SIZE[0] / 2;
    assert!(few.inv_depth[low] > 0.0 && planes.inv_depth[low] == few.inv_depth[low]);
}

#[test]
fn bodies_beyond_the_last_number_are_left_out() {
    let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, FOV, 0.0);
    let wall = |x: f32| triangles(&[[vec3a(x - 1.0, -1.0, -5.0), vec3a(x + 1.0, -1.0, -5.0), vec3a(x, 1.0, -5.0)]]);
    // 16,384 have numbers: the last that has one is seen, the next is not.
    let nothing = body(triangles(&[]));
    let mut bodies = vec![nothing; 16383];
    bodies.push(body(wall(-1.0)));
    let truth = draw(&dark(bodies.clone()), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
    assert!(truth.coverage.contains(&1.0));
    bodies.push(body(wall(1.0)));
    let planes = draw(&dark(bodies), camera, SIZE, Quality::EXACT, testkit::levels()[0].1);
    assert_eq!(planes.differs(&truth), None);
}

/// A coordinate of any size, some of them special.
fn coordinate() -> impl Strategy<Value = f32> {
    let log =
        (any::<bool>(), -30f64..30.0).prop_map(|(sign, e)| (if sign { -1.0 } else { 1.0 }) * 10f64.powf(e) as f32);
    let special = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, 1e30, 0.0, -0.0, 1e-40, NEAR];
    prop_oneof![6 => log, 3 => -3f32..3.0, 1 => prop::sample::select(special.to_vec())]
}

fn point() -> impl Strategy<Value = Vec3A> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| vec3a(x, y, z))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever the corners: no panic, no number that is none, the same at every level.
    #[test]
    fn any_corners_give_finite_light(points in prop::collection::vec(point(), 12), eye in point(), look in point()) {
        let faces: Vec<[Vec3A; 3]> = points.windows(3).flat_map(|w| [[w[0], w[1], w[2]], [w[0], w[2], w[1]]]).collect();
        let eye = if eye.is_finite() { eye.clamp(Vec3A::splat(-1e6), Vec3A::splat(1e6)) } else { Vec3A::ZERO };
        let camera = Camera::look_at(eye, if look.is_finite() { look } else { Vec3A::X }, FOV, 0.3);
        let world = World { ambient: [Vec3A::ONE, vec3a(0.1, 0.2, 0.3)], ..dark(vec![body(triangles(&faces))]) };
        let mut first: Option<Planes> = None;
        for (name, level) in testkit::levels() {
            let planes = draw(&world, camera, [40, 30], Quality::DEFAULT, level);
            prop_assert!(planes.color.iter().all(|c| c.is_finite()), "{}", name);
            // Beside corners 1e20 metres away even the near plane is only roughly known.
            prop_assert!(planes.inv_depth.iter().all(|c| (0.0..=2.001 / NEAR).contains(c)), "{}", name);
            prop_assert!(planes.coverage.iter().all(|c| (0.0..=1.000001).contains(c)), "{}", name);
            prop_assert_eq!(planes.differs(first.get_or_insert_with(|| planes.clone())), None, "{}", name);
        }
    }
}

/// Three suns along the axes: a white surface has its normal as its colour, where that has no negative part.
fn suns() -> Vec<Light> {
    Vec3A::AXES.map(|axis| Light::sun(axis, axis)).to_vec()
}

#[test]
fn normals_are_interpolated_in_perspective() {
    let mut random = Random(4);
    let mut pixels = 0;
    for case in 0..60 {
        // A large triangle from near to far, half of them through the eye's plane.
        let back = if case % 2 == 0 { -20.0 } else { 1.0 };
        let mut face = [0; 3].map(|_| {
            vec3a(random.range(-8.0, 8.0) as f32, random.range(-4.0, 4.0) as f32, -random.range(back, 40.0) as f32)
        });
        let normals = [0; 3].map(|_| random.direction().abs() * random.range(0.5, 2.0) as f32);
        if (face[1] - face[0]).cross(face[2] - face[0]).dot(face[0]) > 0.0 {
            face.swap(1, 2);
        }
        let mut mesh = triangles(&[face]);
        mesh.normals = normals.to_vec();
        let world = World { lights: suns(), ..dark(vec![body(mesh)]) };
        let camera = Camera::look_at(Vec3A::ZERO, Vec3A::NEG_Z, FOV, 0.0);
        let planes = draw(&world, camera, SIZE, Quality::EXACT, testkit::levels()[case % testkit::levels().len()].1);
        let [a, b, c] = face.map(Vec3A::as_dvec3);
        let plane = (b - a).cross(c - a);
        let units = normals.map(|n| n.as_dvec3().normalize());
        let at = |d: DVec3| {
            let p = d * (a.dot(plane) / d.dot(plane));
            let share = |u: DVec3, v: DVec3| (v - u).cross(p - u).dot(plane) / plane.length_squared();
            (units[0] * share(b, c) + units[1] * share(c, a) + units[2] * share(a, b)).normalize()
        };
        // A face seen from its edge shows every normal within a few pixels.
        for (pixel, color) in planes.color.iter().enumerate().filter(|p| planes.coverage[p.0] == 1.0) {
            let truth = rays(&camera, SIZE, pixel).map(at);
            let (low, high) = truth.iter().fold((DVec3::MAX, DVec3::MIN), |(l, h), n| (l.min(*n), h.max(*n)));
            // Rounding of interpolated numbers and of a length; and between the rays it may go beyond them.
            let slack = DVec3::splat(1e-5 + 0.1 * (high - low).max_element());
            let color = color.as_dvec3();
            let right = color.cmpge(low - slack).all() && color.cmple(high + slack).all();
            assert!(right, "case {case}, pixel {pixel}: {color} not in {low} to {high}");
            pixels += 1;
        }
    }
    assert!(pixels > 20_000, "{pixels}");
}

#[test]
fn closed_boxes_show_their_front_and_nothing_from_inside() {
    let mut random = Random(5);
    let (low, high) = (vec3a(-1.0, -0.7, -1.3), vec3a(1.0, 0.7, 1.3));
    let mut seen = 0;
    for case in 0..40 {
        let place = Affine3A::from_mat3(random.turn().into());
        let cube = Body::new(Arc::new(block(low, high)), place);
        let world = World { lights: suns(), ..dark(vec![cube]) };
        let inside = case % 4 == 0;
        let eye = if inside { random.direction() * 0.3 } else { random.direction() * random.range(2.0, 9.0) as f32 };
        let camera = Camera::look_at(eye, if inside { random.direction() } else { Vec3A::ZERO }, FOV, 0.5);
        let planes = draw(&world, camera, SIZE, Quality::EXACT, testkit::levels()[case % testkit::levels().len()].1);
        let turn = place.matrix3.as_dmat3().transpose();
        let from = turn * eye.as_dvec3();
        for pixel in 0..planes.color.len() {
            if inside {
                assert_eq!(planes.coverage[pixel], 0.0, "case {case}: a back face");
                continue;
            }
            let meet = |d: DVec3| {
                let d = turn * d;
                let (t0, t1) = ((low.as_dvec3() - from) / d, (high.as_dvec3() - from) / d);
                let entry = t0.min(t1);
                let (enter, leave) = (entry.max_element(), t0.max(t1).min_element());
                let axis = (0..3).find(|&k| entry[k] == enter).unwrap();
                (enter < leave).then_some((axis, enter))
            };
            let hits = rays(&camera, SIZE, pixel).map(meet);
            if hits.iter().any(|h| h.map(|h| h.0) != hits[0].map(|h| h.0)) {
                continue;
            }
            assert_eq!(planes.coverage[pixel] > 0.0, hits[0].is_some(), "case {case}, pixel {pixel}");
            if let Some((axis, way)) = hits[0] {
                // The side that looks here, by the eye's place.
                let normal = place.matrix3.col(axis) * from[axis].signum() as f32;
                let truth = normal.max(Vec3A::ZERO);
                assert!(planes.color[pixel].abs_diff_eq(truth, 1e-5), "case {case}, pixel {pixel}");
                assert!((planes.inv_depth[pixel] as f64 * way - 1.0).abs() < 1e-3, "case {case}, pixel {pixel}");
                seen += 1;
            }
        }
    }
    assert!(seen > 20_000, "{seen}");
}
