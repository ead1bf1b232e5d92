//! Coverage and depth of triangles against whole numbers that cannot overflow: no gap, no overdraw, the nearest wins.
//!
//! The projection is the identity, so corners are where a test puts them, in steps of 1/256 pixel.

use fearless_simd::dispatch;
use paprsek::frame::Tile;
use paprsek::raster::fill::fill;
use paprsek::raster::id::{NOTHING, PLAIN, join, of_mesh};
use paprsek::raster::setup::SetupMesh;
use paprsek::raster::triangle::SUB;
use paprsek::raster::visible::{CENTER, Visible};
use testkit::coverage::{
    Corner, Corners, NEARNESS, SHEET, SIZES, Shown, Single, any_triangle, area, counts, covers, deep_triangle, draw,
    fan, grid, piece, plane, sample_of, single, turn,
};
use testkit::{ULP, random::Random};

#[test]
fn coverage_is_exact() {
    let mut random = Random(1);
    let (mut pixels, mut covered, mut drawn) = (0u64, 0u64, 0u64);
    for case in 0..3000 {
        let Single { corners: t, size, sample, back_faces, here } = single(&mut random, case);
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

#[test]
fn grids_have_no_gap_and_no_overdraw() {
    let mut random = Random(2);
    for case in 0..30 {
        let (triangles, sample) = grid(&mut random, case);
        for (name, level) in testkit::levels() {
            let counts = counts(level, &triangles, SHEET, sample);
            let off: Vec<_> = counts.iter().enumerate().filter(|c| *c.1 != 1).take(5).collect();
            assert!(off.is_empty(), "{name}, case {case}: {off:?}");
        }
    }
}

#[test]
fn fans_cover_their_polygon_exactly_once() {
    let mut random = Random(3);
    let mut inside = 0;
    for case in 0..120 {
        let Some((fan, rim)) = fan(&mut random, case, case >= 100) else { continue };
        for (name, level) in testkit::levels() {
            for (pixel, count) in counts(level, &fan, SHEET, CENTER).into_iter().enumerate() {
                // Edges that a line to the right crosses, from a hair to the right of the sample and below it.
                let s = sample_of(pixel, SHEET[0], CENTER);
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

#[test]
fn nearness_is_the_plane_and_stays_between_the_corners() {
    let mut random = Random(4);
    let size = SIZES[0];
    let (mut worst, mut slivers) = (0f64, 0);
    for _ in 0..4000 {
        let t = deep_triangle(&mut random);
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

/// What is hidden is left out before it is drawn, by blocks of all samples: here behind walls, level or slanted, whose
/// edges run between the samples of the tile's outer pixels.
#[test]
fn hidden_triangles_change_nothing() {
    const SIZE: [u32; 2] = [64; 2];
    let mut random = Random(6);
    for case in 0..40 {
        let mut triangles = Vec::new();
        for k in 0..120 {
            let near = [0.5, 0.25, 0.5, 0.5 + f32::EPSILON, 0.75][if k % 8 == 0 { 0 } else { 1 + k % 4 }];
            let mut step = |low: f64, high: f64| (random.range(low, high) * f64::from(SUB)) as i32;
            let [x, y] = [step(0.0, 64.0), step(0.0, 64.0)];
            let mut t: Corners = [0; 3].map(|_| {
                let [x, y] = [x + step(-6.0, 6.0), y + step(-6.0, 6.0)];
                Corner { x, y, near: near + if case % 2 == 0 { 0.0 } else { step(0.0, 0.1) as f32 / SUB as f32 } }
            });
            if k % 8 == 0 {
                // A wall whose upright and level edges run through the pixels along the edges of the tile.
                let [mut left, mut right, mut top, mut bottom] =
                    [0, 64, 0, 64].map(|edge| edge * SUB + step(-1.0, 1.0));
                if k % 16 == 0 {
                    (left, right) = (right, left);
                }
                if k % 32 < 16 {
                    (top, bottom) = (bottom, top);
                }
                for (corner, (x, y)) in t.iter_mut().zip([(left, top), (right, top), (left, bottom)]) {
                    (corner.x, corner.y) = (x, y);
                }
            }
            if area(&t) > 0 {
                t.swap(1, 2);
            }
            triangles.push(t);
        }
        let places = [[40, 200], [100, 20], [160, 100], [220, 240]];
        for (name, level) in testkit::levels() {
            let pieces: Vec<SetupMesh> = triangles.iter().map(|t| piece(&[*t], SIZE, false)).collect();
            let mut planes = places.map(|place| (Visible::default(), place));
            planes.iter_mut().for_each(|(visible, _)| visible.clear(&[0.0; Tile::AREA]));
            dispatch!(level, simd => fill(simd, &mut pieces.iter(), [0, 0], &mut planes));
            for (visible, place) in &planes {
                // The first of the nearest, where each is drawn alone.
                let mut truth = vec![(0.0, NOTHING); Tile::AREA];
                for (number, piece) in pieces.iter().enumerate() {
                    let alone = draw(level, std::slice::from_ref(piece), SIZE, *place).0;
                    for (truth, (near, _)) in truth.iter_mut().zip(alone) {
                        if near > truth.0 {
                            *truth = (near, of_mesh(number, join(0, PLAIN)));
                        }
                    }
                }
                let found: Vec<_> = visible.inv_depth.iter().copied().zip(visible.id.iter().copied()).collect();
                assert_eq!(found, truth, "{name}, case {case}, {place:?}");
            }
        }
    }
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
