//! Coverage and depth of triangles against whole numbers that cannot overflow: no gap, no overdraw, the nearest wins.
//!
//! The projection is the identity, so corners are where a test puts them, in steps of 1/256 pixel.

use fearless_simd::{Level, Simd, dispatch};
use glam::{Affine3A, Vec3, Vec4, vec3};
use paprsek::frame::Tile;
use paprsek::raster::bins::Bins;
use paprsek::raster::fill::{CENTER, SubPixel, Visible, fill};
use paprsek::raster::id::{NOTHING, parts};
use paprsek::raster::triangle::{SUB, SetupMesh, TriangleSetup};
use paprsek::raster::{Face, Mesh, Paint, Projection};
use testkit::{ULP, random::Random};

/// Steps of 1/256 pixel, and nearness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Corner {
    x: i32,
    y: i32,
    near: f32,
}

type Corners = [Corner; 3];

/// Odd, one pixel, whole tiles, a pixel more and less than tiles.
const SIZES: [[u32; 2]; 5] = [[100, 70], [64, 64], [65, 63], [1, 1], [131, 5]];
/// Corners may be that far from the picture's middle before they are clipped, steps.
const GUARD: i32 = 16384 * SUB;

fn piece(triangles: &[Corners], size: [u32; 2], back_faces: bool) -> SetupMesh {
    let mut mesh = Mesh { paints: vec![Paint { albedo: Vec3::ONE, texture: None, gloss: 0.0 }], ..Mesh::default() };
    for corners in triangles {
        let first = mesh.points.len() as u16;
        mesh.faces.push(Face { corners: [first, first + 1, first + 2], paint: 0 });
        let step = 1.0 / SUB as f32;
        mesh.points.extend(corners.map(|c| vec3(c.x as f32 * step, c.y as f32 * step, c.near)));
    }
    let projection = Projection { rows: Vec4::AXES, size, texel: 1.0 };
    TriangleSetup { projection, back_faces, shaded: false }.set_up(&mesh, &Affine3A::IDENTITY)
}

/// What each pixel of a picture shows: nearness and number of the triangle.
#[derive(Clone, PartialEq, Debug)]
struct Shown(Vec<(f32, Option<usize>)>);

/// Draws pieces as a frame does: by the tiles' lists.
fn draw(level: Level, pieces: &[SetupMesh], size: [u32; 2], sample: SubPixel) -> Shown {
    #[inline(always)]
    fn tile<S: Simd>(simd: S, pieces: &[SetupMesh], ids: &[u32], at: [usize; 2], sample: SubPixel, out: &mut Visible) {
        fill(simd, pieces, ids, at[0] as i32, at[1] as i32, sample, out);
    }
    let [width, height] = size.map(|n| n as usize);
    let bins = Bins::new(pieces, size);
    let mut shown = vec![(0.0, None); width * height];
    let mut out = Visible { inv_depth: Box::new([0.0; Tile::AREA]), id: Box::new([NOTHING; Tile::AREA]) };
    for y in (0..height).step_by(Tile::SIZE) {
        for x in (0..width).step_by(Tile::SIZE) {
            let ids = bins.of(x / Tile::SIZE, y / Tile::SIZE);
            if ids.is_empty() {
                continue;
            }
            out.inv_depth.fill(0.0);
            out.id.fill(NOTHING);
            dispatch!(level, simd => tile(simd, pieces, ids, [x, y], sample, &mut out));
            for row in 0..Tile::SIZE.min(height - y) {
                for column in 0..Tile::SIZE.min(width - x) {
                    let at = row * Tile::SIZE + column;
                    let id = (out.id[at] != NOTHING).then(|| parts(out.id[at]).1);
                    shown[(y + row) * width + x + column] = (out.inv_depth[at], id);
                }
            }
        }
    }
    Shown(shown)
}

/// Where the sample of a pixel is, steps.
fn sample_of(pixel: usize, width: u32, sample: SubPixel) -> [i128; 2] {
    let (x, y) = (pixel as i128 % width as i128, pixel as i128 / width as i128);
    [x * SUB as i128 + sample[0] as i128, y * SUB as i128 + sample[1] as i128]
}

/// Twice the area of `a`, `b` and a point; positive where they turn clockwise on the screen.
fn turn(a: Corner, b: Corner, s: [i128; 2]) -> i128 {
    (b.x as i128 - a.x as i128) * (s[1] - a.y as i128) - (b.y as i128 - a.y as i128) * (s[0] - a.x as i128)
}

fn area(t: &Corners) -> i128 {
    turn(t[0], t[1], [t[2].x as i128, t[2].y as i128])
}

/// Is a point a hair to the right of the sample, and a hair of that hair below it, inside? That is the top-left rule:
/// such a point is on no edge.
fn covers(t: &Corners, s: [i128; 2]) -> bool {
    let sign = area(t).signum();
    sign != 0
        && (0..3).all(|k| {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            let (dx, dy) = (sign * (b.x as i128 - a.x as i128), sign * (b.y as i128 - a.y as i128));
            (sign * turn(a, b, s), -dy, dx) > (0, 0, 0)
        })
}

/// A number of steps that is likely to go wrong, about a picture of `size` pixels.
fn hard(random: &mut Random, size: u32) -> i32 {
    let pixel = random.range(-20.0, size as f64 + 20.0).floor() as i32 * SUB;
    match (random.unit() * 6.0) as u32 {
        0 => pixel,
        1 => pixel + SUB / 2,
        2 => (pixel / (SUB * 64)) * SUB * 64 + (random.unit() * 3.0) as i32 - 1,
        3 => pixel + SUB / 2 + (random.unit() * 3.0) as i32 - 1,
        4 => pixel + (random.unit() * SUB as f64) as i32,
        _ => [0, SUB / 2, size as i32 * SUB, size as i32 * SUB - SUB / 2][(random.unit() * 4.0) as usize],
    }
}

/// Triangles of every hard kind.
fn any_triangle(random: &mut Random, size: [u32; 2]) -> Corners {
    let mut t = [Corner::default(); 3];
    for corner in &mut t {
        *corner = Corner {
            x: hard(random, size[0]),
            y: hard(random, size[1]),
            near: random.log(1e-5, 1.0) as f32, // More than nothing, which is 0.
        };
    }
    let wiggle = |random: &mut Random, k: i32| (random.unit() * (2 * k + 1) as f64) as i32 - k;
    match (random.unit() * 8.0) as u32 {
        // Tiny.
        0 => {
            for i in 1..3 {
                (t[i].x, t[i].y) = (t[0].x + wiggle(random, 300), t[0].y + wiggle(random, 300));
            }
        }
        // Slivers: two corners in almost one place, or the third almost on the edge between the others.
        1 => (t[1].x, t[1].y) = (t[0].x + wiggle(random, 2), t[0].y + wiggle(random, 2)),
        2 => {
            let k = random.unit();
            let between = |a: i32, b: i32| a + ((b - a) as f64 * k).round() as i32;
            (t[2].x, t[2].y) = (between(t[0].x, t[1].x), between(t[0].y, t[1].y));
            (t[2].x, t[2].y) = (t[2].x + wiggle(random, 1), t[2].y + wiggle(random, 1));
        }
        // An edge along a row or a column of samples.
        3 => t[1].y = t[0].y,
        4 => t[2].x = t[0].x,
        // Huge, up to the guard band and exactly on it.
        5 => {
            for corner in &mut t {
                let at = |random: &mut Random, size: u32| {
                    let far = random.range(-1.0, 1.0) * 1.3 * GUARD as f64;
                    (far as i32).clamp(-GUARD, GUARD) + size as i32 * SUB / 2
                };
                (corner.x, corner.y) = (at(random, size[0]), at(random, size[1]));
            }
        }
        // A hair wide, with a long edge through samples: all digits of f32 cancel in its plane.
        6 => {
            for corner in &mut t[..2] {
                let center = |x: i32| x.div_euclid(SUB) * SUB + SUB / 2;
                (corner.x, corner.y) = (center(corner.x), center(corner.y));
            }
            (t[1].x, t[1].y) =
                (t[0].x + (t[1].x - t[0].x) / SUB / 4 * 4 * SUB, t[0].y + (t[1].y - t[0].y) / SUB / 4 * 4 * SUB);
            (t[2].x, t[2].y) = (t[1].x + wiggle(random, 2), t[1].y + wiggle(random, 2));
        }
        _ => {}
    }
    t
}

#[test]
fn coverage_is_exact() {
    let mut random = Random(1);
    let (mut pixels, mut covered, mut drawn) = (0u64, 0u64, 0u64);
    for case in 0..3000 {
        let size = SIZES[if case % 3 == 0 { case / 3 % SIZES.len() } else { 0 }];
        let t = any_triangle(&mut random, size);
        let sample = match case % 4 {
            0 | 1 => CENTER,
            2 => [[0, 0], [SUB - 1, 0], [0, SUB - 1], [SUB - 1; 2]][case / 4 % 4],
            _ => [0, 1].map(|_| (random.unit() * SUB as f64) as i32),
        };
        let back_faces = case % 5 == 0;
        // Counter-clockwise looks here.
        let here = if back_faces { area(&t) > 0 } else { area(&t) < 0 };
        let piece = [piece(&[t], size, back_faces)];
        drawn += here as u64;
        for (name, level) in testkit::levels() {
            let shown = draw(level, &piece, size, sample);
            for (pixel, found) in shown.0.iter().enumerate() {
                let truth = here && covers(&t, sample_of(pixel, size[0], sample));
                assert_eq!(found.1.is_some(), truth, "{name}: pixel {pixel} of {size:?}, sample {sample:?}: {t:?}");
                covered += truth as u64;
                pixels += 1;
            }
        }
    }
    // The cases are worth something: about half of the triangles look here, and they cover pixels.
    assert!(drawn > 1200 && covered > pixels / 100, "{drawn} triangles, {covered} of {pixels} pixels");
}

/// How often each pixel is covered when each triangle is drawn alone.
fn counts(level: Level, triangles: &[Corners], size: [u32; 2], sample: SubPixel) -> Vec<u32> {
    let mut counts = vec![0; (size[0] * size[1]) as usize];
    for t in triangles {
        // Whichever way it looks.
        let shown = draw(level, &[piece(&[*t], size, area(t) > 0)], size, sample);
        for (count, pixel) in counts.iter_mut().zip(shown.0) {
            *count += pixel.1.is_some() as u32;
        }
    }
    counts
}

#[test]
fn grids_have_no_gap_and_no_overdraw() {
    let mut random = Random(2);
    let size = [100, 70];
    for case in 0..30 {
        // Cells of 16 to 40 pixels, all around the picture.
        let cell = [16 * SUB, 20 * SUB + SUB / 2, 40 * SUB, 25 * SUB + 77, 16 * SUB + SUB / 2][case % 5];
        let (columns, rows) = (100 * SUB / cell + 4, 70 * SUB / cell + 4);
        // Less than would turn a triangle over.
        let jitter = [0, 1, SUB / 2, cell / 5][case % 4];
        let mut points = Vec::new();
        for j in 0..=rows {
            for i in 0..=columns {
                let mut off = || random.range(-jitter as f64, jitter as f64 + 1.0).floor() as i32;
                points.push(Corner { x: (i - 1) * cell - SUB + off(), y: (j - 1) * cell - SUB + off(), near: 1.0 });
            }
        }
        let mut triangles = Vec::new();
        for j in 0..rows as usize {
            for i in 0..columns as usize {
                let at = |i: usize, j: usize| points[j * (columns as usize + 1) + i];
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
                triangles.extend(if random.unit() < 0.5 { [[a, c, b], [b, c, d]] } else { [[a, c, d], [a, d, b]] });
            }
        }
        let sample = if case % 2 == 0 { CENTER } else { [(random.unit() * SUB as f64) as i32, 0] };
        for (name, level) in testkit::levels() {
            let counts = counts(level, &triangles, size, sample);
            let off: Vec<_> = counts.iter().enumerate().filter(|c| *c.1 != 1).take(5).collect();
            assert!(off.is_empty(), "{name}, case {case}: {off:?}");
        }
    }
}

#[test]
fn fans_cover_their_polygon_exactly_once() {
    let mut random = Random(3);
    let size = [100, 70];
    let mut inside = 0;
    for case in 0..120 {
        // A star of spokes around a corner, which may lie on a sample; corners rounded to whole steps.
        let grid = [1, SUB / 2, SUB][case % 3];
        let round = |x: f64| (x * SUB as f64 / grid as f64).round() as i32 * grid;
        let (x, y) = (round(random.range(20.0, 80.0)), round(random.range(20.0, 50.0)));
        let spokes = 3 + case as i32 % 40;
        let mut rim: Vec<Corner> = Vec::new();
        for k in 0..spokes {
            let (sin, cos) = ((k as f64 + random.range(0.0, 0.8)) / spokes as f64 * std::f64::consts::TAU).sin_cos();
            // The last cases reach around the picture.
            let r = if case < 100 { random.log(0.3, 45.0) } else { random.log(300.0, 9000.0) };
            rim.push(Corner { x: x + round(r * cos), y: y + round(r * sin), near: 1.0 });
        }
        let center = Corner { x, y, near: 1.0 };
        let fan: Vec<Corners> = (0..rim.len()).map(|k| [center, rim[k], rim[(k + 1) % rim.len()]]).collect();
        // Rounding may turn a triangle over, or three spokes leave more than half a turn between two.
        if fan.iter().any(|t| area(t) < 0) {
            continue;
        }
        for (name, level) in testkit::levels() {
            for (pixel, count) in counts(level, &fan, size, CENTER).into_iter().enumerate() {
                // Edges that a line to the right crosses, from a hair to the right of the sample and below it.
                let s = sample_of(pixel, size[0], CENTER);
                let crossed = (0..rim.len()).filter(|&k| {
                    let (a, b) = (rim[k], rim[(k + 1) % rim.len()]);
                    let (a_below, b_below) = (a.y as i128 > s[1], b.y as i128 > s[1]);
                    a_below != b_below && turn(a, b, s) * (if b_below { 1 } else { -1 }) > 0
                });
                let truth = crossed.count() as u32 % 2;
                assert_eq!(count, truth, "{name}, case {case}: pixel {pixel}, {rim:?}");
                inside += truth;
            }
        }
    }
    assert!(inside > 100_000, "{inside}");
}

/// Nearness of a triangle's plane at a point, and the sum of the terms' sizes that f32 adds up, whatever corner it
/// starts from.
fn plane(t: &Corners, s: [i128; 2]) -> (f64, f64) {
    let whole = area(t) as f64;
    let mut z = 0.0;
    let (mut zx, mut zy) = (0.0, 0.0);
    for k in 0..3 {
        let (a, b) = (t[(k + 1) % 3], t[(k + 2) % 3]);
        let near = t[k].near as f64;
        z += near * (turn(a, b, s) as f64 / whole);
        zx -= near * (b.y as f64 - a.y as f64) / whole;
        zy += near * (b.x as f64 - a.x as f64) / whole;
    }
    let reach = |at: i128, v: [i32; 3]| v.map(|x| (x as f64 - at as f64).abs()).into_iter().fold(0.0, f64::max);
    let (dx, dy) = (reach(s[0], t.map(|c| c.x)), reach(s[1], t.map(|c| c.y)));
    let largest = t.map(|c| c.near as f64).into_iter().fold(0.0, f64::max);
    (z, largest + zx.abs() * dx + zy.abs() * dy)
}

/// Roundings of the largest term: two slopes, two offsets, two products, two sums.
const NEARNESS: f64 = 6.0;

#[test]
fn nearness_is_the_plane_and_stays_between_the_corners() {
    let mut random = Random(4);
    let size = SIZES[0];
    let (mut worst, mut slivers) = (0f64, 0);
    for _ in 0..4000 {
        let mut t = any_triangle(&mut random, size);
        if random.unit() < 0.3 {
            // From the near plane to the horizon.
            t.iter_mut().for_each(|c| c.near = random.log(1e-5, 20.0) as f32);
        }
        let piece = [piece(&[t], size, area(&t) > 0)];
        let (low, high) = t.iter().fold((f32::MAX, 0f32), |(l, h), c| (l.min(c.near), h.max(c.near)));
        let mut first: Option<Shown> = None;
        for (name, level) in testkit::levels() {
            let shown = draw(level, &piece, size, CENTER);
            for (pixel, found) in shown.0.iter().enumerate().filter(|(_, p)| p.1.is_some()) {
                assert!(found.0 >= low && found.0 <= high, "{name}: {found:?} of {t:?}");
                let (truth, terms) = plane(&t, sample_of(pixel, size[0], CENTER));
                let error = (found.0 as f64 - truth).abs() / (ULP * terms);
                assert!(error <= NEARNESS, "{name}: {} instead of {truth}, {error} roundings: {t:?}", found.0);
                worst = worst.max(error);
                slivers += (terms > 100.0) as u32;
            }
            assert_eq!(&shown, first.get_or_insert_with(|| shown.clone()), "{name}: {t:?}");
        }
    }
    println!("inv_depth: {worst:.2} roundings; {slivers} pixels of slivers");
    assert!(slivers > 100, "{slivers}");
}

#[test]
fn the_nearest_wins_in_any_order() {
    let mut random = Random(5);
    let size = [100, 70];
    let mut shared = 0;
    for case in 0..60 {
        // Through one another: nearness varies as much over a triangle as between them.
        let mut triangles: Vec<Corners> = (0..24).map(|_| any_triangle(&mut random, size)).collect();
        for t in &mut triangles {
            if area(t) > 0 {
                t.swap(1, 2);
            }
        }
        let mut orders = vec![triangles.clone()];
        triangles.reverse();
        orders.push(triangles.clone());
        triangles.rotate_left(7);
        orders.push(triangles.clone());
        for (name, level) in testkit::levels() {
            let shown: Vec<Shown> =
                orders.iter().map(|t| draw(level, &[piece(t, size, false)], size, CENTER)).collect();
            for pixel in 0..shown[0].0.len() {
                let s = sample_of(pixel, size[0], CENTER);
                let bits = |k: usize| shown[k].0[pixel].0.to_bits();
                assert!(bits(0) == bits(1) && bits(0) == bits(2), "{name}, case {case}, pixel {pixel}");
                // Slivers are as uncertain as their terms are large, but never outside of their corners.
                let here = orders[0].iter().filter(|t| covers(t, s));
                let bounds = here.map(|t| {
                    let (z, terms) = plane(t, s);
                    let corners = t.map(|c| c.near as f64);
                    let (low, high) = corners.iter().fold((f64::MAX, 0f64), |(l, h), c| (l.min(*c), h.max(*c)));
                    let error = NEARNESS * ULP * terms;
                    ((z - error).max(low), (z + error).min(high))
                });
                let bounds: Vec<_> = bounds.collect();
                shared += (bounds.len() > 1) as u32;
                let found = shown[0].0[pixel].0 as f64;
                let low = bounds.iter().fold(0f64, |l, b| l.max(b.0));
                let high = bounds.iter().fold(0f64, |h, b| h.max(b.1));
                assert!(found >= low && found <= high, "{name}, case {case}: {found} not in {low} to {high}");
                if let Some(id) = shown[0].0[pixel].1 {
                    // Triangles without an area have no number.
                    let drawn: Vec<&Corners> = orders[0].iter().filter(|t| area(t) != 0 && visible(t, size)).collect();
                    assert!(covers(drawn[id], s), "{name}, case {case}: pixel {pixel} shows what is not there");
                }
            }
        }
    }
    assert!(shared > 10_000, "{shared}");
}

/// May a triangle touch the picture, by its bounding box in whole pixels?
fn visible(t: &Corners, size: [u32; 2]) -> bool {
    let (xs, ys) = (t.map(|c| c.x), t.map(|c| c.y));
    let all_outside = |v: [i32; 3], size: u32| v.iter().all(|&x| x < 0) || v.iter().all(|&x| x > size as i32 * SUB);
    let touches = |v: [i32; 3], size: u32| {
        let (low, high) = (*v.iter().min().unwrap(), *v.iter().max().unwrap());
        high.div_euclid(SUB) >= 0 && low.div_euclid(SUB) < size as i32
    };
    !all_outside(xs, size[0]) && !all_outside(ys, size[1]) && touches(xs, size[0]) && touches(ys, size[1])
}
