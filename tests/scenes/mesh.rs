//! Meshes from formulas: closed where they should be, turned outwards, without cracks; and the bench set against its
//! other writing.

use glam::{DVec3, Mat3A, Vec3A, vec3a};
use paprsek::raster::Mesh;
use paprsek::raster::form::{Rings, SQUARE};
use paprsek::scenes::models::{chapel, land, mustang, tree};
use paprsek::simd::hash::{pcg, rnd};
use std::collections::HashMap;

/// A place by its bits; both zeros are one.
fn key(p: Vec3A) -> [u32; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}

/// The corners of face `i`.
fn corners(mesh: &Mesh, i: usize) -> [Vec3A; 3] {
    mesh.faces[i].corners.map(|i| mesh.points[i as usize])
}

/// How often each directed edge occurs, points in one place taken for one.
fn edges<'a>(meshes: impl IntoIterator<Item = &'a Mesh>) -> HashMap<([u32; 3], [u32; 3]), i32> {
    let mut edges = HashMap::new();
    for mesh in meshes {
        for i in 0..mesh.faces.len() {
            let c = corners(mesh, i).map(key);
            for k in 0..3 {
                *edges.entry((c[k], c[(k + 1) % 3])).or_default() += 1;
            }
        }
    }
    edges
}

/// Edges that one face has and no other has the other way round.
fn open<'a>(meshes: impl IntoIterator<Item = &'a Mesh>) -> Vec<([u32; 3], [u32; 3])> {
    let edges = edges(meshes);
    for (edge, &count) in &edges {
        assert_eq!(count, 1, "an edge occurs twice in one direction: {edge:?}");
    }
    edges.keys().filter(|e| !edges.contains_key(&(e.1, e.0))).copied().collect()
}

/// The faces of each connected part.
fn parts(mesh: &Mesh) -> Vec<Vec<usize>> {
    let mut at: HashMap<[u32; 3], Vec<usize>> = HashMap::new();
    for i in 0..mesh.faces.len() {
        for p in corners(mesh, i) {
            at.entry(key(p)).or_default().push(i);
        }
    }
    let mut seen = vec![false; mesh.faces.len()];
    let mut parts = Vec::new();
    for start in 0..mesh.faces.len() {
        let (mut part, mut todo) = (Vec::new(), vec![start]);
        while let Some(i) = todo.pop() {
            if !std::mem::replace(&mut seen[i], true) {
                part.push(i);
                todo.extend(corners(mesh, i).iter().flat_map(|&p| &at[&key(p)]));
            }
        }
        if !part.is_empty() {
            parts.push(part);
        }
    }
    parts
}

/// Volume inside of some faces, metres cubed; more than 0 if they are turned outwards.
fn volume(mesh: &Mesh, part: &[usize]) -> f64 {
    let origin = corners(mesh, part[0])[0];
    let six = |i: &usize| {
        let [a, b, c] = corners(mesh, *i).map(|p| (p - origin).as_dvec3());
        a.dot(b.cross(c))
    };
    part.iter().map(six).sum::<f64>() / 6.0
}

/// Euler's characteristic of some faces.
fn euler(mesh: &Mesh, part: &[usize]) -> i64 {
    let points: std::collections::HashSet<_> = part.iter().flat_map(|&i| corners(mesh, i)).map(key).collect();
    points.len() as i64 - part.len() as i64 * 3 / 2 + part.len() as i64
}

/// What holds for every mesh.
fn sound(name: &str, mesh: &Mesh) {
    assert!(mesh.points.len() <= 65_536, "{name} has {} points", mesh.points.len());
    assert!(mesh.points.iter().all(|p| p.is_finite()), "{name}");
    assert!(mesh.normals.is_empty() || mesh.normals.len() == mesh.points.len(), "{name}");
    assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5), "{name}: normals of length 1");
    for (i, face) in mesh.faces.iter().enumerate() {
        assert!(face.corners.iter().all(|&c| (c as usize) < mesh.points.len()), "{name}: face {i}");
        assert!((face.paint as usize) < mesh.paints.len(), "{name}: paint {} of face {i}", face.paint);
        let [a, b, c] = corners(mesh, i).map(Vec3A::as_dvec3);
        let area = 0.5 * (b - a).cross(c - a).length();
        assert!(area > 1e-8, "{name}: face {i} has an area of {area}");
    }
}

/// What a smooth normal may lean away from one of its faces: at the knife edge of a tip the faces above and below are
/// all but opposite, and their sum has little to decide by. One corner of the stabiliser has -0.12, the next has 0.04.
const LEAN: f32 = -0.15;

/// The most that a corner's normal leans away from its face's: the cosine.
fn worst_lean(mesh: &Mesh) -> f32 {
    let lean = |i: usize| {
        let [a, b, c] = corners(mesh, i);
        let normal = (b - a).cross(c - a).normalize();
        mesh.faces[i].corners.map(|k| normal.dot(mesh.normals[k as usize])).into_iter().fold(1.0, f32::min)
    };
    (0..mesh.faces.len()).map(lean).fold(1.0, f32::min)
}

#[test]
fn the_hash_is_that_of_the_bench_scenes() {
    // The specification's formula, computed apart from this code.
    assert_eq!([0, 1, 2, 0xffff_ffff].map(pcg), [129708002, 2831084092, 2055130248, 3861530882]);
    assert_eq!(rnd(2, 5, 3), 4253440.0 / 16_777_216.0);
}

#[test]
fn boxes_are_boxes() {
    let mut mesh = Mesh::default();
    let half = Mat3A::from_rotation_y(0.3) * Mat3A::from_diagonal(glam::vec3(1.0, 2.0, 3.0));
    mesh.block(&half, vec3a(5.0, 6.0, 7.0), 0);
    assert_eq!(mesh.faces.len(), 12);
    let all: Vec<_> = (0..12).collect();
    assert!((volume(&mesh, &all) - 48.0).abs() < 1e-4);
    assert_eq!(euler(&mesh, &all), 2);
    assert!(open([&mesh]).is_empty());
}

#[test]
fn bodies_are_closed_by_poles() {
    const ROWS: &[[i8; 5]] = &[[-3, 0, 0, 0, 0], [-3, 0, 1, 2, 0], [3, 0, 1, 2, 0], [3, 0, 0, 0, 0]];
    for (sides, swell, expected) in [(4, SQUARE, 48.0), (4, 0.0, 24.0), (64, 0.0, 12.0 * std::f64::consts::PI)] {
        let mut mesh = Mesh::painted(&mustang::PAINTS);
        let body = Rings { rows: ROWS, sides, half: false, swell, taper: 0.0 };
        mesh.rings(&body, &Mat3A::IDENTITY, Vec3A::X, 0);
        let all: Vec<_> = (0..mesh.faces.len()).collect();
        assert!(open([&mesh]).is_empty());
        assert_eq!(euler(&mesh, &all), 2);
        let volume = volume(&mesh, &all);
        assert!((volume / expected - 1.0).abs() < 2e-3, "{sides} sides: {volume}, not {expected}");
    }
}

#[test]
fn the_mustang_is_closed_and_turned_outwards() {
    for (name, mesh, expected) in [("airframe", mustang::airframe(), 16), ("propeller", mustang::propeller(), 4)] {
        sound(name, &mesh);
        assert!(open([&mesh]).is_empty(), "{name} has open edges");
        let parts = parts(&mesh);
        assert_eq!(parts.len(), expected, "parts of the {name}");
        for part in parts {
            let at = corners(&mesh, part[0])[0];
            assert_eq!(euler(&mesh, &part), 2, "{name} at {at}");
            assert!(volume(&mesh, &part) > 0.0, "{name} at {at} is turned inside out");
        }
    }
}

#[test]
fn the_mustang_has_its_size() {
    let mesh = mustang::airframe();
    assert!((1900..=2400).contains(&mesh.faces.len()), "{} triangles", mesh.faces.len());
    assert!(worst_lean(&mesh) > LEAN, "a normal leans away by {}", worst_lean(&mesh));
    let low = mesh.points.iter().copied().reduce(Vec3A::min).unwrap();
    let high = mesh.points.iter().copied().reduce(Vec3A::max).unwrap();
    let size = high - low;
    // 11.28 m wide and 9.83 m long, to the half grid of its tables.
    assert!((size.x - 11.28).abs() < 0.05 && (size.z - 9.83).abs() < 0.05, "{size}");
    assert!(low.z < -3.0, "the nose points along -z");
}

#[test]
fn the_mustang_is_its_own_mirror_image() {
    let mesh = mustang::airframe();
    let (left, right) = (mesh.faces.len() / 2, mesh.points.len() / 2);
    for i in 0..right {
        let mirrored = |v: Vec3A| vec3a(-v.x, v.y, v.z);
        assert_eq!(mesh.points[i + right], mirrored(mesh.points[i]));
        assert!((mesh.normals[i + right] - mirrored(mesh.normals[i])).length() < 1e-6);
    }
    for i in 0..left {
        let (a, b) = (mesh.faces[i], mesh.faces[i + left]);
        let turned = [b.corners[0], b.corners[2], b.corners[1]].map(|c| c - right as u16);
        assert_eq!((a.corners, a.paint), (turned, b.paint));
    }
}

#[test]
fn the_ground_has_no_cracks() {
    let ground = land::ground();
    let faces: usize = ground.iter().map(|m| m.faces.len()).sum();
    assert!((15_000..=25_000).contains(&faces), "{faces} triangles");
    for (i, mesh) in ground.iter().enumerate() {
        sound(&format!("patch {i}"), mesh);
        assert!(mesh.faces.len() <= 1500, "{} triangles in patch {i}", mesh.faces.len());
        for i in 0..mesh.faces.len() {
            let [a, b, c] = corners(mesh, i);
            assert!((b - a).cross(c - a).y > 0.0, "the ground hangs over at {a}");
        }
    }
    let rim = |p: [u32; 3]| f32::from_bits(p[0]).hypot(f32::from_bits(p[2]));
    for (a, b) in open(&ground) {
        assert!(rim(a) > land::EDGE - 1.0 && rim(b) > land::EDGE - 1.0, "a crack {} m from the middle", rim(a));
    }
}

#[test]
fn the_ground_is_as_high_as_it_says() {
    for mesh in land::ground() {
        for (p, n) in mesh.points.iter().zip(&mesh.normals) {
            assert_eq!(p.y, land::height(p.x, p.z));
            assert!(n.y > 0.0);
        }
    }
    for i in 0..4000 {
        let [x, z] = [0, 1].map(|k| (rnd(9, i, k) - 0.5) * 2e4);
        let y = land::height(x, z);
        assert!(y.is_finite() && (-200.0..3000.0).contains(&y), "{y} at {x}, {z}");
    }
    // Mountains stand all around, but for the valley's two ends.
    let ring =
        |r: f32| (0..360).map(move |a| (a as f32).to_radians().sin_cos()).map(move |(s, c)| land::height(r * s, r * c));
    assert!(ring(5000.0).filter(|&y| y > 200.0).count() > 250);
}

#[test]
fn the_lake_is_level() {
    let lake = land::lake();
    sound("lake", &lake);
    let all: Vec<_> = (0..lake.faces.len()).collect();
    assert!(volume(&lake, &all) > 0.0);
    let top = lake.points.iter().map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
    // Rounded as 6 km are.
    assert!((top - land::WATER).abs() < 1e-3);
}

#[test]
fn trees_stand_on_the_ground() {
    let trees = tree::trees();
    assert!((300..=900).contains(&trees.len()), "{} trees", trees.len());
    for tree in &trees {
        let foot = tree.foot;
        assert_eq!(foot.y, land::height(foot.x, foot.z));
        assert!(foot.y > land::WATER && foot.length() > 20.0, "a tree at {foot}");
        assert!((3.0..25.0).contains(&tree.height));
    }
    let woods = tree::woods(&trees);
    let all: usize = woods.iter().map(|m| m.faces.len()).sum();
    assert!(all < 40_000, "{all} triangles");
    for (i, mesh) in woods.iter().enumerate() {
        sound(&format!("grove {i}"), mesh);
    }
}

#[test]
fn trees_are_open_only_below() {
    for (fir, far, band) in
        [(true, false, 60..=130), (true, true, 16..=30), (false, false, 250..=400), (false, true, 16..=30)]
    {
        for seed in 0..20 {
            let mut mesh = Mesh::painted(&paprsek::scenes::models::PAINTS);
            let tree = tree::Tree { foot: vec3a(30.0, 2.0, -40.0), height: 10.0, seed, fir };
            tree::grow(&mut mesh, &tree, far);
            let name = format!("tree {seed}, fir {fir}, far {far}");
            sound(&name, &mesh);
            assert!(band.contains(&mesh.faces.len()), "{name}: {} triangles", mesh.faces.len());
            // Trunks end in the ground and in the crown.
            for part in parts(&mesh) {
                assert!(volume(&mesh, &part) > 0.0, "{name} is turned inside out");
            }
            let trunk = mesh.faces.iter().filter(|f| f.paint % 3 == paprsek::scenes::models::paint::BARK).count();
            assert!(open([&mesh]).len() <= trunk, "{name}: {} open edges", open([&mesh]).len());
            let (middle, radius) = mesh.bound();
            assert!(middle.distance(tree.foot) < 8.0 && radius < 9.0, "{name}");
        }
    }
}

#[test]
fn the_chapel_is_open_only_at_its_pillars() {
    let mesh = chapel::chapel();
    sound("chapel", &mesh);
    assert!((200..=1300).contains(&mesh.faces.len()), "{} triangles", mesh.faces.len());
    for part in parts(&mesh) {
        let at = corners(&mesh, part[0])[0];
        assert!(volume(&mesh, &part) > 0.0, "the chapel at {at} is turned inside out");
    }
    // Both ends of four pillars.
    assert_eq!(open([&mesh]).len(), 4 * 2 * PILLAR_SIDES);
}

/// Strips around a pillar of the chapel.
const PILLAR_SIDES: usize = 8;

mod bench_set {
    use super::*;
    use paprsek::scenes::bench::shadow_set;

    /// Two writings of the set, this one with noise in f32: they agree to 2e-6.
    const TOLERANCE: f32 = 1e-5;
    /// The normals are differences over 0.1 m of heights that are 4e-7 off: measured, 3.6e-5.
    const NORMAL_TOLERANCE: f32 = 1e-4;

    #[test]
    fn it_is_what_the_specification_counts() {
        let meshes = shadow_set::meshes();
        let of = |from: usize, to: usize| meshes[from..to].iter().map(|m| m.faces.len()).sum::<usize>();
        assert_eq!((of(0, 4), of(4, 5), of(5, 9)), (4608, 768, 4608));
        for (i, mesh) in meshes.iter().enumerate() {
            sound(&format!("mesh {i}"), mesh);
            assert_eq!(mesh.normals.is_empty(), i >= 4, "only the ground is smooth");
        }
        let boxes = &meshes[4];
        assert!(open([boxes]).is_empty());
        assert!(parts(boxes).iter().all(|part| part.len() == 12 && volume(boxes, part) > 0.0));
        // 16 trunks of six sides are open at both ends.
        assert!(meshes[5..].iter().all(|m| open([m]).len() == 16 * 12));
        // The ground has no other border than its own.
        assert_eq!(open(&meshes[..4]).len(), 4 * 48);
    }

    #[test]
    fn it_sums_up_to_what_the_other_writing_does() {
        let (mut low, mut high, mut sum) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY, DVec3::ZERO);
        for mesh in shadow_set::meshes() {
            for i in 0..mesh.faces.len() {
                for p in corners(&mesh, i) {
                    (low, high, sum) = (low.min(p), high.max(p), sum + p.as_dvec3());
                }
            }
        }
        assert!(low.abs_diff_eq(vec3a(-24.0, -1.079_667, -24.0), TOLERANCE), "{low}");
        assert!(high.abs_diff_eq(vec3a(24.0, 6.303_766, 24.0), TOLERANCE), "{high}");
        let mean = sum / (3.0 * 9984.0);
        assert!(mean.abs_diff_eq(MEAN, 1e-6), "{mean}");
    }

    #[test]
    fn its_triangles_are_those_of_the_other_writing() {
        let meshes = shadow_set::meshes();
        for (points, normal, albedo) in TRIANGLES {
            let expected: [Vec3A; 3] = std::array::from_fn(|k| Vec3A::from_slice(&points[3 * k..]));
            let found = meshes.iter().any(|mesh| {
                (0..mesh.faces.len()).any(|i| {
                    let (face, c) = (mesh.faces[i], corners(mesh, i));
                    let same = |turn: usize| (0..3).all(|k| c[(k + turn) % 3].abs_diff_eq(expected[k], TOLERANCE));
                    let Some(turn) = (0..3).find(|&turn| same(turn)) else { return false };
                    let n = match mesh.normals.get(face.corners[turn] as usize) {
                        Some(&n) => n,
                        None => (c[1] - c[0]).cross(c[2] - c[0]).normalize(),
                    };
                    n.abs_diff_eq(normal.into(), NORMAL_TOLERANCE)
                        && mesh.paints[face.paint as usize].albedo.abs_diff_eq(albedo.into(), NORMAL_TOLERANCE)
                })
            });
            assert!(found, "no triangle {expected:?} of this colour");
        }
    }

    #[test]
    fn eye_and_lights_move_as_specified() {
        // The formulas of the specification at t = 2, computed apart.
        assert!(shadow_set::eye(2.0).abs_diff_eq(EYE, 1e-6));
        assert!(shadow_set::sun(2.0).abs_diff_eq(SUN, 1e-6));
        assert!(shadow_set::torch(2.0).abs_diff_eq(TORCH, 1e-5));
    }

    // Recorded from the second writing of the specification, in Python and f64: the mean of all corners; the lights;
    // and every 312th triangle and some more: corners, the first one's normal, albedo.
    const MEAN: DVec3 = DVec3::new(-0.45054982, 0.77146230, 0.84468647);
    const EYE: DVec3 = DVec3::new(8.17778519, 8.00000000, 19.34228087);
    const SUN: DVec3 = DVec3::new(0.81194305, 0.52693967, 0.25116342);
    const TORCH: DVec3 = DVec3::new(2.70151153, 2.56046855, 4.20735492);
    #[rustfmt::skip]
    const TRIANGLES: [([f32; 9], [f32; 3], [f32; 3]); 37] = [
        ([-24.0, 0.34353, -24.0, -24.0, 0.22514, -23.0, -23.0, 0.3977, -24.0], [-0.0476, 0.9934, 0.1046], [0.82, 0.85, 0.9]),
        ([-12.0, 0.59469, -21.0, -12.0, 0.57989, -20.0, -11.0, 0.65222, -21.0], [0.022, 0.9974, 0.0683], [0.82, 0.85, 0.9]),
        ([0.0, -0.22646, -18.0, 0.0, -0.23674, -17.0, 1.0, -0.462, -18.0], [0.2588, 0.9649, -0.0448], [0.82, 0.85, 0.9]),
        ([12.0, -0.39384, -15.0, 12.0, -0.39927, -14.0, 13.0, -0.36699, -15.0], [-0.0749, 0.9947, -0.0706], [0.82, 0.85, 0.9]),
        ([-24.0, -0.08408, -11.0, -24.0, -0.04545, -10.0, -23.0, -0.02639, -11.0], [-0.0003, 0.9995, 0.0319], [0.82, 0.85, 0.9]),
        ([-12.0, -0.04812, -8.0, -12.0, -0.0134, -7.0, -11.0, -0.1544, -8.0], [0.068, 0.9972, -0.0312], [0.82, 0.85, 0.9]),
        ([0.0, -0.02046, -5.0, 0.0, -0.19689, -4.0, 1.0, -0.03847, -5.0], [-0.0059, 0.9934, 0.1146], [0.82, 0.85, 0.9]),
        ([12.0, -0.07679, -2.0, 12.0, -0.00199, -1.0, 13.0, -0.06722, -2.0], [0.0283, 0.9919, -0.1241], [0.82, 0.85, 0.9]),
        ([-24.0, 0.28649, 2.0, -24.0, 0.46469, 3.0, -23.0, 0.12371, 2.0], [0.1529, 0.9731, -0.1726], [0.82, 0.85, 0.9]),
        ([-12.0, -0.31317, 5.0, -12.0, -0.21496, 6.0, -11.0, -0.15082, 5.0], [-0.0653, 0.9977, -0.0204], [0.82, 0.85, 0.9]),
        ([0.0, 0.16461, 8.0, 0.0, 0.26247, 9.0, 1.0, 0.25184, 8.0], [-0.0864, 0.9913, -0.0992], [0.82, 0.85, 0.9]),
        ([12.0, 0.15797, 11.0, 12.0, 0.02647, 12.0, 13.0, 0.12075, 11.0], [0.0937, 0.9896, 0.1091], [0.82, 0.85, 0.9]),
        ([-24.0, 0.18447, 15.0, -24.0, 0.23303, 16.0, -23.0, 0.3269, 15.0], [-0.265, 0.964, -0.0245], [0.82, 0.85, 0.9]),
        ([-12.0, 0.60539, 18.0, -12.0, 0.64332, 19.0, -11.0, 0.37366, 18.0], [0.1271, 0.9896, -0.0671], [0.82, 0.85, 0.9]),
        ([0.0, 0.02045, 21.0, 0.0, -0.07473, 22.0, 1.0, -0.02925, 21.0], [0.0462, 0.9987, 0.021], [0.82, 0.85, 0.9]),
        ([-3.13854, -0.13012, -14.315, -3.85551, -0.13012, -14.04602, -3.85551, 2.06165, -14.04602], [-0.3512, 0.0, -0.9363], [0.4447, 0.3, 0.22]),
        ([17.51931, -0.26252, -1.33177, 17.69683, -0.26252, -2.04574, 17.69683, 1.02747, -2.04574], [0.9705, 0.0, 0.2413], [0.5978, 0.3, 0.22]),
        ([5.58778, -0.65081, -18.01416, 4.98089, -0.65081, -18.54748, 4.98089, -0.0115, -18.54748], [0.6601, 0.0, -0.7512], [0.443, 0.3, 0.22]),
        ([-19.25615, 0.5042, -2.50402, -18.8434, 0.5042, -2.21946, -18.61187, 1.55873, -2.99689], [-0.4581, 0.5904, 0.6645], [0.1, 0.3681, 0.13]),
        ([6.46284, 1.32687, 14.117, 5.9739, 1.32687, 14.13238, 6.24204, 2.56362, 14.8771], [-0.0269, 0.5199, -0.8538], [0.1, 0.3502, 0.13]),
        ([18.89384, -0.14893, -20.99266, 19.05691, -0.14893, -20.96998, 19.05691, 1.02708, -20.96998], [-0.1377, 0.0, 0.9905], [0.25, 0.16, 0.1]),
        ([-16.15577, 0.5534, 2.03401, -15.47822, 0.5534, 1.65414, -16.40156, 2.1873, 0.80143], [0.3947, 0.5904, 0.704], [0.1, 0.3488, 0.13]),
        ([13.19552, 0.97799, -4.38659, 13.24006, 0.97799, -3.8703, 14.01228, 2.28813, -4.19699], [-0.851, 0.5199, 0.0734], [0.1, 0.2625, 0.13]),
        ([14.57618, 0.035, -21.70893, 14.74561, 0.035, -21.75897, 14.74561, 1.29691, -21.75897], [0.2832, 0.0, 0.959], [0.25, 0.16, 0.1]),
        ([11.98547, 0.76881, 8.54261, 11.4125, 0.76881, 9.0599, 12.49502, 2.39255, 9.68298], [-0.5408, 0.5904, -0.5991], [0.1, 0.3413, 0.13]),
        ([2.4762, 1.13705, -9.98921, 2.02883, 1.13705, -10.19203, 1.9404, 2.37888, -9.4022], [0.3527, 0.5199, -0.778], [0.1, 0.3435, 0.13]),
        ([-16.4514, -0.69446, 7.59226, -16.62506, -0.69446, 7.62868, -16.62506, 0.57298, 7.62868], [-0.2053, 0.0, -0.9787], [0.25, 0.16, 0.1]),
        ([-12.38946, 0.87046, -13.28807, -13.04393, 0.87046, -12.7338, -11.86376, 2.67445, -12.00381], [-0.5216, 0.5904, -0.6159], [0.1, 0.3331, 0.13]),
        ([20.66866, 0.5159, 19.7477, 20.35963, 0.5159, 19.45299, 20.06063, 1.59551, 20.07589], [0.5895, 0.5199, -0.6182], [0.1, 0.2872, 0.13]),
        ([2.08649, -0.00291, 11.36925, 2.18681, -0.00291, 11.30563, 2.18681, 0.84553, 11.30563], [0.5356, 0.0, 0.8445], [0.25, 0.16, 0.1]),
        ([0.61884, 0.80508, 20.8225, 0.90871, 0.80508, 20.10945, -0.33351, 2.42415, 20.0199], [0.7477, 0.5904, 0.3039], [0.1, 0.3451, 0.13]),
        ([-3.1204, 1.28746, -9.2373, -2.87533, 1.28746, -8.78324, -2.29913, 2.59195, -9.3874], [-0.7517, 0.5199, 0.4057], [0.1, 0.2919, 0.13]),
        ([24.0, -0.33576, 23.0, 23.0, -0.30978, 24.0, 24.0, -0.25487, 24.0], [-0.1603, 0.9851, -0.0616], [0.82, 0.85, 0.9]),
        ([21.40373, -0.18375, -2.15419, 22.65756, -0.18375, -3.0329, 22.65756, 1.03654, -3.0329], [0.5739, 0.0, 0.8189], [0.4798, 0.3, 0.22]),
        ([11.41933, -0.32511, -6.3613, 9.73476, 0.65781, -6.70237, 11.41933, 0.65781, -6.3613], [0.1984, 0.0, -0.9801], [0.5057, 0.3, 0.22]),
        ([-13.42123, -0.64633, 3.16859, -13.46727, -0.64633, 3.01932, -13.46727, 0.46946, 3.01932], [0.9556, 0.0, -0.2947], [0.25, 0.16, 0.1]),
        ([0.14398, 1.16114, -9.72042, -0.09708, 1.16114, -9.69326, -0.01833, 1.16114, -10.07779], [-0.0, -1.0, 0.0], [0.1, 0.31, 0.13]),
    ];
}
