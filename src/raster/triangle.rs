//! From the faces of a body to triangles in the raster: clipped, snapped, and what is affine over them.

use super::bins::{MOST, PLAIN};
use super::mesh::{Mesh, Paint};
use super::project::Projection;
use glam::{Affine3A, Vec3, Vec4};

/// Steps of a pixel to which corners are snapped, in each direction.
pub const SUB: i32 = 256;
/// Corners farther than this from the picture's middle, pixels, are clipped: then edges fit 32 bits within a tile.
const GUARD: f32 = 16384.0;
/// How far clipped corners may lie beyond that: edges still fit.
const SLACK: f32 = GUARD / 128.0;

/// A value that is affine over the raster.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plane {
    /// At the triangle's anchor.
    pub at: f32,
    /// Change a pixel along x and along y.
    pub by: [f32; 2],
}

/// A triangle that faces the eye.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Three functions `a x + b y + c`, not negative inside, of coordinates in steps of [`SUB`].
    pub edges: [(i32, i32, i64); 3],
    /// The pixels whose centres, or samples, may be inside: first and last column, first and last row.
    pub bound: [i32; 4],
    /// Where planes have their values, pixels.
    pub anchor: [f32; 2],
    /// Nearness.
    pub nearness: Plane,
    /// Index of the world's texture, or [`PLAIN`].
    pub texture: u32,
    /// Nearness of the farthest and of the nearest corner: on slivers the plane leaves them.
    pub range: [f32; 2],
}

/// What the shading of a triangle needs.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Components of the normal in the world, of any length.
    pub normal: [Plane; 3],
    /// What it is painted with.
    pub paint: Paint,
}

/// One body in one raster.
#[derive(Default)]
pub struct Piece {
    /// Its visible triangles.
    pub triangles: Vec<Triangle>,
    /// Their surfaces; none in depth maps.
    pub surfaces: Vec<Surface>,
}

/// What depth maps are painted with.
const NO_PAINT: Paint = Paint { albedo: Vec3::ZERO, texture: None, gloss: 0.0 };

/// A corner before it is snapped.
#[derive(Clone, Copy)]
struct Corner {
    /// Homogeneous pixels.
    h: Vec4,
    /// Normal in the world, of any length.
    normal: Vec3,
}

/// A corner on the raster.
#[derive(Clone, Copy, Default)]
struct Snapped {
    /// In steps of [`SUB`].
    x: i32,
    y: i32,
    nearness: f32,
    /// 1 / w.
    inverse: f32,
}

/// How bodies become pieces.
#[derive(Clone, Copy)]
pub struct Setup {
    /// The raster.
    pub projection: Projection,
    /// Are the faces that look away drawn, instead of those that look here?
    pub back_faces: bool,
    /// Will they be shaded?
    pub shaded: bool,
}

impl Setup {
    /// The triangles of a body's faces that look towards the eye, and may lie in the picture.
    pub fn piece(&self, mesh: &Mesh, place: &Affine3A) -> Piece {
        let matrix = self.projection.of_body(place);
        let mut piece = Piece::default();
        let corners: Vec<(Vec4, u32, Snapped)> = mesh
            .points
            .iter()
            .map(|&p| {
                let h = matrix * p.extend(1.0);
                let outside = self.outside(h);
                (h, outside, if outside < CLIP { snap(h) } else { Snapped::default() })
            })
            .collect();
        for face in &mesh.faces {
            let index = face.corners.map(usize::from);
            let [a, b, c] = index.map(|i| corners[i]);
            if a.1 & b.1 & c.1 != 0 {
                continue;
            }
            let clipped = a.1 | b.1 | c.1 >= CLIP;
            if !clipped && !self.faces_here(a.2, b.2, c.2) {
                continue;
            }
            let mut normals = [Vec3::ZERO; 3];
            let mut paint = NO_PAINT;
            if self.shaded {
                normals = if mesh.normals.is_empty() {
                    let [a, b, c] = index.map(|i| mesh.points[i]);
                    [(b - a).cross(c - a); 3]
                } else {
                    index.map(|i| mesh.normals[i])
                };
                normals = normals.map(|n| (place.matrix3 * n).normalize_or_zero());
                paint = mesh.paints[face.paint as usize];
            }
            if !clipped {
                self.push(&mut piece, [a.2, b.2, c.2], normals, paint);
                continue;
            }
            let corner = |i: usize, h: Vec4| Corner { h, normal: normals[i] };
            let polygon = self.clip([corner(0, a.0), corner(1, b.0), corner(2, c.0)]);
            for i in 2..polygon.len() {
                let fan = [polygon[0], polygon[i - 1], polygon[i]];
                let [a, b, c] = fan.map(|corner| snap(corner.h));
                if self.faces_here(a, b, c) {
                    self.push(&mut piece, [a, b, c], fan.map(|corner| corner.normal), paint);
                }
            }
        }
        piece
    }

    /// The planes of a convex region, as signed distances, of homogeneous pixels: first the picture's sides, then what
    /// must be clipped at.
    fn distances(&self, h: Vec4) -> [f32; 9] {
        let [width, height] = self.projection.size.map(|n| n as f32);
        let (x, y) = (h.x - 0.5 * width * h.w, h.y - 0.5 * height * h.w);
        let guard = GUARD * h.w;
        let near = h.w - self.projection.near;
        [h.x, width * h.w - h.x, h.y, height * h.w - h.y, near, guard + x, guard - x, guard + y, guard - y]
    }

    /// A bit for each of those planes that the point does not lie inside of; what is not a number is inside of none.
    fn outside(&self, h: Vec4) -> u32 {
        let inside = self.distances(h).into_iter().rev().fold(0, |bits, distance| bits << 1 | (distance >= 0.0) as u32);
        inside ^ 0x1ff
    }

    /// The part of a triangle before the near plane and within the guard band: Sutherland and Hodgman, "Reentrant
    /// polygon clipping", 1974.
    fn clip(&self, triangle: [Corner; 3]) -> Vec<Corner> {
        let mut polygon = triangle.to_vec();
        for plane in 4..9 {
            let distance = |corner: &Corner| self.distances(corner.h)[plane];
            let mut rest = Vec::new();
            for i in 0..polygon.len() {
                let (this, next) = (polygon[i], polygon[(i + 1) % polygon.len()]);
                let (d0, d1) = (distance(&this), distance(&next));
                if d0 >= 0.0 {
                    rest.push(this);
                }
                if (d0 >= 0.0) != (d1 >= 0.0) {
                    // From the nearer to the farther, whose digits do not reach here; and so both faces of an edge get
                    // the same point.
                    let nearer = d0.abs() < d1.abs() || (d0.abs() == d1.abs() && d0 >= 0.0);
                    let ((a, da), (b, db)) = if nearer { ((this, d0), (next, d1)) } else { ((next, d1), (this, d0)) };
                    let k = da / (da - db);
                    rest.push(Corner { h: a.h + (b.h - a.h) * k, normal: a.normal + (b.normal - a.normal) * k });
                }
            }
            polygon = rest;
        }
        // What is not a number, or has lost all its digits beside another, is where nothing can be.
        let sound = |corner: &Corner| {
            let slack = [0.5 * self.projection.near, SLACK * corner.h.w];
            (4..9).all(|plane| self.distances(corner.h)[plane] >= -slack[(plane > 4) as usize])
        };
        if polygon.iter().all(sound) { polygon } else { Vec::new() }
    }

    /// Are the corners in the order of a face that is to be drawn?
    fn faces_here(&self, a: Snapped, b: Snapped, c: Snapped) -> bool {
        let twice = twice_area(a, b, c);
        if self.back_faces { twice > 0 } else { twice < 0 }
    }

    /// Adds a triangle that has an area.
    #[inline(never)]
    fn push(&self, piece: &mut Piece, corners: [Snapped; 3], normals: [Vec3; 3], paint: Paint) {
        // Clockwise on the screen, where y points down, is positive: then edges are so inside.
        let order = if self.back_faces { [0, 1, 2] } else { [0, 2, 1] };
        let corners = order.map(|i: usize| corners[i]);
        let first = corners[0];
        let mut edges = [(0, 0, 0); 3];
        let [width, height] = self.projection.size.map(|n| n as i32 - 1);
        // First and last column and row, turned around while they are sought.
        let mut bound = [i32::MAX, i32::MIN, i32::MAX, i32::MIN];
        let mut range = [f32::INFINITY, f32::NEG_INFINITY];
        for (k, a) in corners.into_iter().enumerate() {
            let b = corners[(k + 1) % 3];
            let (ex, ey) = (a.y - b.y, b.x - a.x);
            // The top-left rule: a sample on an edge belongs to the triangle on its right or below it.
            let own = ex > 0 || (ex == 0 && ey > 0);
            edges[k] = (ex, ey, -(ex as i64 * a.x as i64 + ey as i64 * a.y as i64) - !own as i64);
            // A sample may lie anywhere in its pixel.
            let (x, y) = (a.x >> SUB.ilog2(), a.y >> SUB.ilog2());
            bound = [bound[0].min(x), bound[1].max(x), bound[2].min(y), bound[3].max(y)];
            range = [range[0].min(a.nearness), range[1].max(a.nearness)];
        }
        bound = [bound[0].max(0), bound[1].min(width), bound[2].max(0), bound[3].min(height)];
        // Only the near plane's cut is allowed for: more would take the numbers of other pieces.
        if bound[0] > bound[1] || bound[2] > bound[3] || piece.triangles.len() == MOST {
            return;
        }
        let mut planes = [Plane::default(); 4];
        for (k, plane) in planes.iter_mut().enumerate().take(if self.shaded { 4 } else { 1 }) {
            let mut values = corners.map(|corner| corner.nearness);
            if k > 0 {
                for (i, value) in values.iter_mut().enumerate() {
                    *value = normals[order[i]][k - 1] * corners[i].inverse;
                }
            }
            *plane = Plane::through(&corners, values);
        }
        let [nearness, x, y, z] = planes;
        let anchor = [first.x as f32 / SUB as f32, first.y as f32 / SUB as f32];
        let texture = paint.texture.map_or(PLAIN, u32::from);
        piece.triangles.push(Triangle { edges, bound, anchor, nearness, texture, range });
        if self.shaded {
            piece.surfaces.push(Surface { normal: [x, y, z], paint });
        }
    }
}

impl Plane {
    /// Through values at the corners, anchored at the first.
    fn through(corners: &[Snapped; 3], values: [f32; 3]) -> Plane {
        // In f64, as slivers cancel all digits of f32.
        let [(bx, by), (cx, cy)] = [1, 2].map(|i| {
            let (x, y) = (corners[i].x - corners[0].x, corners[i].y - corners[0].y);
            (x as f64 / SUB as f64, y as f64 / SUB as f64)
        });
        let inverse = 1.0 / (bx * cy - cx * by);
        let (b, c) = ((values[1] - values[0]) as f64, (values[2] - values[0]) as f64);
        let by = [(b * cy - c * by) * inverse, (c * bx - b * cx) * inverse];
        Plane { at: values[0], by: by.map(|slope| slope as f32) }
    }
}

/// Bits of [`Setup::outside`] from this on ask for clipping.
const CLIP: u32 = 1 << 4;

/// To the raster.
fn snap(h: Vec4) -> Snapped {
    let inverse = 1.0 / h.w;
    let snap = |x: f32| (x * inverse * SUB as f32).round() as i32;
    Snapped { x: snap(h.x), y: snap(h.y), nearness: h.z * inverse, inverse }
}

/// Twice the area, in steps of [`SUB`] squared; positive where the corners turn clockwise on the screen.
fn twice_area(a: Snapped, b: Snapped, c: Snapped) -> i64 {
    let (bx, by) = ((b.x - a.x) as i64, (b.y - a.y) as i64);
    let (cx, cy) = ((c.x - a.x) as i64, (c.y - a.y) as i64);
    bx * cy - cx * by
}
