//! From the faces of a body to triangles in the raster: clipped, snapped, and what is affine over them.

use super::bins::MOST;
use super::mesh::{Mesh, Paint};
use super::project::{NEAR, Projection};
use glam::{Affine3A, Vec3, Vec3A, Vec4};

/// Steps of a pixel to which corners are snapped, in each direction.
pub const SUB: i32 = 256;
/// Corners farther than this from the picture's middle, pixels, are clipped: then edges fit 32 bits within a tile.
const GUARD: f32 = 16384.0;
/// How far clipped corners may lie beyond that: edges still fit.
const SLACK: f32 = GUARD / 128.0;

/// A triangle that faces the eye.
#[derive(Clone, Copy, Debug)]
pub struct Triangle {
    /// Three functions `a x + b y + c`, not negative inside, of coordinates in steps of [`SUB`].
    pub edges: [(i32, i32, i64); 3],
    /// The pixels whose centres, or samples, may be inside: first and last column, first and last row.
    pub bound: [i32; 4],
    /// Where planes have their values, pixels.
    pub anchor: [f32; 2],
    /// There, the components of the normal in the world, of any length, and nearness. Normals are 0 where nothing is
    /// shaded.
    pub at: Vec4,
    /// Their change a pixel along x and along y: they are affine over the raster.
    pub by: [Vec4; 2],
    /// Nearness of the farthest and of the nearest corner: on slivers the plane leaves them.
    pub range: [f32; 2],
    /// What it is painted with.
    pub paint: Paint,
}

impl Triangle {
    /// Nearness at a point of the raster, pixels.
    pub fn inv_depth(&self, x: f32, y: f32) -> f32 {
        let near = self.at.w + self.by[0].w * (x - self.anchor[0]) + self.by[1].w * (y - self.anchor[1]);
        near.clamp(self.range[0], self.range[1])
    }
}

/// One body in one raster.
#[derive(Default)]
pub struct SetupMesh {
    /// Its visible triangles.
    pub triangles: Vec<Triangle>,
}

/// The first of the planes that must be clipped at.
const CLIP: usize = 4;

/// A corner of a triangle.
#[derive(Clone, Copy)]
struct Corner {
    /// Homogeneous pixels.
    h: Vec4,
    /// Normal in the world, of any length.
    normal: Vec3A,
    /// From the picture's sides, and from [`CLIP`] on from the planes that must be clipped at, signed, in homogeneous
    /// pixels: near, and the guard band's sides.
    distances: [f32; 9],
    /// A bit for each of those that it does not lie inside of.
    outside: u32,
    /// On the raster, in steps of [`SUB`].
    x: i32,
    y: i32,
}

/// How bodies become pieces.
#[derive(Clone, Copy)]
pub struct TriangleSetup {
    /// The raster.
    pub projection: Projection,
    /// Are the faces that look away drawn, instead of those that look here?
    pub back_faces: bool,
    /// Will they be shaded?
    pub shaded: bool,
}

impl TriangleSetup {
    /// The triangles of a body's faces that look towards the eye, and may lie in the picture.
    pub fn piece(&self, mesh: &Mesh, place: &Affine3A) -> SetupMesh {
        let matrix = self.projection.of_body(place);
        let mut corners = Vec::with_capacity(mesh.points.len());
        for (i, p) in mesh.points.iter().enumerate() {
            let mut normal = Vec3A::ZERO;
            if self.shaded && i < mesh.normals.len() {
                normal = turned(place, mesh.normals[i]);
            }
            corners.push(self.corner(matrix * p.extend(1.0), normal));
        }
        let mut piece = SetupMesh::default();
        let mut polygon = Vec::new();
        for face in &mesh.faces {
            let index = face.corners.map(usize::from);
            let [a, b, c] = index.map(|i| corners[i].outside);
            if a & b & c != 0 {
                continue;
            }
            polygon.clear();
            polygon.extend_from_slice(&index);
            if (a | b | c) >> CLIP != 0 {
                self.clip(&mut polygon, &mut corners);
            }
            for i in 2..polygon.len() {
                // Clockwise on the screen, where y points down, is positive: then edges are so inside.
                let [second, third] = if self.back_faces { [i - 1, i] } else { [i, i - 1] };
                let fan = [0, second, third].map(|i| &corners[polygon[i]]);
                let twice = twice_area(fan);
                if twice > 0 {
                    let mut normals = fan.map(|corner| corner.normal);
                    if self.shaded && mesh.normals.is_empty() {
                        let [a, b, c] = index.map(|i| mesh.points[i]);
                        normals = [turned(place, (b - a).cross(c - a)); 3];
                    }
                    self.push(&mut piece, fan, normals, twice, &mesh.paints[face.paint as usize]);
                }
            }
        }
        piece
    }

    /// To the raster.
    fn corner(&self, h: Vec4, normal: Vec3A) -> Corner {
        let [a, b] = self.projection.size.map(|n| n as f32 * h.w);
        let (x, y, guard) = (h.x - 0.5 * a, h.y - 0.5 * b, GUARD * h.w);
        let distances = [h.x, a - h.x, h.y, b - h.y, h.w - NEAR, guard + x, guard - x, guard + y, guard - y];
        let mut outside = 0;
        for (k, distance) in distances.into_iter().enumerate() {
            // What is not a number is inside of none.
            #[allow(clippy::neg_cmp_op_on_partial_ord)]
            let beyond = !(distance >= 0.0);
            outside |= u32::from(beyond) << k;
        }
        let inverse = 1.0 / h.w;
        let sub = |x: f32| (x * inverse * SUB as f32).round() as i32;
        let (x, y) = (sub(h.x), sub(h.y));
        Corner { h, normal, distances, outside, x, y }
    }

    /// The part of a triangle before the near plane and within the guard band, with new corners after the others:
    /// Sutherland and Hodgman, "Reentrant polygon clipping", 1974.
    fn clip(&self, polygon: &mut Vec<usize>, corners: &mut Vec<Corner>) {
        for plane in CLIP..9 {
            let mut rest = Vec::new();
            for (i, &this) in polygon.iter().enumerate() {
                let next = polygon[if i + 1 < polygon.len() { i + 1 } else { 0 }];
                let (d0, d1) = (corners[this].distances[plane], corners[next].distances[plane]);
                if d0 >= 0.0 {
                    rest.push(this);
                }
                if (d0 >= 0.0) != (d1 >= 0.0) {
                    // From the nearer to the farther, whose digits do not reach here; and so both faces of an edge get
                    // the same point. Of two that are as near from the one inside.
                    let nearer = (d0 + d1 > 0.0) != (d0 >= 0.0);
                    let [a, b] = if nearer { [this, next] } else { [next, this] }.map(|i| &corners[i]);
                    let k = a.distances[plane] / (a.distances[plane] - b.distances[plane]);
                    rest.push(corners.len());
                    corners.push(self.corner(a.h + (b.h - a.h) * k, a.normal + (b.normal - a.normal) * k));
                }
            }
            *polygon = rest;
        }
        // What is not a number, or has lost all its digits beside another, is where nothing can be.
        let sound = |&i: &usize| {
            let Corner { h, distances: [.., near, a, b, c, d], .. } = corners[i];
            near >= -0.5 * NEAR && [a, b, c, d].into_iter().all(|side| side >= -SLACK * h.w)
        };
        if !polygon.iter().all(sound) {
            polygon.clear();
        }
    }

    /// Adds a triangle of that area, twice over.
    fn push(&self, piece: &mut SetupMesh, corners: [&Corner; 3], normals: [Vec3A; 3], twice: i64, paint: &Paint) {
        let first = corners[0];
        let mut edges = [(0, 0, 0); 3];
        let [width, height] = self.projection.size.map(|n| n as i32 - 1);
        let mut values = [Vec4::ZERO; 3];
        // First and last column and row, turned around while they are sought.
        let mut bound = [i32::MAX, i32::MIN, i32::MAX, i32::MIN];
        let mut range = [f32::INFINITY, f32::NEG_INFINITY];
        for (k, a) in corners.into_iter().enumerate() {
            let b = corners[(k + 1) % 3];
            let inverse = 1.0 / a.h.w;
            let inv_depth = a.h.z * inverse;
            values[k] = (normals[k] * inverse).extend(inv_depth);
            let (ex, ey) = (a.y - b.y, b.x - a.x);
            // The top-left rule: a sample on an edge belongs to the triangle on its right or below it.
            let own = ex > 0 || (ex == 0 && ey > 0);
            edges[k] = (ex, ey, -(ex as i64 * a.x as i64 + ey as i64 * a.y as i64) - !own as i64);
            // A sample may lie anywhere in its pixel.
            let (x, y) = (a.x >> SUB.ilog2(), a.y >> SUB.ilog2());
            bound = [bound[0].min(x), bound[1].max(x), bound[2].min(y), bound[3].max(y)];
            range = [range[0].min(inv_depth), range[1].max(inv_depth)];
        }
        bound = [bound[0].max(0), bound[1].min(width), bound[2].max(0), bound[3].min(height)];
        // Only the near plane's cut is allowed for: more would take the numbers of other pieces.
        if bound[0] > bound[1] || bound[2] > bound[3] || piece.triangles.len() == MOST {
            return;
        }
        // In f64, as slivers cancel all digits of f32. The edges are the differences of corners.
        let [(ay, ax, _), _, (by, bx, _)] = edges.map(|(x, y, c)| (x as f64, y as f64, c));
        let inverse = SUB as f64 / twice as f64;
        let [a, b, c] = values;
        let (b, c) = ((b - a).as_dvec4(), (c - a).as_dvec4());
        piece.triangles.push(Triangle {
            edges,
            bound,
            anchor: [first.x as f32 / SUB as f32, first.y as f32 / SUB as f32],
            at: a,
            by: [((b * by + c * ay) * inverse).as_vec4(), ((b * bx + c * ax) * inverse).as_vec4()],
            range,
            paint: *paint,
        });
    }
}

/// A normal of a body in the world, of length 1 if any.
fn turned(place: &Affine3A, normal: Vec3) -> Vec3A {
    (place.matrix3 * Vec3A::from(normal)).normalize_or_zero()
}

/// Twice the area, in steps of [`SUB`] squared; positive where the corners turn clockwise on the screen.
fn twice_area([a, b, c]: [&Corner; 3]) -> i64 {
    let (bx, by) = ((b.x - a.x) as i64, (b.y - a.y) as i64);
    let (cx, cy) = ((c.x - a.x) as i64, (c.y - a.y) as i64);
    bx * cy - cx * by
}
