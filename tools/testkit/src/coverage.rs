//! Triangles whose corners are whole 256ths of a pixel, drawn as a frame does, and which pixels they cover by whole
//! numbers that cannot overflow.
//!
//! The projection is the identity, so corners are where a caller puts them.

use super::random::Random;
use fearless_simd::{Level, dispatch};
use glam::{Affine3A, Vec3A, Vec4, vec3a};
use paprsek::frame::Tile;
use paprsek::raster::fill::fill;
use paprsek::raster::id::{NOTHING, parts};
use paprsek::raster::setup::{SetupMesh, TriangleSetup};
use paprsek::raster::triangle::SUB;
use paprsek::raster::visible::{CENTER, SubPixel, Visible};
use paprsek::raster::{Face, Mesh, Paint, Projection};

/// Steps of 1/256 pixel, and nearness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Column, steps of 1/256 pixel.
    pub x: i32,
    /// Row, steps.
    pub y: i32,
    /// Nearness.
    pub near: f32,
}

/// The corners of a triangle.
pub type Corners = [Corner; 3];

/// Odd, one pixel, whole tiles, a pixel more and less than tiles.
pub const SIZES: [[u32; 2]; 5] = [[100, 70], [64, 64], [65, 63], [1, 1], [131, 5]];
/// Corners may be that far from the picture's middle before they are clipped, steps.
pub const GUARD: i32 = 16384 * SUB;

/// Triangles set up for a picture of that size.
pub fn piece(triangles: &[Corners], size: [u32; 2], back_faces: bool) -> SetupMesh {
    let mut mesh = Mesh { paints: vec![Paint { albedo: Vec3A::ONE, texture: None, gloss: 0.0 }], ..Mesh::default() };
    for corners in triangles {
        let first = mesh.points.len() as u16;
        mesh.faces.push(Face { corners: [first, first + 1, first + 2], paint: 0 });
        let step = 1.0 / SUB as f32;
        mesh.points.extend(corners.map(|c| vec3a(c.x as f32 * step, c.y as f32 * step, c.near)));
    }
    let projection = Projection { rows: Vec4::AXES, size, texel: 1.0 };
    TriangleSetup { projection, back_faces, shaded: false }.set_up(&mesh, &Affine3A::IDENTITY)
}

/// What each pixel of a picture shows: nearness and number of the triangle.
#[derive(Clone, PartialEq, Debug)]
pub struct Shown(
    /// Row by row from the top left.
    pub Vec<(f32, Option<usize>)>,
);

/// Draws pieces as a frame does: by the tiles' lists.
pub fn draw(level: Level, pieces: &[SetupMesh], size: [u32; 2], sample: SubPixel) -> Shown {
    let [width, height] = size.map(|n| n as usize);
    let mut shown = vec![(0.0, None); width * height];
    let mut planes = [(Visible::default(), sample)];
    for y in (0..height).step_by(Tile::SIZE) {
        for x in (0..width).step_by(Tile::SIZE) {
            planes[0].0.clear(&[0.0; Tile::AREA]);
            let tile = [x, y].map(|n| n / Tile::SIZE);
            dispatch!(level, simd => fill(simd, &mut pieces.iter(), tile, &mut planes));
            let out = &planes[0].0;
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
pub fn sample_of(pixel: usize, width: u32, sample: SubPixel) -> [i128; 2] {
    let (x, y) = (pixel as i128 % width as i128, pixel as i128 / width as i128);
    [x * SUB as i128 + sample[0] as i128, y * SUB as i128 + sample[1] as i128]
}

/// Twice the area of `a`, `b` and a point; positive where they turn clockwise on the screen.
pub fn turn(a: Corner, b: Corner, s: [i128; 2]) -> i128 {
    (b.x as i128 - a.x as i128) * (s[1] - a.y as i128) - (b.y as i128 - a.y as i128) * (s[0] - a.x as i128)
}

/// Twice the area of a triangle; positive where its corners turn clockwise on the screen.
pub fn area(t: &Corners) -> i128 {
    turn(t[0], t[1], [t[2].x as i128, t[2].y as i128])
}

/// Is a point a hair to the right of the sample, and a hair of that hair below it, inside? That is the top-left rule:
/// such a point is on no edge.
pub fn covers(t: &Corners, s: [i128; 2]) -> bool {
    let sign = area(t).signum();
    sign != 0
        && (0..3).all(|k| {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            let (dx, dy) = (sign * (b.x as i128 - a.x as i128), sign * (b.y as i128 - a.y as i128));
            (sign * turn(a, b, s), -dy, dx) > (0, 0, 0)
        })
}

/// A number of steps that is likely to go wrong, about a picture of `size` pixels.
pub fn hard(random: &mut Random, size: u32) -> i32 {
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
pub fn any_triangle(random: &mut Random, size: [u32; 2]) -> Corners {
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

/// How often each pixel is covered when each triangle is drawn alone.
pub fn counts(level: Level, triangles: &[Corners], size: [u32; 2], sample: SubPixel) -> Vec<u32> {
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

/// Nearness of a triangle's plane at a point, and the sum of the terms' sizes that f32 adds up, whatever corner it
/// starts from.
pub fn plane(t: &Corners, s: [i128; 2]) -> (f64, f64) {
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
pub const NEARNESS: f64 = 6.0;

/// A hard triangle of a numbered case, and how it is drawn.
pub struct Single {
    /// The triangle.
    pub corners: Corners,
    /// Pixels of the picture.
    pub size: [u32; 2],
    /// Where in its pixel each sample is, steps.
    pub sample: SubPixel,
    /// Whether triangles are drawn that turn away.
    pub back_faces: bool,
    /// Whether the triangle is drawn: counter-clockwise looks here.
    pub here: bool,
}

/// The triangle of a case: every size, samples in the middle, in corners and anywhere.
pub fn single(random: &mut Random, case: usize) -> Single {
    let size = SIZES[if case.is_multiple_of(3) { case / 3 % SIZES.len() } else { 0 }];
    let corners = any_triangle(random, size);
    let sample = match case % 4 {
        0 | 1 => CENTER,
        2 => [[0, 0], [SUB - 1, 0], [0, SUB - 1], [SUB - 1; 2]][case / 4 % 4],
        _ => [0, 1].map(|_| (random.unit() * SUB as f64) as i32),
    };
    let back_faces = case.is_multiple_of(5);
    let here = if back_faces { area(&corners) > 0 } else { area(&corners) < 0 };
    Single { corners, size, sample, back_faces, here }
}

/// Pixels of the pictures of grids and fans.
pub const SHEET: [u32; 2] = [100, 70];

/// A grid of triangles that covers each pixel of a sheet once, and the place of the samples.
pub fn grid(random: &mut Random, case: usize) -> (Vec<Corners>, SubPixel) {
    // Cells of 16 to 40 pixels, all around the picture.
    let cell = [16 * SUB, 20 * SUB + SUB / 2, 40 * SUB, 25 * SUB + 77, 16 * SUB + SUB / 2][case % 5];
    let (columns, rows) = (SHEET[0] as i32 * SUB / cell + 4, SHEET[1] as i32 * SUB / cell + 4);
    // Less than would turn a triangle over.
    let jitter = [0, 1, SUB / 2, cell / 5][case % 4];
    let mut points = Vec::new();
    for j in 0..=rows {
        for i in 0..=columns {
            let mut off = || random.range(-jitter as f64, jitter as f64 + 1.0).floor() as i32;
            points.push(Corner { x: (i - 1) * cell - SUB + off(), y: (j - 1) * cell - SUB + off(), near: 1.0 });
        }
    }
    let mut mesh = Vec::new();
    for j in 0..rows as usize {
        for i in 0..columns as usize {
            let at = |i: usize, j: usize| points[j * (columns as usize + 1) + i];
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
            mesh.extend(if random.unit() < 0.5 { [[a, c, b], [b, c, d]] } else { [[a, c, d], [a, d, b]] });
        }
    }
    let sample = if case.is_multiple_of(2) { CENTER } else { [(random.unit() * SUB as f64) as i32, 0] };
    (mesh, sample)
}

/// A star of 3 to 42 spokes around a corner, which may lie on a sample, and its rim; with `wide` it reaches around the
/// sheet. None where rounding to whole steps turned a triangle over, or three spokes left more than half a turn between
/// two.
pub fn fan(random: &mut Random, case: usize, wide: bool) -> Option<(Vec<Corners>, Vec<Corner>)> {
    let grid = [1, SUB / 2, SUB][case % 3];
    let round = |x: f64| (x * SUB as f64 / grid as f64).round() as i32 * grid;
    let (x, y) = (round(random.range(20.0, 80.0)), round(random.range(20.0, 50.0)));
    let spokes = 3 + case as i32 % 40;
    let mut rim: Vec<Corner> = Vec::new();
    for k in 0..spokes {
        let (sin, cos) = ((k as f64 + random.range(0.0, 0.8)) / spokes as f64 * std::f64::consts::TAU).sin_cos();
        let r = if wide { random.log(300.0, 9000.0) } else { random.log(0.3, 45.0) };
        rim.push(Corner { x: x + round(r * cos), y: y + round(r * sin), near: 1.0 });
    }
    let center = Corner { x, y, near: 1.0 };
    let fan: Vec<Corners> = (0..rim.len()).map(|k| [center, rim[k], rim[(k + 1) % rim.len()]]).collect();
    fan.iter().all(|t| area(t) >= 0).then_some((fan, rim))
}

/// A hard triangle of [`SIZES`]`[0]`, three in ten from the near plane to the horizon.
pub fn deep_triangle(random: &mut Random) -> Corners {
    let mut t = any_triangle(random, SIZES[0]);
    if random.unit() < 0.3 {
        t.iter_mut().for_each(|c| c.near = random.log(1e-5, 20.0) as f32);
    }
    t
}
