//! Triangle setup: from the faces of a body to triangles of a raster, culled, clipped, snapped to a grid of subpixels, and
//! turned into edge functions and planes.
//!
//! What is affine in space is affine over the raster once it is divided by w, so a triangle carries the plane of its
//! `inv_depth` and, where it will be shaded, the planes of its normal over w. A fragment then needs no perspective
//! division of its own: the common factor drops out when the normal gets its length.

use super::bins::Bins;
use super::id::{Id, TRIANGLES, parts};
use super::mesh::{Mesh, Paint};
use super::project::{NEAR, Projection};
use super::triangle::{SUB, Triangle};
use crate::cuts;
use crate::vector::cross;
use glam::{Affine3A, Vec3A, Vec4, vec4};

/// The guard band: what lies farther than this from the middle of the raster, pixels, is clipped. Within it the values of
/// edge functions in a tile that they cross fit 32 bits.
const GUARD: f32 = 16384.0;
/// How far rounding may put clipped corners beyond the guard band; the values still fit.
const SLACK: f32 = GUARD / 128.0;

/// The mesh of one body as one raster shows it.
#[derive(Default)]
pub struct SetupMesh {
    /// Its visible triangles.
    pub triangles: Vec<Triangle>,
    /// These by tile.
    pub bins: Bins,
}

impl SetupMesh {
    /// The triangles that the tile of a column and a row of tiles may show, in their order, with their [`Id`] in mesh 0.
    #[inline(always)]
    pub fn in_tile(&self, tile: [usize; 2]) -> impl Iterator<Item = (Id, &Triangle)> {
        self.bins.of(tile).iter().map(|&id| (id, &self.triangles[parts(id).1]))
    }
}

/// Number of the first plane, in [`Corner::outside`], that triangles must be clipped at.
const CLIP: usize = 4;

/// A corner of a triangle.
#[derive(Clone, Copy)]
struct Corner {
    /// Homogeneous pixels.
    h: Vec4,
    /// Place in the world, metres; not known where a triangle is clipped.
    place: Vec3A,
    /// Normal in the world, of any length.
    normal: Vec3A,
    /// Signed distances, in homogeneous pixels and positive inside, from the planes that must be clipped at: the four sides
    /// of the guard band, and near.
    distances: [f32; 5],
    /// For each of the four sides of the raster, then for each of these planes a bit, set where the corner does not lie
    /// inside.
    outside: u32,
    /// Place on the raster, in steps of 1 / [`SUB`] pixel.
    x: i32,
    y: i32,
}

/// What all triangles of a face have in common: see [`Triangle`].
struct Skin<'a> {
    paint: &'a Paint,
    bulge: f32,
    face: u32,
}

/// How the faces of bodies become the triangles of a raster.
#[derive(Clone, Copy)]
pub struct TriangleSetup {
    /// The projection onto the raster.
    pub projection: Projection,
    /// Whether the faces that look away from the eye are drawn, instead of those that look towards it.
    pub back_faces: bool,
    /// Whether the triangles will be shaded, so that they need normals.
    pub shaded: bool,
}

impl TriangleSetup {
    /// Sets up a mesh that `place` puts into the world: the triangles of its faces that look towards the eye and may lie
    /// in the raster. At most 16,383 are kept; corners that are NaN or infinite drop their faces.
    ///
    /// ```text
    /// project all points, note the planes that each lies outside of
    /// for each face
    ///     all corners outside of one plane?        cull it
    ///     a corner beyond near or guard band?      clip it to a polygon
    ///     for each triangle of the fan             clockwise on the raster? snap and push it
    /// ```
    pub fn set_up(&self, mesh: &Mesh, place: &Affine3A) -> SetupMesh {
        let matrix = self.projection.of_body(place);
        let mut corners = Vec::with_capacity(mesh.points.len());
        for (i, p) in mesh.points.iter().enumerate() {
            let (mut at, mut normal) = (Vec3A::ZERO, Vec3A::ZERO);
            if self.shaded {
                at = place.transform_point3a(*p);
                if i < mesh.normals.len() {
                    normal = turned(place, mesh.normals[i]);
                }
            }
            self.add_corner(matrix * p.extend(1.0), at, normal, &mut corners);
        }
        let mut out = SetupMesh::default();
        let mut polygon = Vec::new();
        for (number, face) in mesh.faces.iter().enumerate() {
            let index = face.corners.map(usize::from);
            let [a, b, c] = index.map(|i| &corners[i]);
            if a.outside & b.outside & c.outside != 0 {
                continue;
            }
            let outside = a.outside | b.outside | c.outside;
            polygon.clear();
            polygon.extend_from_slice(&index);
            if outside >> CLIP != 0 {
                self.clip(&mut polygon, &mut corners);
            }
            for i in 2..polygon.len() {
                // On the raster, where y points down, the area is positive if the corners turn clockwise; then so are the
                // edge functions inside.
                let [second, third] = if self.back_faces { [i - 1, i] } else { [i, i - 1] };
                let fan = [0, second, third].map(|i| &corners[polygon[i]]);
                let twice = twice_area(fan);
                if twice > 0 {
                    let mut normals = fan.map(|corner| corner.normal);
                    if self.shaded && mesh.normals.is_empty() {
                        // Vec3A's cross product is fused where the target can.
                        let [a, b, c] = index.map(|i| corners[i].place);
                        normals = [cross(b - a, c - a).normalize_or_zero(); 3];
                    }
                    // Where a point of the smooth surface is the mean, by barycentric weights, of its places on the planes of
                    // the corners' normals `[Hanika21]`, its height in the mean is this sum over the edges.
                    let [a, b, c] = index.map(|i| &corners[i]);
                    let mut bulges = 0.0;
                    if self.shaded {
                        for [a, b] in [[a, b], [b, c], [c, a]] {
                            bulges += (b.place - a.place).dot(b.normal - a.normal).max(0.0);
                        }
                    }
                    let paint = &mesh.paints[face.paint as usize];
                    self.push(&mut out, fan, normals, twice, Skin { paint, bulge: bulges / 12.0, face: number as u32 });
                }
            }
        }
        out.bins = Bins::new(&out.triangles);
        out
    }

    /// Adds a corner at homogeneous pixels `h` to others. In place, as it would be copied if it were returned.
    #[inline(never)]
    fn add_corner(&self, h: Vec4, place: Vec3A, normal: Vec3A, corners: &mut Vec<Corner>) {
        let [a, b] = self.projection.size.map(|n| n as f32 * h.w);
        let (x, y, near) = (h.x - 0.5 * a, h.y - 0.5 * b, h.w - NEAR);
        let guard = Vec4::splat(GUARD * h.w) + vec4(x, -x, y, -y);
        // Written so that NaN lies outside of every plane.
        let within = |distances: Vec4| distances.cmpge(Vec4::ZERO).bitmask();
        let inside = within(vec4(h.x, a - h.x, h.y, b - h.y)) | within(guard) << CLIP | u32::from(near >= 0.0) << 8;
        let [d0, d1, d2, d3] = guard.to_array();
        let (distances, outside) = ([d0, d1, d2, d3, near], !inside & 0x1ff);
        let inverse = 1.0 / h.w;
        let (x, y) = (nearest(h.x * inverse * SUB as f32), nearest(h.y * inverse * SUB as f32));
        corners.push(Corner { h, place, normal, distances, outside, x, y });
    }

    /// Clips a polygon, given by the numbers of its corners, to what lies beyond the near plane and within the guard band
    /// `[SutherlandHodgman74]`. New corners are appended to `corners`.
    fn clip(&self, polygon: &mut Vec<usize>, corners: &mut Vec<Corner>) {
        // Near first: behind the eye the other planes mean nothing.
        for plane in [4, 0, 1, 2, 3] {
            let mut rest = Vec::new();
            for (i, &this) in polygon.iter().enumerate() {
                let next = polygon[if i + 1 < polygon.len() { i + 1 } else { 0 }];
                let (d0, d1) = (corners[this].distances[plane], corners[next].distances[plane]);
                if d0 >= 0.0 {
                    rest.push(this);
                }
                if (d0 >= 0.0) != (d1 >= 0.0) {
                    // Interpolated from the corner nearer to the plane, since the digits of a far one do not reach here.
                    // Both faces of an edge then get the same point. Of two equally near corners, from the one inside.
                    let nearer = (d0 + d1 > 0.0) != (d0 >= 0.0);
                    let [a, b] = if nearer { [this, next] } else { [next, this] }.map(|i| &corners[i]);
                    let k = a.distances[plane] / (a.distances[plane] - b.distances[plane]);
                    rest.push(corners.len());
                    let (h, normal) = (a.h + (b.h - a.h) * k, a.normal + (b.normal - a.normal) * k);
                    self.add_corner(h, Vec3A::ZERO, normal, corners);
                }
            }
            *polygon = rest;
        }
        // A corner that is NaN, or has lost all its digits beside another, may be anywhere: such a polygon is dropped.
        let sound = |&i: &usize| {
            let Corner { h, distances: [a, b, c, d, near], .. } = corners[i];
            near >= -0.5 * NEAR && [a, b, c, d].into_iter().all(|side| side >= -SLACK * h.w)
        };
        if !polygon.iter().all(sound) {
            polygon.clear();
        }
    }

    /// Adds a triangle, of which `twice` is twice the area (see [`twice_area`]), unless it lies beside the raster.
    fn push(&self, out: &mut SetupMesh, corners: [&Corner; 3], normals: [Vec3A; 3], twice: i64, skin: Skin) {
        let first = corners[0];
        let mut edges = [(0, 0, 0); 3];
        let [width, height] = self.projection.size.map(|n| n as i32 - 1);
        let mut values = [Vec4::ZERO; 3];
        // First and last column and row, inside out until the corners have widened it.
        let mut bound = [i32::MAX, i32::MIN, i32::MAX, i32::MIN];
        let mut range = [f32::INFINITY, f32::NEG_INFINITY];
        for (k, &a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % 3];
            let inverse = 1.0 / a.h.w;
            let inv_depth = a.h.z * inverse;
            values[k] = (normals[k] * inverse).extend(inv_depth);
            let (ex, ey) = (a.y - b.y, b.x - a.x);
            // The top-left rule: a sample on an edge belongs to the triangle to its right or below it. On other edges 0
            // is outside, so c is less by 1.
            let own = ex > 0 || (ex == 0 && ey > 0);
            edges[k] = (ex, ey, -(ex as i64 * a.x as i64 + ey as i64 * a.y as i64) - !own as i64);
            // Whole pixels, as a sample may lie anywhere in its pixel.
            let (x, y) = (a.x >> SUB.ilog2(), a.y >> SUB.ilog2());
            bound = [bound[0].min(x), bound[1].max(x), bound[2].min(y), bound[3].max(y)];
            range = [range[0].min(inv_depth), range[1].max(inv_depth)];
        }
        bound = [bound[0].max(0), bound[1].min(width), bound[2].max(0), bound[3].min(height)];
        // A mesh of 8,192 faces, each cut in two by the near plane, fits. Cuts at the guard band may add more, whose
        // numbers would be those of the next mesh.
        if bound[0] > bound[1] || bound[2] > bound[3] || out.triangles.len() == TRIANGLES {
            return;
        }
        // The gradients of the planes, by Cramer's rule. In f64, as slivers cancel all digits of f32. Edge functions hold
        // the differences of corners.
        let [(ay, ax, _), _, (by, bx, _)] = edges.map(|(x, y, c)| (x as f64, y as f64, c));
        let inverse = SUB as f64 / twice as f64;
        let [a, b, c] = values;
        let (b, c) = ((b - a).as_dvec4(), (c - a).as_dvec4());
        out.triangles.push(Triangle {
            edges,
            bound,
            anchor: [first.x as f32 / SUB as f32, first.y as f32 / SUB as f32],
            at: a,
            by: [((b * by + c * ay) * inverse).as_vec4(), ((b * bx + c * ax) * inverse).as_vec4()],
            range,
            bulge: skin.bulge,
            paint: *skin.paint,
            face: if cuts::TRACED_SHADOWS { skin.face } else { 0 },
        });
    }
}

/// The whole number nearest to a number, of two the even one; any for what is too large for it.
fn nearest(x: f32) -> i32 {
    // Beside 1.5 times 2^52 a number has no fraction, and its lowest bits are the whole one.
    (f64::from(x) + 6_755_399_441_055_744.0).to_bits() as i32
}

/// A normal of a body, turned into the world: of length 1, or 0.
fn turned(place: &Affine3A, normal: Vec3A) -> Vec3A {
    (place.matrix3 * normal).normalize_or_zero()
}

/// Twice the area of a triangle, in squares of 1 / [`SUB`] pixel; positive where its corners turn clockwise on the raster.
fn twice_area([a, b, c]: [&Corner; 3]) -> i64 {
    let (bx, by) = ((b.x - a.x) as i64, (b.y - a.y) as i64);
    let (cx, cy) = ((c.x - a.x) as i64, (c.y - a.y) as i64);
    bx * cy - cx * by
}
